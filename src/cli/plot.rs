//! `asperity plot`: one picture of the numbers in several results and tables.

use super::exit_status::{ExitStatus, usage};
use super::figure_args::FigureArgs;
use super::file_curve::{Abscissa, FileCurve, curves_of, key};
use super::file_map::{FileMaps, MapField};
use super::wrote::wrote;
use anyhow::Result;
use asperity::contact::Quantity;
use asperity::files::{check_apart, check_named};
use asperity::plot::{Axis, Colour, FIGURES, Figure, Mark, Panel, Symbol, write_figure};
use clap::Args;
use std::path::PathBuf;

/// A range of positive values has a logarithmic axis if its ends have this ratio.
const LOGARITHMIC_RANGE_RATIO: f64 = 20.0;
/// Room beyond the extreme values, over their distance, and as a factor on a logarithmic axis.
const AXIS_MARGINS: [f64; 2] = [0.06, 1.2];

const EXAMPLES: &str = "\
Examples:
  asperity plot line.csv surface.csv --y kappa_r --out both.svg
  asperity plot curve.npz study.csv --y relative_area --out area.pdf --figure-size 85mm
  asperity plot study.csv --x hurst --y kappa_r --out hurst.pdf
  asperity plot rough.npz smooth.npz --map pressure --out both.png";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct PlotCommand {
    /// Results (.npz) of several loads or states, tables of such runs (.csv), and tables of studies (.csv). Bars are the error of
    /// the grid, and of means over the seeds of a study the standard deviation plus that error
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// The quantity to the right, by its name in tables, such as mean_pressure, or p*; of studies also a value from their lists, such as hurst
    #[arg(long, value_name = "QUANTITY", default_value = "p*")]
    x: String,
    /// The quantity upwards
    #[arg(long, value_name = "QUANTITY", default_value = "kappa_r")]
    y: String,
    /// Maps of this field instead, in the same colours side by side: results (.npz) of one load on a surface each, or of a surface that yields
    #[arg(long, value_name = "FIELD", value_enum, conflicts_with_all = ["x", "y"])]
    map: Option<MapField>,
    /// The picture (.svg, .pdf, .png)
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    #[command(flatten)]
    figure: FigureArgs,
}

impl PlotCommand {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let style = self.figure.style(true)?;
        check_named(&self.out, &FIGURES)?;
        check_apart([&self.out], &self.files)?;
        let panels = match self.map {
            Some(field) => FileMaps::read(&self.files, field)?.panels(field)?,
            None => vec![self.curves()?],
        };
        write_figure(&self.out, &Figure { title: String::new(), panels }, &style)?;
        wrote(&self.out);
        Ok(ExitStatus::Done)
    }

    /// The panel of the curves in all files.
    fn curves(&self) -> Result<Panel> {
        let x = find(&self.x).map_or(Abscissa::Listed(&self.x), Abscissa::Quantity);
        let y = quantity(&self.y)?;
        let mut curves: Vec<FileCurve> = Vec::new();
        for path in &self.files {
            curves.extend(curves_of(path, x, y, self.files.len() > 1)?);
        }
        let dots = || curves.iter().flat_map(|it| &it.dots);
        let bars = || dots().flat_map(|dot| [dot.y - dot.spread, dot.y, dot.y + dot.spread]);
        let name = match x {
            Abscissa::Quantity(quantity) => title(quantity),
            Abscissa::Listed(name) => key(name).replace(['-', '_'], " "),
        };
        let mut panel = Panel::new("", axis(name, dots().map(|dot| dot.x)), axis(title(y), bars()));
        for (i, FileCurve { name, dots }) in curves.into_iter().enumerate() {
            let symbol = Symbol::of_curve(i);
            let is_curve = dots.windows(2).all(|pair| pair[0].x < pair[1].x);
            let mark = match is_curve {
                true => Mark::Joined { symbol, filled: true },
                false => Mark::Symbol { symbol, filled: true },
            };
            panel.add(name, Colour::of_curve(i), mark, dots);
        }
        Ok(panel)
    }
}

/// The quantity of a name, or of its symbol, if there is one.
fn find(name: &str) -> Option<Quantity> {
    let by_symbol = || Quantity::all().find(|it| it.row().symbol == name);
    Quantity::find(&name.replace('-', "_")).or_else(by_symbol)
}

/// The quantity of a name, or of its symbol.
fn quantity(name: &str) -> Result<Quantity> {
    match find(name) {
        Some(quantity) => Ok(quantity),
        None => usage(format!(
            "there is no quantity `{name}`: give the name of a column, such as reduced_pressure, relative_area, kappa_r or mean_gap"
        )),
    }
}

/// The name of a quantity on its axis.
fn title(quantity: Quantity) -> String {
    let row = quantity.row();
    let is_symbol = row.symbol.is_empty() || row.symbol == row.title;
    let name = if is_symbol { row.title.to_owned() } else { format!("{}, {}", row.title, row.symbol) };
    name.replace("kappa_r", "κᵣ").replace("a_rel", "aᵣₑₗ")
}

/// The axis of some name, which holds all values.
fn axis(name: String, values: impl Iterator<Item = f64>) -> Axis {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = values.fold(ends, |[low, high], it| [low.min(it), high.max(it)]);
    let [share, factor] = AXIS_MARGINS;
    if low > 0.0 && high > LOGARITHMIC_RANGE_RATIO * low {
        return Axis::log(name, [low / factor, high * factor]);
    }
    let room = (share * (high - low)).max(1e-3 * high.abs()).max(f64::MIN_POSITIVE);
    Axis::linear(name, [low - room, high + room])
}
