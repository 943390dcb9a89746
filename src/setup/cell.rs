//! The cell: points and lengths along the axes of the arrays.

use crate::error::{GridError, SetupError};
use crate::grid::Grid;
use crate::quantity;
use serde::{Deserialize, Deserializer, Serialize};

/// Points and lengths along the axes of the arrays, in their order: one makes a line, two make a surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Cell {
    /// Points along the axes; none where a height file has its own.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    pub points: Vec<usize>,
    /// Lengths along the axes; one serves all of them.
    #[serde(serialize_with = "one_or_more::serialize", deserialize_with = "lengths")]
    pub size: Vec<f64>,
}

impl Cell {
    /// The cell of a line.
    pub fn line(points: usize, length: f64) -> Self {
        Self { points: vec![points], size: vec![length] }
    }

    /// The cell of a surface, points and lengths along y and x.
    pub fn surface(points: [usize; 2], size: [f64; 2]) -> Self {
        Self { points: points.into(), size: size.into() }
    }

    /// The grid.
    ///
    /// # Errors
    /// For missing points, too many of them, lengths that do not fit, and as [`Grid::line`] and [`Grid::surface`].
    pub fn grid(&self) -> Result<Grid, SetupError> {
        if self.points.is_empty() {
            return Err(SetupError::NoPoints);
        }
        self.grid_of(&self.points)
    }

    /// The grid of an array of some shape; an array of one row is a line.
    pub(super) fn grid_of(&self, shape: &[usize]) -> Result<Grid, SetupError> {
        let axes = shape.len();
        let along = |i: usize| -> Result<f64, SetupError> {
            match *self.size {
                [one] => Ok(one),
                _ if self.size.len() == axes => Ok(self.size[i]),
                _ => Err(SetupError::Sizes { sizes: self.size.len(), axes }),
            }
        };
        let grid: Result<Grid, GridError> = match *shape {
            [n] => Grid::line(n, along(0)?),
            [1, nx] => Grid::line(nx, along(1)?),
            [ny, nx] => Grid::surface([ny, nx], [along(0)?, along(1)?]),
            _ => return Err(SetupError::Axes { axes }),
        };
        Ok(grid?)
    }
}

/// A list of lengths, or a single one.
fn lengths<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    #[derive(Deserialize)]
    #[serde(transparent)]
    struct Length(#[serde(deserialize_with = "quantity::length")] f64);
    Ok(one_or_more::deserialize::<_, Length>(from)?.into_iter().map(|Length(length)| length).collect())
}

/// A list that may be a single value.
mod one_or_more {
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
            f.write_str("one value, or a list with one for each axis")
        }

        one!(visit_i64: i64, visit_u64: u64, visit_f64: f64, visit_str: &str);

        fn visit_seq<A: SeqAccess<'de>>(self, values: A) -> Result<Vec<T>, A::Error> {
            Vec::deserialize(SeqAccessDeserializer::new(values))
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Vec<T>, D::Error> {
        from.deserialize_any(OneOrMore(PhantomData))
    }

    pub fn serialize<S: Serializer, T: Serialize>(values: &[T], into: S) -> Result<S::Ok, S::Error> {
        match values {
            [one] => one.serialize(into),
            more => more.serialize(into),
        }
    }
}
