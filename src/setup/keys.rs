//! The keys of a scene, and the flags of the command line that set them.
//!
//! A new key is one row, here or in the file of its drive: the flag and its help, the units that its value takes, whether it is a file, and where it would
//! have no effect are read from there.

use super::idle::{GIVEN_STEPS, NO_CREEP, NO_FRICTION_PATH, NO_HALF_SPACE, NO_RASTER, NO_YIELDING, YIELDING};
use super::key::{Dimension, FlagValue, Key, choices, key, without_flag};
use super::{Boundary, DRIVES, Method, Part, Theme};
use crate::contact::{Dynamics, Masses};
use crate::elastic::Base;
use crate::surface::{
    Detrend, ExactPart, Fill, Form, Indenter, LineLevel, Mirror, Outliers, Preparation, Resample, RolloffForm, Scars,
    SpectrumConvention,
};

/// The keys before those of the drives.
#[rustfmt::skip]
const OF_CONTACTS: &[Key] = &[
    key("surface.height", "height", FlagValue::One, Dimension::File, "FILE", "File of heights of a line or a surface: an instrument's format, .npy, .npz or text; peaks towards the solid are positive"),
    key("surface.against", "against", FlagValue::One, Dimension::File, "FILE", "File of heights of the second body, of the same shape; peaks towards the first body are positive; both heights are added"),
    key("surface.channel", "channel", FlagValue::One, Dimension::Word, "NAME", "Channel of a file with several channels, by name or number"),
    key("surface.file-unit", "file-unit", FlagValue::One, Dimension::Unit, "L", "Unit of all lengths in a file without units, heights and distances, such as 1um"),
    key("surface.height-unit", "height-unit", FlagValue::One, Dimension::Unit, "L", "Unit of the heights alone in a file without units, such as 1nm, where that of the distances is another one"),
    key("surface.prepare.steps", "prepare", FlagValue::Choice(|| Preparation::WAYS.to_vec()), Dimension::Word, "WAY", "auto: choose the preparation steps from the heights, and print the reasons; steps that you give are kept"),
    key("surface.prepare.resample", "resample", FlagValue::Choice(choices::<Resample>), Dimension::Word, "WAY", "Interpolate heights at uneven positions to even spacing"),
    key("surface.prepare.crop", "crop", FlagValue::List, Dimension::One, "A,B[,C,D]", "Part to keep: first node and last node + 1; of a map, first for the rows and then for the columns"),
    key("surface.prepare.level-rows", "level-rows", FlagValue::Choice(choices::<LineLevel>), Dimension::Word, "WAY", "Level the rows of a map, each for itself: offsets takes off what differs independently from row to row, the others more"),
    key("surface.prepare.level-columns", "level-columns", FlagValue::Choice(choices::<LineLevel>), Dimension::Word, "WAY", "Level the columns of a map, each for itself"),
    key("surface.prepare.outliers", "outliers", FlagValue::Choice(choices::<Outliers>), Dimension::Word, "WAY", "Single heights that stand off all their neighbours (dead pixels, spikes): make them voids, for --fill"),
    key("surface.prepare.scars", "scars", FlagValue::Choice(choices::<Scars>), Dimension::Word, "LINES", "Stretches of rows or columns that stand off the lines beside them: make them voids, for --fill"),
    key("surface.prepare.fill", "fill", FlagValue::Choice(choices::<Fill>), Dimension::Word, "WAY", "Fill voids"),
    key("surface.prepare.detrend", "detrend", FlagValue::Choice(choices::<Detrend>), Dimension::Word, "TREND", "Trend to subtract from the heights"),
    key("surface.prepare.remove-form", "remove-form", FlagValue::Choice(choices::<Form>), Dimension::Word, "FORM", "Shape to fit and subtract"),
    key("surface.prepare.high-pass", "high-pass", FlagValue::One, Dimension::Length, "LAMBDA", "Remove longer wavelengths (Gaussian filter, ISO 16610)").named("high-pass wavelength"),
    key("surface.prepare.low-pass", "low-pass", FlagValue::One, Dimension::Length, "LAMBDA", "Remove shorter wavelengths (Gaussian filter, ISO 16610)").named("low-pass wavelength"),
    key("surface.prepare.taper", "taper", FlagValue::One, Dimension::One, "SHARE", "Fraction of each side within which the heights go to their mean smoothly, at most 0.5"),
    key("surface.prepare.mirror", "mirror", FlagValue::Choice(choices::<Mirror>), Dimension::Word, "AXES", "Axes along which the heights are mirrored, which makes them periodic without a jump"),
    key("surface.indenter.shape", "indenter", FlagValue::Variant(choices::<Indenter>), Dimension::Word, "SHAPE", "A smooth indenter, centred in the cell"),
    key("surface.indenter.radius", "radius", FlagValue::One, Dimension::Length, "R", "Radius of the cylinder or sphere"),
    key("surface.indenter.radius-x", "radius-x", FlagValue::One, Dimension::Length, "R", "Radius of curvature along x of the elliptic paraboloid"),
    key("surface.indenter.radius-y", "radius-y", FlagValue::One, Dimension::Length, "R", "Radius of curvature along y of the elliptic paraboloid"),
    key("surface.indenter.amplitude", "amplitude", FlagValue::One, Dimension::Length, "D", "Amplitude of the sine or crossed sine (half of its peak-to-valley height)"),
    key("surface.indenter.slope", "slope", FlagValue::One, Dimension::Slope, "M", "Slope of the wedge, cone or pyramid, or the angle of its flanks, such as 5deg"),
    key("surface.indenter.coefficient", "coefficient", FlagValue::One, Dimension::PowerLaw, "A", "Coefficient A of the power law A r^n"),
    key("surface.indenter.exponent", "exponent", FlagValue::One, Dimension::One, "n", "Exponent n of the power law A r^n"),
    key("surface.indenter.half-width", "half-width", FlagValue::One, Dimension::Length, "B", "Half-width or radius of the punch"),
    key("surface.indenter.depth", "depth", FlagValue::One, Dimension::Length, "D", "Height of the step at the rim of the punch"),
    key("surface.spectrum.hurst", "hurst", FlagValue::One, Dimension::One, "H", "Self-affine roughness with this Hurst exponent, in (0, 1]; it is added to the indenter or heights"),
    key("surface.spectrum.rolloff-wavelength", "rolloff", FlagValue::One, Dimension::Length, "LAMBDA", "Roll-off wavelength, above which the spectrum is flat (see --rolloff-form)"),
    key("surface.spectrum.short-cutoff", "short-cutoff", FlagValue::One, Dimension::Length, "LAMBDA", "Wavelength below which the spectrum is zero"),
    key("surface.spectrum.rms-gradient", "rms-gradient", FlagValue::One, Dimension::One, "G", "Root-mean-square gradient of the roughness; each realisation is scaled to it exactly"),
    key("surface.spectrum.rms-height", "rms-height", FlagValue::One, Dimension::Length, "L", "Root-mean-square height of the roughness, instead of --rms-gradient"),
    key("surface.spectrum.rolloff-form", "rolloff-form", FlagValue::Choice(choices::<RolloffForm>), Dimension::Word, "FORM", "What the spectrum does above the roll-off wavelength [default: plateau]"),
    key("surface.spectrum.table", "spectrum", FlagValue::One, Dimension::File, "FILE", "Roughness by a table of its spectrum, instead of --hurst and the wavelengths: two columns (wavenumber, density), or a CSV file of contact.engineering"),
    key("surface.spectrum.convention", "convention", FlagValue::Choice(choices::<SpectrumConvention>), Dimension::Word, "NAME", "Convention of the density in two columns [default: surface]"),
    key("surface.spectrum.peklenik", "peklenik", FlagValue::One, Dimension::One, "GAMMA", "Peklenik number of a surface with a lay: correlation length along the lay over that across it [default: 1]"),
    key("surface.spectrum.lay-angle", "lay-angle", FlagValue::One, Dimension::One, "DEGREES", "Angle from the x axis to the lay [default: 0]"),
    key("surface.spectrum.skewness", "skewness", FlagValue::One, Dimension::One, "SSK", "Skewness of heights that are not Gaussian; needs --kurtosis"),
    key("surface.spectrum.kurtosis", "kurtosis", FlagValue::One, Dimension::One, "SKU", "Kurtosis of heights that are not Gaussian (3 for Gaussian ones), above the square of the skewness + 1; needs --skewness"),
    key("surface.spectrum.weibull", "weibull", FlagValue::One, Dimension::One, "K", "Heights with Weibull's distribution of this shape"),
    key("surface.spectrum.beta", "beta", FlagValue::List, Dimension::One, "A,B", "Heights with the beta distribution of these shapes"),
    key("surface.spectrum.heights-like", "heights-like", FlagValue::One, Dimension::File, "FILE", "Heights with the distribution of those in a file"),
    key("surface.spectrum.exact", "exact", FlagValue::Choice(choices::<ExactPart>), Dimension::Word, "PART", "What is exact if heights are not Gaussian: their distribution, or the spectrum of the realisation [default: heights]"),
    without_flag("surface.joined", Dimension::Word),
    without_flag("surface.second-spectrum.hurst", Dimension::One),
    without_flag("surface.second-spectrum.rolloff-wavelength", Dimension::Length),
    without_flag("surface.second-spectrum.short-cutoff", Dimension::Length),
    without_flag("surface.second-spectrum.rms-gradient", Dimension::One),
    without_flag("surface.second-spectrum.rms-height", Dimension::Length),
    without_flag("surface.second-spectrum.rolloff-form", Dimension::Word),
    without_flag("surface.second-spectrum.table", Dimension::File),
    without_flag("surface.second-spectrum.convention", Dimension::Word),
    without_flag("surface.second-spectrum.peklenik", Dimension::One),
    without_flag("surface.second-spectrum.lay-angle", Dimension::One),
    without_flag("surface.second-spectrum.skewness", Dimension::One),
    without_flag("surface.second-spectrum.kurtosis", Dimension::One),
    without_flag("surface.second-spectrum.weibull", Dimension::One),
    without_flag("surface.second-spectrum.beta", Dimension::One),
    without_flag("surface.second-spectrum.heights-like", Dimension::File),
    without_flag("surface.second-spectrum.exact", Dimension::Word),
    key("surface.seed", "seed", FlagValue::One, Dimension::One, "SEED", "Seed of the random numbers [default: 1]"),
    key("surface.bumps", "bumps", FlagValue::List, Dimension::Length, "X,H,W[,...]", "Bumps on a line, three lengths each: position, height (negative for a hollow) and width").named("length of a bump"),
    key("grid.points", "points", FlagValue::List, Dimension::One, "N[,N]", "Grid points along the array's axes: one number for a line, two (rows, columns) for a surface; for roughness also auto or auto,auto"),
    key("grid.size", "size", FlagValue::List, Dimension::Length, "L[,L]", "Lengths of the cell along the array's axes (rows, columns); one value holds for all axes; not needed if the height file has them"),
    key("grid.refine", "refine", FlagValue::One, Dimension::One, "N", "Refinement factor of the file's grid (interpolated) or of --points, along each axis; auto: refine until area and kappa_r are accurate"),
    key("grid.area-tolerance", "area-tolerance", FlagValue::One, Dimension::One, "ERROR", "Estimated relative error of area and kappa_r at which --refine auto or --points auto stops [default: 0.01]"),
    key("grid.boundary", "boundary", FlagValue::Choices(choices::<Boundary>), Dimension::Word, "B[,B]", "Boundary along the array's axes (rows, columns); one value holds for all axes [default: periodic]"),
    key("grid.datum", "datum", FlagValue::One, Dimension::Length, "D", "If only one axis is free: distance from a line load at which the displacement is zero [default: the length of the cell along it]").idle_where(&[NO_HALF_SPACE]),
    key("solid.contact-modulus", "modulus", FlagValue::One, Dimension::Pressure, "E*", "Contact modulus E* = E / (1 - nu^2), with a unit such as 1GPa, or a number in your units"),
    key("solid.young", "young", FlagValue::List, Dimension::Pressure, "E[,E]", "Young's modulus of the elastic body, or of both bodies: 1/E* = sum (1 - nu^2)/E; needs --poisson").named("Young's modulus"),
    key("solid.poisson", "poisson", FlagValue::List, Dimension::One, "NU[,NU]", "Poisson's ratio of the elastic body, or of both bodies"),
    key("solid.layer", "layer", FlagValue::One, Dimension::Length, "T", "Thickness of an elastic layer on a rigid base, instead of a half-space; needs --poisson"),
    key("solid.base", "base", FlagValue::Choice(choices::<Base>), Dimension::Word, "BASE", "How the layer is held on its base [default: bonded]"),
    without_flag("solid.wavenumber", Dimension::One),
    without_flag("solid.stiffness", Dimension::One),
    without_flag("solid.uniform-stiffness", Dimension::One),
    key("law.hardness", "hardness", FlagValue::One, Dimension::Pressure, "H_C", "Hardness of the softer body: it yields at this pressure, and no pressure is higher; with a unit, or in the unit of the modulus; without a modulus, divided by E*").over_modulus(),
    key("load.mean-pressure", "pressure", FlagValue::List, Dimension::Pressure, "P[,P]", "Mean pressure, with a unit, or in the unit of the modulus; needs a modulus; several values are solved one after the other"),
    key("load.reduced-pressure", "reduced-pressure", FlagValue::List, Dimension::One, "P*[,P*]", "Reduced pressure p* = p / (rms gradient x modulus); without a modulus, pressures are divided by E*"),
    key("load.mean-gap", "mean-gap", FlagValue::List, Dimension::Length, "G[,G]", "Mean gap: distance between the mean planes of both surfaces, less than the height of the highest peak; not with --solver gfmd"),
    key("friction.coefficient", "friction", FlagValue::One, Dimension::One, "MU", "Coefficient of friction; needs --tangential, --path-tangential, --creepage or --rolling"),
    key("friction.tangential", "tangential", FlagValue::One, Dimension::Load, "Q", "Tangential load along x, less than MU times the normal load, and of the same kind as it: a mean traction, a reduced traction or a force").named("tangential load"),
];

/// The keys after those of the drives: of paths, which several drives have, and of what is done with any contact.
#[rustfmt::skip]
const OF_RUNS: &[Key] = &[
    key("path.file", "path", FlagValue::One, Dimension::File, "FILE.csv", "Path of a history: a table with columns time, load and tangential, of which some may be missing; loads change linearly between rows"),
    key("path.time", "path-time", FlagValue::List, Dimension::Time, "T[,T]", "Times of the path; with a single time, the load is held until then; needs --creep or --relaxation").named("time of the path"),
    key("path.load", "path-load", FlagValue::List, Dimension::Load, "P[,P]", "Normal loads of the path, of the same kind as the load; 1..8:4 for 4 loads with equal ratios [default: the load at all points]").named("load of the path"),
    key("path.tangential", "path-tangential", FlagValue::List, Dimension::Load, "Q[,Q]", "Tangential loads of the path, of the same kind as the load and of any sign; needs --friction").named("tangential load of the path"),
    key("path.steps", "path-steps", FlagValue::One, Dimension::One, "N", "Number of equal steps between two points of the path [default: with a yield stress 1; with adhesion 20; in time as many as --time-tolerance needs, with friction as many as --path-tolerance needs]"),
    key("path.tolerance", "path-tolerance", FlagValue::One, Dimension::One, "ERROR", "With friction, largest estimated relative error of shift and lost energy by the steps of the path [default: 1e-2]").idle_where(&[GIVEN_STEPS, NO_FRICTION_PATH]),
    key("path.time-tolerance", "time-tolerance", FlagValue::One, Dimension::One, "ERROR", "Largest estimated relative error in time, of pressure, mean gap and lost energy [default: 1e-2]").idle_where(&[GIVEN_STEPS, NO_CREEP]),
    key("load.force", "force", FlagValue::List, Dimension::Force, "F[,F]", "Force on the cell (for a line, force per length), with a unit, or in the units of modulus and size"),
    key("load.approach", "approach", FlagValue::List, Dimension::Length, "D[,D]", "Approach of the bodies after the first contact, for a layer or a free boundary; not with --solver gfmd"),
    key("flow.leakage", "flow", FlagValue::Switch, Dimension::Switch, "", "Also compute what leaks through the gap along each axis, with bounds, and whether the contact seals; a recording shows the flux"),
    key("flow.resistivity", "resistivity", FlagValue::List, Dimension::Conduction, "RHO[,RHO]", "Also compute the conductance per area between bodies of these resistivities, such as 17nohm*m; one value is for both bodies; for heat 'm K/W'"),
    key("flow.conductivity", "conductivity", FlagValue::List, Dimension::Conduction, "SIGMA[,SIGMA]", "Conductivities in place of the resistivities, such as 58MS/m, or for heat '400W/(m K)'"),
    key("solver.method", "solver", FlagValue::Variant(choices::<Method>), Dimension::Word, "METHOD", "The method [default: multilevel]"),
    key("solver.masses", "masses", FlagValue::Choice(choices::<Masses>), Dimension::Word, "MASSES", "GFMD: masses of the surface modes [default: uniform]"),
    key("solver.dynamics", "dynamics", FlagValue::Choice(choices::<Dynamics>), Dimension::Word, "DYNAMICS", "GFMD: damping of the motion [default: damped]"),
    key("solver.time-step", "time-step", FlagValue::One, Dimension::One, "DT", "GFMD: time step divided by the stability limit, in (0, 1) [default: 0.5]"),
    key("solver.damping", "damping", FlagValue::One, Dimension::One, "C", "GFMD: damping divided by the critical damping of the slowest mode [default: 1]"),
    key("stop.tolerance", "tolerance", FlagValue::One, Dimension::One, "ETA", "Stop at this certificate eta, a bound of the energy error divided by load times rms height [default: 1e-8]"),
    key("stop.pressure-tolerance", "pressure-tolerance", FlagValue::One, Dimension::One, "E", "Stop only if the bound of the relative error of the pressure (energy norm) is also below this; use it for indenters that are narrow in their cell").idle_where(&[YIELDING]),
    key("stop.max-iterations", "max-iterations", FlagValue::One, Dimension::One, "N", "Largest number of iterations [default: 100000]"),
    key("record.what", "record-what", FlagValue::Choices(choices::<Part>), Dimension::Word, "PART[,PART]", "Parts to record [default: traces, profile or mesh, fields, mask]"),
    key("record.raster-at", "raster-at", FlagValue::List, Dimension::One, "ROW,COLUMN", "Row and column of a surface, counted from 0, that the raster shows [default: through the highest peak]").idle_where(&[NO_RASTER]),
    key("record.every", "record-every", FlagValue::One, Dimension::One, "N", "Record the fields of every N-th step [default: all early steps, later ones less often]"),
    key("record.iterations", "record-iterations", FlagValue::Switch, Dimension::Switch, "", "Of a body that yields below its surface, also keep each iteration of flow as a state, on the way from load to load").idle_where(&[NO_YIELDING]),
    key("record.length-unit", "length-unit", FlagValue::One, Dimension::Unit, "UNIT", "Unit of the given lengths, for the recording; metres are shown as mm, um or nm [default: m]"),
    key("record.pressure-unit", "pressure-unit", FlagValue::One, Dimension::Unit, "UNIT", "Unit of the given pressures, for the recording; pascals are shown as kPa, MPa or GPa [default: Pa if a pressure has a unit]"),
    key("record.theme", "theme", FlagValue::Choice(choices::<Theme>), Dimension::Word, "THEME", "Background of the pictures in the recording [default: dark]"),
];

impl Key {
    /// All keys. Those with flags are in the order of a command line.
    pub fn all() -> impl Iterator<Item = &'static Self> {
        OF_CONTACTS.iter().chain(DRIVES.iter().flat_map(|drive| drive.keys)).chain(OF_RUNS)
    }

    /// The keys that flags set, in the order of a command line.
    pub fn with_flags() -> impl Iterator<Item = &'static Self> {
        Self::all().filter(|key| !key.flag.is_empty())
    }

    /// The keys of a dimension.
    pub fn of_dimension(dimension: Dimension) -> impl Iterator<Item = &'static Self> {
        Self::all().filter(move |key| key.dimension == dimension)
    }

    /// The key at a path.
    pub fn find(path: &str) -> Option<&'static Self> {
        Self::all().find(|key| key.path == path)
    }

    /// Whether it is a key of a drive.
    pub fn is_of_drive(&self) -> bool {
        DRIVES.iter().flat_map(|drive| drive.keys).any(|key| key.path == self.path)
    }
}
