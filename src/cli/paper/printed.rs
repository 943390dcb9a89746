//! What the paper says, with the place where it says it.

use anyhow::Result;
use serde::Deserialize;

/// The numbers of the paper, one by one.
const VALUES: &str = include_str!("../../../assets/paper.csv");

/// A number or a statement of the paper.
#[derive(Clone, Deserialize)]
pub struct Printed {
    /// What it goes by here.
    pub key: String,
    /// What it is, in words.
    pub quantity: String,
    /// The number; none for statements.
    pub value: Option<f64>,
    /// Half of the last digit that is printed.
    pub reading: Option<f64>,
    /// The statement, or the number as it is printed.
    pub printed: String,
    /// Where it stands.
    pub place: String,
}

impl Printed {
    /// The number or statement that goes by `key`.
    pub fn of(key: &str) -> Result<Self> {
        let rows = csv::Reader::from_reader(VALUES.as_bytes()).into_deserialize();
        let mut rows = rows.collect::<Result<Vec<Self>, _>>()?.into_iter();
        rows.find(|row| row.key == key).ok_or_else(|| anyhow::anyhow!("assets/paper.csv holds no {key}"))
    }
}
