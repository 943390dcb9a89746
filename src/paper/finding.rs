//! A number or statement of the paper beside what is found here.

use crate::study::Spread;
use serde::{Deserialize, Serialize};

/// The numbers and statements of the paper, one by one.
const PRINTED: &str = include_str!("../../assets/paper.csv");

/// A number or a statement of the paper.
#[derive(Clone, Deserialize)]
struct Printed {
    key: String,
    /// Its name, in words.
    quantity: String,
    /// The number; none for statements.
    value: Option<f64>,
    /// Half of the last digit that is printed.
    reading: Option<f64>,
    /// The statement, or the number as it is printed.
    printed: String,
    /// Where it stands.
    place: String,
}

impl Printed {
    /// The number or statement that goes by `key`.
    fn of(key: &str) -> Self {
        let mut rows = csv::Reader::from_reader(PRINTED.as_bytes()).into_deserialize();
        let is_it = |row: &csv::Result<Self>| row.as_ref().is_ok_and(|row| row.key == key);
        rows.find(is_it).and_then(Result::ok).unwrap_or_else(|| panic!("assets/paper.csv holds no {key}"))
    }
}

/// A number or statement of the paper and what is found here.
pub struct Finding {
    key: &'static str,
    /// The kind of number, where it differs from what the paper gives: raw, corrected, another size.
    how: String,
    found: Found,
    /// Why it may differ from the paper.
    why: &'static str,
}

/// A finding itself.
enum Found {
    Number(Spread),
    /// In words, and whether the statement holds.
    Words(String, bool),
}

impl Finding {
    /// A number with its scatter; `how` says what kind it is.
    pub fn number(key: &'static str, how: impl Into<String>, here: Spread) -> Self {
        Self { key, how: how.into(), found: Found::Number(here), why: "" }
    }

    /// A number without scatter.
    pub fn exact(key: &'static str, how: impl Into<String>, here: f64) -> Self {
        Self::number(key, how, Spread { mean: here, deviation: 0.0, count: 1 })
    }

    /// A statement: what is found instead of it, and whether it holds.
    pub fn statement(key: &'static str, here: impl Into<String>, holds: bool) -> Self {
        Self { key, how: String::new(), found: Found::Words(here.into(), holds), why: "" }
    }

    /// Says why it may differ from the paper; read only if it does.
    pub fn because(self, why: &'static str) -> Self {
        Self { why, ..self }
    }

    /// The finding as a row of the table of all, under the name of its item.
    pub(super) fn verdict(self, item: &str) -> Verdict {
        let Self { key, how, found, why } = self;
        let Printed { quantity, value, reading, printed, place, .. } = Printed::of(key);
        let quantity = if how.is_empty() { quantity } else { format!("{quantity}, {how}") };
        let (here, scatter, verdict) = match found {
            Found::Number(spread) => {
                let scatter = if spread.count > 1 { format!("{:.3}", spread.deviation) } else { String::new() };
                (format!("{:.3}", spread.mean), scatter, compared(value, reading, spread))
            }
            Found::Words(words, holds) => (words, String::new(), if holds { "holds" } else { "does not hold" }.into()),
        };
        let why = if ["agrees", "holds"].contains(&verdict.as_str()) { "" } else { why };
        Verdict { item: item.into(), quantity, paper: printed, here, scatter, verdict, why: why.into(), place }
    }
}

/// A number or statement of the paper, what is found here, and whether both agree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The table or figure.
    #[serde(rename = "part")]
    pub item: String,
    /// The quantity, and what kind of number is found.
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

/// Whether a number agrees with the paper's: within its last digit and two standard errors of the mean.
fn compared(value: Option<f64>, reading: Option<f64>, here: Spread) -> String {
    let Some(value) = value else { return String::new() };
    let off = here.mean - value;
    let is_close = off.abs() <= reading.unwrap_or(0.0) + 2.0 * here.error();
    if is_close { "agrees".into() } else { format!("differs by {:+.1} %", 100.0 * off / value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_allow_for_the_printed_digits_and_the_error_of_the_mean() {
        let verdict = |mean, deviation| compared(Some(1.75), Some(0.005), Spread { mean, deviation, count: 16 });
        assert_eq!(verdict(1.7549, 0.0), "agrees");
        assert_eq!(verdict(1.76, 0.0), "differs by +0.6 %");
        assert_eq!(verdict(1.76, 0.02), "agrees");
        assert_eq!(verdict(1.70, 0.02), "differs by -2.9 %");
    }
}
