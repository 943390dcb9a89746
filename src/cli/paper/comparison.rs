//! The paper's numbers beside those found here.

use super::printed::Printed;
use anyhow::Result;
use asperity::study::Spread;
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// A number or statement of the paper and what is found here.
pub struct Finding {
    key: &'static str,
    /// What is found, where it differs from what the paper gives: raw, corrected, another size.
    how: String,
    found: Found,
    /// Why it may differ from the paper.
    why: &'static str,
}

/// What is found.
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
}

/// The table of all findings.
#[derive(Default)]
pub struct Comparison(Vec<Row>);

/// A row of the table.
#[derive(Serialize)]
struct Row {
    part: &'static str,
    quantity: String,
    paper: String,
    here: String,
    scatter: String,
    verdict: String,
    /// Why it differs.
    why: &'static str,
    place: String,
}

impl Row {
    fn of(part: &'static str, Finding { key, how, found, why }: Finding) -> Result<Self> {
        let Printed { quantity, value, reading, printed, place, .. } = Printed::of(key)?;
        let quantity = if how.is_empty() { quantity } else { format!("{quantity}, {how}") };
        let (here, scatter, verdict) = match found {
            Found::Number(spread) => {
                let scatter = if spread.count > 1 { format!("{:.3}", spread.deviation) } else { String::new() };
                (format!("{:.3}", spread.mean), scatter, verdict(value, reading, spread))
            }
            Found::Words(words, holds) => (words, String::new(), if holds { "holds" } else { "does not hold" }.into()),
        };
        let why = if ["agrees", "holds"].contains(&verdict.as_str()) { "" } else { why };
        Ok(Self { part, quantity, paper: printed, here, scatter, verdict, why, place })
    }
}

/// Whether a number agrees with the paper's: within its last digit and two standard errors of the mean.
fn verdict(value: Option<f64>, reading: Option<f64>, here: Spread) -> String {
    let Some(value) = value else { return String::new() };
    let off = here.mean - value;
    let is_close = off.abs() <= reading.unwrap_or(0.0) + 2.0 * here.error();
    if is_close { "agrees".into() } else { format!("differs by {:+.1} %", 100.0 * off / value) }
}

impl Comparison {
    /// Adds what a part found.
    pub fn add(&mut self, part: &'static str, findings: Vec<Finding>) -> Result<()> {
        for finding in findings {
            self.0.push(Row::of(part, finding)?);
        }
        Ok(())
    }

    /// Writes the table as CSV.
    pub fn write_csv(&self, path: &Path) -> Result<()> {
        Ok(super::write_csv(path, &self.0)?)
    }

    /// Writes the table for reading.
    pub fn write_text(&self, out: &mut impl Write) -> Result<()> {
        let width = |of: fn(&Row) -> &str| self.0.iter().map(|row| of(row).chars().count()).max().unwrap_or(0);
        let [quantity, paper, here] = [width(|row| &row.quantity), width(|row| &row.paper), width(|row| &row.here)];
        let [quantity, paper, here] = [quantity.max(8), paper.max(5), here.max(4)];
        writeln!(
            out,
            "\n{:7} {:quantity$}  {:paper$}  {:here$}  {:7}  verdict",
            "", "quantity", "paper", "here", "scatter"
        )?;
        let mut last = "";
        for row in &self.0 {
            let part = if row.part == last { "" } else { row.part };
            last = row.part;
            writeln!(
                out,
                "{part:7} {:quantity$}  {:paper$}  {:here$}  {:7}  {}",
                row.quantity, row.paper, row.here, row.scatter, row.verdict
            )?;
        }
        self.write_reasons(out)
    }

    /// Writes why numbers differ, each reason once.
    fn write_reasons(&self, out: &mut impl Write) -> Result<()> {
        let mut told: Vec<&str> = Vec::new();
        for Row { part, why, .. } in self.0.iter().filter(|row| !row.why.is_empty()) {
            if !told.contains(why) {
                told.push(why);
                let lead = if told.len() == 1 { "\nWhere it differs\n" } else { "" };
                writeln!(out, "{lead}{part:7} {why}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_allow_for_the_printed_digits_and_the_error_of_the_mean() {
        let verdict = |mean, deviation| verdict(Some(1.75), Some(0.005), Spread { mean, deviation, count: 16 });
        assert_eq!(verdict(1.7549, 0.0), "agrees");
        assert_eq!(verdict(1.76, 0.0), "differs by +0.6 %");
        assert_eq!(verdict(1.76, 0.02), "agrees");
        assert_eq!(verdict(1.70, 0.02), "differs by -2.9 %");
    }
}
