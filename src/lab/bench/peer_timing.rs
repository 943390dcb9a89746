//! Times and certificates of this code and of others, on the same contacts.

use super::contest::Contest;
use super::peer::{Peer, PeerSolution, Python};
use crate::contact::{Certificate, Contact, Multilevel, Problem, Solver, Stop};
use crate::error::SetupError;
use crate::lab::ObserverMaker;
use crate::lab::table::{median, or_dash};
use crate::plot::{Axis, Colour, Dot, Figure, Mark, Panel, Symbol};
use rayon::ThreadPoolBuilder;
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt;
use std::num::NonZeroUsize;
use std::time::Instant;

/// The names of the columns in which a [`PeerTiming`] displays.
pub const PEER_HEAD: &str = "\
case                        points threads code                       seconds      eta    ratio";

/// The name of this code.
const THIS: &str = "asperity";

/// One contest solved by one code on a number of threads. It displays as a row, and serialises with all digits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PeerTiming {
    case: String,
    points: String,
    is_periodic: bool,
    threads: usize,
    code: String,
    /// The version of the code, if it runs.
    version: Option<String>,
    /// Median over the repeats, of the solve alone.
    seconds: Option<f64>,
    /// The certificate of its pressure.
    certificate: Option<f64>,
    /// The certificate that was asked for.
    tolerance: f64,
    /// Its seconds over those of this code.
    ratio: Option<f64>,
    /// Why the code did not solve it.
    skipped: Option<String>,
}

impl PeerTiming {
    /// Solves a contest by this code and by the others, on one thread and on all of them. Each row is given to `show` when it is known.
    ///
    /// # Errors
    /// A contact that cannot be posed.
    pub fn all(
        contest: &Contest,
        stop: &Stop,
        repeats: NonZeroUsize,
        python: &Python,
        watch: ObserverMaker,
        mut show: impl FnMut(Self),
    ) -> Result<(), SetupError> {
        let problem = contest.setup.problem()?;
        let title = format!("{} {}", contest.name, contest.points());
        let mut counts = vec![1, rayon::current_num_threads()];
        counts.dedup();
        for threads in counts {
            let row = |code: &str, version: Option<String>, solved: Result<TimedSolve, String>, ours: Option<f64>| {
                let (solved, skipped) =
                    solved.map_or_else(|reason| (None, Some(reason)), |solved| (Some(solved), None));
                let seconds = solved.as_ref().map(|solved| solved.seconds);
                Self {
                    case: contest.name.clone(),
                    points: contest.points(),
                    is_periodic: problem.surface().grid().is_periodic(),
                    threads,
                    code: code.into(),
                    version,
                    seconds,
                    certificate: solved.map(|solved| solved.certificate),
                    tolerance: stop.tolerance(),
                    ratio: seconds.zip(ours).map(|(seconds, ours)| seconds / ours),
                    skipped,
                }
            };
            let ours = TimedSolve::of_repeats(repeats, || solve(&problem, stop, threads, watch, &title));
            let seconds = ours.as_ref().ok().map(|solved| solved.seconds);
            show(row(THIS, Some(env!("CARGO_PKG_VERSION").into()), ours, seconds));
            for peer in Peer::OF_CONTACTS {
                let mut of = None;
                let solved = TimedSolve::of_repeats(repeats, || {
                    let PeerSolution { version, seconds, pressure } =
                        peer.solve(python, &problem, stop.tolerance(), threads)?;
                    of = Some(version);
                    let Certificate { eta, load_error, .. } = Certificate::new(&problem, &pressure);
                    if load_error > stop.gap_tolerance() {
                        return Err(format!("its mean pressure is wrong by {:.2} %", 100.0 * load_error));
                    }
                    Ok(TimedSolve { seconds, certificate: eta })
                });
                show(row(peer.into(), of, solved, seconds));
            }
        }
        Ok(())
    }

    /// Whether it is a contact that this program did not solve.
    pub fn is_own_failure(&self) -> bool {
        self.skipped.is_some() && self.code == THIS
    }

    /// The figure of all rows: certificates against seconds, with periodic and with free boundaries.
    pub fn figure(rows: &[Self]) -> Figure {
        let of = |is_periodic| rows.iter().filter(|row| row.is_periodic == is_periodic).collect::<Vec<_>>();
        let panels = [("periodic boundaries", of(true)), ("free boundaries", of(false))];
        let panels = panels.into_iter().filter_map(|(title, rows)| panel(title, &rows)).collect();
        Figure { title: "Rough surfaces: certificate against time".into(), panels }
    }
}

/// The panel of some rows, unless none has numbers that can be drawn.
fn panel(title: &str, rows: &[&PeerTiming]) -> Option<Panel> {
    let seconds = rows.iter().filter_map(|row| row.seconds);
    let x = Axis::log_over("seconds; filled: one thread, open: all threads", seconds)?;
    let y = Axis::log_over("certificate η", rows.iter().filter_map(|row| row.certificate))?;
    let mut panel = Panel::new(title, x, y);
    let asked = rows.first()?.tolerance;
    panel.add_curve("asked for", Colour::GREY, Mark::Dotted, |_| asked);
    let codes: BTreeSet<(&str, Option<&str>)> = rows
        .iter()
        .filter(|row| row.seconds.is_some())
        .map(|row| (row.code.as_str(), row.version.as_deref()))
        .collect();
    for (code, version) in codes {
        let (colour, symbol) = look(code);
        for filled in [true, false] {
            let of_code = rows.iter().filter(|row| row.code == code && (row.threads == 1) == filled);
            let dots = of_code.filter_map(|row| Some(Dot::at(row.seconds?, row.certificate?)));
            let name = if filled { format!("{code} {}", version.unwrap_or_default()) } else { String::new() };
            panel.add(name, colour, Mark::Symbol { symbol, filled }, dots);
        }
    }
    Some(panel)
}

impl fmt::Display for PeerTiming {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let code = format!("{} {}", self.code, self.version.as_deref().unwrap_or_default());
        write!(f, "{:<22} {:>11} {:>7} {code:<24}", self.case, self.points, self.threads)?;
        match &self.skipped {
            Some(reason) if self.code == THIS => return write!(f, " {reason}"),
            Some(reason) => return write!(f, " skipped: {reason}"),
            None => {}
        }
        let [seconds, ratio] = [self.seconds, self.ratio].map(|value| or_dash(value, |value| format!("{value:.3}")));
        write!(f, " {seconds:>9} {:>8} {ratio:>8}", or_dash(self.certificate, |eta| format!("{eta:.1e}")))?;
        let is_met = self.certificate.is_some_and(|eta| eta <= self.tolerance);
        f.write_str(if is_met { "" } else { " (!)" })
    }
}

/// The colour and the symbol of a code.
fn look(code: &str) -> (Colour, Symbol) {
    match code {
        THIS => (Colour::BLUE, Symbol::Circle),
        "tamaas" => (Colour::VERMILION, Symbol::Square),
        "contact-mechanics" => (Colour::GREEN, Symbol::Triangle),
        "aspher" => (Colour::PURPLE, Symbol::Diamond),
        _ => (Colour::ORANGE, Symbol::Diamond),
    }
}

/// Seconds, and the certificate of the pressure.
struct TimedSolve {
    seconds: f64,
    certificate: f64,
}

impl TimedSolve {
    /// The median time of several solves, and the worst of their certificates; one that is no number counts as the worst.
    fn of_repeats(repeats: NonZeroUsize, mut solve: impl FnMut() -> Result<Self, String>) -> Result<Self, String> {
        let all = (0..repeats.get()).map(|_| solve()).collect::<Result<Vec<_>, _>>()?;
        let (mut seconds, mut certificates): (Vec<f64>, Vec<f64>) =
            all.iter().map(|solved| (solved.seconds, solved.certificate)).unzip();
        seconds.sort_by(f64::total_cmp);
        certificates.sort_by(f64::total_cmp);
        Ok(Self { seconds: median(&seconds), certificate: certificates[certificates.len() - 1] })
    }
}

/// Solves a contact by this code on one thread or on all of them.
fn solve(
    problem: &Problem,
    stop: &Stop,
    threads: usize,
    watch: ObserverMaker,
    title: &str,
) -> Result<TimedSolve, String> {
    let run = || {
        let clock = Instant::now();
        let contact = Multilevel.solve(problem, stop, &mut watch(title)).and_then(Contact::converged);
        let contact = contact.map_err(|error| error.to_string())?;
        Ok(TimedSolve { seconds: clock.elapsed().as_secs_f64(), certificate: contact.certificate.eta })
    };
    if threads == rayon::current_num_threads() {
        return run();
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| error.to_string())?;
    pool.install(run)
}
