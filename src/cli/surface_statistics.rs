//! The statistics of a surface, as they are printed.

use super::exit_status::usage;
use super::measurement::MeasurementReport;
use super::output::{TextRow, row, write_rows};
use super::problem_summary::along_axes;
use super::survey;
use super::texture::TextureReport;
use super::units::{Units, significant};
use super::warnings::in_flags;
use anyhow::Result;
use asperity::Grid;
use asperity::error::FileError;
use asperity::formats::{HeightFile, Measurement, Scan};
use asperity::record::record_survey;
use asperity::seen::capital;
use asperity::sentence::{Sentence, Value};
use asperity::setup::{Cell, Cost, Recipe};
use asperity::surface::{Artefacts, Field, PreparationChoice, RankMap, Resample, Roughness, Surface, Survey};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// Fields that a surface takes while it is made, described and written: heights as they are and as given, with trends and windows on and
/// off, and their spectrum; at most, their autocorrelation on half as many nodes again along both axes.
const FIELDS_IN_MEMORY: f64 = 12.0;

/// The statistics of a surface as they are printed.
#[derive(Serialize)]
pub(crate) struct Statistics {
    /// The parts of the surface, such as a file, in words.
    pub source: String,
    /// What the file of heights says.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<Origin>,
    points: Vec<usize>,
    size: Vec<f64>,
    /// Distances of rows and columns, or of the nodes of a line.
    spacing: Vec<f64>,
    /// What the steps of the preparation came to.
    steps: Vec<Sentence>,
    voids: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub survey: Option<Survey>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    /// The statistics of heights without voids.
    #[serde(flatten)]
    whole: Option<HeightStatistics>,
    pub warnings: Vec<String>,
    /// What is wrong with measured heights, and what an automatic preparation would do.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    verdict: Vec<String>,
    /// What tip and repetition of the measurement tell.
    #[serde(flatten)]
    measurement: MeasurementReport,
    #[serde(skip)]
    pub units: Units,
}

/// What a file of heights says of itself.
#[derive(Serialize)]
struct Origin {
    format: &'static str,
    channels: Vec<String>,
    channel: String,
    /// The channels that cannot be read, and why.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unreadable: Vec<(String, String)>,
    /// Whether the file has units, so that lengths are in metres.
    is_in_metres: bool,
    /// Whether the file says distances in a unit that it does not say.
    #[serde(skip)]
    has_spacing_without_unit: bool,
    /// Whether the file says the unit of its heights.
    #[serde(skip)]
    has_height_unit: bool,
    header: Vec<(String, String)>,
}

/// The statistics of heights without voids.
#[derive(Serialize)]
struct HeightStatistics {
    /// Jumps across the period along y and x, or of a line along it.
    jump_in_rms_steps: Vec<f64>,
    #[serde(flatten)]
    roughness: Roughness,
    #[serde(flatten)]
    texture: TextureReport,
    /// How random heights got a distribution that is not Gaussian.
    #[serde(skip_serializing_if = "Option::is_none")]
    rank_map: Option<RankMap>,
    /// Whether the gradient is that of heights which jump across the period.
    #[serde(skip)]
    has_cliffs: bool,
}

/// A surface with its statistics.
pub(crate) struct Described {
    pub recipe: Recipe,
    pub grid: Grid,
    pub statistics: Statistics,
    pub height: Field,
    /// Whether the height of each node was filled in, row by row; none if all were measured, or are void.
    pub filled: Option<Vec<bool>>,
}

impl Described {
    pub(crate) fn new((mut recipe, cell): (Recipe, Cell), units: Units) -> Result<Self> {
        let uneven = even(&mut recipe)?;
        let grid = recipe.grid(&cell)?;
        recipe.check(&grid)?;
        Cost::from_fields(&grid, FIELDS_IN_MEMORY).check("a surface")?;
        let mut it = describe(recipe, grid, &cell, units)?;
        it.statistics.warnings.extend(uneven);
        Ok(it)
    }
}

/// Resamples heights at uneven positions, which a description needs, too, and returns a warning.
fn even(recipe: &mut Recipe) -> Result<Option<String>> {
    let is_given = recipe.prepare.resample.is_some();
    let Some(file) = recipe.height.as_ref().filter(|_| !is_given) else { return Ok(None) };
    if file.layout(recipe.channel.as_deref())?.is_even {
        return Ok(None);
    }
    recipe.prepare.resample = Some(Resample::Linear);
    Ok(Some(
        "The positions are not evenly spaced, so no contact can be solved. The numbers below are for heights \
         interpolated to even spacing (--resample linear)."
            .into(),
    ))
}

/// The statistics of a surface, and its heights, NaN where they are void.
fn describe(recipe: Recipe, grid: Grid, cell: &Cell, units: Units) -> Result<Described> {
    let outer = 2 - recipe.rank(cell)?;
    let read = |file: &HeightFile| -> Result<_> { Ok((Origin::read(file, &recipe)?, recipe.prepared(file, &grid)?)) };
    let (file, prepared) = recipe.height.as_ref().map(read).transpose()?.unzip();
    let voids = prepared.as_ref().map_or(0, |it| it.scan.voids());
    let mut statistics = Statistics {
        source: recipe.description(),
        warnings: file.iter().filter_map(|it| it.unit_warning(&recipe)).collect(),
        file,
        points: grid.shape()[outer..].to_vec(),
        size: grid.size()[outer..].to_vec(),
        spacing: grid.spacing()[outer..].to_vec(),
        steps: prepared.as_ref().map(|it| it.effects.clone()).unwrap_or_default(),
        voids,
        survey: None,
        seed: recipe.spectrum.as_ref().map(|_| recipe.seed()),
        whole: None,
        verdict: Vec::new(),
        measurement: MeasurementReport::default(),
        units,
    };
    if let Some(prepared) = prepared.filter(|_| voids > 0) {
        let survey = Survey::new(&prepared.scan)?;
        statistics.warnings.extend(in_flags(&recipe.warnings_of_voids(&survey, &prepared.scan, grid.periodic())));
        statistics.verdict = verdict(&recipe, &survey, &prepared.scan, &grid, units)?;
        statistics.survey = Some(survey);
        return Ok(Described { recipe, grid, statistics, height: prepared.scan.height, filled: None });
    }
    let surface = recipe.surface(grid)?;
    let scan = Scan::from_surface(&surface, 1);
    let survey = Survey::new(&scan)?;
    statistics.verdict = verdict(&recipe, &survey, &scan, &grid, units)?;
    let is_sample = recipe.indenter.is_none() && (recipe.is_measured() || recipe.spectrum.is_some());
    statistics.whole = Some(HeightStatistics::new(&surface, outer, is_sample));
    let growth = recipe.is_measured().then(|| survey.warning_of_growth()).flatten();
    statistics.warnings.extend(in_flags(
        &recipe.warnings_of_surveyed(&surface, &survey).into_iter().chain(growth).collect::<Vec<_>>(),
    ));
    statistics.survey = Some(survey);
    let filled = surface.filled().map(<[bool]>::to_vec);
    Ok(Described { recipe, grid, statistics, height: surface.heights_as_given(), filled })
}

impl Origin {
    fn read(file: &HeightFile, recipe: &Recipe) -> Result<Self> {
        let Measurement { format, channels, channel, unreadable, is_in_metres, units, spacing, header, .. } =
            file.measurement(recipe.channel.as_deref())?;
        let has_spacing_without_unit = spacing.is_some() && units.distance.is_none();
        let has_height_unit = units.height.is_some();
        Ok(Self {
            format,
            channels,
            channel,
            unreadable,
            is_in_metres,
            has_spacing_without_unit,
            has_height_unit,
            header,
        })
    }

    /// Whether the unit of lengths is known.
    fn has_unit(&self, recipe: &Recipe) -> bool {
        let has_height_unit = self.has_height_unit || recipe.height_unit.is_some();
        let is_told = recipe.file_unit.is_some() || (has_height_unit && !self.has_spacing_without_unit);
        self.is_in_metres || is_told || self.format == "NumPy"
    }

    /// The warning that the unit of lengths is unknown.
    fn unit_warning(&self, recipe: &Recipe) -> Option<String> {
        (!self.has_unit(recipe)).then(|| {
            "the file has no units, so the heights are used without a unit: give it with --file-unit, such as \
             1um"
            .into()
        })
    }

    /// Names and values for reading.
    fn rows(&self) -> Vec<TextRow> {
        let unit = match (self.is_in_metres, self.has_height_unit, self.has_spacing_without_unit) {
            (true, ..) => "metres",
            (false, true, _) => "metres for heights, not given for distances",
            (false, false, false) => "not given for heights",
            (false, false, true) => "not given in the file",
        };
        let channel = match self.channels.as_slice() {
            [one] => one.clone(),
            all => format!("{}, one of {}: choose with --channel", self.channel, all.join(", ")),
        };
        let mut rows = vec![row("format", self.format), row("channel", channel), row("lengths", unit)];
        for (name, why) in &self.unreadable {
            rows.push(row("unreadable channel", format!("{name}: {why}")));
        }
        rows.extend(self.header.clone());
        rows
    }
}

impl Statistics {
    /// Whether lengths are in metres, as far as is known.
    pub(crate) fn is_in_metres(&self) -> bool {
        self.file.as_ref().is_none_or(|file| file.is_in_metres) || self.units.metres
    }

    /// The numbers of a table by the names of their columns; those of heights are none where some are void.
    pub(crate) fn columns(&self) -> Vec<(String, Option<f64>)> {
        let axes = |name: &str, values: Vec<f64>| -> Vec<(String, Option<f64>)> {
            let axes = if values.len() == 1 { &["x"][..] } else { &["y", "x"] };
            axes.iter().zip(values).map(|(axis, value)| (format!("{name}_{axis}"), Some(value))).collect()
        };
        let mut columns = axes("points", self.points.iter().map(|count| *count as f64).collect());
        columns.extend(axes("size", self.size.clone()));
        columns.push(("voids".into(), Some(self.voids as f64)));
        columns.push(("rms_gradient".into(), self.rms_gradient()));
        if let Some(whole) = &self.whole {
            let Roughness { rms_height, rms_curvature, peak, valley, skewness, kurtosis, .. } = whole.roughness;
            let heights = [
                ("rms_height", rms_height),
                ("rms_curvature", rms_curvature),
                ("peak", peak),
                ("valley", valley),
                ("skewness", skewness),
                ("kurtosis", kurtosis),
            ];
            columns.extend(heights.map(|(name, value)| (name.to_owned(), Some(value))));
            columns.extend(whole.texture.values());
        }
        columns
    }

    /// The rms gradient; of heights with voids that between neighbours that were measured.
    fn rms_gradient(&self) -> Option<f64> {
        let of_measured = || {
            let axes = &self.survey.as_ref()?.axes;
            let squares: Option<Vec<f64>> =
                axes.iter().map(|axis| Some(axis.scales.first()?.rms_gradient.powi(2))).collect();
            Some(squares?.iter().sum::<f64>().sqrt())
        };
        self.whole.as_ref().map(|whole| whole.roughness.rms_gradient).or_else(of_measured)
    }

    /// Records heights, which must not be void.
    pub(crate) fn record(&self, path: &Path, recipe: &Recipe, height: &Field, grid: Grid) -> Result<()> {
        let survey = self.whole_survey("the surface cannot be recorded")?;
        let mut text = Vec::new();
        self.write(true, &mut text)?;
        let text = format!("```text\n{}```\n", String::from_utf8_lossy(&text));
        let unit = if self.file.as_ref().is_some_and(|it| it.is_in_metres) { "m" } else { "" };
        let surface = Surface::new(grid, height.clone())?;
        Ok(record_survey(path, &recipe.title(&grid), &surface, survey, unit, &text)?)
    }

    /// The survey of heights of which none is void.
    pub(crate) fn whole_survey(&self, refused: &str) -> Result<&Survey> {
        match self.survey.as_ref().filter(|_| self.voids == 0) {
            Some(survey) => Ok(survey),
            None => usage(format!(
                "{} heights are void, so {refused}: fill them with --fill harmonic, or cut them off with --crop",
                self.voids
            )),
        }
    }

    /// Refuses a format in metres for heights in an unknown unit.
    pub(crate) fn check_unit(&self, recipe: &Recipe, path: &Path) -> Result<(), FileError> {
        let is_array = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy"));
        if is_array || self.file.as_ref().is_none_or(|it| it.has_unit(recipe)) {
            return Ok(());
        }
        let reason =
            "the format is in metres, but the height file has no units: give them with --file-unit, such as 1um";
        Err(FileError::Target { path: path.into(), reason: reason.into() })
    }

    /// Adds what is known of the measurement beside its heights.
    pub(crate) fn tell(&mut self, report: MeasurementReport) {
        self.verdict.extend(report.sentences(self.units));
        self.measurement = report;
    }

    /// Writes what is wrong with the heights first, then their size, heights, texture and spectrum, and on request their differences at all scales.
    pub(crate) fn write(&self, has_scales: bool, out: &mut impl Write) -> io::Result<()> {
        let units = self.units;
        writeln!(out, "{}", self.source)?;
        if !self.verdict.is_empty() {
            writeln!(out, "\nVerdict")?;
            self.verdict.iter().try_for_each(|line| writeln!(out, "  {line}"))?;
        }
        writeln!(out, "\nSize")?;
        write_rows(self.file.iter().flat_map(Origin::rows), out)?;
        let as_given = |it: &f64| if units.metres { units.length(*it) } else { it.to_string() };
        let size: Vec<String> = self.size.iter().map(as_given).collect();
        let points: Vec<String> = self.points.iter().map(usize::to_string).collect();
        let mut rows = vec![
            row("points", points.join(" x ")),
            row("size", size.join(" x ")),
            row("spacing", along_axes(&self.spacing, |length| units.length(length))),
            row("voids", self.voids.to_string()),
            row("rms gradient", self.rms_gradient().map_or("not known".to_owned(), significant)),
        ];
        rows.extend(self.steps.iter().map(|step| row("prepared", step.to_string())));
        write_rows(rows, out)?;
        if let Some(whole) = &self.whole {
            writeln!(out, "\nHeights and slopes")?;
            write_rows(whole.rows(units), out)?;
            writeln!(out, "\nTexture, by ISO 25178 or ISO 21920, and spectral moments")?;
            write_rows(whole.texture.rows(units), out)?;
        }
        let Some(survey) = &self.survey else { return Ok(()) };
        writeln!(out, "\nTrend, noise and spectrum")?;
        write_rows(survey::rows(survey, units), out)?;
        if has_scales { survey::write_scales(survey, out) } else { Ok(()) }
    }
}

/// The sentence that ends each survey. A smoothed map, a map by a blunt tip and noise of a correlation length of a few nodes all look like a surface,
/// so that no number can be given for their effect.
const NOT_TOLD_BY_HEIGHTS: &str = "Heights alone do not tell the radius of the tip, smoothing by the instrument, or noise that is alike at neighbouring nodes: \
     --tip-radius and --repeat tell more";

/// What is wrong with measured heights, and what an automatic preparation would do.
fn verdict(recipe: &Recipe, survey: &Survey, scan: &Scan, grid: &Grid, units: Units) -> Result<Vec<String>> {
    if !recipe.is_measured() {
        return Ok(Vec::new());
    }
    let words = |value: &Value| match value {
        Value::Length(length) => Some(units.length(*length)),
        _ => None,
    };
    let is_as_measured = recipe.prepare.is_none();
    let mut lines = Vec::new();
    for artefact in &survey.artefacts {
        lines.push(capital(&artefact.sentence().in_words(words)));
    }
    if survey.area_error >= Artefacts::TOLD {
        let percent = 100.0 * survey.area_error;
        lines.push(match is_as_measured {
            true => format!("As they are, areas may be off by up to {percent:.0} % by what can be mended"),
            false => format!("Areas may be off by up to {percent:.0} % by what the preparation has left"),
        });
    }
    let choice = PreparationChoice::of_survey(survey, scan, grid.periodic())?;
    if lines.is_empty() && choice.reasons.is_empty() {
        lines.push("No artefacts were found".into());
    }
    // advice on a preparation is for heights that have none
    if !is_as_measured {
        lines.push(NOT_TOLD_BY_HEIGHTS.into());
        return Ok(lines);
    }
    match choice.preparation.is_none() {
        true => lines.push("--prepare auto would leave the heights as they are".into()),
        false => lines.push(format!("--prepare auto would do: {}", choice.preparation.description())),
    }
    // the reason for a step that mends an artefact begins with the artefact, which stands above already
    let known: Vec<String> = survey.artefacts.iter().map(|artefact| artefact.sentence().to_string()).collect();
    for reason in choice.reasons.iter().map(Sentence::to_string) {
        if !known.iter().any(|artefact| reason.starts_with(artefact)) {
            lines.push(format!("  {reason}"));
        }
    }
    lines.push(NOT_TOLD_BY_HEIGHTS.into());
    Ok(lines)
}

impl HeightStatistics {
    /// The statistics of a surface from an axis on.
    fn new(surface: &Surface, outer: usize, is_sample: bool) -> Self {
        let (roughness, texture) = (Roughness::new(surface), TextureReport::new(surface, is_sample));
        Self {
            jump_in_rms_steps: surface.jumps()[outer..].to_vec(),
            roughness,
            texture,
            rank_map: surface.rank_map().copied(),
            has_cliffs: surface.grid().is_periodic() && surface.ends().contains(&true),
        }
    }

    /// Names and values for reading.
    fn rows(&self, units: Units) -> Vec<TextRow> {
        let Roughness { rms_height, rms_gradient, rms_curvature, peak, valley, skewness, kurtosis } = self.roughness;
        let jumps = along_axes(&self.jump_in_rms_steps, |jump| format!("{jump:.3}"));
        let cliffs =
            if self.has_cliffs { " (with the cliffs across the period, without which the texture is)" } else { "" };
        let curvature_unit = if units.metres { " 1/m" } else { "" };
        let mut rows = vec![
            row("jump across the period", format!("{jumps} rms steps")),
            row("rms height", units.length(rms_height)),
            row("rms gradient", format!("{}{cliffs}", significant(rms_gradient))),
            row("rms curvature", format!("{rms_curvature:.6e}{curvature_unit}")),
            row("highest peak", units.length(peak)),
            row("deepest valley", units.length(valley)),
            row("skewness", significant(skewness)),
            row("kurtosis", significant(kurtosis)),
        ];
        if let Some(RankMap { rounds, spectrum_error, height_error }) = self.rank_map {
            // one of both is exact after any number of rounds, and the other one comes closer
            let words = match spectrum_error > 0.0 {
                true => format!("heights exact, spectrum within {:.2} %", 100.0 * spectrum_error),
                false => format!("spectrum exact, heights within {:.2} % of the rms height", 100.0 * height_error),
            };
            rows.push(row("distribution", format!("{words}, after {rounds} rounds")));
        }
        rows
    }
}
