//! Axes: the places of values along them, and their ticks.

/// Spacing of values along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisScale {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long; values are positive.
    Log,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the quantity, with its unit.
    pub name: String,
    /// Spacing of the values.
    pub scale: AxisScale,
    /// Values at the start and the end.
    pub range: [f64; 2],
}

/// Steps on a linear axis, at most.
const LINEAR_TICKS: f64 = 6.0;
/// Powers of ten with a label, at most.
const MOST_POWERS: f64 = 12.0;
/// Below this many powers of ten, 2 and 5 have labels too.
const FEW_POWERS: f64 = 2.0;
/// Powers of ten up to which values are written in full.
const PLAIN: std::ops::RangeInclusive<i32> = -3..=4;
/// Share of a range by which rounding may put a tick outside.
const ROUNDING: f64 = 1e-9;

impl Axis {
    /// An axis with equal differences.
    pub fn linear(name: impl Into<String>, range: [f64; 2]) -> Self {
        Self { name: name.into(), scale: AxisScale::Linear, range }
    }

    /// A logarithmic axis; both ends of `range` must be positive.
    pub fn log(name: impl Into<String>, range: [f64; 2]) -> Self {
        Self { name: name.into(), scale: AxisScale::Log, range }
    }

    /// A logarithmic axis over the decades around those of the values that it can show; none if there are no such values.
    pub fn log_over(name: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let logs = values.into_iter().map(f64::log10).filter(|log| log.is_finite());
        let [least, most] = logs.map(|log| [log, log]).reduce(|[a, b], [least, most]| [a.min(least), b.max(most)])?;
        Some(Self::log(name, [10f64.powf(least.floor()), 10f64.powf((most + 1e-9).ceil())]))
    }

    /// The place of `value` along the axis: 0 at its start, 1 at its end, not finite for a value that has no place.
    pub fn place(&self, value: f64) -> f64 {
        let [start, end, at] = [self.range[0], self.range[1], value].map(|value| match self.scale {
            AxisScale::Linear => value,
            AxisScale::Log => value.max(0.0).ln(),
        });
        (at - start) / (end - start)
    }

    /// The value at a `place`.
    pub(crate) fn value(&self, place: f64) -> f64 {
        let between = |[start, end]: [f64; 2]| start + place * (end - start);
        match self.scale {
            AxisScale::Linear => between(self.range),
            AxisScale::Log => 10f64.powf(between(self.range.map(f64::log10))),
        }
    }

    /// The ticks that have a label, each with it, in ascending order; none on a range that is empty or not finite.
    ///
    /// A logarithmic axis has powers of ten, `10⁻⁵`, below two decades also `2·10⁻⁵` and `5·10⁻⁵`, and numbers such as `0.02` where none is very
    /// small or large; a linear one has steps of 1, 2 or 5 times a power of ten.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let decades = match self.scale {
            _ if !self.is_drawable() => return Vec::new(),
            AxisScale::Linear => return self.linear_ticks(),
            AxisScale::Log => self.decades(),
        };
        let digits: &[u8] = if decades < FEW_POWERS { &[1, 2, 5] } else { &[1] };
        let ticks = self.powers((decades / MOST_POWERS).ceil() as usize, digits);
        if ticks.len() < 2 {
            return self.linear_ticks();
        }
        let is_plain = decades < FEW_POWERS && ticks.iter().all(|(_, _, exponent)| PLAIN.contains(exponent));
        let label = |(value, digit, exponent): (f64, u8, i32)| match is_plain {
            true => (value, format!("{value:.*}", -exponent.min(0) as usize)),
            false => (value, log_label(digit, exponent)),
        };
        ticks.into_iter().map(label).collect()
    }

    /// The short ticks of a logarithmic axis, at some of which there is a labelled one, too.
    pub fn minor_ticks(&self) -> Vec<f64> {
        if self.scale == AxisScale::Linear || !self.is_drawable() {
            return Vec::new();
        }
        let digits: &[u8] = if self.decades() > MOST_POWERS { &[1] } else { &[1, 2, 3, 4, 5, 6, 7, 8, 9] };
        self.powers(1, digits).into_iter().map(|(value, ..)| value).collect()
    }

    /// Whether it can have these limits.
    pub(super) fn holds_limits(&self, [low, _]: [f64; 2]) -> bool {
        self.scale == AxisScale::Linear || low > 0.0
    }

    fn is_drawable(&self) -> bool {
        let [start, end] = self.range.map(|end| self.place(end));
        start == 0.0 && end == 1.0 && self.range.iter().all(|end| end.is_finite())
    }

    fn ends(&self) -> [f64; 2] {
        let [a, b] = self.range;
        [a.min(b), a.max(b)]
    }

    fn decades(&self) -> f64 {
        let [low, high] = self.ends().map(f64::log10);
        high - low
    }

    fn holds(&self, value: f64) -> bool {
        (-ROUNDING..=1.0 + ROUNDING).contains(&self.place(value))
    }

    /// Digits times every `stride`-th power of ten: the value, the digit and the exponent.
    fn powers(&self, stride: usize, digits: &[u8]) -> Vec<(f64, u8, i32)> {
        let [low, high] = self.ends().map(|end| end.log10().floor() as i32);
        let stride = stride.max(1) as i32;
        (low..=high + 1)
            .filter(|exponent| exponent % stride == 0)
            .flat_map(|exponent| digits.iter().map(move |&digit| (times_ten(digit, exponent), digit, exponent)))
            .filter(|(value, ..)| self.holds(*value))
            .collect()
    }

    fn linear_ticks(&self) -> Vec<(f64, String)> {
        let [low, high] = self.ends();
        let wanted = (high - low) / LINEAR_TICKS;
        let exponent = wanted.log10().floor() as i32;
        let steps = [1, 2, 5].map(|digit| (times_ten(digit, exponent), exponent));
        let larger = (times_ten(1, exponent + 1), exponent + 1);
        let (step, exponent) = steps.into_iter().find(|(step, _)| *step >= wanted).unwrap_or(larger);
        if !step.is_normal() {
            return Vec::new();
        }
        let places = [low / step - ROUNDING, high / step + ROUNDING];
        (places[0].ceil() as i64..=places[1].floor() as i64)
            .map(|i| (i as f64 * step, linear_label(i as f64 * step, low.abs().max(high.abs()), exponent)))
            .collect()
    }
}

/// The name of the largest unit that is not larger than a value, and its size; none of unknown units.
pub fn unit(is_known: bool, units: &[(&'static str, f64)], value: f64) -> (&'static str, f64) {
    let fits = |unit: &&(&str, f64)| value.abs() >= unit.1;
    if is_known { *units.iter().find(fits).unwrap_or(&units[units.len() - 1]) } else { ("", 1.0) }
}

/// The name of an axis with its unit, if there is one.
pub fn label(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name} / {unit}") }
}

fn times_ten(digit: u8, exponent: i32) -> f64 {
    let power = 10f64.powi(exponent.abs());
    if exponent < 0 { f64::from(digit) / power } else { f64::from(digit) * power }
}

fn log_label(digit: u8, exponent: i32) -> String {
    match digit {
        1 => power_of_ten(exponent),
        _ => format!("{digit}·{}", power_of_ten(exponent)),
    }
}

/// A value on an axis up to `largest` whose step has its first digit at `exponent`.
fn linear_label(value: f64, largest: f64, exponent: i32) -> String {
    let lead = largest.log10().floor() as i32;
    let label = match lead {
        _ if value == 0.0 => "0".into(),
        _ if PLAIN.contains(&lead) => format!("{value:.*}", -exponent.min(0) as usize),
        _ => format!("{:.*}·{}", (lead - exponent).max(0) as usize, value / times_ten(1, lead), power_of_ten(lead)),
    };
    label.replace('-', "−")
}

fn power_of_ten(exponent: i32) -> String {
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| SUPERSCRIPTS[digit as usize]);
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}
