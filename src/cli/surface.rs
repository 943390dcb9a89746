//! `asperity surface`: makes a surface, or describes one.

use super::choice::choice;
use super::exit_status::{ExitStatus, usage};
use super::figure_args::FigureArgs;
use super::flags::{OfSurface, SceneArgs};
use super::output::{write_json, write_rows};
use super::picture::title_of;
use super::problem_summary::along_axes;
use super::survey;
use super::survey_picture::of_survey;
use super::terminal::stdout;
use super::texture::TextureReport;
use super::units::{Units, significant};
use super::warnings::{self, in_flags};
use super::wrote::wrote;
use anyhow::Result;
use asperity::Grid;
use asperity::error::FileError;
use asperity::files::{check_apart, check_named};
use asperity::plot::{FIGURES, is_figure, write_figure};
use asperity::record::record_survey;
use asperity::seen::capital;
use asperity::setup::{Cost, Recipe};
use asperity::surface::{
    Artefacts, Field, HeightFile, Measurement, PreparationChoice, RankMap, Resample, Roughness, Scan,
    SpectrumConvention, SpectrumTable, Surface, Survey,
};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Fields that a surface takes while it is made, described and written: heights as they are and as given, with trends and windows on and
/// off, and their spectrum; at most, their autocorrelation on half as many nodes again along both axes.
const FIELDS: f64 = 12.0;

const EXAMPLES: &str = "\
Examples:
  asperity surface patch.x3p --fill harmonic --detrend curvature --out flat.npy
  asperity surface --indenter sphere --radius 1mm --points 256,256 --size 100um --json";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Describe {
    #[command(flatten)]
    scene: SceneArgs<OfSurface>,
    /// Write the heights in metres (.npy, .sdf, .x3p or .xyz), or a picture of them, of their artefacts and of their spectrum (.svg, .pdf or .png)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Record the heights, their power spectrum and their gradient at each scale, for the Rerun viewer
    #[arg(long, value_name = "FILE.rrd", help_heading = "Output")]
    record: Option<PathBuf>,
    /// Write the power spectrum, averaged over directions, as two columns that --spectrum reads: wavenumber and density
    #[arg(long, value_name = "FILE.csv", help_heading = "Output")]
    psd: Option<PathBuf>,
    /// Convention of the density in --psd [default: surface or profile, without factors of 2 pi]
    #[arg(long, value_name = "NAME", value_parser = choice::<SpectrumConvention>(), requires = "psd", help_heading = "Output")]
    psd_convention: Option<SpectrumConvention>,
    /// Also print the differences of heights at each scale along each axis
    #[arg(long, help_heading = "Output")]
    scales: bool,
    /// Treat warnings as errors
    #[arg(long, help_heading = "Output")]
    strict: bool,
    /// Print one JSON object instead of a table
    #[arg(long, help_heading = "Output")]
    json: bool,
    #[command(flatten)]
    figure: FigureArgs,
}

/// The statistics of a surface as they are printed.
#[derive(Serialize)]
struct Statistics {
    /// The parts of the surface, such as a file, in words.
    source: String,
    /// What the file of heights says.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<Origin>,
    points: Vec<usize>,
    size: Vec<f64>,
    /// Distances of rows and columns, or of the nodes of a line.
    spacing: Vec<f64>,
    /// What the steps of the preparation came to.
    steps: Vec<String>,
    voids: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    survey: Option<Survey>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    /// The statistics of heights without voids.
    #[serde(flatten)]
    whole: Option<HeightStatistics>,
    warnings: Vec<String>,
    /// What is wrong with measured heights, and what an automatic preparation would do.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    verdict: Vec<String>,
    #[serde(skip)]
    units: Units,
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
    /// Whether the file says distances.
    #[serde(skip)]
    has_spacing: bool,
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

impl Describe {
    pub fn run(&self) -> Result<ExitStatus> {
        if let Some(path) = &self.out {
            check_named(path, &Scan::endings().into_iter().chain(FIGURES).collect::<Vec<_>>())?;
        }
        if let Some(path) = &self.record {
            check_named(path, &["rrd"])?;
        }
        if let Some(path) = &self.psd {
            check_named(path, &["csv"])?;
        }
        let style = self.figure.style(self.out.as_deref().is_some_and(is_figure))?;
        let table = self.scene.table()?;
        let written = self.out.iter().chain(&self.psd).chain(&self.record);
        check_apart(written, self.scene.files(&table))?;
        let (mut recipe, cell) = table.surface()?;
        let uneven = even(&mut recipe)?;
        let grid = recipe.grid(&cell)?;
        recipe.check(&grid)?;
        Cost::from_fields(&grid, FIELDS).check("a surface")?;
        let units = self.scene.units();
        let (mut statistics, height) = describe(&recipe, &grid, 2 - recipe.rank(&cell)?, units)?;
        statistics.warnings.extend(uneven);
        warnings::refuse_if_strict(&statistics.warnings, self.strict)?;
        let mut heights = self.out.iter().filter(|path| !is_figure(path));
        heights.try_for_each(|path| statistics.check_unit(&recipe, path))?;
        if let Some(path) = &self.record {
            statistics.record(path, &recipe, &height, grid)?;
        }
        if let Some(path) = &self.psd {
            statistics.whole_survey("their spectrum cannot be written")?;
            write_psd(path, self.psd_convention, &Surface::new(grid, height.clone())?)?;
        }
        match &self.out {
            Some(path) if is_figure(path) => {
                let survey = statistics.survey.as_ref().expect("heights have a survey");
                let title = title_of(&recipe, &grid);
                write_figure(path, &of_survey(&title, &scan(height, &grid), survey, statistics.units), &style)?;
            }
            Some(path) => scan(height, &grid).write(path)?,
            None => {}
        }
        if self.json {
            write_json(&statistics, &mut stdout())?
        } else {
            statistics.write(self.scales, &mut stdout())?
        }
        warnings::print(&statistics.warnings);
        self.record.iter().for_each(|path| wrote(path));
        self.out.iter().chain(&self.psd).for_each(|path| wrote(path));
        Ok(ExitStatus::Done)
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

/// The statistics of a surface from an axis on, and its heights, NaN where they are void.
fn describe(recipe: &Recipe, grid: &Grid, outer: usize, units: Units) -> Result<(Statistics, Field)> {
    let read = |file: &HeightFile| -> Result<_> { Ok((Origin::read(file, recipe)?, recipe.prepared(file, grid)?)) };
    let (file, prepared) = recipe.height.as_ref().map(read).transpose()?.unzip();
    let voids = prepared.as_ref().map_or(0, |it| it.scan.voids());
    let mut statistics = Statistics {
        source: recipe.description(),
        warnings: file.iter().filter_map(|it| it.unit_warning(recipe)).collect(),
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
        units,
    };
    if let Some(prepared) = prepared.filter(|_| voids > 0) {
        let survey = Survey::new(&prepared.scan)?;
        statistics.warnings.extend(in_flags(&recipe.warnings_of_voids(&survey, grid.len())));
        statistics.verdict = verdict(recipe, &survey, &prepared.scan, grid, units)?;
        statistics.survey = Some(survey);
        return Ok((statistics, prepared.scan.height));
    }
    let surface = recipe.surface(*grid)?;
    let scan = Scan::from_surface(&surface, 1);
    let survey = Survey::new(&scan)?;
    statistics.verdict = verdict(recipe, &survey, &scan, grid, units)?;
    let is_sample = recipe.indenter.is_none() && (recipe.is_measured() || recipe.spectrum.is_some());
    statistics.whole = Some(HeightStatistics::new(&surface, outer, is_sample));
    let growth = recipe.is_measured().then(|| survey.warning_of_growth()).flatten();
    statistics.warnings.extend(in_flags(&recipe.warnings(&surface).into_iter().chain(growth).collect::<Vec<_>>()));
    statistics.survey = Some(survey);
    Ok((statistics, surface.heights_as_given()))
}

/// Writes the power spectrum of a surface in a convention, or in the one without factors of 2 pi.
fn write_psd(path: &Path, convention: Option<SpectrumConvention>, surface: &Surface) -> Result<()> {
    let plain = if surface.grid().is_line() { SpectrumConvention::Profile } else { SpectrumConvention::Surface };
    Ok(SpectrumTable::from_surface(surface)?.write(path, convention.unwrap_or(plain))?)
}

/// Heights as a scan on the cell of a grid; they may have fewer points than the grid.
fn scan(height: Field, grid: &Grid) -> Scan {
    let (points, size) = ([height.nrows(), height.ncols()], grid.size());
    Scan { height, spacing: [0, 1].map(|axis| size[axis] / points[axis] as f64) }
}

impl Origin {
    fn read(file: &HeightFile, recipe: &Recipe) -> Result<Self> {
        let Measurement { format, channels, channel, unreadable, is_in_metres, spacing, header, .. } =
            file.measurement(recipe.channel.as_deref())?;
        Ok(Self { format, channels, channel, unreadable, is_in_metres, has_spacing: spacing.is_some(), header })
    }

    /// Whether the unit of lengths is known.
    fn has_unit(&self, recipe: &Recipe) -> bool {
        let own = recipe.height_unit.filter(|_| !self.has_spacing); // otherwise distances have none
        self.is_in_metres || recipe.file_unit.or(own).is_some() || self.format == "NumPy"
    }

    /// The warning that the unit of lengths is unknown.
    fn unit_warning(&self, recipe: &Recipe) -> Option<String> {
        (!self.has_unit(recipe)).then(|| {
            "the file has no units, so the heights are used without a unit: give it with --file-unit, such as \
             1um"
            .into()
        })
    }

    fn rows(&self) -> Vec<(String, String)> {
        let unit = if self.is_in_metres { "metres" } else { "not given in the file" };
        let channel = match self.channels.as_slice() {
            [one] => one.clone(),
            all => format!("{}, one of {}: choose with --channel", self.channel, all.join(", ")),
        };
        let rows = [("format", self.format.to_owned()), ("channel", channel), ("lengths", unit.to_owned())];
        let rows = rows.map(|(name, value)| (name.to_owned(), value)).into_iter();
        let unreadable =
            self.unreadable.iter().map(|(name, why)| ("unreadable channel".into(), format!("{name}: {why}")));
        rows.chain(unreadable).chain(self.header.clone()).collect()
    }
}

impl Statistics {
    /// Records heights, which must not be void.
    fn record(&self, path: &Path, recipe: &Recipe, height: &Field, grid: Grid) -> Result<()> {
        let survey = self.whole_survey("the surface cannot be recorded")?;
        let mut text = Vec::new();
        self.write(true, &mut text)?;
        let text = format!("```text\n{}```\n", String::from_utf8_lossy(&text));
        let unit = if self.file.as_ref().is_some_and(|it| it.is_in_metres) { "m" } else { "" };
        let surface = Surface::new(grid, height.clone())?;
        Ok(record_survey(path, &recipe.title(&grid), &surface, survey, unit, &text)?)
    }

    /// The survey of heights of which none is void.
    fn whole_survey(&self, refused: &str) -> Result<&Survey> {
        match self.survey.as_ref().filter(|_| self.voids == 0) {
            Some(survey) => Ok(survey),
            None => usage(format!(
                "{} heights are void, so {refused}: fill them with --fill harmonic, or cut them off with --crop",
                self.voids
            )),
        }
    }

    /// Refuses a format in metres for heights in an unknown unit.
    fn check_unit(&self, recipe: &Recipe, path: &Path) -> Result<(), FileError> {
        let is_array = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy"));
        if is_array || self.file.as_ref().is_none_or(|it| it.has_unit(recipe)) {
            return Ok(());
        }
        let reason =
            "the format is in metres, but the height file has no units: give them with --file-unit, such as 1um";
        Err(FileError::Target { path: path.into(), reason: reason.into() })
    }

    /// Writes what is wrong with the heights first, then their size, heights, texture and spectrum, and on request their differences at all scales.
    fn write(&self, has_scales: bool, out: &mut impl Write) -> io::Result<()> {
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
        let rows = [
            ("points", points.join(" x ")),
            ("size", size.join(" x ")),
            ("spacing", along_axes(&self.spacing, |it| units.length(it))),
            ("voids", self.voids.to_string()),
        ];
        write_rows(rows.map(|(name, value)| (name.to_owned(), value)), out)?;
        write_rows(self.steps.iter().map(|step| ("prepared".to_owned(), step.clone())), out)?;
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

/// What no survey can find, since it looks like a surface: a blunt tip and a smoothing program make contacts 35 to 59 % too large, and noise that is
/// alike at neighbouring nodes up to 31 % too small.
const UNKNOWN: &str = "Heights alone do not tell the radius of the tip, smoothing by the instrument, or noise that is alike at neighbouring nodes";

/// What is wrong with measured heights, and what an automatic preparation would do.
fn verdict(recipe: &Recipe, survey: &Survey, scan: &Scan, grid: &Grid, units: Units) -> Result<Vec<String>> {
    if !recipe.is_measured() {
        return Ok(Vec::new());
    }
    let words = |length: f64| units.length(length);
    let found = survey.artefacts.iter().map(|it| capital(&it.sentence_in(&words)));
    let error =
        Some(survey.area_error).filter(|it| *it >= Artefacts::TOLD).map(|error| match recipe.prepare.is_none() {
            true => format!("As they are, areas may be off by up to {:.0} % by what can be mended", 100.0 * error),
            false => format!("Areas may be off by up to {:.0} % by what the preparation has left", 100.0 * error),
        });
    let mut lines: Vec<String> = found.chain(error).collect();
    let choice = PreparationChoice::new(scan, true, grid.periodic())?;
    if lines.is_empty() && choice.reasons.is_empty() {
        lines.push("No artefacts were found".into());
    }
    if !recipe.prepare.is_none() {
        lines.push(UNKNOWN.into());
        return Ok(lines);
    }
    match choice.preparation.is_none() {
        true => lines.push("--prepare auto would leave the heights as they are".into()),
        false => lines.push(format!("--prepare auto would do: {}", choice.preparation.description())),
    }
    let is_new = |it: &&String| !survey.artefacts.iter().any(|artefact| it.starts_with(&artefact.sentence()));
    lines.extend(choice.reasons.iter().filter(is_new).map(|reason| format!("  {reason}")));
    lines.push(UNKNOWN.into());
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

    fn rows(&self, units: Units) -> Vec<(String, String)> {
        let Roughness { rms_height, rms_gradient, rms_curvature, peak, valley, skewness, kurtosis } = self.roughness;
        let jumps = along_axes(&self.jump_in_rms_steps, |jump| format!("{jump:.3}"));
        let cliffs =
            if self.has_cliffs { " (with the cliffs across the period, without which the texture is)" } else { "" };
        let rows = [
            ("jump across the period", format!("{jumps} rms steps")),
            ("rms height", units.length(rms_height)),
            ("rms gradient", format!("{}{cliffs}", significant(rms_gradient))),
            (
                "rms curvature",
                if units.metres { format!("{rms_curvature:.6e} 1/m") } else { format!("{rms_curvature:.6e}") },
            ),
            ("highest peak", units.length(peak)),
            ("deepest valley", units.length(valley)),
            ("skewness", significant(skewness)),
            ("kurtosis", significant(kurtosis)),
        ];
        let heights = self.rank_map.map(|RankMap { rounds, spectrum_error, height_error }| {
            let told = match spectrum_error > 0.0 {
                true => format!("heights exact, spectrum within {:.2} %", 100.0 * spectrum_error),
                false => format!("spectrum exact, heights within {:.2} % of the rms height", 100.0 * height_error),
            };
            ("distribution", format!("{told}, after {rounds} rounds"))
        });
        rows.into_iter().chain(heights).map(|(name, value)| (name.to_owned(), value)).collect()
    }
}
