//! The flags of the command line that lay values over a setup.

use super::{Boundary, Method, Part, Theme};
use crate::contact::{Dynamics, Masses};
use crate::elastic::Base;
use crate::surface::{Detrend, Fill, Form, Indenter, Mirror, Preparation, Resample};
use strum::{EnumMessage, IntoEnumIterator};

/// A flag of the command line, and the place in a setup that its value is laid over.
pub struct Flag {
    /// Its name, without the dashes.
    pub name: &'static str,
    /// Keys in a setup, with dots between.
    pub path: &'static str,
    /// The kind of its value.
    pub value: FlagValue,
    /// A name for its value.
    pub placeholder: &'static str,
    /// One sentence.
    pub help: &'static str,
}

/// The value of a flag.
#[derive(Clone, Copy)]
pub enum FlagValue {
    /// A number, a quantity with a unit, or a name.
    One,
    /// One of them, or several with commas between.
    List,
    /// One of some names, with a few words on each.
    Choice(Choices),
    /// One of some names, each with keys of its own: it takes the place of all that stands beside it.
    Variant(Choices),
    /// Several of some names.
    Choices(Choices),
}

/// Names to choose from, with a few words on each.
pub type Choices = fn() -> Vec<(&'static str, &'static str)>;

/// The names of the variants of an enum, with a few words on each: its message, or the first line of its documentation.
///
/// ```
/// use asperity::setup::{Theme, choices};
/// assert_eq!(choices::<Theme>()[0], ("dark", "Light lines on a dark ground"));
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
    flag("height", "surface.height", FlagValue::One, "FILE", "Heights of a line or a surface from a file of an instrument, .npy, .npz or text of numbers; peaks towards the solid are positive"),
    flag("against", "surface.against", FlagValue::One, "FILE", "Heights of a second surface of the same shape, on which the first is pressed: peaks towards the first are positive, and they are added"),
    flag("channel", "surface.channel", FlagValue::One, "NAME", "Channel of a file that has several, by name or number"),
    flag("file-unit", "surface.file-unit", FlagValue::One, "L", "Length of 1 in a file that does not say its units, such as 1um"),
    flag("prepare", "surface.prepare.steps", FlagValue::Choice(|| Preparation::WAYS.to_vec()), "WAY", "Choose the steps that the heights need, and say why; steps that are given are kept"),
    flag("resample", "surface.prepare.resample", FlagValue::Choice(choices::<Resample>), "WAY", "Bring heights at uneven positions to even ones"),
    flag("crop", "surface.prepare.crop", FlagValue::List, "A,B[,C,D]", "Part that is kept: first node and one beyond the last, of a map those of rows, then columns"),
    flag("fill", "surface.prepare.fill", FlagValue::Choice(choices::<Fill>), "WAY", "Fill voids"),
    flag("detrend", "surface.prepare.detrend", FlagValue::Choice(choices::<Detrend>), "TREND", "Trend to take off the heights"),
    flag("remove-form", "surface.prepare.remove-form", FlagValue::Choice(choices::<Form>), "FORM", "Body whose fitted form is taken off"),
    flag("high-pass", "surface.prepare.high-pass", FlagValue::One, "LAMBDA", "Wavelength above which waves are taken off, by the Gaussian filter of ISO 16610"),
    flag("low-pass", "surface.prepare.low-pass", FlagValue::One, "LAMBDA", "Wavelength below which waves are taken off, by the Gaussian filter of ISO 16610"),
    flag("taper", "surface.prepare.taper", FlagValue::One, "SHARE", "Share of each side within which heights run out to their mean, at most 0.5"),
    flag("mirror", "surface.prepare.mirror", FlagValue::Choice(choices::<Mirror>), "AXES", "Axes along which heights are mirrored, so that they are periodic without a jump"),
    flag("indenter", "surface.indenter.shape", FlagValue::Variant(choices::<Indenter>), "SHAPE", "A smooth indenter, centred in the cell"),
    flag("radius", "surface.indenter.radius", FlagValue::One, "R", "Radius of the cylinder or sphere"),
    flag("amplitude", "surface.indenter.amplitude", FlagValue::One, "D", "Amplitude of the sine or crossed sine (half of its peak-to-valley height)"),
    flag("slope", "surface.indenter.slope", FlagValue::One, "M", "Slope of the wedge or cone"),
    flag("coefficient", "surface.indenter.coefficient", FlagValue::One, "A", "Coefficient A of the power law A r^n"),
    flag("exponent", "surface.indenter.exponent", FlagValue::One, "n", "Exponent n of the power law A r^n"),
    flag("half-width", "surface.indenter.half-width", FlagValue::One, "B", "Half-width or radius of the punch"),
    flag("depth", "surface.indenter.depth", FlagValue::One, "D", "Height of the step at the rim of the punch"),
    flag("hurst", "surface.spectrum.hurst", FlagValue::One, "H", "Self-affine roughness of this Hurst exponent, in (0, 1]; added to what else is given"),
    flag("rolloff", "surface.spectrum.rolloff-wavelength", FlagValue::One, "LAMBDA", "Wavelength above which the spectrum is flat"),
    flag("short-cutoff", "surface.spectrum.short-cutoff", FlagValue::One, "LAMBDA", "Wavelength below which the spectrum is zero"),
    flag("rms-gradient", "surface.spectrum.rms-gradient", FlagValue::One, "G", "Root-mean-square gradient of the roughness, made exact for the realisation"),
    flag("seed", "surface.seed", FlagValue::One, "SEED", "Seed of the realisation [default: 1]"),
    flag("bumps", "surface.bumps", FlagValue::List, "X,H,W[,...]", "Bumps on a line, three lengths for each: where it is, its height (a hollow has a negative one) and its width"),
    flag("points", "grid.points", FlagValue::List, "N[,N]", "Points along the array's axes, in their order: one makes a line, two a surface; of roughness auto or auto,auto"),
    flag("size", "grid.size", FlagValue::List, "L[,L]", "Lengths of the cell along the array's axes, in their order; one value serves all axes; not needed where a height file says its own"),
    flag("refine", "grid.refine", FlagValue::One, "N", "Points for each point of the file (interpolated) or of --points, along each axis; auto: until area and kappa_r settle"),
    flag("area-tolerance", "grid.area-tolerance", FlagValue::One, "ERROR", "Estimated relative error of area and kappa_r at which --refine auto or --points auto ends [default: 0.01]"),
    flag("boundary", "grid.boundary", FlagValue::Choices(choices::<Boundary>), "B[,B]", "Boundary along the array's axes, in their order; one value serves all axes [default: periodic]"),
    flag("datum", "grid.datum", FlagValue::One, "D", "Distance from a line load at which the surface stands still, where one axis only is free [default: the length of the cell along it]"),
    flag("modulus", "solid.contact-modulus", FlagValue::One, "E*", "Contact modulus E* = E / (1 - nu^2), a pressure: with a unit such as 1GPa, or a number in your units"),
    flag("young", "solid.young", FlagValue::List, "E[,E]", "Young's modulus, a pressure, of the elastic body, or of both: 1/E* = sum (1 - nu^2)/E; with --poisson"),
    flag("poisson", "solid.poisson", FlagValue::List, "NU[,NU]", "Poisson's ratio of the same"),
    flag("layer", "solid.layer", FlagValue::One, "T", "Thickness of an elastic layer on a rigid base, in the place of a half-space; with --poisson"),
    flag("base", "solid.base", FlagValue::Choice(choices::<Base>), "BASE", "How the layer lies on its base [default: bonded]"),
    flag("hardness", "law.hardness", FlagValue::One, "H_C", "Hardness of the softer body, a pressure above which it yields: no pressure is higher; with a unit or in that of the modulus, without a modulus over it"),
    flag("pressure", "load.mean-pressure", FlagValue::List, "P[,P]", "Mean pressure, with a unit or in that of the modulus, which must be given; several are solved one after the other"),
    flag("reduced-pressure", "load.reduced-pressure", FlagValue::List, "P*[,P*]", "Reduced pressure p* = p / (rms gradient x modulus); without a modulus pressures are over E*"),
    flag("mean-gap", "load.mean-gap", FlagValue::List, "G[,G]", "Mean gap between the mean planes of both surfaces, below the highest peak; not with --solver gfmd"),
    flag("friction", "friction.coefficient", FlagValue::One, "MU", "Coefficient of friction under a tangential load; with --tangential"),
    flag("tangential", "friction.tangential", FlagValue::One, "Q", "Tangential load along x, less than MU times the normal one and in its form: a mean traction, or over rms gradient x modulus, or a force"),
    flag("force", "load.force", FlagValue::List, "F[,F]", "Force on the cell, on a line per length across it, with a unit or in those of modulus and size"),
    flag("approach", "load.approach", FlagValue::List, "D[,D]", "Approach since the highest peak touched: of a layer or a free boundary, not with --solver gfmd"),
    flag("solver", "solver.method", FlagValue::Variant(choices::<Method>), "METHOD", "The method [default: multilevel]"),
    flag("masses", "solver.masses", FlagValue::Choice(choices::<Masses>), "MASSES", "GFMD: masses of the surface modes [default: uniform]"),
    flag("dynamics", "solver.dynamics", FlagValue::Choice(choices::<Dynamics>), "DYNAMICS", "GFMD: damping of the motion [default: damped]"),
    flag("time-step", "solver.time-step", FlagValue::One, "DT", "GFMD: time step over the stability limit, in (0, 1) [default: 0.5]"),
    flag("damping", "solver.damping", FlagValue::One, "C", "GFMD: friction over the critical one of the slowest mode [default: 1]"),
    flag("tolerance", "stop.tolerance", FlagValue::One, "ETA", "Certificate eta to reach: error in energy over load times rms height [default: 1e-8]"),
    flag("pressure-tolerance", "stop.pressure-tolerance", FlagValue::One, "E", "Bound of the relative error of the pressure to reach as well, in the energy norm: for indenters that are narrow in their cell"),
    flag("max-iterations", "stop.max-iterations", FlagValue::One, "N", "Iterations at the most [default: 100000]"),
    flag("record-what", "record.what", FlagValue::Choices(choices::<Part>), "PART[,PART]", "Parts to record [default: traces, profile or mesh, fields, mask]"),
    flag("raster-at", "record.raster-at", FlagValue::List, "ROW,COLUMN", "Row and column of a surface, from 0 on, along which the raster runs [default: through the highest peak]"),
    flag("record-every", "record.every", FlagValue::One, "N", "Record the fields of every N-th step [default: all early steps and then ever fewer]"),
    flag("length-unit", "record.length-unit", FlagValue::One, "UNIT", "Unit of lengths in the recording; metres are shown as mm, um or nm [default: m]"),
    flag("theme", "record.theme", FlagValue::Choice(choices::<Theme>), "THEME", "Ground of the pictures in the recording [default: dark]"),
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
    /// The section of the setup that it belongs to.
    pub fn section(&self) -> &'static str {
        self.path.split('.').next().unwrap_or_default()
    }
}
