//! `asperity plot`: one picture of the numbers in several results and tables.

use super::exit_status::{ExitStatus, usage};
use super::figure_args::FigureArgs;
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::{ArchiveReader, Quantity};
use asperity::error::FileError;
use asperity::files::{check_apart, check_named, read_columns};
use asperity::plot::{Axis, Colour, Dot, FIGURES, Figure, Mark, Panel, Symbol, write_figure};
use clap::Args;
use std::path::{Path, PathBuf};

/// A range of positive values has a logarithmic axis if its ends have this ratio.
const LOGARITHMIC: f64 = 20.0;
/// Room beyond the extreme values, over their distance, and as a factor on a logarithmic axis.
const ROOM: [f64; 2] = [0.06, 1.2];
const COLOURS: [Colour; 6] =
    [Colour::BLUE, Colour::VERMILION, Colour::GREEN, Colour::PURPLE, Colour::ORANGE, Colour::SKY];
const SYMBOLS: [Symbol; 4] = [Symbol::Circle, Symbol::Square, Symbol::Triangle, Symbol::Diamond];

const EXAMPLES: &str = "\
Examples:
  asperity plot line.csv surface.csv --y kappa_r --out both.svg
  asperity plot curve.npz study.csv --y relative_area --out area.pdf --figure-size 85mm";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct PlotCommand {
    /// Results (.npz) of several loads or states, tables of such runs (.csv), and tables of studies (.csv)
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// The quantity to the right, by its name in tables, such as mean_pressure, or p*
    #[arg(long, value_name = "QUANTITY", default_value = "p*")]
    x: String,
    /// The quantity upwards
    #[arg(long, value_name = "QUANTITY", default_value = "kappa_r")]
    y: String,
    /// The picture (.svg, .pdf, .png)
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    #[command(flatten)]
    figure: FigureArgs,
}

impl PlotCommand {
    pub fn run(&self) -> Result<ExitStatus> {
        let style = self.figure.style(true)?;
        check_named(&self.out, &FIGURES)?;
        check_apart([&self.out], &self.files)?;
        let [x, y] = [quantity(&self.x)?, quantity(&self.y)?];
        let curves = self.files.iter().map(|path| dots(path, [x, y])).collect::<Result<Vec<_>>>()?;
        let all = || curves.iter().flatten();
        let axes = [axis(x, all().map(|dot| dot.x)), axis(y, all().map(|dot| dot.y))];
        let [across, up] = axes;
        let mut panel = Panel::new("", across, up);
        for (i, (path, dots)) in self.files.iter().zip(curves).enumerate() {
            let symbol = SYMBOLS[i % SYMBOLS.len()];
            let is_curve = dots.windows(2).all(|pair| pair[0].x < pair[1].x);
            let mark = match is_curve {
                true => Mark::Joined { symbol, filled: true },
                false => Mark::Symbol { symbol, filled: true },
            };
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            panel.add(name, COLOURS[i % COLOURS.len()], mark, dots);
        }
        write_figure(&self.out, &Figure { title: String::new(), panels: vec![panel] }, &style)?;
        wrote(&self.out);
        Ok(ExitStatus::Done)
    }
}

/// The quantity of a name, or of its symbol.
fn quantity(name: &str) -> Result<Quantity> {
    let by_symbol = || Quantity::all().find(|it| it.row().symbol == name);
    match Quantity::find(&name.replace('-', "_")).or_else(by_symbol) {
        Some(quantity) => Ok(quantity),
        None => usage(format!(
            "there is no quantity `{name}`: give the name of a column, such as reduced_pressure, relative_area, kappa_r or mean_gap"
        )),
    }
}

/// The finite pairs of two quantities in a file, in their order.
fn dots(path: &Path, quantities: [Quantity; 2]) -> Result<Vec<Dot>> {
    let is_archive = path.is_dir() || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz"));
    let [x, y] = if is_archive { of_archive(path, quantities)? } else { of_table(path, quantities)? };
    let dots: Vec<Dot> =
        x.iter().zip(&y).map(|(x, y)| Dot::at(*x, *y)).filter(|dot| is_known(dot, quantities)).collect();
    match dots.is_empty() {
        true => usage(format!(
            "{} has no numbers of {} beside {}: choose other quantities",
            path.display(),
            quantities[1].name(),
            quantities[0].name()
        )),
        false => Ok(dots),
    }
}

/// Whether both numbers are known. An area of 0, or a `kappa` of it, is that of a contact that is not resolved.
fn is_known(dot: &Dot, quantities: [Quantity; 2]) -> bool {
    let is_of_area = |it| matches!(it, Quantity::RelativeArea | Quantity::Kappa | Quantity::KappaR);
    let is_known = |(value, it): (f64, Quantity)| value.is_finite() && (value != 0.0 || !is_of_area(it));
    [dot.x, dot.y].into_iter().zip(quantities).all(is_known)
}

fn of_archive(path: &Path, quantities: [Quantity; 2]) -> Result<[Vec<f64>; 2]> {
    let archive = ArchiveReader::open(path)?;
    let missing = |it: Quantity| missing(path, it);
    let [x, y] = quantities.map(|it| archive.numbers(it.name()).map_err(anyhow::Error::from));
    Ok([x?.ok_or_else(|| missing(quantities[0]))?, y?.ok_or_else(|| missing(quantities[1]))?])
}

fn of_table(path: &Path, quantities: [Quantity; 2]) -> Result<[Vec<f64>; 2]> {
    let columns = read_columns(path)?;
    let numbers = |it: Quantity| {
        let column = columns.iter().find(|column| column.name == it.name()).ok_or_else(|| missing(path, it))?;
        Ok::<_, FileError>(column.words.iter().map(|word| word.text.parse().unwrap_or(f64::NAN)).collect())
    };
    Ok([numbers(quantities[0])?, numbers(quantities[1])?])
}

fn missing(path: &Path, quantity: Quantity) -> FileError {
    let reason = format!("it has no {}", quantity.name());
    FileError::Format { path: path.into(), what: "result or table", reason }
}

/// The axis of a quantity, which holds all values.
fn axis(quantity: Quantity, values: impl Iterator<Item = f64>) -> Axis {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = values.fold(ends, |[low, high], it| [low.min(it), high.max(it)]);
    let (row, [share, factor]) = (quantity.row(), ROOM);
    let is_symbol = row.symbol.is_empty() || row.symbol == row.title;
    let name = if is_symbol { row.title.to_owned() } else { format!("{}, {}", row.title, row.symbol) };
    let name = name.replace("kappa_r", "κᵣ").replace("a_rel", "aᵣₑₗ");
    if low > 0.0 && high > LOGARITHMIC * low {
        return Axis::log(name, [low / factor, high * factor]);
    }
    let room = (share * (high - low)).max(1e-3 * high.abs()).max(f64::MIN_POSITIVE);
    Axis::linear(name, [low - room, high + room])
}
