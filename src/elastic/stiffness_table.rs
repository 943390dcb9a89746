//! A solid that is given by its stiffness.

use super::ElasticSolid;
use crate::error::SolidError;
use std::sync::Arc;

/// Rows of the table from which a value between two of them is interpolated.
const NEAREST: usize = 4;

/// A solid given by the stiffness of its waves: rows of a wavenumber `q` and the stiffness `k(q) = p_q / u_q`.
///
/// At a row the stiffness is that of the row. Between two rows `ln k` is the polynomial of third order in `ln q` through the
/// four nearest rows, of lower order if there are fewer rows. For the smooth `k` of a layer with 100 rows per decade its relative error is at most 4e-8.
///
/// The contact modulus is that of the half-space with the same stiffness at the last row, `E* = 2 k / q`. Solvers need all
/// waves of a grid: see [`ElasticSolid::known_waves`]. The boundary is periodic.
///
/// ```
/// use asperity::contact::{Load, Multilevel, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop, elastic::{ElasticSolid, StiffnessTable}};
/// // a half-space of modulus 2 on springs of stiffness 5
/// let rows = (0..400).map(|i| 10f64.powf(0.01 * i as f64)).map(|q| [q, q + 5.0]);
/// let solid = StiffnessTable::new(rows, Some(5.0))?;
/// assert!((0.5 * solid.contact_modulus() * 10.0 / solid.factor(10.0) - 15.0).abs() < 1e-7);
/// let surface = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(512, 1.0)?)?;
/// let problem = Problem::new(surface, solid, Load::MeanPressure(0.01))?;
/// assert!(Multilevel.solve(&problem, &Stop::default(), &mut ())?.is_converged());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StiffnessTable {
    rows: Arc<[[f64; 2]]>,
    uniform: Option<f64>,
}

impl StiffnessTable {
    /// The solid with `rows` of a wavenumber, 1/length, and a stiffness, a pressure per length, and with the stiffness `uniform` under a
    /// uniform pressure; none if a uniform pressure displaces the solid without limit.
    ///
    /// # Errors
    /// [`SolidError::StiffnessTable`] unless there are two rows or more with ascending wavenumbers, and all values are positive
    /// and finite.
    pub fn new(rows: impl IntoIterator<Item = [f64; 2]>, uniform: Option<f64>) -> Result<Self, SolidError> {
        let rows: Arc<[[f64; 2]]> = rows.into_iter().collect();
        let wrong = |reason: String| Err(SolidError::StiffnessTable { reason });
        if rows.len() < 2 {
            return wrong(format!("it has {} rows: give two or more", rows.len()));
        }
        if let Some([q, k]) = rows.iter().find(|row| !row.iter().all(|it| it.is_finite() && *it > 0.0)) {
            return wrong(format!("the stiffness at the wavenumber {q:?} is {k:?}: give positive, finite values"));
        }
        if let Some(pair) = rows.windows(2).find(|pair| pair[0][0] >= pair[1][0]) {
            return wrong(format!("the wavenumber {:?} follows {:?}: sort them", pair[1][0], pair[0][0]));
        }
        match uniform {
            Some(k) if !(k.is_finite() && k > 0.0) => {
                wrong(format!("the stiffness under a uniform pressure is {k:?}: give a positive, finite value"))
            }
            _ => Ok(Self { rows, uniform }),
        }
    }

    /// The rows of a wavenumber and a stiffness.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// The stiffness under a uniform pressure, a pressure per length.
    pub fn uniform(&self) -> Option<f64> {
        self.uniform
    }

    /// The stiffness of a wave, a pressure per length.
    pub fn stiffness(&self, q: f64) -> f64 {
        let after = self.rows.partition_point(|row| row[0] < q);
        if let Some([_, k]) = self.rows.get(after).filter(|row| row[0] == q) {
            return *k;
        }
        let count = NEAREST.min(self.rows.len());
        let first = after.saturating_sub(count / 2).min(self.rows.len() - count);
        let near = || self.rows[first..first + count].iter().map(|row| row.map(f64::ln));
        let weight = |[x, _]: [f64; 2]| -> f64 {
            near().filter(|[other, _]| *other != x).map(|[other, _]| (q.ln() - other) / (x - other)).product()
        };
        near().map(|row| weight(row) * row[1]).sum::<f64>().exp()
    }
}

impl ElasticSolid for StiffnessTable {
    fn contact_modulus(&self) -> f64 {
        let [q, k] = self.rows[self.rows.len() - 1];
        2.0 * k / q
    }

    fn factor(&self, q: f64) -> f64 {
        0.5 * self.contact_modulus() * q / self.stiffness(q)
    }

    fn uniform_compliance(&self) -> Option<f64> {
        self.uniform.map(f64::recip)
    }

    fn known_waves(&self) -> Option<[f64; 2]> {
        Some([self.rows[0][0], self.rows[self.rows.len() - 1][0]])
    }

    fn description(&self) -> String {
        let [[first, _], [last, _]] = [self.rows[0], self.rows[self.rows.len() - 1]];
        format!("solid with a given stiffness for wavenumbers from {first:.4e} to {last:.4e}")
    }
}

impl From<StiffnessTable> for Arc<dyn ElasticSolid> {
    fn from(table: StiffnessTable) -> Self {
        Arc::new(table)
    }
}
