//! Lists that may be a single value.

use super::range::Range;
use crate::quantity;
use serde::de::value::{self, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, SeqAccess, Visitor};
use serde::{Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

struct OneOrMore<T>(PhantomData<T>);

/// Visits of a single value.
macro_rules! one {
    ($($visit:ident: $type:ty),+) => {
        $(fn $visit<E: Error>(self, value: $type) -> Result<Vec<T>, E> {
            T::deserialize(value.into_deserializer()).map(|value| vec![value])
        })+
    };
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for OneOrMore<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("one value, or a list of them")
    }

    one!(visit_i64: i64, visit_u64: u64, visit_f64: f64, visit_str: &str);

    fn visit_seq<A: SeqAccess<'de>>(self, values: A) -> Result<Vec<T>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(values))
    }
}

/// Reads a list, or a single value.
pub(crate) fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Vec<T>, D::Error> {
    from.deserialize_any(OneOrMore(PhantomData))
}

/// Writes a list, that of one value as the value.
pub(crate) fn serialize<S: Serializer, T: Serialize>(values: &[T], into: S) -> Result<S::Ok, S::Error> {
    match values {
        [one] => one.serialize(into),
        more => more.serialize(into),
    }
}

/// Reads a list of lengths, or a single one.
pub(crate) fn lengths<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    Ok(deserialize::<_, quantity::Length>(from)?.into_iter().map(|quantity::Length(length)| length).collect())
}

/// Reads a list of pressures, or a single one.
pub(crate) fn pressures<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Pressure(#[serde(deserialize_with = "quantity::pressure")] f64);
    Ok(deserialize::<_, Pressure>(from)?.into_iter().map(|Pressure(pressure)| pressure).collect())
}

/// Reads a list of times, or a single one; a text such as `"1e-3..1e3:13"` means 13 times with equal ratios.
pub(crate) fn times<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    expanded(from, |word| quantity::time(word.into_deserializer()))
}

/// Reads a list of speeds, or a single one, with ranges like those of [`times`].
pub(crate) fn speeds<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    expanded(from, |word| quantity::speed(word.into_deserializer()))
}

/// Reads pairs of a ratio, which has no unit, and a time.
pub(crate) fn ratios_and_times<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    const PAIRS: &str = "give pairs of a ratio and a time, such as 9 and 1ms";
    let time = |text: &str| quantity::time::<value::StrDeserializer<'_, value::Error>>(text.into_deserializer());
    let ratio = |text: &str| match (text.trim().parse(), time(text)) {
        (Ok(ratio), _) => Ok(ratio),
        (Err(_), Ok(_)) => {
            Err(value::Error::custom(format_args!("`{text}` is a time, but a ratio stands in its place: {PAIRS}")))
        }
        (Err(_), Err(_)) => Err(value::Error::custom(format_args!("`{text}` is not a ratio: {PAIRS}"))),
    };
    let read = |(i, word): (usize, Word)| match word {
        Word::Number(number) => Ok(number),
        Word::Text(text) if i % 2 == 0 => ratio(&text),
        Word::Text(text) => time(&text),
    };
    let words = deserialize::<_, Word>(from)?.into_iter().enumerate();
    words.map(read).collect::<Result<_, _>>().map_err(D::Error::custom)
}

/// Reads a list of numbers, or a single one, with ranges like those of [`times`].
pub(crate) fn numbers<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let number =
        |word: &str| word.trim().parse().map_err(|_| value::Error::custom(format_args!("`{word}` is not a number")));
    expanded(from, number)
}

/// Reads a list of resistivities, or a single one.
pub(crate) fn resistivities<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Resistivity(#[serde(deserialize_with = "quantity::resistivity")] f64);
    Ok(deserialize::<_, Resistivity>(from)?.into_iter().map(|Resistivity(it)| it).collect())
}

/// Reads a list of conductivities, or a single one.
pub(crate) fn conductivities<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Conductivity(#[serde(deserialize_with = "quantity::conductivity")] f64);
    Ok(deserialize::<_, Conductivity>(from)?.into_iter().map(|Conductivity(it)| it).collect())
}

/// Reads a list of quantities whose words are read by `one`, or a single one. A range of them has equal ratios.
fn expanded<'de, D: Deserializer<'de>>(
    from: D,
    one: impl Fn(&str) -> Result<f64, value::Error>,
) -> Result<Vec<f64>, D::Error> {
    let values = |word: Word| match word {
        Word::Number(number) => Ok(vec![number]),
        Word::Text(text) => match Range::parse(&text) {
            Some(range) => range.map_err(value::Error::custom)?.values(&one, value::Error::custom),
            None => one(&text).map(|value| vec![value]),
        },
    };
    let words = deserialize::<_, Word>(from)?;
    Ok(words.into_iter().map(values).collect::<Result<Vec<_>, _>>().map_err(D::Error::custom)?.concat())
}

/// A number, or a text.
#[derive(serde::Deserialize)]
#[serde(untagged, expecting = "give a number, one with a unit, or a range such as \"1e-3..1e-1:13\"")]
enum Word {
    Number(f64),
    Text(String),
}
