//! A number or statement of the paper beside what is found here.

use super::item::Item;
use crate::study::Spread;
use serde::{Deserialize, Serialize};

/// The numbers and statements of the paper, one by one.
const PRINTED: &str = include_str!("../../assets/paper.csv");

/// A number or a statement of the paper.
#[derive(Deserialize)]
struct Printed {
    #[serde(rename = "part")]
    item: Item,
    key: String,
    quantity: String,
    /// The number; none for statements.
    value: Option<f64>,
    /// Half of the last digit that is printed.
    reading: Option<f64>,
    /// The statement, or the number as it is printed.
    printed: String,
    place: String,
}

/// A number or statement of the paper, what is found here, and whether both agree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The table or figure.
    #[serde(rename = "part")]
    pub item: Item,
    /// The quantity, and what kind of number is found: raw, corrected, another size.
    pub quantity: String,
    /// The number or statement as it is printed.
    pub paper: String,
    /// The number or statement that is found.
    pub here: String,
    /// Standard deviation of the number over realisations.
    pub scatter: String,
    /// `agrees`, `differs by ...`, `holds` or `does not hold`.
    pub verdict: String,
    /// Why it differs.
    pub why: String,
    /// Where it stands in the paper.
    pub place: String,
}

impl Verdict {
    /// A number with its scatter; `how` says what kind it is.
    pub(super) fn number(key: &str, how: &str, here: Spread) -> Self {
        let printed = Printed::of(key);
        let verdict = printed.verdict(here);
        let scatter = if here.count > 1 { format!("{:.3}", here.deviation) } else { String::new() };
        Self { scatter, verdict, ..Self::on(printed, how, format!("{:.3}", here.mean)) }
    }

    /// A number without scatter.
    pub(super) fn exact(key: &str, how: &str, here: f64) -> Self {
        Self::number(key, how, Spread { mean: here, deviation: 0.0, count: 1 })
    }

    /// A statement: what is found instead of it, and whether it holds.
    pub(super) fn statement(key: &str, here: String, holds: bool) -> Self {
        let verdict = if holds { "holds" } else { "does not hold" }.into();
        Self { verdict, ..Self::on(Printed::of(key), "", here) }
    }

    fn on(Printed { item, quantity, printed, place, .. }: Printed, how: &str, here: String) -> Self {
        let quantity = if how.is_empty() { quantity } else { format!("{quantity}, {how}") };
        let [scatter, verdict, why] = [const { String::new() }; 3];
        Self { item, quantity, paper: printed, here, scatter, verdict, why, place }
    }

    /// The verdict with the reason why it differs from the paper, if it does.
    pub(super) fn because(self, why: &str) -> Self {
        if self.is_good() { self } else { Self { why: why.into(), ..self } }
    }

    /// Whether the number agrees, or the statement holds.
    pub fn is_good(&self) -> bool {
        ["agrees", "holds"].contains(&self.verdict.as_str())
    }
}

impl Printed {
    /// The number or statement that goes by `key`.
    fn of(key: &str) -> Self {
        let mut rows = csv::Reader::from_reader(PRINTED.as_bytes()).into_deserialize::<Self>().flatten();
        rows.find(|row| row.key == key).unwrap_or_else(|| panic!("assets/paper.csv holds no {key}"))
    }

    /// Whether a number agrees with the paper's: within its last digit and two standard errors of the mean.
    fn verdict(&self, here: Spread) -> String {
        let Some(value) = self.value else { return String::new() };
        let off = here.mean - value;
        let is_close = off.abs() <= self.reading.unwrap_or(0.0) + 2.0 * here.error();
        if is_close { "agrees".into() } else { format!("differs by {:+.1} %", 100.0 * off / value) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_allow_for_the_printed_digits_and_the_error_of_the_mean() {
        let verdict = |mean, deviation| {
            let here = Spread { mean, deviation, count: 16 };
            let Verdict { verdict, why, .. } = Verdict::number("fig2.kappa_r", "", here).because("of this");
            [verdict, why]
        };
        assert_eq!(verdict(1.7549, 0.0), ["agrees", ""]);
        assert_eq!(verdict(1.76, 0.0), ["differs by +0.6 %", "of this"]);
        assert_eq!(verdict(1.76, 0.02), ["agrees", ""]);
        assert_eq!(verdict(1.70, 0.02), ["differs by -2.9 %", "of this"]);
    }
}
