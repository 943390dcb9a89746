//! `asperity surface`: makes a surface, or describes one.

use super::choice::choice;
use super::exit_status::{ExitStatus, usage};
use super::figure_args::FigureArgs;
use super::flags::{OfSurface, SceneArgs};
use super::hatch::hatch;
use super::measurement::MeasurementArgs;
use super::output::write_json;
use super::picture::title_of;
use super::surface_statistics::Described;
use super::surface_table::SurfaceTable;
use super::survey_picture::of_survey;
use super::terminal::stdout;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::Grid;
use asperity::files::{check_apart, check_named};
use asperity::formats::Scan;
use asperity::plot::{FIGURES, is_figure, write_figure};
use asperity::surface::{Field, SpectrumConvention, SpectrumTable, Surface};
use clap::Args;
use std::path::{Path, PathBuf};

/// The ending of a table of statistics.
const TABLE_ENDING: &str = "csv";

const EXAMPLES: &str = "\
Examples:
  asperity surface patch.x3p --fill harmonic --detrend curvature --out flat.npy
  asperity surface *.x3p --detrend plane --out table.csv
  asperity surface --indenter sphere --radius 1mm --points 256,256 --size 100um --json";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Describe {
    #[command(flatten)]
    scene: SceneArgs<OfSurface>,
    /// Further files of heights, each with the same flags: a row of statistics for each, and one of their mean
    #[arg(value_name = "FILES")]
    more: Vec<PathBuf>,
    /// Write the heights, a picture or a table, by the end of the file's name
    ///
    /// Heights in metres: .npy, .sdf, .x3p, .xyz, .gwy; as a closed block in millimetres: .stl. A picture of the heights, of their artefacts
    /// and of their spectrum: .svg, .pdf, .png. The statistics of one or several files as a table: .csv.
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
    measurement: MeasurementArgs,
    #[command(flatten)]
    figure: FigureArgs,
}

impl Describe {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let is_table =
            self.out.as_ref().and_then(|path| path.extension()).is_some_and(|it| it.eq_ignore_ascii_case(TABLE_ENDING));
        if is_table || !self.more.is_empty() {
            return self.run_many();
        }
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
        check_apart(written, self.scene.files(&table).into_iter().chain(self.measurement.files()))?;
        let units = self.scene.units();
        let (recipe, cell) = table.surface()?;
        let Described { recipe, grid, mut statistics, height, filled } = Described::new((recipe, cell.clone()), units)?;
        statistics.tell(self.measurement.report(&recipe, &cell)?);
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
                let mut figure = of_survey(&title, &scan(height, &grid), survey, statistics.units);
                if !grid.is_line() {
                    hatch(&mut figure.panels[0], &grid, filled.as_deref(), statistics.units);
                }
                write_figure(path, &figure, &style)?;
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

    /// Statistics of one file or several as a table.
    fn run_many(&self) -> Result<ExitStatus> {
        if let Some(path) = &self.out {
            check_named(path, &[TABLE_ENDING])?;
        }
        if self.record.is_some() || self.psd.is_some() {
            return usage("--record and --psd are for one file of heights: give one file, and another --out than .csv");
        }
        if self.measurement.is_given() {
            return usage(
                "--repeat and --tip-radius are for one file of heights: give one file, and another --out than .csv",
            );
        }
        let scenes: Vec<SceneArgs<OfSurface>> =
            self.more.iter().map(|file| self.scene.with_file(file.clone())).collect();
        let mut files = Vec::new();
        for scene in std::iter::once(&self.scene).chain(&scenes) {
            let table = scene.table()?;
            check_apart(&self.out, scene.files(&table))?;
            let described = Described::new(table.surface()?, scene.units())?;
            let name = scene.file().map_or(described.statistics.source.clone(), |file| file.display().to_string());
            files.push((name, described.statistics));
        }
        SurfaceTable::new(&files, self.scene.units())?.run(self.out.as_deref(), self.json, self.strict)
    }
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
