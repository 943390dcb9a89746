//! The recordings of the figures: their curves over the loads, and contacts that grow.

use super::means::{Points, Quantity};
use super::part::Part;
use super::rough::Rough;
use super::smooth::realisation;
use super::study::Study;
use super::{beyond, fig1, fig3, fig5};
use anyhow::Result;
use asperity::Problem;
use asperity::plot::{Colour, Figure};
use asperity::record::{Curve, LoadRecording, Loads, Options, Scene};
use asperity::study::{Pressed, Realisation, Row, Shape};
use asperity::theory::{Geometry, SummitHeights};

/// Separations of Section 6, over the scale of the heights.
const SEPARATIONS: [f64; 11] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0];
/// Points of the cylinder, and along a side of the sphere, that are shown.
const SHOWN_LINE: usize = 1 << 12;
const SHOWN_SIDE: usize = 1 << 9;
/// Colours of the Hurst exponents, three shades of a kind.
const WARM: [Colour; 4] = [Colour::VERMILION, Colour::ORANGE, Colour::PURPLE, Colour::GREY];
const COLD: [Colour; 4] = [Colour::BLUE, Colour::SKY, Colour::GREEN, Colour::GREY];

/// What a recording shows over its loads.
struct Growth {
    captions: Vec<String>,
    /// Where each load stands in the panels of the figure.
    cursor: Vec<f64>,
    curves: Vec<(Curve, Vec<f64>)>,
    contacts: Vec<Realisation>,
    length_unit: &'static str,
}

/// Records `figure`, and the contacts of one realisation of each kind under its loads.
pub fn record(part: Part, study: &Study, figure: &Figure) -> Result<()> {
    match part {
        Part::Fig1 => smooth(study)?,
        Part::Fig2 => rough(&study.lines, &study.points(part)?, study.lines.lines()?),
        Part::Fig3 => fits(study)?,
        Part::Fig4 => rough(&study.surfaces, &study.points(part)?, study.surfaces.surfaces()?),
        Part::Fig5 => ratios(study)?,
        Part::Gw => summits(),
        Part::Beyond => sine(study)?,
        Part::Table1 | Part::All => return Ok(()),
    }
    .record(part, study, figure)
}

impl Growth {
    fn record(self, part: Part, study: &Study, figure: &Figure) -> Result<()> {
        let problems = self.contacts.iter().map(heaviest).collect::<Result<Vec<_>>>()?;
        let scene = |(contact, problem): (&Realisation, _)| Scene {
            name: title(contact),
            title: title(contact),
            problem,
            description: format!("{}, {} points", title(contact), points(contact)),
            exact: None,
        };
        let scenes: Vec<Scene<'_>> = self.contacts.iter().zip(&problems).map(scene).collect();
        let loads = Loads {
            title: figure.title.clone(),
            description: "Tribology Letters 66:115 (2018), made again. Click a load in a curve to see its contact."
                .into(),
            captions: self.captions.clone(),
            curves: self.curves.iter().map(|(curve, _)| curve.clone()).collect(),
            figure: Some((figure, self.cursor.clone())),
            scenes: &scenes,
        };
        let options = Options { length_unit: self.length_unit.into(), ..Options::default() };
        let recording = LoadRecording::create(&study.file(part.name(), "rrd"), &loads, options)?;
        for load in 0..self.captions.len() {
            let values: Vec<f64> =
                self.curves.iter().map(|(_, values)| values.get(load).copied().unwrap_or(f64::NAN)).collect();
            recording.values(load, &values)?;
        }
        for (scene, contact) in self.contacts.iter().enumerate() {
            contact.press(&study.stop(part)?, |Pressed { load, contact, .. }| -> Result<()> {
                Ok(recording.contact(scene, load, contact)?)
            })?;
        }
        Ok(recording.finish()?)
    }
}

fn heaviest(contact: &Realisation) -> Result<Problem> {
    let load = contact.loads.last().copied().unwrap_or(f64::NAN);
    Ok(Problem::at_reduced_pressure(contact.surface()?, 1.0, load)?)
}

fn title(contact: &Realisation) -> String {
    match contact.shape {
        Shape::Smooth(_) => contact.name.clone(),
        Shape::Rough { spectrum, seed } => format!("{}, H = {}, seed {seed}", contact.name, spectrum.hurst),
    }
}

fn points(contact: &Realisation) -> String {
    match contact.grid.shape() {
        [1, nx] => nx.to_string(),
        [ny, nx] => format!("{ny} x {nx}"),
    }
}

fn captions(name: &str, values: &[f64]) -> Vec<String> {
    values.iter().map(|value| format!("{name} = {value:.2e}")).collect()
}

fn curve(view: &str, name: impl Into<String>, colour: Colour) -> Curve {
    Curve { view: view.into(), name: name.into(), colour: colour.0 }
}

/// Means over the realisations, and the first realisation of each Hurst exponent on the coarsest grid.
fn rough(rough: &Rough, points: &Points, all: Vec<Realisation>) -> Growth {
    let finest = points.grids().last().copied().unwrap_or(0);
    let kinds: [(&str, &str, &[Colour], Quantity); 4] = [
        ("κ and κ_r", "κ", &WARM, |row| row.kappa),
        ("κ and κ_r", "κ_r", &COLD, |row| row.kappa_r),
        ("κ_r corrected", "κ_r corrected", &COLD, |row| row.kappa_r_corrected),
        ("relative contact area", "log10 a_rel", &WARM, |row| row.relative_area.log10()),
    ];
    let mut curves = Vec::new();
    for (view, name, colours, quantity) in kinds {
        for (&hurst, colour) in rough.hurst.iter().zip(colours.iter().cycle()) {
            let values = rough.loads.iter().map(|&load| points.at(hurst, load, finest, quantity).mean).collect();
            curves.push((curve(view, format!("{name}, H = {hurst}"), *colour), values));
        }
    }
    let contacts = all.into_iter().take(rough.hurst.len() * rough.seeds.len()).step_by(rough.seeds.len());
    Growth {
        captions: captions("p*", &rough.loads),
        cursor: rough.loads.clone(),
        curves,
        contacts: contacts.collect(),
        length_unit: "m",
    }
}

/// The fits beside what is fitted; no contacts.
fn fits(study: &Study) -> Result<Growth> {
    let points = study.points(Part::Fig2)?;
    let growth = rough(&study.lines, &points, Vec::new());
    let measured = growth.curves.into_iter().filter(|(curve, _)| curve.name.starts_with("κ,"));
    let fits = fig3::fits(study, &points).into_iter().zip(COLD.iter().cycle()).map(|(fit, colour)| {
        let values = study.lines.loads.iter().map(|&load| fit.kappa_at(load)).collect();
        (curve("κ and κ_r", fit.name(), *colour), values)
    });
    Ok(Growth { curves: measured.chain(fits).collect(), ..growth })
}

/// Ratios; no contacts.
fn ratios(study: &Study) -> Result<Growth> {
    let ratios = fig5::ratios(study)?;
    type Kind = (&'static str, &'static [Colour], fn(&fig5::Ratio) -> f64);
    let kinds: [Kind; 2] = [("κ", &WARM, |ratio| ratio.kappa), ("κ_r", &COLD, |ratio| ratio.kappa_r)];
    let mut curves = Vec::new();
    for (name, colours, quantity) in kinds {
        for (hurst, colour) in study.lines.hurst.iter().zip(colours.iter().cycle()) {
            let values = ratios.iter().filter(|ratio| ratio.hurst == *hurst).map(quantity).collect();
            curves.push((curve("lines over surfaces", format!("{name}, H = {hurst}"), *colour), values));
        }
    }
    let growth = rough(&study.lines, &study.points(Part::Fig2)?, Vec::new());
    Ok(Growth { curves, ..growth })
}

/// Cylinder and sphere with contacts of the same widths, on grids for the eye.
fn smooth(study: &Study) -> Result<Growth> {
    let points = study.points(Part::Fig1)?;
    let widths = fig1::shown_widths();
    let rows = |name: &str| {
        let rows: Vec<_> = points.0.iter().filter(|row| row.name == name).collect();
        let every = (rows.len().saturating_sub(1) / (widths.len() - 1)).max(1);
        rows.into_iter().step_by(every).collect::<Vec<_>>()
    };
    let [cylinders, spheres] = ["cylinder", "sphere"].map(rows);
    let kappa_r = |rows: &[&Row]| rows.iter().map(|row| row.kappa_r_corrected).collect();
    Ok(Growth {
        captions: captions("a/L", &widths),
        cursor: cylinders.iter().map(|row| row.reduced_pressure_contact).collect(),
        curves: vec![
            (curve("κ_r corrected", "cylinder", Colour::VERMILION), kappa_r(&cylinders)),
            (curve("κ_r corrected", "sphere", Colour::BLUE), kappa_r(&spheres)),
        ],
        contacts: vec![
            realisation(Geometry::Line, SHOWN_LINE, &widths)?,
            realisation(Geometry::Point, SHOWN_SIDE, &widths)?,
        ],
        length_unit: "R",
    })
}

/// Both distributions of heights over the separation; no contacts.
fn summits() -> Growth {
    let kinds = [
        ("exponential heights", Colour::BLUE, SummitHeights::Exponential),
        ("Gaussian heights", Colour::VERMILION, SummitHeights::Gaussian),
    ];
    let curves = kinds.map(|(name, colour, heights)| {
        (curve("κ_r", name, colour), SEPARATIONS.map(|separation| heights.kappa_r(separation)).to_vec())
    });
    Growth {
        captions: SEPARATIONS.map(|separation| format!("d/σ = {separation}")).to_vec(),
        cursor: SEPARATIONS.to_vec(),
        curves: curves.into(),
        contacts: Vec::new(),
        length_unit: "",
    }
}

/// The sine to full contact.
fn sine(study: &Study) -> Result<Growth> {
    let points = study.points(Part::Beyond)?;
    let rows: Vec<_> = points.0.iter().filter(|row| row.name == "sine").collect();
    let contacts: Vec<_> = beyond::realisations(study)?.into_iter().filter(|contact| contact.name == "sine").collect();
    let values = |quantity: Quantity| rows.iter().map(|row| quantity(row)).collect::<Vec<_>>();
    Ok(Growth {
        captions: beyond::SINE.map(|share| format!("p/p_full = {share}")).to_vec(),
        cursor: beyond::SINE.to_vec(),
        curves: vec![
            (curve("sine", "a_rel corrected", Colour::VERMILION), values(|row| row.relative_area_corrected)),
            (curve("sine", "κ_r corrected", Colour::BLUE), values(|row| row.kappa_r_corrected)),
        ],
        contacts,
        length_unit: "L/4",
    })
}
