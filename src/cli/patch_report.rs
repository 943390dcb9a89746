//! Contact patches for reading: states, patches, sizes, and what happened.

use super::units::Units;
use asperity::contact::{NumberedPatch, PatchEvent, PatchEventKind, PatchHistory, PatchState};
use std::io::{self, Write};

/// The most patches, events and branches that are printed.
const MOST_LINES: usize = 20;

/// The patches of some states, in words.
pub(crate) struct PatchReport<'a> {
    pub patches: &'a PatchHistory,
    pub units: Units,
    pub is_line: bool,
}

impl PatchReport<'_> {
    /// Writes all of it.
    pub(crate) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let states = &self.patches.states;
        if states.len() > 1 {
            self.write_states(out)?;
        }
        if let Some(last) = states.last() {
            self.write_patches(last, out)?;
            write_sizes(last, out)?;
        }
        if states.len() > 1 {
            write_events(&self.patches.events, out)?;
            self.write_mergers(out)?;
        }
        Ok(())
    }

    /// One row for each state.
    fn write_states(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(
            out,
            "\n{:>6} {:>12} {:>12} {:>8} {:>6} {:>7} {:>6} {:>6}  carries most",
            "state", "p*", "pressure", "patches", "born", "merged", "split", "died"
        )?;
        let mut events = self.patches.events.as_slice();
        for it in &self.patches.states {
            let (now, later) = events.split_at(events.partition_point(|event| event.state <= it.state));
            events = later;
            let [born, merged, split, died] =
                [PatchEventKind::Born, PatchEventKind::Merged, PatchEventKind::Split, PatchEventKind::Died]
                    .map(|kind| now.iter().filter(|event| event.event == kind).count());
            let (pressure, patches) = (self.units.pressure(it.mean_pressure), it.patches.len());
            let most = it.strongest().map_or("-".into(), |most| {
                format!("patch {}: {:.1} % of the load", most.number, 1e2 * most.its.load / it.load())
            });
            let p = it.reduced_pressure;
            writeln!(
                out,
                "{:>6} {p:>12.4e} {pressure:>12} {patches:>8} {born:>6} {merged:>7} {split:>6} {died:>6}  {most}",
                it.state
            )?;
        }
        Ok(())
    }

    /// The largest patches of a state.
    fn write_patches(&self, state: &PatchState, out: &mut impl Write) -> io::Result<()> {
        let [size, place] = if self.is_line { ["length", "x"] } else { ["area", "x, y"] };
        let count = state.patches.len();
        writeln!(
            out,
            "\nThe {} in state {}, the largest first, areas and kappa_r by counting nodes:",
            counted(count, "patch", "patches"),
            state.state
        )?;
        writeln!(out, "{:>8} {:>9} {size:>16} {:>10} {:>9}  centre {place}", "patch", "nodes", "load", "kappa_r")?;
        let load = state.load();
        for NumberedPatch { number, its } in state.patches.iter().take(MOST_LINES) {
            let area = if self.is_line { self.units.length(its.area) } else { self.units.area(its.area) };
            let [y, x] = its.centre.map(|it| self.units.length(it));
            let centre = if self.is_line { x } else { format!("{x}, {y}") };
            let (share, kappa_r) = (1e2 * its.load / load, its.kappa_r);
            writeln!(out, "{number:>8} {:>9} {area:>16} {share:>8.2} % {kappa_r:>9.4}  {centre}", its.nodes)?;
        }
        write_rest(count, "patches", out)
    }

    /// The trees of the patches that merged into those of the last state.
    fn write_mergers(&self, out: &mut impl Write) -> io::Result<()> {
        let Some(last) = self.patches.states.last() else { return Ok(()) };
        let mut lines = Vec::new();
        for patch in last.patches.iter().filter(|it| self.patches.merged_into(it.number).next().is_some()) {
            lines.push(format!("  {}", patch.number));
            self.branches(patch.number, 2, &mut lines);
        }
        if lines.is_empty() {
            return Ok(());
        }
        writeln!(out, "\nWhat the patches of the last state have taken in:")?;
        lines.iter().take(MOST_LINES).try_for_each(|line| writeln!(out, "{line}"))?;
        write_rest(lines.len(), "lines", out)
    }

    /// The patches that merged into one, and those that merged into them before.
    fn branches(&self, patch: usize, depth: usize, lines: &mut Vec<String>) {
        for (merged, state) in self.patches.merged_into(patch) {
            lines.push(format!("{}{merged} in state {state}", "  ".repeat(depth)));
            self.branches(merged, depth + 1, lines);
        }
    }
}

/// The distribution of sizes in a state.
fn write_sizes(state: &PatchState, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "\nSizes in state {}:", state.state)?;
    writeln!(out, "{:>19} {:>8} {:>10} {:>10}", "nodes", "patches", "area", "load")?;
    state.sizes().iter().try_for_each(|it| {
        let nodes = format!("{} to {}", it.nodes, 2 * it.nodes - 1);
        let [area, load] = [it.area_share, it.load_share].map(|share| 1e2 * share);
        writeln!(out, "{nodes:>19} {:>8} {area:>8.2} % {load:>8.2} %", it.patches)
    })
}

/// What happened, state by state.
fn write_events(events: &[PatchEvent], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "\nWhat happened: {}", counted(events.len(), "event", "events"))?;
    events.iter().take(MOST_LINES).try_for_each(|it| {
        let PatchEvent { state, patch, .. } = it;
        let what = match (it.event, it.other) {
            (PatchEventKind::Merged, Some(other)) => format!("merged into patch {other}"),
            (PatchEventKind::Split, Some(other)) => format!("split from patch {other}"),
            (event, _) => <&str>::from(event).to_owned(),
        };
        writeln!(out, "  state {state:>4}: patch {patch} {what}")
    })?;
    write_rest(events.len(), "events", out)
}

/// How many were left out.
fn write_rest(count: usize, name: &str, out: &mut impl Write) -> io::Result<()> {
    match count.saturating_sub(MOST_LINES) {
        0 => Ok(()),
        rest => writeln!(out, "  and {rest} more {name} (--out, --json)"),
    }
}

fn counted(count: usize, one: &str, several: &str) -> String {
    if count == 1 { format!("{count} {one}") } else { format!("{count} {several}") }
}
