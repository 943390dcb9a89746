//! The classic formats of NetCDF: arrays with names and attributes.

use super::bytes::{ByteReader, latin, nodes};
use super::format::malformed;
use std::io;

/// Dimensions, variables or attributes that are read at most: files of heights have a few, and every channel carries the attributes.
const MOST: u64 = 128;
/// Numbers of an attribute that are shown.
const SHOWN: usize = 8;
/// What the format fills in for floating point numbers where nothing is written.
pub(super) const FILL: f64 = 9.969_209_968_386_869e36;

/// A file whose values are not read before they are asked for.
pub(super) struct File<'a> {
    pub bytes: &'a [u8],
    /// Names and lengths, zero for one without limit.
    pub dimensions: Vec<(String, u64)>,
    pub attributes: Vec<Attribute>,
    pub variables: Vec<Variable>,
}

impl<'a> File<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> io::Result<Self> {
        let version = bytes[3];
        let mut header =
            HeaderReader { at: ByteReader::new(bytes).seek(4)?, is_wide: version == 5, is_far: version > 1 };
        header.count()?; // of records
        let dimensions = header.list("dimensions", |it| Ok((it.name()?, it.count()?)))?;
        let attributes = header.attributes()?;
        let variables = header.list("variables", HeaderReader::variable)?;
        let known = dimensions.len() as u64;
        if let Some((name, wrong)) = variables.iter().find_map(|it| Some((&it.name, it.beyond(known)?))) {
            return Err(malformed(format!("its variable {name:?} has dimension {wrong}, but there are {known}")));
        }
        Ok(Self { bytes, dimensions, attributes, variables })
    }

    /// The names of a variable's dimensions.
    pub(crate) fn names(&self, variable: &Variable) -> Vec<&str> {
        variable.dimensions.iter().map(|it| self.dimensions[*it as usize].0.as_str()).collect()
    }

    /// The lengths of a variable's dimensions, and its bytes.
    pub(crate) fn data(&self, variable: &Variable) -> io::Result<([usize; 2], &'a [u8])> {
        let lengths = variable.dimensions.iter().map(|it| self.dimensions[*it as usize].1);
        let lengths: Vec<i64> = lengths.map(|it| i64::try_from(it).unwrap_or(i64::MAX)).collect();
        if lengths.contains(&0) {
            let name = &variable.name;
            return Err(malformed(format!(
                "its variable {name:?} has an unlimited dimension: convert it with `nccopy -u`"
            )));
        }
        let (rows, columns) = match lengths[..] {
            [columns] => (1, columns),
            [rows, columns] => (rows, columns),
            _ => return Err(malformed(format!("its variable {:?} is neither a map nor a profile", variable.name))),
        };
        let mut at = ByteReader::new(self.bytes).seek(variable.place)?;
        let shape = nodes(rows, columns, variable.kind.size(), at.rest().len())?;
        Ok((shape, at.take(shape[0] * shape[1] * variable.kind.size())?))
    }
}

/// A place in a header.
struct HeaderReader<'a> {
    at: ByteReader<'a>,
    /// Whether counts have 8 bytes.
    is_wide: bool,
    /// Whether places of values have 8 bytes.
    is_far: bool,
}

impl<'a> HeaderReader<'a> {
    fn number(&mut self) -> io::Result<u64> {
        Ok(self.at.u32()?.swap_bytes().into())
    }

    fn long(&mut self) -> io::Result<u64> {
        Ok(u64::from_be_bytes(self.at.i64()?.to_le_bytes()))
    }

    fn count(&mut self) -> io::Result<u64> {
        if self.is_wide { self.long() } else { self.number() }
    }

    fn place(&mut self) -> io::Result<u64> {
        if self.is_far { self.long() } else { self.number() }
    }

    /// A number of bytes, and the padding to a multiple of four.
    fn padded(&mut self, count: u64) -> io::Result<&'a [u8]> {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        let bytes = self.at.take(count)?;
        self.at.take(count.next_multiple_of(4) - count)?;
        Ok(bytes)
    }

    fn name(&mut self) -> io::Result<String> {
        let length = self.count()?;
        self.padded(length).map(latin)
    }

    /// A list of items.
    fn list<T>(&mut self, what: &str, item: impl Fn(&mut Self) -> io::Result<T>) -> io::Result<Vec<T>> {
        self.number()?; // its tag
        match self.count()? {
            count if count > MOST => Err(malformed(format!("it has {count} {what}, but at most {MOST} are read"))),
            count => (0..count).map(|_| item(self)).collect(),
        }
    }

    fn attributes(&mut self) -> io::Result<Vec<Attribute>> {
        self.list("attributes", |header| {
            let name = header.name()?;
            let kind = ValueType::new(header.number()?)?;
            let count = header.count()?;
            let bytes = header.padded(count.saturating_mul(kind.size() as u64))?;
            Ok(Attribute { name, text: kind.text(bytes), number: kind.numbers(bytes).next() })
        })
    }

    fn variable(&mut self) -> io::Result<Variable> {
        let name = self.name()?;
        let dimensions = (0..self.count()?).map(|_| self.count()).collect::<io::Result<_>>()?;
        let attributes = self.attributes()?;
        let kind = ValueType::new(self.number()?)?;
        self.count()?; // of bytes
        let place = usize::try_from(self.place()?).unwrap_or(usize::MAX);
        Ok(Variable { name, dimensions, attributes, kind, place })
    }
}

/// A type of values.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ValueType {
    Signed(usize),
    Unsigned(usize),
    Float,
    Double,
    Text,
}

impl ValueType {
    fn new(code: u64) -> io::Result<Self> {
        Ok(match code {
            1 => Self::Signed(1),
            2 => Self::Text,
            3 => Self::Signed(2),
            4 => Self::Signed(4),
            5 => Self::Float,
            6 => Self::Double,
            7 => Self::Unsigned(1),
            8 => Self::Unsigned(2),
            9 => Self::Unsigned(4),
            10 => Self::Signed(8),
            11 => Self::Unsigned(8),
            _ => return Err(malformed(format!("it holds values of the type {code}, which NetCDF does not know"))),
        })
    }

    /// Bytes of a value.
    fn size(self) -> usize {
        match self {
            Self::Signed(size) | Self::Unsigned(size) => size,
            Self::Float => 4,
            Self::Double => 8,
            Self::Text => 1,
        }
    }

    /// The value in as many bytes.
    fn number(self, bytes: &[u8]) -> f64 {
        let bits = bytes.iter().fold(0, |bits, byte| bits << 8 | u64::from(*byte));
        let unused = 64 - 8 * self.size();
        match self {
            Self::Signed(_) => ((bits << unused) as i64 >> unused) as f64,
            Self::Float => f32::from_bits(bits as u32).into(),
            Self::Double => f64::from_bits(bits),
            Self::Unsigned(_) | Self::Text => bits as f64,
        }
    }

    /// The value at a place.
    pub(crate) fn at(self, bytes: &[u8], place: usize) -> f64 {
        self.number(&bytes[place * self.size()..][..self.size()])
    }

    fn numbers(self, bytes: &[u8]) -> impl Iterator<Item = f64> {
        bytes.chunks_exact(self.size()).map(move |it| self.number(it))
    }

    /// The values for people.
    fn text(self, bytes: &[u8]) -> String {
        if self == Self::Text {
            return latin(bytes).trim_matches(['\0', ' ', '\n']).to_owned();
        }
        self.numbers(bytes).take(SHOWN).map(|it| it.to_string()).collect::<Vec<_>>().join(" ")
    }
}

/// An attribute of a variable or of the file.
pub(super) struct Attribute {
    pub name: String,
    pub text: String,
    /// Its first value.
    pub number: Option<f64>,
}

/// A variable.
pub(super) struct Variable {
    pub name: String,
    /// Places of its dimensions in the list of the file.
    pub dimensions: Vec<u64>,
    pub attributes: Vec<Attribute>,
    pub kind: ValueType,
    pub place: usize,
}

impl Variable {
    fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|it| it.name == name)
    }

    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        self.attribute(name)?.number
    }

    /// A dimension beyond those that are known.
    fn beyond(&self, known: u64) -> Option<u64> {
        self.dimensions.iter().copied().find(|it| *it >= known)
    }

    /// Its value at a place of its bytes, none where it is void.
    pub(crate) fn values(&self) -> impl Fn(&[u8], usize) -> Option<f64> + use<> {
        let void = ["_FillValue", "missing_value"].map(|name| self.number(name));
        let [scale, offset] = [self.number("scale_factor").unwrap_or(1.0), self.number("add_offset").unwrap_or(0.0)];
        let kind = self.kind;
        let filled = matches!(kind, ValueType::Float | ValueType::Double).then_some(FILL);
        move |bytes, place| {
            let number = kind.at(bytes, place);
            let is_void = void.contains(&Some(number)) || filled == Some(number);
            (!is_void).then_some(scale * number + offset)
        }
    }

    /// Its unit, empty if it has none.
    pub(crate) fn unit(&self) -> &str {
        self.attribute("unit").or_else(|| self.attribute("units")).map_or("", |it| it.text.as_str())
    }
}
