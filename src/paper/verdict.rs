//! A number or statement of the paper beside what is found here.

use super::item::Item;
use crate::study::Estimate;
use serde::{Deserialize, Serialize};

/// The numbers and statements of the paper, one by one.
const PRINTED: &str = include_str!("../../assets/paper.csv");

/// Standard errors within which two numbers agree, and beyond which a difference is one.
const CLOSE: f64 = 2.0;

/// The largest change, in per cent, of a number that is *constant*, or *independent* of something. The paper's means over ten profiles have a standard
/// error of 0.35 % in `kappa_r`, so that the difference of two of them has 0.5 %, and it could not have seen less than 1 %.
pub(super) const CONSTANT: f64 = 1.0;

/// A number or a statement of the paper.
#[derive(Deserialize)]
struct Printed {
    #[serde(rename = "part")]
    item: Item,
    key: String,
    quantity: String,
    /// The number; none for statements.
    value: Option<f64>,
    /// Half of the last digit that is printed.
    reading: Option<f64>,
    /// The statement, or the number as it is printed.
    printed: String,
    /// Realisations of each Hurst exponent that the number is a mean over.
    realisations: Option<f64>,
    /// What the number or statement follows from, if it is not independent.
    follows: String,
    place: String,
}

/// The answer to a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
pub(super) enum StatementVerdict {
    /// It is true, whatever its errors hide.
    #[strum(serialize = "holds")]
    Holds,
    /// It is wrong, whatever its errors hide.
    #[strum(serialize = "does not hold")]
    DoesNotHold,
    /// Its errors hide whether it is true.
    #[strum(serialize = "undecided")]
    Undecided,
    /// A single realisation, whose error is not known.
    #[strum(serialize = "no error")]
    NoError,
}

impl StatementVerdict {
    /// The answer to the statement that a number is positive: the distance of what was found from the limit that the statement sets.
    ///
    /// A statement is true or wrong only if the whole interval of what the number may be lies on one side of the limit. That a change is less than
    /// two standard errors does *not* show that there is none: -10 ± 5 % may be nothing, or 20 %. So a statement that something is constant is held
    /// against a limit as well, see [`CONSTANT`], and both answers have to be earned.
    ///
    /// The error of the grid is added to the two standard errors, not squared with them: it has the same sign in all realisations, and no number of them makes
    /// it smaller.
    pub(crate) fn is_positive(distance: Estimate) -> Self {
        let Estimate { mean, error, grid, .. } = distance;
        let half_width = CLOSE * error + grid;
        match mean.abs() > half_width {
            _ if half_width.is_nan() || mean.is_nan() => Self::NoError,
            true if mean > 0.0 => Self::Holds,
            true => Self::DoesNotHold,
            false => Self::Undecided,
        }
    }

    /// Whether a change in per cent is none.
    pub(crate) fn is_constant(percent: Estimate) -> Self {
        Self::is_positive(Estimate { mean: CONSTANT - percent.mean.abs(), ..percent })
    }

    /// Whether a change in per cent is one.
    pub(crate) fn changes(percent: Estimate) -> Self {
        Self::is_positive(Estimate { mean: percent.mean.abs() - CONSTANT, ..percent })
    }

    /// The answer to several statements at once: one that is wrong is enough to make all wrong.
    pub(crate) fn all(answers: impl IntoIterator<Item = Self>) -> Self {
        let answers: Vec<Self> = answers.into_iter().collect();
        let worst = [Self::NoError, Self::DoesNotHold, Self::Undecided];
        worst.into_iter().find(|answer| answers.contains(answer)).unwrap_or(Self::Holds)
    }
}

/// The weight of a verdict as evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Evidence {
    /// A number or statement of its own, like held against like.
    Own,
    /// One that follows from others of the table.
    Follows,
    /// One that is measured in another way than the paper's, and stands beside it to be seen.
    Beside,
}

/// A number or statement of the paper, what is found here, and whether both agree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The table or figure.
    #[serde(rename = "part")]
    pub item: Item,
    /// The quantity, and what kind of number is found: counted, corrected, resolved, another size.
    pub quantity: String,
    /// The number or statement as it is printed.
    pub paper: String,
    /// The number or statement that is found.
    pub here: String,
    /// Standard error of the number that is found, over realisations.
    pub error: Option<f64>,
    /// Error of its grid: of an extrapolation in the spacing.
    pub grid_error: Option<f64>,
    /// Standard error of the paper's number: of its realisations, with the scatter found here, and of its last digit.
    pub paper_error: Option<f64>,
    /// Deviation from the paper, in per cent.
    pub off_percent: Option<f64>,
    /// Deviation from the paper, in standard errors of both together.
    pub sigma: Option<f64>,
    /// `agrees` or `differs` for numbers; `holds`, `does not hold` or `undecided` for statements; `beside`, or `no error` for a single realisation.
    pub verdict: String,
    /// Its weight.
    pub evidence: Evidence,
    /// Why it differs, or what it follows from.
    pub why: String,
    /// Where it stands in the paper.
    pub place: String,
}

impl Verdict {
    /// A number with its errors; `how` says what kind it is.
    pub(super) fn number(key: &str, how: &str, here: Estimate) -> Self {
        let printed = Printed::from_key(key);
        let (value, own) = (printed.value.unwrap_or(f64::NAN), printed.error(here.scatter));
        let (off, error) = (here.mean - value, here.uncertainty().hypot(own));
        let verdict = match off.abs() <= CLOSE * error {
            _ if error.is_nan() => "no error",
            true => "agrees",
            false => "differs",
        };
        let known = |number: f64| number.is_finite().then_some(number);
        Self {
            error: known(here.error),
            grid_error: known(here.grid),
            paper_error: known(own),
            off_percent: known(100.0 * off / value),
            sigma: known(off / error),
            ..Self::on(printed, how, format!("{:.3}", here.mean), verdict)
        }
    }

    /// A number without errors of its own.
    pub(super) fn exact(key: &str, how: &str, here: f64) -> Self {
        Self::number(key, how, Estimate::exact(here))
    }

    /// A statement: what is found instead of it, and the answer to it.
    pub(super) fn statement(key: &str, here: String, answer: StatementVerdict) -> Self {
        Self::on(Printed::from_key(key), "", here, answer.into())
    }

    fn on(printed: Printed, how: &str, here: String, verdict: &str) -> Self {
        let Printed { item, quantity, printed: paper, follows, place, .. } = printed;
        let evidence = if follows.is_empty() { Evidence::Own } else { Evidence::Follows };
        let why = if follows.is_empty() { String::new() } else { format!("It follows from {follows}.") };
        let quantity = if how.is_empty() { quantity } else { format!("{quantity}, {how}") };
        let [error, grid_error, paper_error, off_percent, sigma] = [None; 5];
        let verdict = verdict.into();
        Self {
            item,
            quantity,
            paper,
            here,
            error,
            grid_error,
            paper_error,
            off_percent,
            sigma,
            verdict,
            evidence,
            why,
            place,
        }
    }

    /// The verdict with the reason why it differs from the paper, if it does.
    pub(super) fn because(self, why: &str) -> Self {
        if self.is_good() || self.is_undecided() { self } else { Self { why: why.into(), ..self } }
    }

    /// The number beside the paper's, which is measured otherwise: neither agrees with it nor differs.
    pub(super) fn beside(self) -> Self {
        Self { verdict: "beside".into(), evidence: Evidence::Beside, why: String::new(), ..self }
    }

    /// Whether the errors are too large to decide on a statement.
    pub fn is_undecided(&self) -> bool {
        self.verdict == <&str>::from(StatementVerdict::Undecided)
    }

    /// Whether the number agrees, or the statement holds.
    pub fn is_good(&self) -> bool {
        ["agrees", "holds"].contains(&self.verdict.as_str())
    }

    /// The number that is found, with its error.
    pub(super) fn found(&self) -> String {
        let error = self.error.unwrap_or(0.0).hypot(self.grid_error.unwrap_or(0.0));
        if error > 0.0 { format!("{} ± {error:.3}", self.here) } else { self.here.clone() }
    }

    /// The deviation from the paper, in per cent and in standard errors.
    pub(super) fn deviation(&self) -> String {
        let percent = self.off_percent.map(|off| format!("{off:+.1} %"));
        let sigma = self.sigma.map(|sigma| format!("{sigma:+.1} σ"));
        percent.into_iter().chain(sigma).collect::<Vec<_>>().join(", ")
    }
}

impl Printed {
    /// The number or statement with this `key`.
    fn from_key(key: &str) -> Self {
        let mut rows = csv::Reader::from_reader(PRINTED.as_bytes()).into_deserialize::<Self>().flatten();
        rows.find(|row| row.key == key).unwrap_or_else(|| panic!("assets/paper.csv holds no {key}"))
    }

    /// Standard error of the number: of a digit that is rounded anywhere within its reading, and of a mean over realisations
    /// that scatter as those found here.
    fn error(&self, scatter: f64) -> f64 {
        let sample = self.realisations.map_or(0.0, |count| scatter / count.sqrt());
        sample.hypot(self.reading.unwrap_or(0.0) / 3f64.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(key: &str, mean: f64, [error, grid, scatter]: [f64; 3]) -> Verdict {
        Verdict::number(key, "", Estimate { mean, error, grid, scatter }).because("of this")
    }

    #[test]
    fn verdicts_weigh_the_errors_of_both_sides() {
        let words = |mean, errors| {
            let Verdict { verdict, why, .. } = verdict("fig2.kappa_r", mean, errors);
            [verdict, why]
        };
        assert_eq!(words(1.7549, [0.0; 3]), ["agrees", ""]);
        assert_eq!(words(1.76, [0.0; 3]), ["differs", "of this"]);
        // an error of ours, of the grid, and of the ten realisations of the paper
        assert_eq!(words(1.76, [0.005, 0.0, 0.0]), ["agrees", ""]);
        assert_eq!(words(1.76, [0.0, 0.005, 0.0]), ["agrees", ""]);
        assert_eq!(words(1.76, [0.0, 0.0, 0.02]), ["agrees", ""]);
        assert_eq!(words(1.70, [0.005, 0.005, 0.02]), ["differs", "of this"]);
        assert_eq!(words(1.75, [f64::NAN, 0.0, 0.0]), ["no error", "of this"]);
        // a number that is no mean over realisations gains nothing from their scatter
        assert_eq!(verdict("fig1.line", 1.4802, [0.0, 0.0, 0.1]).verdict, "differs");
    }

    #[test]
    fn a_statement_is_decided_only_where_no_error_covers_the_limit() {
        let percent = |mean, error, grid| Estimate { mean, error, grid, scatter: 0.0 };
        for (mean, error, grid, constant, changes) in [
            (0.2, 0.3, 0.0, StatementVerdict::Holds, StatementVerdict::DoesNotHold),
            (0.2, 0.3, 0.3, StatementVerdict::Undecided, StatementVerdict::Undecided),
            (-10.15, 5.24, 0.0, StatementVerdict::Undecided, StatementVerdict::Undecided),
            (-10.15, 1.0, 0.0, StatementVerdict::DoesNotHold, StatementVerdict::Holds),
            (10.15, 1.0, 8.0, StatementVerdict::Undecided, StatementVerdict::Undecided),
            (0.0, f64::NAN, 0.0, StatementVerdict::NoError, StatementVerdict::NoError),
        ] {
            let change = percent(mean, error, grid);
            assert_eq!(
                (StatementVerdict::is_constant(change), StatementVerdict::changes(change)),
                (constant, changes),
                "{change:?}"
            );
        }
        assert_eq!(
            StatementVerdict::all([
                StatementVerdict::Holds,
                StatementVerdict::Undecided,
                StatementVerdict::DoesNotHold
            ]),
            StatementVerdict::DoesNotHold
        );
        assert_eq!(
            StatementVerdict::all([StatementVerdict::Holds, StatementVerdict::Undecided]),
            StatementVerdict::Undecided
        );
        let undecided =
            Verdict::statement("fig2.constant", String::new(), StatementVerdict::Undecided).because("of this");
        assert!(undecided.is_undecided() && !undecided.is_good() && undecided.why.is_empty());
    }

    #[test]
    fn deviations_are_given_in_per_cent_and_in_standard_errors() {
        let off = verdict("fig2.kappa_r", 1.785, [0.004, 0.002, 0.01]);
        assert_eq!(off.found(), "1.785 ± 0.004");
        let error = 0.004f64.hypot(0.002).hypot(0.01 / 10f64.sqrt()).hypot(0.005 / 3f64.sqrt());
        assert_eq!(off.deviation(), format!("+2.0 %, +{:.1} σ", 0.035 / error));
    }

    #[test]
    fn what_follows_from_others_or_stands_beside_is_no_evidence_of_its_own() {
        let of = |key| verdict(key, 1.0, [0.1, 0.0, 0.0]);
        assert_eq!(of("fig4.kappa_r").evidence, Evidence::Own);
        assert_eq!((of("fig5.kappa_r").evidence, of("table1.ratio").evidence), (Evidence::Follows, Evidence::Follows));
        let beside = of("fig4.kappa_r").beside();
        assert_eq!((beside.evidence, beside.verdict.as_str(), beside.is_good()), (Evidence::Beside, "beside", false));
    }
}
