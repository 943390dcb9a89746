//! Means of solved points over realisations.

use crate::contact::Observables;
use crate::plot::Dot;
use crate::study::{Line, Point, Spread};

/// A quantity of a point.
pub type Quantity = fn(&Observables) -> f64;

/// Solved points, all converged.
pub struct Points(pub Vec<Point>);

impl Points {
    /// The points of the realisations of a name.
    pub fn named(&self, name: &str) -> impl Iterator<Item = &Point> {
        self.0.iter().filter(move |row| row.name == name)
    }

    /// A quantity of the points of the realisations of a name.
    pub fn values(&self, name: &str, quantity: Quantity) -> impl Iterator<Item = f64> {
        self.named(name).map(move |row| quantity(&row.observables))
    }

    /// One dot per point of the realisations of a name.
    pub fn dots(&self, name: &str, x: Quantity, y: Quantity) -> impl Iterator<Item = Dot> {
        self.values(name, x).zip(self.values(name, y)).map(|(x, y)| Dot::at(x, y))
    }

    /// The points on the grid of `nx` points along x.
    pub fn on(&self, nx: usize) -> impl Iterator<Item = &Point> {
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
        let is_it = |row: &&Point| row.hurst == Some(hurst) && row.observables.reduced_pressure == load;
        Spread::of(self.on(nx).filter(is_it).map(|row| quantity(&row.observables)))
    }

    /// `quantity` averaged over the loads of each realisation, over all realisations.
    pub fn overall(&self, nx: usize, quantity: Quantity) -> Spread {
        let mean = |rows: Vec<&Point>| Spread::of(rows.iter().map(|row| quantity(&row.observables))).mean;
        Spread::of(self.realisations(nx).into_iter().map(mean))
    }

    /// The points of each realisation on a grid.
    pub fn realisations(&self, nx: usize) -> Vec<Vec<&Point>> {
        let mut groups: Vec<Vec<&Point>> = Vec::new();
        for row in self.on(nx) {
            match groups.last_mut() {
                Some(group) if (group[0].hurst, group[0].seed) == (row.hurst, row.seed) => group.push(row),
                _ => groups.push(vec![row]),
            }
        }
        groups
    }

    /// One dot per load, on the finest grid: the means of `x` and `y`, with the scatter of `y`.
    pub fn curve(&self, hurst: f64, loads: &[f64], [x, y]: [Quantity; 2]) -> Vec<Dot> {
        let nx = self.finest();
        let dot = |&load: &f64| {
            let (x, y) = (self.at(hurst, load, nx, x), self.at(hurst, load, nx, y));
            Dot { x: x.mean, y: y.mean, spread: y.deviation }
        };
        loads.iter().map(dot).collect()
    }

    /// The mean of a quantity under each load, on the finest grid.
    pub fn along(&self, hurst: f64, loads: &[f64], quantity: Quantity) -> Vec<f64> {
        loads.iter().map(|&load| self.at(hurst, load, self.finest(), quantity).mean).collect()
    }

    /// The points as on a grid of `nx` points along x: quantity by quantity on the line in the grid spacing through the grids
    /// that there are. Without `nx`, of infinitely many points.
    ///
    /// Cost and certificate of a point are those of the finest grid.
    pub fn extrapolated(&self, nx: Option<usize>) -> Self {
        let spacing = nx.map_or(0.0, |nx| 1.0 / nx as f64);
        let row = |row: &Point| {
            let others: Vec<&Point> = self.0.iter().filter(|other| is_same_point(row, other)).collect();
            let value = |quantity: Quantity| {
                let points: Vec<_> =
                    others.iter().map(|row| (1.0 / row.nx as f64, quantity(&row.observables))).collect();
                Line::through(&points).at(spacing)
            };
            let observables = Observables {
                reduced_pressure_contact: value(|it| it.reduced_pressure_contact),
                relative_area: value(|it| it.relative_area),
                relative_area_corrected: value(|it| it.relative_area_corrected),
                rms_gradient_contact: value(|it| it.rms_gradient_contact),
                kappa: value(|it| it.kappa),
                kappa_corrected: value(|it| it.kappa_corrected),
                kappa_r: value(|it| it.kappa_r),
                kappa_r_corrected: value(|it| it.kappa_r_corrected),
                ..row.observables
            };
            Point { observables, ..row.clone() }
        };
        Self(self.on(self.finest()).map(row).collect())
    }

    /// Means over the realisations of each grid, Hurst exponent and load.
    pub fn means(&self) -> Vec<Mean> {
        let mut means: Vec<Mean> = Vec::new();
        for Point { nx, hurst, observables, .. } in &self.0 {
            let place = (*nx, hurst.unwrap_or(f64::NAN), observables.reduced_pressure);
            if !means.iter().any(|mean| (mean.nx, mean.hurst, mean.reduced_pressure) == place) {
                means.push(Mean::of(self, place));
            }
        }
        means
    }
}

/// Whether two points differ in their grid alone.
fn is_same_point(a: &Point, b: &Point) -> bool {
    (a.hurst, a.seed, a.observables.reduced_pressure) == (b.hurst, b.seed, b.observables.reduced_pressure)
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
    fn of(points: &Points, (nx, hurst, reduced_pressure): (usize, f64, f64)) -> Self {
        let of = |quantity| points.at(hurst, reduced_pressure, nx, quantity);
        let [area, kappa, kappa_corrected] =
            [of(|it| it.relative_area), of(|it| it.kappa), of(|it| it.kappa_corrected)];
        let [kappa_r, kappa_r_corrected] = [of(|it| it.kappa_r), of(|it| it.kappa_r_corrected)];
        Self {
            nx,
            hurst,
            reduced_pressure,
            realisations: area.count,
            reduced_pressure_contact: of(|it| it.reduced_pressure_contact).mean,
            relative_area: area.mean,
            relative_area_deviation: area.deviation,
            relative_area_corrected: of(|it| it.relative_area_corrected).mean,
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
