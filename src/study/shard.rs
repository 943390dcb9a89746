//! Shares of a study, for independent machines.

use std::fmt;
use std::str::FromStr;

/// One of several shares of a study: `3/100` is the third of a hundred.
///
/// ```
/// use asperity::study::Shard;
/// let shard: Shard = "3/100".parse()?;
/// assert_eq!((shard.number(), shard.count()), (3, 100));
/// assert!("0/4".parse::<Shard>().is_err() && "5/4".parse::<Shard>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    count: usize,
}

impl Shard {
    /// All of a study.
    pub const WHOLE: Self = Self { number: 1, count: 1 };

    /// Number of the share, from 1.
    pub fn number(self) -> usize {
        self.number
    }

    /// The number of shares.
    pub fn count(self) -> usize {
        self.count
    }

    /// Whether the share holds place `i`, from 0, when places are dealt one to each share in turn.
    pub(super) fn holds(self, i: usize) -> bool {
        i % self.count == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = |word: &str| word.trim().parse::<usize>().ok();
        match text.split_once('/').map(|(number, count)| (parse(number), parse(count))) {
            Some((Some(number @ 1..), Some(count))) if number <= count => Ok(Self { number, count }),
            _ => Err(format!("{text:?} is not a share: give its number and the number of shares, such as 3/100")),
        }
    }
}
