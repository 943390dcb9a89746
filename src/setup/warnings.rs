//! Warnings about surfaces for which the numbers of a contact mean little.

use super::{Recipe, Setup};
use crate::elastic::stress::USUAL_POISSON;
use crate::formats::{HeightFile, Layout, Measurement, Scan};
use crate::sentence::{LengthValue, sentence};
use crate::surface::{
    Artefact, Artefacts, Detrend, HeightDistribution, Mirror, Noise, Preparation, PreparationChoice, Roughness,
    Surface, Survey,
};
use crate::warning::Warning;
use std::cell::LazyCell;

/// Rms gradients of measured heights above this one come from a wrong unit, as they differ by thousands.
const STEEPEST: f64 = 10.0;
/// Lengths whose logarithms to the base of ten differ from a whole number by less than this may be the same in another unit.
const SAME_LENGTH: f64 = 0.01;
/// Rms gradients at the spacing over those at twice the spacing above this give a warning: those of resolved heights are about equal.
const LARGEST_GROWTH: f64 = 1.1;
/// Spacings that differ by less than this share count as equal.
const UNEQUAL: f64 = 0.01;
/// Spectra and distributions of heights that are farther than this from what was asked for give a warning.
const LARGEST_MISFIT: f64 = 0.1;
/// Relative errors of areas above this one, by heights that were filled in, give a warning.
const LARGEST_FILL_ERROR: f64 = 0.02;
/// Dundurs' constants above this one give a warning under friction.
const LARGEST_BETA: f64 = 0.01;

impl Setup {
    /// The warning that normal and tangential loads couple, which a single pull, as the difference of two normal contacts, leaves out.
    pub fn warning_of_coupling(&self) -> Option<Warning> {
        let beta = self.friction.and(self.solid.as_ref())?.dundurs_beta()?.abs();
        (beta > LARGEST_BETA).then(|| {
            Warning::new(
                format!(
                    "In these bodies the normal load alone causes tangential tractions (Dundurs' beta is {beta:.2}). \
                     The stick and slip areas neglect them"
                ),
                "A path of tangential loads includes them",
            )
            .with_remedy("path.tangential", None)
        })
    }

    /// The warning that the stress uses an assumed Poisson's ratio.
    pub fn warning_of_stress(&self) -> Option<Warning> {
        self.poisson().is_none().then(|| {
            Warning::new(
                format!("The stress assumes a Poisson's ratio of {USUAL_POISSON}"),
                "Give Young's modulus and Poisson's ratio instead of the contact modulus",
            )
            .with_remedy("solid.poisson", None)
        })
    }
}

impl Recipe {
    /// Warnings about the surface that was made: jumps across the period, unequal spacings, gradients of a wrong unit, noise,
    /// and what the file contradicts.
    pub fn warnings(&self, surface: &Surface) -> Vec<Warning> {
        self.warnings_of(surface, None)
    }

    /// The warnings about a surface whose survey is known, see [`Recipe::warnings`].
    pub fn warnings_of_surveyed(&self, surface: &Surface, survey: &Survey) -> Vec<Warning> {
        self.warnings_of(surface, Some(survey))
    }

    fn warnings_of(&self, surface: &Surface, survey: Option<&Survey>) -> Vec<Warning> {
        let measured = self.height.as_ref().map(|file| {
            let refined = refinement(self, file, surface);
            let raw = file.measurement(self.channel.as_deref()).ok();
            let of_file_spacing = spacing_of_file(self, file, surface, refined);
            let found = [spacing(surface), gradient(surface), of_file_spacing, smooth_fill(surface)];
            let periodic = surface.grid().periodic();
            // a survey is that of all nodes, with mirror images
            let known = survey.filter(|_| refined == 1 && self.prepare.mirror.is_none()).map(|it| it.found.clone());
            let scan = Scan::from_surface(surface, refined);
            let artefacts = self.warnings_of_artefacts(&scan, known, raw.as_ref(), periodic);
            let of_file = raw.map(|it| it.warnings).unwrap_or_default();
            of_file.into_iter().chain(found.into_iter().flatten()).chain(artefacts)
        });
        let jumps = self.warnings_of_jumps(surface.jumps(), surface.ends()).into_iter();
        jumps.chain(self.warnings_of_distribution(surface)).chain(measured.into_iter().flatten()).collect()
    }

    /// Warnings about artefacts in heights without their mirror images, which may be known, and in those of their file, and about noise in the rest.
    fn warnings_of_artefacts(
        &self,
        scan: &Scan,
        known: Option<Artefacts>,
        raw: Option<&Measurement>,
        periodic: [bool; 2],
    ) -> Vec<Warning> {
        let scan = self.prepare.mirror.map_or_else(|| scan.clone(), |mirror| mirror.original(scan));
        let artefacts = known.unwrap_or_else(|| Artefacts::new(&scan));
        let spacing = scan.spacing;
        let as_read = |it: &Measurement| Scan { height: it.height.clone(), spacing };
        let auto = LazyCell::new(|| raw.map_or_else(Preparation::default, |it| self.auto(as_read(it), periodic)));
        let noise = Noise::from_scan(&artefacts.rest).ok().and_then(|it| self.warning_of_noise(&it, || &auto));
        let raw = raw.filter(|_| !self.prepare.is_none() && self.prepare.crop.is_none());
        let hidden = raw.map(|it| Artefacts::of_equal_heights(&as_read(it)));
        let hidden = hidden.unwrap_or_default().into_iter().filter(|it| !artefacts.all.contains(it));
        let all: Vec<Artefact> = artefacts.all.iter().copied().chain(hidden).collect();
        all.iter().filter_map(|it| self.warning_of(it, artefacts.area_error, || &auto)).chain(noise).collect()
    }

    /// The steps that an automatic preparation takes on the heights of a file. A survey of prepared heights may find what that of the file did not, and an
    /// automatic preparation is advised only for what it would really mend.
    fn auto(&self, file: Scan, periodic: [bool; 2]) -> Preparation {
        let part = self.prepare.crop.as_ref().map_or(Some(file.clone()), |crop| crop.apply(&file)).unwrap_or(file);
        PreparationChoice::new(&part, true, periodic).map(|it| it.preparation).unwrap_or_default()
    }

    /// Warnings about random heights whose distribution and spectrum are far from what was asked for.
    fn warnings_of_distribution(&self, surface: &Surface) -> Vec<Warning> {
        let Some(map) = surface.rank_map() else { return Vec::new() };
        let error = map.spectrum_error.max(map.height_error);
        let part = if map.spectrum_error > 0.0 { "spectrum" } else { "distribution of the heights" };
        let apart = (error > LARGEST_MISFIT).then(|| {
            Warning::new(
                format!(
                    "The {part} is {:.0} % off, since no heights with this distribution have this spectrum",
                    100.0 * error
                ),
                "Ask for a distribution closer to the Gaussian one",
            )
        });
        let asked = self.spectrum.as_ref().and_then(|roughness| roughness.heights.as_ref());
        let tails = match asked.map(|asked| &asked.distribution) {
            Some(&HeightDistribution::Moments { kurtosis, .. }) if map.height_error == 0.0 && self.is_random() => {
                let found = Roughness::new(surface).kurtosis;
                ((found / kurtosis - 1.0).abs() > LARGEST_MISFIT).then(|| {
                    Warning::new(
                        format!("The kurtosis is {found:.2} instead of {kurtosis}: the tails need more points"),
                        "Use more points, or a lower kurtosis",
                    )
                })
            }
            _ => None,
        };
        apart.into_iter().chain(tails).collect()
    }

    /// Warnings about heights with voids, on a cell that is periodic along y and x or not.
    pub fn warnings_of_voids(&self, survey: &Survey, scan: &Scan, periodic: [bool; 2]) -> Vec<Warning> {
        let auto = LazyCell::new(|| {
            PreparationChoice::of_survey(survey, scan, periodic).map(|it| it.preparation).unwrap_or_default()
        });
        let voids = Warning::new(
            format!("{} of {} heights are void, so no contact can be solved", survey.voids, scan.height.len()),
            "Fill them, or crop the heights",
        )
        .with_remedy("surface.prepare.fill", Some("harmonic"))
        .with_remedy("surface.prepare.crop", None);
        let jumps = self.warnings_of_jumps(survey.jumps, survey.ends);
        [voids]
            .into_iter()
            .chain(jumps)
            .chain(survey.artefacts.iter().filter_map(|it| self.warning_of(it, survey.area_error, || &auto)))
            .chain(self.warning_of_noise(&survey.noise, || &auto))
            .chain(survey.warning_of_growth())
            .collect()
    }

    /// Warnings about jumps across the period along y and x.
    fn warnings_of_jumps(&self, jumps: [f64; 2], ends: [bool; 2]) -> Vec<Warning> {
        let jump = |(axis, jump): (&str, f64)| {
            let statement = sentence!(
                "The heights jump by {jump:.3} rms steps across the period along {axis}, and the contact there is an \
                 artefact",
                jump,
                axis
            );
            let warning = match self.prepare.detrend {
                Some(Detrend::Plane | Detrend::Curvature | Detrend::Cubic) => {
                    Warning::new(statement, "Mirror the heights, or use a free boundary")
                        .with_remedy("surface.prepare.mirror", None)
                }
                _ if self.is_measured() => {
                    Warning::new(statement, "Subtract the trend and mirror the heights, or use a free boundary")
                        .with_remedy("surface.prepare.steps", Some("auto"))
                }
                _ => Warning::new(statement, "Use a longer cell, or a free boundary"),
            };
            warning.with_remedy("grid.boundary", Some("free"))
        };
        // heights that are mirrored along an axis have no jump there, but a first step that may be steep
        let is_mirrored = match self.prepare.mirror {
            None => [false; 2],
            Some(mirror) => [mirror != Mirror::X, mirror != Mirror::Y],
        };
        let axes = (0..2).filter(|axis| ends[*axis] && !is_mirrored[*axis]);
        axes.map(|axis| jump((["y", "x"][axis], jumps[axis]))).collect()
    }

    /// The warning about an artefact, if it has an effect on the contact. Areas have at most the given error by all that can be mended. A step that
    /// was done is not advised again, and an automatic preparation only where it has that step.
    fn warning_of<'p>(&self, artefact: &Artefact, error: f64, auto: impl Fn() -> &'p Preparation) -> Option<Warning> {
        let what = artefact.sentence();
        if let Some((key, value)) = step_against(artefact) {
            let percent = Some(100.0 * error).filter(|_| error >= Artefacts::TOLD)?;
            if has_step_against(&self.prepare, artefact) {
                let left = sentence!(
                    "{what}, which the preparation has left. The area may be off by up to {percent:.0} %",
                    what,
                    percent
                );
                return Some(
                    Warning::new(left, "Look at the heights, or crop them").with_remedy("surface.prepare.crop", None),
                );
            }
            let (key, value) = match has_step_against(auto(), artefact) {
                true => ("surface.prepare.steps", "auto"),
                false => (key, value),
            };
            let statement = sentence!("{what}. The area may be off by up to {percent:.0} %", what, percent);
            return Some(Warning::new(statement, "Mend it").with_remedy(key, Some(value)));
        }
        Some(match artefact {
            Artefact::Clipped { is_top: false, .. } => return None,
            Artefact::Border { .. } => Warning::new(what, "Crop the heights").with_remedy("surface.prepare.crop", None),
            _ => Warning::new(what, "Look at the heights: no step of a preparation mends it"),
        })
    }

    /// The warning that much of the gradient is noise, so that the area has no limit for small spacings.
    fn warning_of_noise<'p>(&self, noise: &Noise, auto: impl Fn() -> &'p Preparation) -> Option<Warning> {
        if noise.area_error() <= Noise::TOLD {
            return None;
        }
        let statement = sentence!(
            "Noise at the spacing makes {part}, so area and kappa depend on the noise of the instrument, and the area \
             may be off by {error:.0} %",
            part = noise.part_of_gradient(),
            error = 100.0 * noise.area_error()
        );
        Some(match self.prepare.low_pass {
            Some(_) => Warning::new(
                sentence!("{statement}, after the filter that was used", statement),
                "Use a longer cut-off, or compare with a second measurement",
            ),
            None => {
                let filter =
                    Warning::new(statement, "Filter the noise out").with_remedy("surface.prepare.low-pass", None);
                let is_automatic = auto().low_pass.is_some();
                if is_automatic { filter.with_remedy("surface.prepare.steps", Some("auto")) } else { filter }
            }
        })
    }
}

/// The key and the value of the step of a preparation that mends an artefact, if there is one.
fn step_against(artefact: &Artefact) -> Option<(&'static str, &'static str)> {
    let level = |axis: &str| if axis == "y" { "surface.prepare.level-rows" } else { "surface.prepare.level-columns" };
    Some(match artefact {
        Artefact::Offsets { axis, .. } => (level(axis), "offsets"),
        Artefact::Settling { axis, .. } => (level(axis), "settling"),
        Artefact::Outliers { .. } => ("surface.prepare.outliers", "void"),
        Artefact::Scars { axis, .. } => ("surface.prepare.scars", if *axis == "y" { "rows" } else { "columns" }),
        Artefact::Repeated { .. } => ("surface.prepare.resample", "repeats"),
        _ => return None,
    })
}

/// Whether a preparation has a step against an artefact, of which some may be left all the same.
fn has_step_against(prepare: &Preparation, artefact: &Artefact) -> bool {
    let level = |axis: &str| if axis == "y" { prepare.level_rows } else { prepare.level_columns };
    match artefact {
        Artefact::Offsets { axis, .. } | Artefact::Settling { axis, .. } => level(axis).is_some(),
        Artefact::Outliers { .. } => prepare.outliers.is_some(),
        Artefact::Scars { .. } => prepare.scars.is_some(),
        Artefact::Repeated { .. } => prepare.resample.is_some(),
        _ => false,
    }
}

impl Survey {
    /// The warning that heights are as rough as their spacing lets them be.
    pub fn warning_of_growth(&self) -> Option<Warning> {
        let growth = self.gradient_growth();
        (growth > LARGEST_GROWTH).then(|| {
            Warning::new(
                sentence!("The rms gradient is {growth:.0} % larger at the spacing than at twice the spacing, so area and kappa depend on the spacing", growth = 100.0 * (growth - 1.0)),
                "Compare only files with the same low-pass filter",
            )
            .with_remedy("surface.prepare.low-pass", None)
        })
    }
}

/// The warning that heights which were filled in are smoother than those that were measured.
fn smooth_fill(surface: &Surface) -> Option<Warning> {
    let error = surface.area_error_by_fill();
    (error > LARGEST_FILL_ERROR).then(|| {
        Warning::new(
            format!("Filled heights are smooth: areas may be up to {:.1} % too large", 100.0 * error),
            "Crop the heights to a part that was measured",
        )
        .with_remedy("surface.prepare.crop", None)
    })
}

/// The warning that the lengths of a measured surface may have been swapped.
fn spacing(surface: &Surface) -> Option<Warning> {
    let [dy, dx] = surface.grid().spacing();
    let is_unequal = !surface.grid().is_line() && (dy / dx - 1.0).abs() > UNEQUAL;
    is_unequal.then(|| {
        Warning::new(
            sentence!(
                "The spacing is {dy:.4e} along y (rows) and {dx:.4e} along x (columns)",
                dy = LengthValue(dy),
                dx = LengthValue(dx)
            ),
            "If the axes are the other way round, swap height and width",
        )
        .with_remedy("grid.size", Some("HEIGHT,WIDTH"))
    })
}

/// The warning that distances in a file do not fit the size, or, where the file does not say its units, do not fit it in any unit.
fn spacing_of_file(recipe: &Recipe, file: &HeightFile, surface: &Surface, refined: usize) -> Option<Warning> {
    let Layout { spacing, units, .. } = file.layout(recipe.channel.as_deref()).ok()?;
    let [_, own] = spacing?;
    let own = own * recipe.file_unit.filter(|_| units.distance.is_none()).unwrap_or(1.0);
    let spacing = surface.grid().spacing()[1] * refined as f64;
    let power = (spacing / own).log10();
    let unit = if units.distance.or(recipe.file_unit).is_some() { 0.0 } else { power.round() };
    let is_same = (power - unit).abs() < SAME_LENGTH;
    (!is_same).then(|| {
        Warning::new(
            sentence!(
                "The points in {file} are {own:.6e} apart, but the grid has a spacing of {spacing:.6e}",
                file = file.display(),
                own = LengthValue(own),
                spacing = LengthValue(spacing)
            ),
            "Leave the size out, or give the size of the file",
        )
    })
}

/// The nodes of a surface for each of its file along an axis.
fn refinement(recipe: &Recipe, file: &HeightFile, surface: &Surface) -> usize {
    let layout = file.layout(recipe.channel.as_deref()).ok();
    let shape = layout.and_then(|it| recipe.prepare.shape(it.shape).ok());
    shape.map_or(1, |[_, nx]| surface.grid().shape()[1] / nx).max(1)
}

/// The warning that heights may have another unit than the size.
fn gradient(surface: &Surface) -> Option<Warning> {
    let gradient = surface.rms_gradient();
    (gradient > STEEPEST).then(|| {
        Warning::new(
            sentence!("The rms gradient is {gradient:.3e}", gradient),
            "Give heights and size in the same unit",
        )
    })
}
