//! The printed tables of a study: its cost, and its means.

use anyhow::Result;
use asperity::contact::Quantity;
use asperity::quantity::bytes_in_words;
use asperity::study::{Campaign, Plan, Point, Spread};
use indicatif::HumanDuration;
use std::io::Write;
use std::time::Duration;

/// Largest number of lines; the rest is in the table.
const LINES: usize = 40;

/// Writes the cost of the rows of a share, the longest first.
pub fn write_expenses(plan: &Plan, campaign: &Campaign, out: &mut impl Write) -> Result<()> {
    let (share, mut groups) = (plan.share(campaign.shard)?, plan.expenses()?);
    let (loads, seeds) = (plan.loads().len(), plan.seeds());
    let before = |end: usize| share.partition_point(|it| *it < end);
    let in_group = |first: usize| before(first + seeds) - before(first);
    let memory = campaign.memory.unwrap_or(f64::INFINITY);
    let seconds: f64 = groups.iter().map(|(first, it)| it.seconds * in_group(*first) as f64).sum();
    let longest = groups.iter().map(|(_, it)| it.seconds).fold(0.0, f64::max);
    let most = groups.iter().map(|(_, it)| it.bytes).fold(0.0, f64::max);
    let at_a_time = (memory / most).floor().clamp(1.0, campaign.workers as f64);
    writeln!(out, "Estimate for share {} of the study; nothing was solved.", campaign.shard)?;
    writeln!(out, "  rows          {} of {}", share.len() * loads, plan.rows())?;
    writeln!(
        out,
        "  realisations  {} of {}, each under {}",
        share.len(),
        plan.realisations(),
        if loads == 1 { "one load".to_owned() } else { format!("{loads} loads one after the other") }
    )?;
    writeln!(out, "  work          about {} of one core", in_words(seconds))?;
    writeln!(
        out,
        "  time          about {}, {at_a_time} at the same time",
        in_words((seconds / at_a_time).max(longest))
    )?;
    writeln!(out, "  memory        about {}", bytes_in_words(at_a_time * most))?;
    if most > memory {
        writeln!(
            out,
            "  too large     a realisation needs {}, but the limit is {}",
            bytes_in_words(most),
            bytes_in_words(memory)
        )?;
    }
    writeln!(out, "\n{:>12} {:>10} {:>10}  first row", "realisations", "each", "memory")?;
    groups.sort_by(|(_, a), (_, b)| b.seconds.total_cmp(&a.seconds));
    groups.retain(|(first, _)| in_group(*first) > 0);
    for (first, it) in groups.iter().take(LINES) {
        let (count, each, memory) = (in_group(*first), format!("{:.2e} s", it.seconds), bytes_in_words(it.bytes));
        writeln!(out, "{count:>12} {each:>10} {memory:>10}  {}: {}", 1 + first * loads, plan.words_but_seed(*first))?;
    }
    write_rest(groups.len(), "combinations of values", out)
}

/// Writes the means over the seeds under each load, for each combination of values. Only points that converged and are
/// resolved count.
pub fn write_means(plan: &Plan, points: &[Point], out: &mut impl Write) -> Result<()> {
    if points.iter().any(Point::has_adhesion) {
        return write_adhesion_means(plan, points, out);
    }
    let (loads, seeds) = (plan.loads().len(), plan.seeds());
    writeln!(out, "{} rows, mean and standard deviation over {seeds} seeds, resolved", points.len())?;
    writeln!(out, "\n{:>11} {:>9} {:>9} {:>8} {:>8}", "p*", "area", "std", "kappa_r", "std")?;
    let groups = points.chunks(loads * seeds).enumerate();
    let rows = groups.flat_map(|(group, points)| (0..loads).map(move |load| (group, load, points)));
    for (group, load, points) in rows.take(LINES) {
        let found = || points.iter().skip(load).step_by(loads);
        let spread = |of: fn(&Point) -> Option<f64>| Spread::from_values(found().filter_map(of));
        let pressure = spread(|it| Some(it.observables.reduced_pressure)).mean;
        let [area, area_std] = words(spread(Point::relative_area), 6);
        let [kappa, kappa_std] = words(spread(Point::kappa_r), 4);
        let choice = plan.words_but_seed(group * seeds);
        writeln!(out, "{pressure:>11.4e} {area:>9} {area_std:>9} {kappa:>8} {kappa_std:>8}  {choice}")?;
    }
    write_rest(plan.rows() / seeds, "lines", out)
}

/// Writes the means over the seeds of a study with adhesion, for each combination of values. Only histories that were followed to their ends
/// count.
fn write_adhesion_means(plan: &Plan, points: &[Point], out: &mut impl Write) -> Result<()> {
    let seeds = plan.seeds();
    writeln!(
        out,
        "{} rows, mean and standard deviation over {seeds} seeds, pressures and energies in units of the scene",
        points.len()
    )?;
    writeln!(
        out,
        "\n{:>10} {:>9} {:>10} {:>9} {:>9} {:>6} {:>6}",
        "pull-off", "std", "lost", "std", "area", "jumps", "parted"
    )?;
    for (group, points) in points.chunks(seeds).enumerate().take(LINES) {
        let spread = |of: fn(&Point) -> Option<f64>| {
            Spread::from_values(points.iter().filter(|it| it.is_converged()).filter_map(of))
        };
        let [pull_off, pull_off_std] = short_words(spread(|it| it.pull_off()));
        let [lost, lost_std] = short_words(spread(|it| it.lost()));
        let [area, _] = words(spread(|it| it.get(Quantity::LargestArea)), 5);
        let [jumps, _] = words(spread(|it| it.get(Quantity::Jumps)), 1);
        let parted = points.iter().filter(|it| it.get(Quantity::Separated) == Some(1.0)).count();
        let choice = plan.words_but_seed(group * seeds);
        writeln!(
            out,
            "{pull_off:>10} {pull_off_std:>9} {lost:>10} {lost_std:>9} {area:>9} {jumps:>6} {parted:>6}  {choice}"
        )?;
    }
    write_rest(plan.realisations() / seeds, "lines", out)
}

/// Mean and standard deviation with four and two digits.
fn short_words(spread: Spread) -> [String; 2] {
    let mean = if spread.count > 0 { format!("{:.3e}", spread.mean) } else { NONE.into() };
    [mean, if spread.count > 1 { format!("{:.1e}", spread.deviation) } else { NONE.into() }]
}

/// Placeholder for an unknown number.
const NONE: &str = "-";

/// Mean and standard deviation with some digits; the mean needs one value, the deviation two.
fn words(spread: Spread, digits: usize) -> [String; 2] {
    let word = |value: f64, least: usize| if spread.count >= least { format!("{value:.digits$}") } else { NONE.into() };
    [word(spread.mean, 1), word(spread.deviation, 2)]
}

fn write_rest(count: usize, what: &str, out: &mut impl Write) -> Result<()> {
    if count > LINES {
        writeln!(out, "and {} more {what}", count - LINES)?;
    }
    Ok(())
}

/// Seconds in words.
fn in_words(seconds: f64) -> String {
    match Duration::try_from_secs_f64(seconds) {
        Ok(duration) if seconds >= 1.0 => HumanDuration(duration).to_string(),
        Ok(_) => format!("{seconds:.1e} seconds"),
        Err(_) => format!("{seconds:.1e} seconds"),
    }
}
