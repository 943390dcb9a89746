//! A run: points solved, figures drawn, numbers compared.

use super::comparison::Comparison;
use super::fig5::Both;
use super::item::Item;
use super::limits::limits;
use super::means::Points;
use super::persson::{self, Seen};
use super::plan::Paper;
#[cfg(feature = "record")]
use super::recording;
use super::reproduction::Reproduction;
use super::{beyond, fig1, fig2, fig3, fig4, gw, hurst, nayak, table1};
use crate::error::StudyError;
use crate::files::write_csv;
use crate::plot::{write_png, write_svg};
use crate::study::Point;
use std::collections::BTreeSet;
use std::time::Instant;

/// An event of a run.
pub enum Event<'a> {
    /// The points of an item come next.
    Begin {
        /// The item.
        item: Item,
        /// Nodes of all its points together, a measure of the work.
        nodes: u64,
    },
    /// A point is solved.
    Solved(&'a Point),
    /// The points of an item are there.
    End {
        /// The item.
        item: Item,
        /// Points that were solved now, and were not in its table.
        new: usize,
        /// All its points.
        points: usize,
        /// Seconds that it took.
        seconds: f64,
    },
}

/// A function that takes events, which come from all threads that solve.
pub type EventHandler<'a> = &'a (dyn Fn(Event<'_>) + Sync);

impl Paper {
    /// Solves, draws and compares some items, and returns the verdicts on them. `comparison.csv` keeps the verdicts of earlier
    /// runs on other items.
    ///
    /// # Errors
    /// Before anything is solved, for a folder that cannot be written into or holds another study, and for surfaces and loads
    /// that cannot be or do not fit in memory. Later for files that cannot be written.
    pub fn run(&self, items: &[Item], watch: EventHandler<'_>) -> Result<Comparison, StudyError> {
        self.check(items)?;
        self.prepare(items)?;
        let path = self.file("comparison.csv");
        let mut comparison = Comparison::read(&path)?;
        for &item in items {
            let reproduction = self.reproduce(item, watch)?;
            self.draw(item, &reproduction)?;
            comparison.replace(item, reproduction.verdicts);
            write_csv(&path, &comparison.verdicts)?;
        }
        comparison.verdicts.retain(|verdict| items.contains(&verdict.item));
        Ok(comparison)
    }

    /// Makes one item: solves what its tables do not hold yet, and writes all its tables.
    fn reproduce(&self, item: Item, watch: EventHandler<'_>) -> Result<Reproduction, StudyError> {
        let points = |source| self.points(source, watch);
        let file = |name: &str| self.file(&format!("{name}.csv"));
        let Self { lines, surfaces, .. } = self;
        Ok(match item {
            Item::Table1 => table1::reproduce(&points(item)?),
            Item::Fig1 => fig1::reproduce(&points(item)?),
            Item::Fig2 => {
                let points = points(item)?;
                write_csv(&file("fig2.means"), points.means())?;
                fig2::reproduce(lines, &points)
            }
            Item::Fig3 => {
                let points = points(Item::Fig2)?;
                let fits = fig3::fits(lines, &points);
                write_csv(&file("fig3"), fits.iter().flatten())?;
                fig3::reproduce(lines, &points, &fits)
            }
            Item::Fig4 => {
                let points = points(item)?;
                write_csv(&file("fig4.means"), points.means())?;
                write_csv(&file("fig4.limits"), limits(&points, surfaces.paper_side()))?;
                fig4::reproduce(surfaces, &points)
            }
            Item::Fig5 => {
                let both = Both::new(surfaces, [points(Item::Fig2)?, points(Item::Fig4)?]);
                let ratios = both.ratios();
                write_csv(&file("fig5"), &ratios)?;
                both.reproduce(&ratios)
            }
            Item::Gw => {
                let separations = gw::separations();
                write_csv(&file("gw"), &separations)?;
                gw::reproduce()
            }
            Item::Beyond => beyond::reproduce(&points(item)?),
            Item::Hurst => {
                let points = points(item)?;
                write_csv(&file("hurst.means"), points.means())?;
                write_csv(&file("hurst.limits"), limits(&points, self.fine_lines.paper_line()))?;
                hurst::reproduce(&self.fine_lines, &points)
            }
            Item::Persson => {
                let seen = self.contacts(item, watch)?;
                write_csv(&file("persson"), persson::rows(&seen))?;
                write_csv(&file("persson.curves"), persson::curves(&seen))?;
                persson::reproduce(&seen)
            }
            Item::Nayak => {
                let spectra = nayak::spectra([&self.broad_lines, &self.broad_surfaces], &points(item)?)?;
                write_csv(&file("nayak.limits"), nayak::rows(&spectra))?;
                write_csv(&file("nayak.trends"), nayak::trends(&spectra))?;
                nayak::reproduce(&spectra)
            }
        })
    }

    /// The contacts of an item that keeps no points, solved now, as far as they are compared.
    fn contacts(&self, item: Item, watch: EventHandler<'_>) -> Result<Vec<Vec<Seen>>, StudyError> {
        let (sweep, clock) = (self.sweep(item)?, Instant::now());
        watch(Event::Begin { item, nodes: sweep.nodes()? });
        let seen = sweep.map(&|point, contact| {
            watch(Event::Solved(point));
            Seen::new(point, contact)
        })?;
        let points = sweep.points();
        watch(Event::End { item, new: points, points, seconds: clock.elapsed().as_secs_f64() });
        Ok(seen)
    }

    /// All points of some items. Those without a contact, see [`Point::has_contact`], are left out of averages and figures.
    ///
    /// # Errors
    /// The errors of [`crate::study::Table::read`].
    pub fn all_points(&self, items: &[Item]) -> Result<Vec<Point>, StudyError> {
        let sources: BTreeSet<Item> = items.iter().flat_map(|item| item.sources()).copied().collect();
        let tables = sources.into_iter().map(|source| self.table(source).read());
        Ok(tables.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
    }

    /// The points of an item, solved now or before, without those that have no contact on their grid.
    fn points(&self, item: Item, watch: EventHandler<'_>) -> Result<Points, StudyError> {
        let (sweep, table, clock) = (self.sweep(item)?, self.table(item), Instant::now());
        let new = sweep.points() - sweep.points_in(&table)?;
        watch(Event::Begin { item, nodes: sweep.nodes()? });
        let points = sweep.run(&table, &|point| watch(Event::Solved(point)))?;
        watch(Event::End { item, new, points: points.len(), seconds: clock.elapsed().as_secs_f64() });
        Ok(Points(points.into_iter().filter(Point::has_contact).collect()))
    }

    /// Writes the figure of an item, if it is one, and its recording.
    fn draw(&self, item: Item, reproduction: &Reproduction) -> Result<(), StudyError> {
        let Some((figure, _)) = &reproduction.figure else { return Ok(()) };
        let path = |ending: &str| self.file(&format!("{}.{ending}", item.name()));
        write_svg(&path("svg"), figure)?;
        write_png(&path("png"), figure)?;
        #[cfg(feature = "record")]
        if let Some((_, ramp)) = reproduction.figure.as_ref().filter(|_| self.is_recorded) {
            let contacts = self.stopping(item, ramp.contacts.clone())?;
            recording::record(&path("rrd"), figure, ramp, &contacts)?;
        }
        Ok(())
    }
}
