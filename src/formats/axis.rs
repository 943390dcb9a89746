//! Axes of coordinates as XML describes them.

use super::bytes::ByteReader;
use super::format::malformed;
use roxmltree::Node;
use std::io;

/// An axis of coordinates, in metres.
#[derive(Clone, Copy)]
pub(super) struct CoordinateAxis {
    /// None if the file does not say it.
    pub increment: Option<f64>,
    pub offset: f64,
    /// The type of the coordinates that are stored, none for those that follow from the grid.
    pub kind: Option<CoordinateType>,
}

impl CoordinateAxis {
    pub(crate) fn new(axes: Node, name: &str) -> io::Result<Self> {
        let axis = child(axes, name).ok_or_else(|| malformed(format!("it does not describe its axis {name}")))?;
        let kind = match find(axis, "AxisType") {
            Some("I") => None,
            Some("A") => Some(CoordinateType::new(find(axis, "DataType").unwrap_or_default())?),
            other => return Err(malformed(format!("its axis {name} is of the type {:?}", other.unwrap_or_default()))),
        };
        let increment: Option<f64> = number(axis, "Increment")?;
        if let (None, Some(CoordinateType::Short | CoordinateType::Long)) = (increment, kind) {
            return Err(malformed(format!(
                "its axis {name} has whole numbers, but no Increment that turns them into metres"
            )));
        }
        Ok(Self { increment, offset: number(axis, "Offset")?.unwrap_or(0.0), kind })
    }

    /// The coordinate of a stored number.
    pub(crate) fn metres(&self, number: f64) -> f64 {
        self.offset + self.increment.unwrap_or(1.0) * number
    }
}

/// The type of a stored coordinate.
#[derive(Clone, Copy)]
pub(super) enum CoordinateType {
    Short,
    Long,
    Float,
    Double,
}

impl CoordinateType {
    fn new(name: &str) -> io::Result<Self> {
        Ok(match name {
            "I" => Self::Short,
            "L" => Self::Long,
            "F" => Self::Float,
            "D" => Self::Double,
            _ => {
                return Err(malformed(format!(
                    "it holds coordinates of the type {name:?}, which is not one of I, L, F, D"
                )));
            }
        })
    }

    /// Bytes of a number.
    pub(crate) fn size(self) -> usize {
        match self {
            Self::Short => 2,
            Self::Long | Self::Float => 4,
            Self::Double => 8,
        }
    }

    /// The number in some bytes.
    pub(crate) fn number(self, bytes: &[u8]) -> io::Result<f64> {
        let mut bytes = ByteReader::new(bytes);
        Ok(match self {
            Self::Short => bytes.i16()?.into(),
            Self::Long => bytes.i32()?.into(),
            Self::Float => bytes.f32()?.into(),
            Self::Double => bytes.f64()?,
        })
    }
}

/// The first child of a name.
pub(super) fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|it| it.tag_name().name() == name)
}

/// The text at the end of a path of names.
pub(super) fn find<'a>(node: Node<'a, '_>, path: &str) -> Option<&'a str> {
    let found = path.split('/').try_fold(node, child)?;
    Some(found.text().unwrap_or_default().trim())
}

/// The number at the end of a path of names.
pub(super) fn number<T: std::str::FromStr>(node: Node, path: &str) -> io::Result<Option<T>> {
    let parse =
        |text: &str| text.parse().map_err(|_| malformed(format!("it has {text:?} for {path}, which is not a number")));
    find(node, path).filter(|it| !it.is_empty()).map(parse).transpose()
}
