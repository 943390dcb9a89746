//! Lists that may be a single value.

use crate::quantity;
use serde::de::value::SeqAccessDeserializer;
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
pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Vec<T>, D::Error> {
    from.deserialize_any(OneOrMore(PhantomData))
}

/// Writes a list, that of one value as the value.
pub fn serialize<S: Serializer, T: Serialize>(values: &[T], into: S) -> Result<S::Ok, S::Error> {
    match values {
        [one] => one.serialize(into),
        more => more.serialize(into),
    }
}

/// Reads a list of lengths, or a single one.
pub fn lengths<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    Ok(deserialize::<_, quantity::Length>(from)?.into_iter().map(|quantity::Length(length)| length).collect())
}

/// Reads a list of pressures, or a single one.
pub fn pressures<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Pressure(#[serde(deserialize_with = "quantity::pressure")] f64);
    Ok(deserialize::<_, Pressure>(from)?.into_iter().map(|Pressure(pressure)| pressure).collect())
}

/// Reads a list of times, or a single one.
pub fn times<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Time(#[serde(deserialize_with = "quantity::time")] f64);
    Ok(deserialize::<_, Time>(from)?.into_iter().map(|Time(time)| time).collect())
}

/// Reads a list of resistivities, or a single one.
pub fn resistivities<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Resistivity(#[serde(deserialize_with = "quantity::resistivity")] f64);
    Ok(deserialize::<_, Resistivity>(from)?.into_iter().map(|Resistivity(it)| it).collect())
}

/// Reads a list of conductivities, or a single one.
pub fn conductivities<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Conductivity(#[serde(deserialize_with = "quantity::conductivity")] f64);
    Ok(deserialize::<_, Conductivity>(from)?.into_iter().map(|Conductivity(it)| it).collect())
}

/// Reads a list of speeds, or a single one; a text such as `"1e-3..1e3:13"` means 13 speeds with equal ratios.
pub fn speeds<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Speed(#[serde(deserialize_with = "quantity::speed")] f64);
    let one = |word: &str| {
        let value: serde::de::value::StrDeserializer<'_, D::Error> = word.into_deserializer();
        Speed::deserialize(value).map(|Speed(speed)| speed)
    };
    let words = deserialize::<_, Word>(from)?;
    let speeds = words.into_iter().map(|word| match word {
        Word::Number(number) => Ok(vec![number]),
        Word::Text(text) => match super::range::Range::parse(&text) {
            Some(range) => range.map_err(D::Error::custom)?.values(one),
            None => one(&text).map(|speed| vec![speed]),
        },
    });
    Ok(speeds.collect::<Result<Vec<_>, _>>()?.concat())
}

/// A number, or a text.
#[derive(serde::Deserialize)]
#[serde(untagged, expecting = "give a speed: a number, or one with a unit such as \"1 m/s\"")]
enum Word {
    Number(f64),
    Text(String),
}
