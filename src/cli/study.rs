//! `asperity study`: a setup with lists, solved row by row on one machine or on many.

use super::choice::{bytes, count};
use super::exit_status::{ExitStatus, Usage, usage};
use super::figure_args::FigureArgs;
use super::interrupt::when_interrupted;
use super::progress::blank;
use super::study_row;
use super::study_summary::{StudyOutput, StudySummary};
use super::study_table::write_expenses;
use super::terminal::stdout;
use super::warnings;
use super::wrote::wrote;
use anyhow::Result;
use asperity::files::{check_apart, check_named, check_target};
use asperity::setup::available_bytes;
use asperity::study::{Campaign, Plan, Shard, Table};
use clap::Args;
use indicatif::ProgressBar;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The share of the free memory that a study may fill.
const MEMORY_SHARE: f64 = 0.8;

const EXAMPLES: &str = "\
A study is a scene in which any value may be a list, and a seed a range such as \"1-100\":

  surface = { spectrum = { hurst = [0.2, 0.5, 0.8], rolloff-wavelength = 20e-6, short-cutoff = 1e-6, rms-gradient = 0.1 }, seed = \"1-20\" }
  grid = { points = [[2048], [4096]], size = 160e-6 }
  load = { reduced-pressure = \"1e-3..1e-1:5\" }

Examples:
  asperity study study.toml
  asperity study study.toml --shard 3/100
  asperity study study.toml --record-row 7 --record row.rrd";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Study {
    /// The study
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// Table of all rows; NAME.parquet, NAME.svg and NAME.png are written beside it [default: name of the study, in
    /// this folder]
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Solve one of several shares, and write it to its own table, such as NAME.3-of-100.csv
    #[arg(long, value_name = "N/COUNT")]
    shard: Option<Shard>,
    /// Realisations solved at the same time [default: the number of threads]
    #[arg(long, value_name = "N", value_parser = count)]
    workers: Option<NonZeroUsize>,
    /// Memory for all of them together, such as 8GB [default: 80 % of the free memory]
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    memory: Option<f64>,
    /// Solve all rows again, and replace existing results
    #[arg(long)]
    fresh: bool,
    /// Print the number of rows and the estimated time and memory, and do not solve
    #[arg(long, conflicts_with = "json")]
    dry_run: bool,
    #[command(flatten)]
    output: StudyOutput,
    #[command(flatten)]
    figure: FigureArgs,
    /// Record the steps of the row with this number, instead of solving the study
    #[arg(long, value_name = "ROW", requires = "record", conflicts_with_all = ["shard", "out", "dry_run", "fresh", "json", "strict"])]
    record_row: Option<usize>,
    /// The recording of that row
    #[arg(long, value_name = "FILE.rrd", requires = "record_row")]
    record: Option<PathBuf>,
    /// Show the study in the installed Rerun viewer, one realisation after the other, instead of writing a table: the steps under one load, the
    /// contacts under several, or the states of a history
    #[arg(long, conflicts_with_all = ["record_row", "shard", "out", "dry_run", "fresh", "json", "strict", "workers"])]
    live: bool,
}

impl Study {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let plan = Plan::read(&self.study)?;
        if let (Some(row), Some(path)) = (self.record_row, &self.record) {
            check_apart([path], [self.study.as_path()].into_iter().chain(plan.files()))?;
            return study_row::record(&plan, row, path);
        }
        if self.live {
            return study_row::show_all(&plan);
        }
        let campaign = self.campaign();
        let style = self.figure.style(campaign.shard == Shard::WHOLE)?;
        if self.dry_run {
            write_expenses(&plan, &campaign, &mut stdout())?;
            return Ok(ExitStatus::Done);
        }
        let table = Table::new(self.table()?);
        check_outputs(&table, [self.study.as_path()].into_iter().chain(plan.files()))?;
        plan.check()?;
        if self.fresh {
            table.read()?; // what is no table of a study is not ours to replace
            table.clear()?;
        }
        let bar = bar(&plan, campaign.shard)?;
        end_when_interrupted(&table, &bar)?;
        let points = plan.run(&campaign, &table, &|_| bar.inc(1)).inspect_err(|_| {
            bar.finish_and_clear();
            say_where_rows_are(&table);
        })?;
        bar.finish_and_clear();
        let summary = match campaign.shard == Shard::WHOLE {
            true => StudySummary::of_all(&plan, table.path(), &points),
            false => StudySummary::of_share(&plan, table.path(), &points),
        };
        if campaign.shard == Shard::WHOLE {
            plan.write_views(table.path(), &points, &style)?.iter().for_each(|path| wrote(path));
        }
        wrote(table.path());
        summary.finish(&plan, &self.output)
    }

    /// How the study is solved.
    fn campaign(&self) -> Campaign {
        Campaign {
            shard: self.shard.unwrap_or(Shard::WHOLE),
            workers: self.workers.map_or_else(rayon::current_num_threads, NonZeroUsize::get),
            memory: self.memory.or_else(|| available_bytes().map(|free| MEMORY_SHARE * free)),
        }
    }

    /// The path of the table.
    fn table(&self) -> Result<PathBuf> {
        let whole = table_of(&self.study, self.out.as_deref())?;
        Ok(match self.shard {
            Some(shard) => whole.with_extension(format!("{}-of-{}.csv", shard.number(), shard.count())),
            None => whole,
        })
    }
}

/// The table of a whole study: the one that is given, or else the one of its name in this folder.
pub(crate) fn table_of(study: &Path, given: Option<&Path>) -> Result<PathBuf> {
    let path = match (given, study.file_name()) {
        (Some(path), _) => path.to_path_buf(),
        (None, Some(name)) => Path::new(name).with_extension("csv"),
        (None, None) => return usage(format!("{} is not the name of a study: give a file", study.display())),
    };
    check_named(&path, &["csv"])?;
    check_target(&path)?;
    Ok(path)
}

/// Refuses a table of which a file, or a drawing, is one of the files that are read.
fn check_outputs<R: AsRef<Path>>(table: &Table, read: impl IntoIterator<Item = R>) -> Result<()> {
    Ok(check_apart(table.files().into_iter().chain(table.views()), read)?)
}

/// Ends the program on Ctrl-C, and says where the rows are that were solved.
fn end_when_interrupted(table: &Table, bar: &ProgressBar) -> Result<()> {
    let (bar, files) = (bar.clone(), [table.unfinished_path(), table.path().to_path_buf()]);
    when_interrupted(move || {
        bar.finish_and_clear();
        let rows_are = match files.iter().find(|path| path.is_file()) {
            Some(path) => {
                format!("the rows that were solved are in {}. Run the same command again to go on", path.display())
            }
            None => "no row was solved".into(),
        };
        warnings::print(&[format!("Interrupted: {rows_are}.")]);
    })?;
    Ok(())
}

/// Says where the rows are that were solved before an error, if there are any.
fn say_where_rows_are(table: &Table) {
    let path = table.unfinished_path();
    if path.is_file() {
        warnings::print(&[format!(
            "The rows that were solved are in {}. Mend the study and run the same command again to go on, or with --fresh to begin again.",
            path.display()
        )]);
    }
}

/// A bar of the rows of a share.
fn bar(plan: &Plan, shard: Shard) -> Result<ProgressBar> {
    let bar = blank("{prefix} [{wide_bar}] {pos} of {len} rows ({eta} left)");
    bar.set_length((plan.share(shard)?.len() * plan.loads().len()) as u64);
    bar.set_prefix(if shard == Shard::WHOLE { "study".into() } else { format!("share {shard}") });
    bar.enable_steady_tick(Duration::from_millis(200));
    Ok(bar)
}

const MERGE_EXAMPLES: &str = "\
Examples:
  asperity merge study.toml study.1-of-2.csv study.2-of-2.csv
  asperity merge study.toml study.1-of-2.csv study.2-of-2.csv --out all.csv";

#[derive(Args)]
#[command(after_help = MERGE_EXAMPLES)]
pub(crate) struct Merge {
    /// The study
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// Tables of its shares
    #[arg(value_name = "SHARE.csv", required = true)]
    shares: Vec<PathBuf>,
    /// Table of all rows; NAME.parquet, NAME.svg and NAME.png are written beside it [default: name of the study, in
    /// this folder]
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    #[command(flatten)]
    output: StudyOutput,
    #[command(flatten)]
    figure: FigureArgs,
}

impl Merge {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let plan = Plan::read(&self.study)?;
        let path = table_of(&self.study, self.out.as_deref())?;
        let style = self.figure.style(true)?;
        if let Some(share) =
            self.shares.iter().find(|share| !share.is_file() && !share.with_extension("unfinished").is_file())
        {
            return Err(
                Usage(format!("there is no table {}: solve this share, or leave it out", share.display())).into()
            );
        }
        let tables: Vec<Table> = self.shares.iter().map(Table::new).collect();
        let named = [self.study.as_path()].into_iter().chain(plan.files()).map(Path::to_path_buf);
        let merged = Table::new(&path);
        check_outputs(&merged, named.chain(tables.iter().flat_map(Table::files)))?;
        merged.read()?; // what is no table of a study is not ours to replace
        let points = plan.merge(&tables)?;
        let all: Vec<usize> = (0..plan.realisations()).collect();
        plan.finish(&merged, &all, &points)?;
        plan.write_views(&path, &points, &style)?.iter().for_each(|path| wrote(path));
        wrote(&path);
        StudySummary::of_all(&plan, &path, &points).finish(&plan, &self.output)
    }
}
