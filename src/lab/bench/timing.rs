//! Time and work of a method in a contest.

use super::contest::Contest;
use super::group::Group;
use crate::contact::{Observables, Status, Stop};
use crate::error::SetupError;
use crate::lab::ObserverMaker;
use crate::lab::table::{median, or_dash, points};
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};
use crate::setup::{Method, Setup};
use serde::Serialize;
use std::fmt;
use std::num::NonZeroUsize;
use std::time::Instant;

/// The names of the columns in which a [`Timing`] displays, 120 wide.
pub const HEAD: &str = "\
case                points solver         steps transforms  solve s make s     eta   meas kappa_r   MiB  ratio status";

/// One contest solved by one method; displays as a row, and serialises with all digits.
#[derive(Serialize)]
pub struct Timing {
    group: Group,
    case: String,
    ny: usize,
    nx: usize,
    solver: String,
    /// How the solver stopped.
    pub status: Status,
    iterations: usize,
    transforms: u64,
    /// Median over the repeats.
    solve_seconds: f64,
    make_seconds: f64,
    /// Of all observables of the contact, its edges resolved.
    measure_seconds: f64,
    certificate: f64,
    relative_area: f64,
    kappa_r: f64,
    /// Peak resident memory while the surface was generated and solved, if the system reports it.
    peak_mib: Option<f64>,
    /// Seconds in the solver over those of the first method, if there are several.
    ratio: Option<f64>,
}

impl Timing {
    /// Solves a contest by each method when its timing is requested; memory is freed in between. With several methods
    /// the first is what the others are held against.
    ///
    /// # Errors
    /// Each timing, for a contact that a method cannot take on.
    pub fn all<'a>(
        contest: &'a Contest,
        methods: &'a [Method],
        stop: Stop,
        repeats: NonZeroUsize,
        watch: ObserverMaker,
    ) -> impl Iterator<Item = Result<Self, SetupError>> + 'a {
        let mut first = None;
        methods.iter().map(move |&solver| {
            let setup = Setup { solver, stop, ..contest.setup.clone() };
            let (timing, peak_mib) = peak_of(|| Self::measure(contest, &setup, repeats, watch));
            let timing = Self { peak_mib, ..timing? };
            let first = *first.get_or_insert(timing.solve_seconds);
            Ok(Self { ratio: (methods.len() > 1).then(|| timing.solve_seconds / first), ..timing })
        })
    }

    /// The figure of all rows: seconds against relative contact area, with periodic and with free boundaries.
    pub fn figure(rows: &[Self]) -> Figure {
        let panel = || {
            let x = Axis::log_over("relative contact area", rows.iter().map(|row| row.relative_area))?;
            let y = Axis::log_over("seconds in the solver", rows.iter().map(|row| row.solve_seconds))?;
            let mut panel = Panel::new("", x, y);
            let kinds = [("periodic", Colour::BLUE, Symbol::Circle), ("free", Colour::VERMILION, Symbol::Square)];
            for (boundary, colour, symbol) in kinds {
                let rows = rows.iter().filter(|row| row.case.ends_with(" free") == (boundary == "free"));
                let dots = rows.map(|row| Dot::at(row.relative_area, row.solve_seconds));
                panel.add(boundary, colour, Mark::Symbol { symbol, filled: true }, dots);
            }
            Some(panel)
        };
        Figure { title: "Rough surfaces: time against contact".into(), panels: panel().into_iter().collect() }
    }

    /// Makes and solves a contact.
    fn measure(
        contest: &Contest,
        setup: &Setup,
        repeats: NonZeroUsize,
        watch: ObserverMaker,
    ) -> Result<Self, SetupError> {
        let clock = Instant::now();
        let problem = setup.problem()?;
        let make_seconds = clock.elapsed().as_secs_f64();
        let title = format!("{} {}", contest.name, contest.points());
        let mut seconds = Vec::new();
        let contact = loop {
            let contact = setup.solver.solver().solve(&problem, &setup.stop, &mut watch(&title))?;
            seconds.push(contact.work.seconds);
            if seconds.len() == repeats.get() {
                break contact;
            }
        };
        seconds.sort_by(f64::total_cmp);
        let clock = Instant::now();
        let measured = Observables::new(&contact);
        let measure_seconds = clock.elapsed().as_secs_f64();
        let [ny, nx] = problem.surface().grid().shape();
        Ok(Self {
            group: contest.group,
            case: contest.name.clone(),
            ny,
            nx,
            iterations: contact.work.iterations,
            transforms: contact.work.transforms,
            solve_seconds: median(&seconds),
            make_seconds,
            measure_seconds,
            certificate: contact.certificate.eta,
            relative_area: measured.relative_area,
            kappa_r: measured.kappa_r,
            peak_mib: None,
            ratio: None,
            status: contact.status,
            solver: contact.solver,
        })
    }
}

impl fmt::Display for Timing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = 100.0 * self.measure_seconds / self.solve_seconds;
        write!(
            f,
            "{:<14} {:>11} {:<13} {:>6} {:>10} {:>8.3} {:>6.3} {:>7.1e} {:>4.*} % {:>7.4} {:>5} {:>6} {}",
            self.case,
            points([self.ny, self.nx]),
            self.solver,
            self.iterations,
            self.transforms,
            self.solve_seconds,
            self.make_seconds,
            self.certificate,
            usize::from(share < 99.95),
            share,
            self.kappa_r,
            or_dash(self.peak_mib, |mib| format!("{mib:.0}")),
            or_dash(self.ratio, |ratio| format!("{ratio:.2}")),
            self.status
        )
    }
}

/// Runs `run`, and returns its peak resident memory in MiB, if the system reports it: the high-water mark of the whole
/// process (`VmHWM`), set back to what is resident at the start. What the allocator keeps of earlier runs counts.
#[cfg(target_os = "linux")]
fn peak_of<T>(run: impl FnOnce() -> T) -> (T, Option<f64>) {
    use procfs::process::{ClearRefs, Process};
    let process = Process::myself().and_then(|process| process.clear_refs(ClearRefs::PeakRSS).map(|()| process));
    let value = run();
    let kib = process.and_then(|process| process.status()).ok().and_then(|status| status.vmhwm);
    (value, kib.map(|kib| kib as f64 / 1024.0))
}

#[cfg(not(target_os = "linux"))]
fn peak_of<T>(run: impl FnOnce() -> T) -> (T, Option<f64>) {
    (run(), None)
}
