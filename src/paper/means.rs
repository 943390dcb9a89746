//! Means of solved points over realisations.

use crate::plot::Point;
use crate::study::{Line, Row, Spread};

/// A quantity of a point.
pub type Quantity = fn(&Row) -> f64;

/// Solved points, all converged.
pub struct Points(pub Vec<Row>);

impl Points {
    /// The points of the realisations of a name.
    pub fn named(&self, name: &str) -> impl Iterator<Item = &Row> {
        self.0.iter().filter(move |row| row.name == name)
    }

    /// The points on the grid of `nx` points along x.
    pub fn on(&self, nx: usize) -> impl Iterator<Item = &Row> {
        self.0.iter().filter(move |row| row.nx == nx)
    }

    /// Points along x of the grids, coarsest first.
    pub fn grids(&self) -> Vec<usize> {
        let mut grids: Vec<usize> = self.0.iter().map(|row| row.nx).collect();
        grids.sort_unstable();
        grids.dedup();
        grids
    }

    /// Points along x of the finest grid.
    pub fn finest(&self) -> usize {
        self.0.iter().map(|row| row.nx).max().unwrap_or(0)
    }

    /// `quantity` at one Hurst exponent and load, over the realisations.
    pub fn at(&self, hurst: f64, load: f64, nx: usize, quantity: Quantity) -> Spread {
        let is_it = |row: &&Row| row.hurst == Some(hurst) && row.reduced_pressure == load;
        Spread::of(self.on(nx).filter(is_it).map(quantity))
    }

    /// `quantity` averaged over the loads of each realisation, over all realisations.
    pub fn overall(&self, nx: usize, quantity: Quantity) -> Spread {
        Spread::of(self.realisations(nx).into_iter().map(|rows| Spread::of(rows.into_iter().map(quantity)).mean))
    }

    /// The points of each realisation on a grid.
    pub fn realisations(&self, nx: usize) -> Vec<Vec<&Row>> {
        let mut groups: Vec<Vec<&Row>> = Vec::new();
        for row in self.on(nx) {
            match groups.last_mut() {
                Some(group) if (group[0].hurst, group[0].seed) == (row.hurst, row.seed) => group.push(row),
                _ => groups.push(vec![row]),
            }
        }
        groups
    }

    /// One point per load, on the finest grid: the means of `x` and `y`, with the scatter of `y`.
    pub fn curve(&self, hurst: f64, loads: &[f64], [x, y]: [Quantity; 2]) -> Vec<Point> {
        let nx = self.finest();
        let point = |&load: &f64| {
            let (x, y) = (self.at(hurst, load, nx, x), self.at(hurst, load, nx, y));
            Point { x: x.mean, y: y.mean, spread: y.deviation }
        };
        loads.iter().map(point).collect()
    }

    /// The points as on a grid of `nx` points along x: quantity by quantity on the line in the grid spacing through the grids
    /// that there are. Without `nx`, of infinitely many points.
    ///
    /// What a point costs and its certificate are those of the finest grid.
    pub fn extrapolated(&self, nx: Option<usize>) -> Self {
        let spacing = nx.map_or(0.0, |nx| 1.0 / nx as f64);
        let row = |row: &Row| {
            let others: Vec<&Row> = self.0.iter().filter(|other| is_same_point(row, other)).collect();
            let value = |quantity: Quantity| {
                let points: Vec<_> = others.iter().map(|row| (1.0 / row.nx as f64, quantity(row))).collect();
                Line::through(&points).at(spacing)
            };
            Row {
                reduced_pressure_contact: value(|row| row.reduced_pressure_contact),
                relative_area: value(|row| row.relative_area),
                relative_area_corrected: value(|row| row.relative_area_corrected),
                rms_gradient_contact: value(|row| row.rms_gradient_contact),
                kappa: value(|row| row.kappa),
                kappa_corrected: value(|row| row.kappa_corrected),
                kappa_r: value(|row| row.kappa_r),
                kappa_r_corrected: value(|row| row.kappa_r_corrected),
                ..row.clone()
            }
        };
        Self(self.on(self.finest()).map(row).collect())
    }

    /// Means over the realisations of each grid, Hurst exponent and load.
    pub fn means(&self) -> Vec<Mean> {
        let mut means: Vec<Mean> = Vec::new();
        for row in &self.0 {
            let hurst = row.hurst.unwrap_or(f64::NAN);
            if !means.iter().any(|mean| mean.is_of(hurst, row)) {
                means.push(Mean::of(self, hurst, row));
            }
        }
        means
    }
}

/// Whether two points differ in their grid alone.
fn is_same_point(a: &Row, b: &Row) -> bool {
    (a.hurst, a.seed, a.reduced_pressure) == (b.hurst, b.seed, b.reduced_pressure)
}

/// Means over realisations with their standard deviations.
#[derive(serde::Serialize)]
pub struct Mean {
    nx: usize,
    hurst: f64,
    reduced_pressure: f64,
    realisations: usize,
    reduced_pressure_contact: f64,
    relative_area: f64,
    relative_area_deviation: f64,
    relative_area_corrected: f64,
    kappa: f64,
    kappa_deviation: f64,
    kappa_corrected: f64,
    kappa_corrected_deviation: f64,
    kappa_r: f64,
    kappa_r_deviation: f64,
    kappa_r_corrected: f64,
    kappa_r_corrected_deviation: f64,
}

impl Mean {
    fn is_of(&self, hurst: f64, row: &Row) -> bool {
        (self.nx, self.hurst, self.reduced_pressure) == (row.nx, hurst, row.reduced_pressure)
    }

    fn of(points: &Points, hurst: f64, row: &Row) -> Self {
        let quantities: [Quantity; 7] = [
            |row| row.reduced_pressure_contact,
            |row| row.relative_area,
            |row| row.relative_area_corrected,
            |row| row.kappa,
            |row| row.kappa_corrected,
            |row| row.kappa_r,
            |row| row.kappa_r_corrected,
        ];
        let [pressure_contact, area, area_corrected, kappa, kappa_corrected, kappa_r, kappa_r_corrected] =
            quantities.map(|quantity| points.at(hurst, row.reduced_pressure, row.nx, quantity));
        Self {
            nx: row.nx,
            hurst,
            reduced_pressure: row.reduced_pressure,
            realisations: area.count,
            reduced_pressure_contact: pressure_contact.mean,
            relative_area: area.mean,
            relative_area_deviation: area.deviation,
            relative_area_corrected: area_corrected.mean,
            kappa: kappa.mean,
            kappa_deviation: kappa.deviation,
            kappa_corrected: kappa_corrected.mean,
            kappa_corrected_deviation: kappa_corrected.deviation,
            kappa_r: kappa_r.mean,
            kappa_r_deviation: kappa_r.deviation,
            kappa_r_corrected: kappa_r_corrected.mean,
            kappa_r_corrected_deviation: kappa_r_corrected.deviation,
        }
    }
}
