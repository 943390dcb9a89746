//! The flags of the command line that set values of a setup.

use super::{Boundary, Method, Part, Theme};
use crate::adhesion::{AdhesiveMethod, AttractionForm};
use crate::contact::{Dynamics, Masses};
use crate::elastic::Base;
use crate::surface::{
    Detrend, ExactPart, Fill, Form, Indenter, LineLevel, Mirror, Outliers, Preparation, Resample, RolloffForm, Scars,
    SpectrumConvention,
};
use strum::{EnumMessage, IntoEnumIterator};

/// A flag of the command line, and the keys of the setup that it sets.
pub struct Flag {
    /// Its name, without the dashes.
    pub name: &'static str,
    /// Keys in a setup, separated by dots.
    pub path: &'static str,
    /// The kind of its value.
    pub value: FlagValue,
    /// The placeholder of its value in the help.
    pub placeholder: &'static str,
    /// One sentence.
    pub help: &'static str,
}

/// The value of a flag.
#[derive(Clone, Copy)]
pub enum FlagValue {
    /// A number, a quantity with a unit, or a name.
    One,
    /// One of them, or several separated by commas.
    List,
    /// One of some names, with a short description each.
    Choice(Choices),
    /// One of some names that each have their own keys: it replaces all keys of its section or table.
    Variant(Choices),
    /// Several of some names.
    Choices(Choices),
    /// Nothing: the flag alone means yes.
    Switch,
}

/// Names to choose from, with a short description each.
pub type Choices = fn() -> Vec<(&'static str, &'static str)>;

/// The names of the variants of an enum, with a short description each: its message, or the first line of its documentation.
///
/// ```
/// use asperity::setup::{Theme, choices};
/// assert_eq!(choices::<Theme>()[0], ("dark", "Light lines on a dark background"));
/// ```
pub fn choices<T: IntoEnumIterator + EnumMessage + Into<&'static str>>() -> Vec<(&'static str, &'static str)> {
    let choice = |it: T| {
        let line = it.get_documentation().and_then(|text| text.lines().next()).unwrap_or_default();
        let words = it.get_message().unwrap_or(line.trim_end_matches('.'));
        (it.into(), words)
    };
    T::iter().map(choice).collect()
}

/// All flags, in the order of a command line.
#[rustfmt::skip]
pub const FLAGS: &[Flag] = &[
    flag("height", "surface.height", FlagValue::One, "FILE", "File of heights of a line or a surface: an instrument's format, .npy, .npz or text; peaks towards the solid are positive"),
    flag("against", "surface.against", FlagValue::One, "FILE", "File of heights of the second body, of the same shape; peaks towards the first body are positive; both heights are added"),
    flag("channel", "surface.channel", FlagValue::One, "NAME", "Channel of a file with several channels, by name or number"),
    flag("file-unit", "surface.file-unit", FlagValue::One, "L", "Unit of all lengths in a file without units, heights and distances, such as 1um"),
    flag("height-unit", "surface.height-unit", FlagValue::One, "L", "Unit of the heights alone in a file without units, such as 1nm, where that of the distances is another one"),
    flag("prepare", "surface.prepare.steps", FlagValue::Choice(|| Preparation::WAYS.to_vec()), "WAY", "auto: choose the preparation steps from the heights, and print the reasons; steps that you give are kept"),
    flag("resample", "surface.prepare.resample", FlagValue::Choice(choices::<Resample>), "WAY", "Interpolate heights at uneven positions to even spacing"),
    flag("crop", "surface.prepare.crop", FlagValue::List, "A,B[,C,D]", "Part to keep: first node and last node + 1; of a map, first for the rows and then for the columns"),
    flag("level-rows", "surface.prepare.level-rows", FlagValue::Choice(choices::<LineLevel>), "WAY", "Level the rows of a map, each for itself: offsets takes off what differs independently from row to row, the others more"),
    flag("level-columns", "surface.prepare.level-columns", FlagValue::Choice(choices::<LineLevel>), "WAY", "Level the columns of a map, each for itself"),
    flag("outliers", "surface.prepare.outliers", FlagValue::Choice(choices::<Outliers>), "WAY", "Single heights that stand off all their neighbours (dead pixels, spikes): make them voids, for --fill"),
    flag("scars", "surface.prepare.scars", FlagValue::Choice(choices::<Scars>), "LINES", "Stretches of rows or columns that stand off the lines beside them: make them voids, for --fill"),
    flag("fill", "surface.prepare.fill", FlagValue::Choice(choices::<Fill>), "WAY", "Fill voids"),
    flag("detrend", "surface.prepare.detrend", FlagValue::Choice(choices::<Detrend>), "TREND", "Trend to subtract from the heights"),
    flag("remove-form", "surface.prepare.remove-form", FlagValue::Choice(choices::<Form>), "FORM", "Shape to fit and subtract"),
    flag("high-pass", "surface.prepare.high-pass", FlagValue::One, "LAMBDA", "Remove longer wavelengths (Gaussian filter, ISO 16610)"),
    flag("low-pass", "surface.prepare.low-pass", FlagValue::One, "LAMBDA", "Remove shorter wavelengths (Gaussian filter, ISO 16610)"),
    flag("taper", "surface.prepare.taper", FlagValue::One, "SHARE", "Fraction of each side within which the heights go to their mean smoothly, at most 0.5"),
    flag("mirror", "surface.prepare.mirror", FlagValue::Choice(choices::<Mirror>), "AXES", "Axes along which the heights are mirrored, which makes them periodic without a jump"),
    flag("indenter", "surface.indenter.shape", FlagValue::Variant(choices::<Indenter>), "SHAPE", "A smooth indenter, centred in the cell"),
    flag("radius", "surface.indenter.radius", FlagValue::One, "R", "Radius of the cylinder or sphere"),
    flag("radius-x", "surface.indenter.radius-x", FlagValue::One, "R", "Radius of curvature along x of the elliptic paraboloid"),
    flag("radius-y", "surface.indenter.radius-y", FlagValue::One, "R", "Radius of curvature along y of the elliptic paraboloid"),
    flag("amplitude", "surface.indenter.amplitude", FlagValue::One, "D", "Amplitude of the sine or crossed sine (half of its peak-to-valley height)"),
    flag("slope", "surface.indenter.slope", FlagValue::One, "M", "Slope of the wedge, cone or pyramid, or the angle of its flanks, such as 5deg"),
    flag("coefficient", "surface.indenter.coefficient", FlagValue::One, "A", "Coefficient A of the power law A r^n"),
    flag("exponent", "surface.indenter.exponent", FlagValue::One, "n", "Exponent n of the power law A r^n"),
    flag("half-width", "surface.indenter.half-width", FlagValue::One, "B", "Half-width or radius of the punch"),
    flag("depth", "surface.indenter.depth", FlagValue::One, "D", "Height of the step at the rim of the punch"),
    flag("hurst", "surface.spectrum.hurst", FlagValue::One, "H", "Self-affine roughness with this Hurst exponent, in (0, 1]; it is added to the indenter or heights"),
    flag("rolloff", "surface.spectrum.rolloff-wavelength", FlagValue::One, "LAMBDA", "Roll-off wavelength, above which the spectrum is flat (see --rolloff-form)"),
    flag("short-cutoff", "surface.spectrum.short-cutoff", FlagValue::One, "LAMBDA", "Wavelength below which the spectrum is zero"),
    flag("rms-gradient", "surface.spectrum.rms-gradient", FlagValue::One, "G", "Root-mean-square gradient of the roughness; each realisation is scaled to it exactly"),
    flag("rms-height", "surface.spectrum.rms-height", FlagValue::One, "L", "Root-mean-square height of the roughness, instead of --rms-gradient"),
    flag("rolloff-form", "surface.spectrum.rolloff-form", FlagValue::Choice(choices::<RolloffForm>), "FORM", "What the spectrum does above the roll-off wavelength [default: plateau]"),
    flag("spectrum", "surface.spectrum.table", FlagValue::One, "FILE", "Roughness by a table of its spectrum, instead of --hurst and the wavelengths: two columns (wavenumber, density), or a CSV file of contact.engineering"),
    flag("convention", "surface.spectrum.convention", FlagValue::Choice(choices::<SpectrumConvention>), "NAME", "Convention of the density in two columns [default: surface]"),
    flag("peklenik", "surface.spectrum.peklenik", FlagValue::One, "GAMMA", "Peklenik number of a surface with a lay: correlation length along the lay over that across it [default: 1]"),
    flag("lay-angle", "surface.spectrum.lay-angle", FlagValue::One, "DEGREES", "Angle from the x axis to the lay [default: 0]"),
    flag("skewness", "surface.spectrum.skewness", FlagValue::One, "SSK", "Skewness of heights that are not Gaussian; needs --kurtosis"),
    flag("kurtosis", "surface.spectrum.kurtosis", FlagValue::One, "SKU", "Kurtosis of heights that are not Gaussian (3 for Gaussian ones), above the square of the skewness + 1; needs --skewness"),
    flag("weibull", "surface.spectrum.weibull", FlagValue::One, "K", "Heights with Weibull's distribution of this shape"),
    flag("beta", "surface.spectrum.beta", FlagValue::List, "A,B", "Heights with the beta distribution of these shapes"),
    flag("heights-like", "surface.spectrum.heights-like", FlagValue::One, "FILE", "Heights with the distribution of those in a file"),
    flag("exact", "surface.spectrum.exact", FlagValue::Choice(choices::<ExactPart>), "PART", "What is exact if heights are not Gaussian: their distribution, or the spectrum of the realisation [default: heights]"),
    flag("seed", "surface.seed", FlagValue::One, "SEED", "Seed of the random numbers [default: 1]"),
    flag("bumps", "surface.bumps", FlagValue::List, "X,H,W[,...]", "Bumps on a line, three lengths each: position, height (negative for a hollow) and width"),
    flag("points", "grid.points", FlagValue::List, "N[,N]", "Grid points along the array's axes: one number for a line, two (rows, columns) for a surface; for roughness also auto or auto,auto"),
    flag("size", "grid.size", FlagValue::List, "L[,L]", "Lengths of the cell along the array's axes (rows, columns); one value holds for all axes; not needed if the height file has them"),
    flag("refine", "grid.refine", FlagValue::One, "N", "Refinement factor of the file's grid (interpolated) or of --points, along each axis; auto: refine until area and kappa_r are accurate"),
    flag("area-tolerance", "grid.area-tolerance", FlagValue::One, "ERROR", "Estimated relative error of area and kappa_r at which --refine auto or --points auto stops [default: 0.01]"),
    flag("boundary", "grid.boundary", FlagValue::Choices(choices::<Boundary>), "B[,B]", "Boundary along the array's axes (rows, columns); one value holds for all axes [default: periodic]"),
    flag("datum", "grid.datum", FlagValue::One, "D", "If only one axis is free: distance from a line load at which the displacement is zero [default: the length of the cell along it]"),
    flag("modulus", "solid.contact-modulus", FlagValue::One, "E*", "Contact modulus E* = E / (1 - nu^2), with a unit such as 1GPa, or a number in your units"),
    flag("young", "solid.young", FlagValue::List, "E[,E]", "Young's modulus of the elastic body, or of both bodies: 1/E* = sum (1 - nu^2)/E; needs --poisson"),
    flag("poisson", "solid.poisson", FlagValue::List, "NU[,NU]", "Poisson's ratio of the elastic body, or of both bodies"),
    flag("layer", "solid.layer", FlagValue::One, "T", "Thickness of an elastic layer on a rigid base, instead of a half-space; needs --poisson"),
    flag("base", "solid.base", FlagValue::Choice(choices::<Base>), "BASE", "How the layer is held on its base [default: bonded]"),
    flag("yield-stress", "solid.yield-stress", FlagValue::One, "Y", "Yield stress in tension of a body that yields below its surface (J2 plasticity) and keeps an imprint; needs --young, --poisson and --hardening-modulus; loads, up and down, follow each other"),
    flag("hardening-modulus", "solid.hardening-modulus", FlagValue::One, "H", "Modulus of isotropic hardening: after a plastic strain alpha the body yields at Y + H alpha; a millionth of Young's modulus hardly differs from none"),
    flag("kinematic-hardening", "solid.kinematic-hardening", FlagValue::One, "C", "Modulus of linear kinematic hardening besides, which moves the yield limits [default: 0]"),
    flag("yield-depth", "solid.yield-depth", FlagValue::One, "D", "Depth at which the layers end in which the body may yield [default: half the longest side of the cell, and deeper where the body yields down to there]"),
    flag("yield-layers", "solid.yield-layers", FlagValue::One, "N", "Number of layers, all of equal thickness [default: the first is half as thick as the spacing of the grid, each further one thicker by a tenth]"),
    flag("yield-errors", "solid.yield-errors", FlagValue::Switch, "", "Estimate the errors of imprint and area by the load steps, by the layers and by the grid, from the same loads solved in finer steps, in coarser layers and on a coarser grid; takes about four times as long"),
    flag("hardness", "law.hardness", FlagValue::One, "H_C", "Hardness of the softer body: it yields at this pressure, and no pressure is higher; with a unit, or in the unit of the modulus; without a modulus, divided by E*"),
    flag("pressure", "load.mean-pressure", FlagValue::List, "P[,P]", "Mean pressure, with a unit, or in the unit of the modulus; needs a modulus; several values are solved one after the other"),
    flag("reduced-pressure", "load.reduced-pressure", FlagValue::List, "P*[,P*]", "Reduced pressure p* = p / (rms gradient x modulus); without a modulus, pressures are divided by E*"),
    flag("mean-gap", "load.mean-gap", FlagValue::List, "G[,G]", "Mean gap: distance between the mean planes of both surfaces, less than the height of the highest peak; not with --solver gfmd"),
    flag("friction", "friction.coefficient", FlagValue::One, "MU", "Coefficient of friction; needs --tangential, --path-tangential, --creepage or --rolling"),
    flag("tangential", "friction.tangential", FlagValue::One, "Q", "Tangential load along x, less than MU times the normal load, and of the same kind as it: a mean traction, a reduced traction or a force"),
    flag("adhesion", "adhesion.work", FlagValue::One, "W", "Work of adhesion, an energy per area such as 50mJ/m^2; needs --adhesion-range"),
    flag("adhesion-range", "adhesion.range", FlagValue::One, "RHO", "Range of the attraction: the work of adhesion over its largest traction, a length"),
    flag("adhesion-form", "adhesion.form", FlagValue::Choice(choices::<AttractionForm>), "FORM", "How the attraction falls with the gap [default: exponential]"),
    flag("adhesion-table", "adhesion.table", FlagValue::One, "FILE.csv", "Table of the attraction with the columns gap and traction, instead of the three flags above"),
    flag("adhesion-method", "adhesion.method", FlagValue::Choice(choices::<AdhesiveMethod>), "METHOD", "Method that finds states with adhesion; gfmd is a motion, in which jumps can be watched [default: fast]"),
    flag("creep", "viscoelastic.creep", FlagValue::List, "F,TAU[,...]", "Creep of a viscoelastic solid: pairs of a ratio and a retardation time; the modulus is the one at once after loading; needs --path-time, --path or --speed"),
    flag("relaxation", "viscoelastic.relaxation", FlagValue::List, "G,TAU[,...]", "Relaxation of a viscoelastic solid, instead of --creep: pairs of a share of the modulus and a relaxation time"),
    flag("speed", "sliding.speed", FlagValue::List, "V[,V]", "Speed at which the surface slides steadily over a viscoelastic solid along x; 1e-3..1e3:13 for 13 speeds with equal ratios"),
    flag("creepage", "rolling.creepage", FlagValue::List, "XI[,XI]", "Steady rolling along x of a line with friction, at this creepage; a negative creepage pulls the solid towards +x; needs --friction"),
    flag("rolling", "rolling.tangential", FlagValue::List, "Q[,Q]", "Steady rolling under this tangential load, of the same kind as the normal one; 0 for free rolling; needs --friction"),
    flag("rolling-step", "rolling.step", FlagValue::One, "L", "Length of a step of rolling [default: the spacing of the grid]"),
    flag("path", "path.file", FlagValue::One, "FILE.csv", "Path of a history: a table with columns time, load and tangential, of which some may be missing; loads change linearly between rows"),
    flag("path-time", "path.time", FlagValue::List, "T[,T]", "Times of the path; with a single time, the load is held until then; needs --creep or --relaxation"),
    flag("path-load", "path.load", FlagValue::List, "P[,P]", "Normal loads of the path, of the same kind as the load; 1..8:4 for 4 loads with equal ratios [default: the load at all points]"),
    flag("path-tangential", "path.tangential", FlagValue::List, "Q[,Q]", "Tangential loads of the path, of the same kind as the load and of any sign; needs --friction"),
    flag("path-steps", "path.steps", FlagValue::One, "N", "Number of equal steps between two points of the path [default: with a yield stress 1; with adhesion 20; in time as many as --time-tolerance needs, with friction as many as --path-tolerance needs]"),
    flag("path-tolerance", "path.tolerance", FlagValue::One, "ERROR", "With friction, largest estimated relative error of shift and lost energy by the steps of the path [default: 1e-2]"),
    flag("time-tolerance", "path.time-tolerance", FlagValue::One, "ERROR", "Largest estimated relative error in time, of pressure, mean gap and lost energy [default: 1e-2]"),
    flag("force", "load.force", FlagValue::List, "F[,F]", "Force on the cell (for a line, force per length), with a unit, or in the units of modulus and size"),
    flag("approach", "load.approach", FlagValue::List, "D[,D]", "Approach of the bodies after the first contact, for a layer or a free boundary; not with --solver gfmd"),
    flag("flow", "flow.leakage", FlagValue::Switch, "", "Also compute what leaks through the gap along each axis, with bounds, and whether the contact seals; a recording shows the flux"),
    flag("resistivity", "flow.resistivity", FlagValue::List, "RHO[,RHO]", "Also compute the conductance per area between bodies of these resistivities, such as 17nohm*m; one value is for both bodies; for heat 'm K/W'"),
    flag("conductivity", "flow.conductivity", FlagValue::List, "SIGMA[,SIGMA]", "Conductivities in place of the resistivities, such as 58MS/m, or for heat '400W/(m K)'"),
    flag("solver", "solver.method", FlagValue::Variant(choices::<Method>), "METHOD", "The method [default: multilevel]"),
    flag("masses", "solver.masses", FlagValue::Choice(choices::<Masses>), "MASSES", "GFMD: masses of the surface modes [default: uniform]"),
    flag("dynamics", "solver.dynamics", FlagValue::Choice(choices::<Dynamics>), "DYNAMICS", "GFMD: damping of the motion [default: damped]"),
    flag("time-step", "solver.time-step", FlagValue::One, "DT", "GFMD: time step divided by the stability limit, in (0, 1) [default: 0.5]"),
    flag("damping", "solver.damping", FlagValue::One, "C", "GFMD: damping divided by the critical damping of the slowest mode [default: 1]"),
    flag("tolerance", "stop.tolerance", FlagValue::One, "ETA", "Stop at this certificate eta, a bound of the energy error divided by load times rms height [default: 1e-8]"),
    flag("pressure-tolerance", "stop.pressure-tolerance", FlagValue::One, "E", "Stop only if the bound of the relative error of the pressure (energy norm) is also below this; use it for indenters that are narrow in their cell"),
    flag("max-iterations", "stop.max-iterations", FlagValue::One, "N", "Largest number of iterations [default: 100000]"),
    flag("record-what", "record.what", FlagValue::Choices(choices::<Part>), "PART[,PART]", "Parts to record [default: traces, profile or mesh, fields, mask]"),
    flag("raster-at", "record.raster-at", FlagValue::List, "ROW,COLUMN", "Row and column of a surface, counted from 0, that the raster shows [default: through the highest peak]"),
    flag("record-every", "record.every", FlagValue::One, "N", "Record the fields of every N-th step [default: all early steps, later ones less often]"),
    flag("record-iterations", "record.iterations", FlagValue::Switch, "", "Of a body that yields below its surface, also keep each iteration of flow as a state, on the way from load to load"),
    flag("length-unit", "record.length-unit", FlagValue::One, "UNIT", "Unit of the given lengths, for the recording; metres are shown as mm, um or nm [default: m]"),
    flag("pressure-unit", "record.pressure-unit", FlagValue::One, "UNIT", "Unit of the given pressures, for the recording; pascals are shown as kPa, MPa or GPa [default: Pa if a pressure has a unit]"),
    flag("theme", "record.theme", FlagValue::Choice(choices::<Theme>), "THEME", "Background of the pictures in the recording [default: dark]"),
];

const fn flag(
    name: &'static str,
    path: &'static str,
    value: FlagValue,
    placeholder: &'static str,
    help: &'static str,
) -> Flag {
    Flag { name, path, value, placeholder, help }
}

impl Flag {
    /// Whether it belongs to a body that yields below its surface.
    pub fn is_of_yielding(&self) -> bool {
        ["solid.yield", "solid.hardening", "solid.kinematic"].iter().any(|start| self.path.starts_with(start))
    }

    /// The section of the setup that it belongs to.
    pub fn section(&self) -> &'static str {
        self.path.split('.').next().unwrap_or_default()
    }
}
