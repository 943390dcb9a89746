//! Ranges of values with equal ratios, such as `1e-3..1e-1:13`.

/// Largest number of values of a range.
const MOST: u32 = 100_000;

/// A range of values with equal ratios: the words of its ends, and the number of values.
pub(super) struct Range<'t> {
    ends: [&'t str; 2],
    count: u32,
}

impl<'t> Range<'t> {
    /// The range in a text; none if the text is no range. What is wrong with a range is the sentence of the error.
    pub(crate) fn parse(text: &'t str) -> Option<Result<Self, String>> {
        let (first, rest) = text.split_once("..")?;
        // A third dot would become the decimal point of the last value: 1e-3...1e-1 would end at 0.01.
        if rest.starts_with('.') {
            let meant = format!("{first}..{}", rest.trim_start_matches('.'));
            return Some(Err(format!("`{text}` has more than two dots between its ends: give two, as in {meant}")));
        }
        let wrong = || format!("`{text}` is not a range: give first..last:number, such as 1e-3..1e-1:13");
        let parsed = || {
            let (last, count) = rest.rsplit_once(':').ok_or_else(wrong)?;
            let count: u32 = count.trim().parse().ok().filter(|count| *count > 1).ok_or_else(wrong)?;
            let ends = [first.trim(), last.trim()];
            if ends.contains(&"") {
                return Err(wrong());
            }
            // A number alone beside a quantity with a unit would be in the SI unit, which is seldom what is meant.
            if let Some(unit) = unit_of_one(ends) {
                return Err(format!(
                    "one end of `{text}` has a unit and the other one has none: give both with a unit, as in {}",
                    with_unit(ends, unit, count)
                ));
            }
            if count > MOST {
                return Err(format!("`{text}` has too many values: give at most {MOST}"));
            }
            Ok(Self { ends, count })
        };
        Some(parsed())
    }

    /// The values, whose ends `read` reads from their words. Ends between which there are no equal ratios give the error that `wrong` makes
    /// of a sentence.
    pub(crate) fn values<E>(
        &self,
        read: impl Fn(&str) -> Result<f64, E>,
        wrong: impl Fn(String) -> E,
    ) -> Result<Vec<f64>, E> {
        let [first, last] = [read(self.ends[0])?, read(self.ends[1])?];
        let ratio = last / first;
        if !(ratio.is_finite() && ratio > 0.0) {
            let [first, last] = self.ends;
            return Err(wrong(format!(
                "no values with equal ratios lead from {first} to {last}: give ends of one sign that are not 0, or a list of values"
            )));
        }
        let share = |i: u32| f64::from(i) / f64::from(self.count - 1);
        let inner = (1..self.count - 1).map(|i| first * ratio.powf(share(i)));
        Ok([first].into_iter().chain(inner).chain([last]).collect())
    }
}

/// Whether a quantity, as it is written, ends in a unit: it has letters, and is no number such as `1e-3` or `inf`.
pub(super) fn has_unit(word: &str) -> bool {
    word.contains(char::is_alphabetic) && word.trim().parse::<f64>().is_err()
}

/// The unit of one end of a range, if the other end is a number alone; none if both ends have a unit, or neither has.
fn unit_of_one(ends: [&str; 2]) -> Option<&str> {
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    match ends {
        [with, alone] if is_number(alone) => unit(with),
        [alone, with] if is_number(alone) => unit(with),
        _ => None,
    }
}

/// The unit behind the number of a quantity; none for a number alone, and for what does not begin with a number.
pub(super) fn unit(word: &str) -> Option<&str> {
    if !has_unit(word) {
        return None;
    }
    let mut ends_of_number = word.char_indices().rev().map(|(at, _)| at);
    let at = ends_of_number.find(|&at| word[..at].trim_end().parse::<f64>().is_ok())?;
    Some(word[at..].trim())
}

/// The range with the same unit at both of its ends.
fn with_unit(ends: [&str; 2], unit: &str, count: u32) -> String {
    let [first, last] = ends.map(|end| if has_unit(end) { end.to_owned() } else { format!("{end}{unit}") });
    format!("{first}..{last}:{count}")
}
