//! Where the surface comes from: a file, an indenter or a spectrum.

use super::usage;
use anyhow::Result;
use asperity::surface::{Field, Indenter, Spectrum, read_heights, read_shape};
use asperity::{Grid, Surface};
use clap::{Args, ValueEnum};
use ndarray::Axis;
use std::path::{Path, PathBuf};

/// The surface: a height file, an indenter, a random spectrum, or an indenter with roughness on it.
#[derive(Args)]
#[command(next_help_heading = "Surface (--height, or --indenter or --hurst or both)")]
pub struct Source {
    /// Heights from a .npy file, of rank 1 (line) or 2 (surface); peaks towards the solid are positive
    #[arg(long, value_name = "FILE.npy")]
    height: Option<PathBuf>,
    /// A smooth indenter, centred in the cell
    #[arg(long, value_enum, value_name = "KIND")]
    indenter: Option<Kind>,
    /// Self-affine random roughness with this Hurst exponent, in (0, 1]; with --indenter, roughness on it
    #[arg(long, value_name = "H", allow_negative_numbers = true)]
    hurst: Option<f64>,
    /// Lengths of the cell along the array's axes, in their order; one value serves all axes
    #[arg(long, value_name = "L[,L]", value_delimiter = ',', allow_negative_numbers = true)]
    size: Vec<f64>,
    /// Points along the array's axes, in their order: one makes a line, two a surface
    #[arg(long, value_name = "N[,N]", value_delimiter = ',')]
    points: Vec<usize>,
    #[command(flatten)]
    shape: Shape,
    #[command(flatten)]
    roughness: Roughness,
}

#[derive(Clone, Copy, ValueEnum)]
enum Kind {
    /// -x^2 / (2 radius), a line
    Cylinder,
    /// -r^2 / (2 radius), a surface
    Sphere,
    /// amplitude cos(2 pi x / L), a line
    Sine,
    /// amplitude cos(2 pi x / Lx) cos(2 pi y / Ly), a surface
    CrossedSine,
    /// -slope |x|, a line
    Wedge,
    /// -slope r, a surface
    Cone,
    /// -coefficient r^exponent
    PowerLaw,
    /// flat within half-width, lower by depth outside
    Punch,
}

#[derive(Args)]
#[command(next_help_heading = "Shape of the indenter")]
struct Shape {
    /// Radius of the cylinder or sphere
    #[arg(long, value_name = "R", allow_negative_numbers = true, requires = "indenter")]
    radius: Option<f64>,
    /// Amplitude of the sine or crossed sine (half of its peak-to-valley height)
    #[arg(long, value_name = "D", allow_negative_numbers = true, requires = "indenter")]
    amplitude: Option<f64>,
    /// Slope of the wedge or cone
    #[arg(long, value_name = "M", allow_negative_numbers = true, requires = "indenter")]
    slope: Option<f64>,
    /// Coefficient A of the power law A r^n
    #[arg(long, value_name = "A", allow_negative_numbers = true, requires = "indenter")]
    coefficient: Option<f64>,
    /// Exponent n of the power law A r^n
    #[arg(long, value_name = "n", allow_negative_numbers = true, requires = "indenter")]
    exponent: Option<f64>,
    /// Half-width or radius of the flat punch
    #[arg(long, value_name = "B", allow_negative_numbers = true, requires = "indenter")]
    half_width: Option<f64>,
    /// Depth of the ground around the flat punch
    #[arg(long, value_name = "D", allow_negative_numbers = true, requires = "indenter")]
    depth: Option<f64>,
}

#[derive(Args)]
#[command(next_help_heading = "Roughness")]
struct Roughness {
    /// Wavelength above which the spectrum is constant
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, requires = "hurst")]
    rolloff: Option<f64>,
    /// Wavelength below which the spectrum is zero
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, requires = "hurst")]
    short_cutoff: Option<f64>,
    /// Root-mean-square gradient, made exact for the realisation
    #[arg(long, value_name = "G", allow_negative_numbers = true, requires = "hurst")]
    rms_gradient: Option<f64>,
    /// Seed of the realisation; 1 if none is given
    #[arg(long, requires = "hurst")]
    seed: Option<u64>,
}

/// How a surface was made: the indenter it is if it is one, and the rank of the arrays it came from or goes to.
pub struct Made {
    pub indenter: Option<Indenter>,
    pub rank: usize,
    /// Its name.
    pub title: String,
    /// What it is, in words.
    pub description: String,
}

/// The one source that is given.
enum Given<'a> {
    File(&'a Path),
    Indenter(Kind),
    Roughness(f64),
    RoughIndenter(Kind, f64),
}

impl Source {
    /// Reads or makes the surface, and says how.
    pub fn surface(&self) -> Result<(Surface, Made)> {
        match self.given()? {
            Given::File(path) => self.read(path),
            Given::Indenter(kind) => self.press(kind),
            Given::Roughness(hurst) => self.roughen(hurst),
            Given::RoughIndenter(kind, hurst) => self.press_rough(kind, hurst),
        }
    }

    /// The grid, when all that is given can make a surface on it. None is made; of a file only the header is read.
    pub fn check(&self) -> Result<Grid> {
        match self.given()? {
            Given::File(path) => self.grid_of(path, &read_shape(path)?),
            Given::Indenter(kind) => {
                self.shape.indenter(kind)?;
                self.grid()
            }
            Given::Roughness(hurst) => self.check_roughness(hurst),
            Given::RoughIndenter(kind, hurst) => {
                self.shape.indenter(kind)?;
                self.check_roughness(hurst)
            }
        }
    }

    /// The grid, if it can carry the roughness.
    fn check_roughness(&self, hurst: f64) -> Result<Grid> {
        let grid = self.grid()?;
        self.roughness.spectrum(hurst)?.validate(&grid)?;
        Ok(grid)
    }

    /// Whether the surface is random, and so all the same everywhere.
    pub fn is_random(&self) -> bool {
        self.hurst.is_some() && self.indenter.is_none()
    }

    fn given(&self) -> Result<Given<'_>> {
        match (&self.height, self.indenter, self.hurst) {
            (Some(path), None, None) => Ok(Given::File(path)),
            (None, Some(kind), None) => Ok(Given::Indenter(kind)),
            (None, None, Some(hurst)) => Ok(Given::Roughness(hurst)),
            (None, Some(kind), Some(hurst)) => Ok(Given::RoughIndenter(kind, hurst)),
            (None, None, None) => usage("no surface is given: use one of --height, --indenter or --hurst"),
            _ => usage("more than one surface is given: --height goes with neither --indenter nor --hurst"),
        }
    }

    fn read(&self, path: &Path) -> Result<(Surface, Made)> {
        let height = read_heights(path)?;
        let (rank, grid) = (height.ndim(), self.grid_of(path, height.shape())?);
        let height = if rank == 1 { height.insert_axis(Axis(0)) } else { height };
        let height: Field = height.into_dimensionality()?;
        let surface = Surface::new(grid, height)?;
        let title = path.file_stem().map_or("surface".into(), |stem| stem.to_string_lossy().into_owned());
        let description = format!("heights from {}", path.display());
        Ok((surface, Made { indenter: None, rank, title, description }))
    }

    /// The grid of the heights of a file.
    fn grid_of(&self, path: &Path, shape: &[usize]) -> Result<Grid> {
        if !self.points.is_empty() {
            return usage("--points does not go with --height: the file has its own");
        }
        let sizes = self.sizes(shape.len())?;
        match *shape {
            [n] => grid(&[1, n], &sizes),
            [1, nx] => grid(&[1, nx], &sizes[1..]),
            [ny, nx] => grid(&[ny, nx], &sizes),
            _ => usage(format!("{} holds an array of rank {}: give rank 1 or 2", path.display(), shape.len())),
        }
    }

    fn press(&self, kind: Kind) -> Result<(Surface, Made)> {
        let grid = self.grid()?;
        let indenter = self.shape.indenter(kind)?;
        let rank = self.points.len();
        let (title, description) = (capitalised(indenter.name()), self.shape.describe(&indenter));
        Ok((indenter.surface(grid)?, Made { indenter: Some(indenter), rank, title, description }))
    }

    fn roughen(&self, hurst: f64) -> Result<(Surface, Made)> {
        let grid = self.grid()?;
        let spectrum = self.roughness.spectrum(hurst)?;
        let seed = self.roughness.seed.unwrap_or(1);
        let surface = Surface::rough(grid, &spectrum, seed)?;
        let description = format!(
            "self-affine roughness, H = {hurst}, roll-off {:e}, short cut-off {:e}, rms gradient {:e}, seed {seed}",
            spectrum.rolloff_wavelength, spectrum.short_cutoff, spectrum.rms_gradient
        );
        let title = if grid.is_line() { "Rough line" } else { "Rough surface" }.into();
        Ok((surface, Made { indenter: None, rank: self.points.len(), title, description }))
    }

    fn press_rough(&self, kind: Kind, hurst: f64) -> Result<(Surface, Made)> {
        let (smooth, made) = self.press(kind)?;
        let (rough, roughness) = self.roughen(hurst)?;
        let title = format!("Rough {}", made.title.to_lowercase());
        let description = format!("{}, with {}", made.description, roughness.description);
        Ok((smooth.plus(&rough), Made { indenter: None, title, description, ..made }))
    }

    fn grid(&self) -> Result<Grid> {
        match self.points.as_slice() {
            [] => usage("--points is missing: one number makes a line, two make a surface"),
            [n] => grid(&[1, *n], &self.sizes(1)?),
            [ny, nx] => grid(&[*ny, *nx], &self.sizes(2)?),
            more => usage(format!("--points has {} numbers: give one for a line, two for a surface", more.len())),
        }
    }

    /// The lengths along `axes` axes.
    fn sizes(&self, axes: usize) -> Result<Vec<f64>> {
        match self.size.as_slice() {
            [] => usage("--size is missing: give the length of the cell"),
            [one] => Ok(vec![*one; axes]),
            given if given.len() == axes => Ok(given.to_vec()),
            more => usage(format!("--size has {} lengths: give one for a line, one or two for a surface", more.len())),
        }
    }
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

fn grid(shape: &[usize; 2], size: &[f64]) -> Result<Grid> {
    match *size {
        [length] => Ok(Grid::line(shape[1], length)?),
        [ly, lx] => Ok(Grid::surface(*shape, [ly, lx])?),
        _ => usage("a grid has one or two axes"),
    }
}

impl Roughness {
    /// The spectrum, if all of it is given.
    fn spectrum(&self, hurst: f64) -> Result<Spectrum> {
        let needs = |value: Option<f64>, name: &str| match value {
            Some(value) => Ok(value),
            None => usage(format!("--hurst needs {name} as well")),
        };
        Ok(Spectrum {
            hurst,
            rolloff_wavelength: needs(self.rolloff, "--rolloff")?,
            short_cutoff: needs(self.short_cutoff, "--short-cutoff")?,
            rms_gradient: needs(self.rms_gradient, "--rms-gradient")?,
        })
    }
}

impl Kind {
    /// Its parameters.
    fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::Cylinder | Self::Sphere => &["--radius"],
            Self::Sine | Self::CrossedSine => &["--amplitude"],
            Self::Wedge | Self::Cone => &["--slope"],
            Self::PowerLaw => &["--coefficient", "--exponent"],
            Self::Punch => &["--half-width", "--depth"],
        }
    }
}

impl Shape {
    /// The indenter, if exactly its own parameters are given.
    fn indenter(&self, kind: Kind) -> Result<Indenter> {
        let own = kind.parameters();
        if let Some((name, _)) = self.given().find(|(name, _)| !own.contains(name)) {
            return usage(format!("{name} does not go with this indenter, which has {}", own.join(" and ")));
        }
        let value = |i: usize| match self.given().find(|(name, _)| *name == own[i]) {
            Some((_, value)) => Ok(value),
            None => usage(format!("this indenter needs {}", own[i])),
        };
        Ok(match kind {
            Kind::Cylinder => Indenter::Cylinder { radius: value(0)? },
            Kind::Sphere => Indenter::Sphere { radius: value(0)? },
            Kind::Sine => Indenter::Sine { amplitude: value(0)? },
            Kind::CrossedSine => Indenter::CrossedSine { amplitude: value(0)? },
            Kind::Wedge => Indenter::Wedge { slope: value(0)? },
            Kind::Cone => Indenter::Cone { slope: value(0)? },
            Kind::PowerLaw => Indenter::PowerLaw { coefficient: value(0)?, exponent: value(1)? },
            Kind::Punch => Indenter::Punch { half_width: value(0)?, depth: value(1)? },
        })
    }

    fn describe(&self, indenter: &Indenter) -> String {
        let given = self.given().map(|(name, value)| format!(", {} {value:?}", name.trim_start_matches('-')));
        format!("{}{}", indenter.name(), given.collect::<String>())
    }

    fn given(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let all = [
            ("--radius", self.radius),
            ("--amplitude", self.amplitude),
            ("--slope", self.slope),
            ("--coefficient", self.coefficient),
            ("--exponent", self.exponent),
            ("--half-width", self.half_width),
            ("--depth", self.depth),
        ];
        all.into_iter().filter_map(|(name, value)| value.map(|value| (name, value)))
    }
}
