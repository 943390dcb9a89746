//! Axes with ticks and numbers, drawn as strips and labelled points: the 2-D views of the viewer have none.

use super::palette::{self, colour};
use rerun::{LineStrips2D, Points2D, Radius, RecordingStream, RecordingStreamResult};

/// What an axis shows: a quantity and the unit in which its values come.
#[derive(Debug, Clone)]
pub struct Quantity {
    /// Symbol of the quantity.
    pub symbol: &'static str,
    /// Unit of the values, empty if they have none.
    pub unit: String,
}

/// An axis from `low` to `high`, whose numbers are in powers of a thousand.
#[derive(Debug, Clone)]
pub struct Axis {
    quantity: Quantity,
    low: f64,
    high: f64,
    exponent: i32,
}

/// A tick: where along the axis (0 to 1), and its number.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Place along the axis.
    pub place: f64,
    /// Number.
    pub label: String,
}

impl Axis {
    /// Ticks aimed at.
    const TICKS: f64 = 5.0;

    /// An axis over `low..high`; an empty range is widened.
    pub fn new(quantity: Quantity, low: f64, high: f64) -> Self {
        let high = if high > low { high } else { low + low.abs().max(f64::MIN_POSITIVE) };
        let exponent = engineering_exponent(low.abs().max(high.abs()), quantity.unit.is_empty());
        Self { quantity, low, high, exponent }
    }

    /// The same axis up to another end, in the same power of a thousand.
    pub fn up_to(&self, high: f64) -> Self {
        Self { high: if high > self.low { high } else { self.high }, ..self.clone() }
    }

    /// End of the axis.
    pub fn high(&self) -> f64 {
        self.high
    }

    /// Length of the axis.
    pub fn span(&self) -> f64 {
        self.high - self.low
    }

    /// Where `value` lies, from 0 to 1.
    pub fn place(&self, value: f64) -> f64 {
        (value - self.low) / self.span()
    }

    /// `value` in the unit of the numbers.
    pub fn number(&self, value: f64) -> f64 {
        value / 10f64.powi(self.exponent)
    }

    /// Symbol and unit.
    pub fn title(&self) -> String {
        let unit = scaled_unit(&self.quantity.unit, self.exponent);
        if unit.is_empty() { self.quantity.symbol.into() } else { format!("{} [{unit}]", self.quantity.symbol) }
    }

    /// The length of the axis with its unit, such as `x: 160 µm`.
    pub fn full_length(&self) -> String {
        let unit = scaled_unit(&self.quantity.unit, self.exponent);
        let number = format!("{:.3}", self.number(self.span()));
        let number = number.trim_end_matches('0').trim_end_matches('.');
        format!("{}: {number} {unit}", self.quantity.symbol).trim_end().into()
    }

    /// Ticks at 1, 2 or 5 times a power of ten.
    pub fn ticks(&self) -> Vec<Tick> {
        let step = round_step(self.span() / Self::TICKS);
        let decimals = (self.exponent - step.log10().floor() as i32).clamp(0, 9) as usize;
        let (first, last) = ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        let tick = |k: i64| {
            let value = k as f64 * step;
            Tick { place: self.place(value), label: format!("{:.decimals$}", self.number(value)) }
        };
        (first..=last).map(tick).collect()
    }
}

/// 1, 2 or 5 times a power of ten, about as large as `span`.
fn round_step(span: f64) -> f64 {
    let power = 10f64.powf(span.log10().floor());
    let rest = span / power;
    power
        * if rest < 1.5 {
            1.0
        } else if rest < 3.1 {
            2.0
        } else if rest < 7.1 {
            5.0
        } else {
            10.0
        }
}

/// The multiple of three that leaves numbers between 1 and 1000; pure numbers from 0.1 stay as they are.
fn engineering_exponent(largest: f64, pure: bool) -> i32 {
    if pure && (0.1..1000.0).contains(&largest) { 0 } else { (largest.log10() / 3.0).floor() as i32 * 3 }
}

/// The unit times a power of ten: metres take a prefix.
fn scaled_unit(unit: &str, exponent: i32) -> String {
    let prefix = match exponent {
        -15 => "f",
        -12 => "p",
        -9 => "n",
        -6 => "µ",
        -3 => "m",
        0 => "",
        3 => "k",
        _ => return format!("1e{exponent} {unit}").trim_end().into(),
    };
    if unit == "m" || exponent == 0 {
        format!("{prefix}{unit}")
    } else {
        format!("1e{exponent} {unit}").trim_end().into()
    }
}

/// A box with two axes on a canvas whose y points down; its upper left corner is the origin.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Width of the box.
    pub width: f32,
    /// Height of the box.
    pub height: f32,
    /// Height of a line of text, at the size at which the canvas usually shows.
    pub text: f32,
}

impl Frame {
    /// Margins left, right, above and below, in lines of text.
    const MARGINS: [f64; 4] = [4.2, 1.8, 2.6, 3.6];
    /// Length of a tick, in lines of text.
    const TICK: f32 = 0.3;

    /// Where `y` lies on the canvas.
    pub fn place_y(&self, y: f64) -> f32 {
        (1.0 - self.y.place(y)) as f32 * self.height
    }

    /// The part of the canvas that box, ticks and labels take: left, right, top, bottom.
    pub fn bounds(&self) -> [f64; 4] {
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let [left, right, above, below] = Self::MARGINS.map(|margin| margin * f64::from(self.text));
        [-left, width + right, -above, height + below]
    }

    /// Draws box, ticks, numbers and titles at `entity`, once and for all times.
    pub fn log(&self, recording: &RecordingStream, entity: &str) -> RecordingStreamResult<()> {
        recording.log_static(format!("{entity}/box"), &frame_strips(self.strips()))?;
        recording.log_static(format!("{entity}/labels"), &labels(self.labels()))
    }

    /// Draws the lower edge with its ticks, numbers and title at `entity`, once and for all times.
    pub fn log_floor(&self, recording: &RecordingStream, entity: &str) -> RecordingStreamResult<()> {
        let edge = vec![[0.0, self.height], [self.width, self.height]];
        let strips = std::iter::once(edge).chain(self.strips_below()).collect();
        recording.log_static(format!("{entity}/box"), &frame_strips(strips))?;
        recording.log_static(format!("{entity}/labels"), &labels(self.labels_below().collect()))
    }

    /// Words above the middle of the box.
    pub fn caption(&self, words: String) -> Points2D {
        labels(vec![([0.5 * self.width, -1.9 * self.text], words)])
    }

    fn strips(&self) -> Vec<Vec<[f32; 2]>> {
        let (w, h, t) = (self.width, self.height, Self::TICK * self.text);
        let frame = vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h], [0.0, 0.0]];
        let left =
            self.y.ticks().into_iter().map(|tick| (1.0 - tick.place) as f32 * h).map(|y| vec![[-t, y], [0.0, y]]);
        std::iter::once(frame).chain(self.strips_below()).chain(left).collect()
    }

    /// Ticks below the box.
    fn strips_below(&self) -> impl Iterator<Item = Vec<[f32; 2]>> {
        let (w, h, t) = (self.width, self.height, Self::TICK * self.text);
        self.x.ticks().into_iter().map(move |tick| tick.place as f32 * w).map(move |x| vec![[x, h], [x, h + t]])
    }

    fn labels(&self) -> Vec<([f32; 2], String)> {
        let (h, line) = (self.height, self.text);
        let left = self.y.ticks().into_iter().map(|tick| {
            let y = (1.0 - tick.place) as f32 * h;
            ([-1.7 * line, y - 0.6 * line], tick.label)
        });
        let title = ([0.0, -1.9 * line], self.y.title());
        self.labels_below().chain(left).chain([title]).collect()
    }

    /// Numbers and title below the box.
    fn labels_below(&self) -> impl Iterator<Item = ([f32; 2], String)> {
        let (w, h, line) = (self.width, self.height, self.text);
        let ticks = self.x.ticks().into_iter().map(move |tick| ([tick.place as f32 * w, h + 0.4 * line], tick.label));
        ticks.chain([([0.5 * w, h + 1.9 * line], self.x.title())])
    }
}

/// Thin strips in the colour of axes.
pub fn frame_strips(strips: Vec<Vec<[f32; 2]>>) -> LineStrips2D {
    LineStrips2D::new(strips)
        .with_colors([colour(palette::FAINT)])
        .with_radii([Radius::new_ui_points(0.6)])
        .with_draw_order(20.0)
}

/// Words at points that do not show themselves.
pub fn labels(labels: Vec<([f32; 2], String)>) -> Points2D {
    let (positions, words): (Vec<_>, Vec<_>) = labels.into_iter().unzip();
    Points2D::new(positions)
        .with_labels(words)
        .with_show_labels(true)
        .with_colors([colour(palette::INK)])
        .with_radii([Radius::new_ui_points(0.0)])
        .with_draw_order(40.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(low: f64, high: f64, unit: &str) -> Axis {
        Axis::new(Quantity { symbol: "x", unit: unit.into() }, low, high)
    }

    fn numbers(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(numbers(&axis(0.0, 160e-6, "m")), ["0", "50", "100", "150"]);
        assert_eq!(numbers(&axis(-0.3, 0.7, "")), ["-0.2", "0.0", "0.2", "0.4", "0.6"]);
        assert_eq!(numbers(&axis(0.0, 2e-3, "")), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        let ticks = axis(1.3e7, 8.1e7, "").ticks();
        assert!(ticks.len() >= 3 && ticks.iter().all(|t| (0.0..=1.0).contains(&t.place)));
    }

    #[test]
    fn titles_carry_unit_and_power() {
        assert_eq!(axis(0.0, 160e-6, "m").title(), "x [µm]");
        assert_eq!(axis(0.0, 2e-3, "").title(), "x [1e-3]");
        assert_eq!(axis(0.0, 2e7, "mm").title(), "x [1e6 mm]");
        assert_eq!(axis(0.0, 5.0, "").title(), "x");
        assert_eq!(axis(2.0, 2.0, "R").ticks().len(), 5);
    }
}
