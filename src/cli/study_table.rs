//! The printed tables of a study: its cost, and its means.

use anyhow::Result;
use asperity::quantity::bytes_in_words;
use asperity::study::{AdhesionMeans, Campaign, LoadMeans, Plan, SeedMean, YieldMeans};
use indicatif::HumanDuration;
use std::io::Write;
use std::time::Duration;

/// Largest number of lines; the rest is in the table.
const MOST_LINES: usize = 40;

/// Writes the cost of the rows of a share, the longest first.
pub(crate) fn write_expenses(plan: &Plan, campaign: &Campaign, out: &mut impl Write) -> Result<()> {
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
        "  realisations  {} of {}, each {}",
        share.len(),
        plan.realisations(),
        match (plan.states()?, loads) {
            (Some(states), _) => format!("a history of about {states} states"),
            (None, 1) => "under one load".into(),
            (None, _) => format!("under {loads} loads one after the other"),
        }
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
    for (first, it) in groups.iter().take(MOST_LINES) {
        let (count, each, memory) = (in_group(*first), format!("{:.2e} s", it.seconds), bytes_in_words(it.bytes));
        writeln!(out, "{count:>12} {each:>10} {memory:>10}  {}: {}", 1 + first * loads, plan.words_but_seed(*first))?;
    }
    write_rest(groups.len(), "combinations of values", out)
}

/// Writes the means over the seeds under each load, for each combination of values. Only points that converged and are
/// resolved count.
pub(crate) fn write_means(plan: &Plan, rows: usize, means: &[LoadMeans], out: &mut impl Write) -> Result<()> {
    writeln!(
        out,
        "{rows} rows, means over {} seeds: with standard deviation (std), standard error (sem) and estimated error of the grid (grid), of the \
         n whose area, and whose kappa_r, are resolved",
        plan.seeds()
    )?;
    let errors = format!("{:>8} {:>8} {:>8} {:>4}", "std", "sem", "grid", "n");
    writeln!(out, "\n{:>11} {:>9} {errors} {:>8} {errors}", "p*", "area", "kappa_r")?;
    for LoadMeans { values, reduced_pressure, relative_area, kappa_r, .. } in means.iter().take(MOST_LINES) {
        let [area, area_errors] = words(relative_area, 6);
        let [kappa_r, kappa_r_errors] = words(kappa_r, 4);
        writeln!(out, "{reduced_pressure:>11.4e} {area:>9} {area_errors} {kappa_r:>8} {kappa_r_errors}  {values}")?;
    }
    write_rest(means.len(), "lines", out)
}

/// Writes the means over the seeds of a study with adhesion, for each combination of values. Only histories that were followed to their ends
/// count.
pub(crate) fn write_adhesion_means(
    plan: &Plan,
    rows: usize,
    means: &[AdhesionMeans],
    out: &mut impl Write,
) -> Result<()> {
    writeln!(
        out,
        "{rows} rows, mean and standard deviation over {} seeds, pressures and energies in units of the scene",
        plan.seeds()
    )?;
    writeln!(
        out,
        "\n{:>10} {:>9} {:>4} {:>10} {:>9} {:>4} {:>9} {:>6} {:>6}",
        "pull-off", "std", "n", "lost", "std", "n", "area", "jumps", "parted"
    )?;
    for AdhesionMeans { values, pull_off, lost_in_jumps, largest_area, jumps, separated } in
        means.iter().take(MOST_LINES)
    {
        // energies of histories that parted under the load do not count, so that their number is another one
        let [pull_offs, losses] = [pull_off.count, lost_in_jumps.count];
        let [pull_off, pull_off_std] = short_words(pull_off);
        let [lost, lost_std] = short_words(lost_in_jumps);
        let ([area, _], [jumps, _]) = (words(largest_area, 5), words(jumps, 1));
        writeln!(
            out,
            "{pull_off:>10} {pull_off_std:>9} {pull_offs:>4} {lost:>10} {lost_std:>9} {losses:>4} {area:>9} {jumps:>6} {separated:>6}  {values}"
        )?;
    }
    write_rest(means.len(), "lines", out)
}

/// Writes the means over the seeds of a study of solids that yield below their surface, for each combination of values. Only histories that converged count.
pub(crate) fn write_yield_means(plan: &Plan, rows: usize, means: &[YieldMeans], out: &mut impl Write) -> Result<()> {
    writeln!(
        out,
        "{rows} rows, mean and standard deviation over {} seeds, lengths and energies in units of the scene",
        plan.seeds()
    )?;
    writeln!(
        out,
        "\n{:>10} {:>9} {:>12} {:>9} {:>13} {:>12}",
        "imprint", "std", "plastic work", "std", "largest alpha", "largest area"
    )?;
    for YieldMeans { values, imprint_depth, plastic_work, max_plastic_strain, largest_area } in
        means.iter().take(MOST_LINES)
    {
        let [imprint, imprint_std] = short_words(imprint_depth);
        let [work, work_std] = short_words(plastic_work);
        let ([strain, _], [area, _]) = (short_words(max_plastic_strain), words(largest_area, 5));
        writeln!(out, "{imprint:>10} {imprint_std:>9} {work:>12} {work_std:>9} {strain:>13} {area:>12}  {values}")?;
    }
    write_rest(means.len(), "lines", out)
}

/// Mean and standard deviation with four and two digits.
fn short_words(mean: &SeedMean) -> [String; 2] {
    let known = |value: f64, words: String| if value.is_finite() { words } else { NO_NUMBER.into() };
    [
        known(mean.mean, format!("{:.3e}", mean.mean)),
        known(mean.standard_deviation, format!("{:.1e}", mean.standard_deviation)),
    ]
}

/// Placeholder for an unknown number.
const NO_NUMBER: &str = "-";

/// A mean with some digits, and the columns of its errors and of the number of its seeds: a grid may resolve the areas of more seeds than `kappa_r`.
fn words(mean: &SeedMean, digits: usize) -> [String; 2] {
    let word = |value: f64| if value.is_finite() { format!("{value:.digits$}") } else { NO_NUMBER.into() };
    let errors = [mean.standard_deviation, mean.standard_error, mean.grid_error].map(word);
    let [deviation, error, grid] = errors;
    [word(mean.mean), format!("{deviation:>8} {error:>8} {grid:>8} {:>4}", mean.count)]
}

fn write_rest(count: usize, what: &str, out: &mut impl Write) -> Result<()> {
    if count > MOST_LINES {
        writeln!(out, "and {} more {what}", count - MOST_LINES)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_mean_tells_the_number_of_its_own_seeds() {
        let counts = |count: usize| {
            let mean = SeedMean::from_values((0..count).map(|seed| (seed as f64, 0.5)));
            words(&mean, 3)[1].split_whitespace().map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!((counts(4).last(), counts(3).last()), (Some(&"4".to_owned()), Some(&"3".to_owned())));
        assert_eq!(counts(3)[..3], ["1.000", "0.577", "0.500"]);
    }
}
