//! Classic NetCDF files as contact.engineering lays them out.

use super::{SHAPE, VOID, height, heights};

/// A type of values and their bytes.
type Values = (u32, Vec<u8>);

fn doubles(numbers: impl IntoIterator<Item = f64>) -> Values {
    (6, numbers.into_iter().flat_map(f64::to_be_bytes).collect())
}

fn shorts(numbers: impl IntoIterator<Item = i16>) -> Values {
    (3, numbers.into_iter().flat_map(i16::to_be_bytes).collect())
}

fn integer(number: i32) -> Values {
    (4, number.to_be_bytes().to_vec())
}

fn text(text: &str) -> Values {
    (2, text.as_bytes().to_vec())
}

/// A variable: name, dimensions, attributes and values.
type Variable<'a> = (&'a str, &'a [usize], Vec<(&'a str, Values)>, Values);

/// A writer of a version of the format.
struct Format(u8);

impl Format {
    fn count(&self, count: usize) -> Vec<u8> {
        if self.0 == 5 { (count as u64).to_be_bytes().to_vec() } else { (count as u32).to_be_bytes().to_vec() }
    }

    fn place(&self, place: usize) -> Vec<u8> {
        if self.0 > 1 { (place as u64).to_be_bytes().to_vec() } else { (place as u32).to_be_bytes().to_vec() }
    }

    fn padded(&self, bytes: &[u8]) -> Vec<u8> {
        [bytes, &vec![0; bytes.len().next_multiple_of(4) - bytes.len()]].concat()
    }

    fn name(&self, name: &str) -> Vec<u8> {
        [self.count(name.len()), self.padded(name.as_bytes())].concat()
    }

    fn list(&self, tag: u32, items: Vec<Vec<u8>>) -> Vec<u8> {
        let tag = if items.is_empty() { 0 } else { tag };
        [tag.to_be_bytes().to_vec(), self.count(items.len()), items.concat()].concat()
    }

    fn attributes(&self, attributes: &[(&str, Values)]) -> Vec<u8> {
        let size = |kind| [1, 1, 1, 2, 4, 4, 8][kind as usize];
        let attribute = |(name, (kind, bytes)): &(&str, Values)| {
            let count = self.count(bytes.len() / size(*kind));
            [self.name(name), kind.to_be_bytes().to_vec(), count, self.padded(bytes)].concat()
        };
        self.list(12, attributes.iter().map(attribute).collect())
    }

    fn header(&self, dimensions: &[(&str, usize)], variables: &[Variable], places: &[usize]) -> Vec<u8> {
        let dimensions = dimensions.iter().map(|(name, length)| [self.name(name), self.count(*length)].concat());
        let variable = |((name, along, attributes, (kind, bytes)), place): (&Variable, &usize)| {
            let along: Vec<u8> = along.iter().flat_map(|it| self.count(*it)).collect();
            let (count, attributes) = (self.count(along.len() / self.count(0).len()), self.attributes(attributes));
            let kind = kind.to_be_bytes().to_vec();
            [self.name(name), count, along, attributes, kind, self.count(bytes.len()), self.place(*place)].concat()
        };
        let variables = variables.iter().zip(places).map(variable);
        let global = [("title", text("a small map"))];
        [
            vec![b'C', b'D', b'F', self.0],
            self.count(0),
            self.list(10, dimensions.collect()),
            self.attributes(&global),
            self.list(11, variables.collect()),
        ]
        .concat()
    }

    fn file(&self, dimensions: &[(&str, usize)], variables: &[Variable]) -> Vec<u8> {
        let mut at = self.header(dimensions, variables, &vec![0; variables.len()]).len();
        let mut places = Vec::new();
        for (_, _, _, (_, bytes)) in variables {
            places.push(at);
            at += self.padded(bytes).len();
        }
        let values = variables.iter().flat_map(|it| self.padded(&it.3.1));
        self.header(dimensions, variables, &places).into_iter().chain(values).collect()
    }
}

/// Numbers along x and then y, as files of contact.engineering have them.
fn turned<T>(number: impl Fn(usize, usize) -> T) -> Vec<T> {
    let number = &number;
    (0..SHAPE[1]).flat_map(|ix| (0..SHAPE[0]).map(move |iy| number(ix, iy))).collect()
}

/// Heights along x and y in nanometres, distances as lengths in micrometres, and a mask.
pub fn file() -> Vec<u8> {
    let mask = turned(|ix, iy| i16::from([iy, ix] == VOID));
    let axis = |length: f64, unit| vec![("length", doubles([length])), ("periodic", integer(0)), ("unit", text(unit))];
    let variables: [Variable; 4] = [
        ("y", &[1], axis(SHAPE[0] as f64 * 3e3, "nm"), doubles((0..SHAPE[0]).map(|i| i as f64))),
        ("mask", &[0, 1], vec![], shorts(mask)),
        ("heights", &[0, 1], vec![("unit", text("nm"))], doubles(turned(height))),
        ("x", &[0], axis(SHAPE[1] as f64 * 2.0, "um"), doubles((0..SHAPE[1]).map(|i| i as f64))),
    ];
    Format(1).file(&[("x", SHAPE[1]), ("y", SHAPE[0])], &variables)
}

/// Rows of short integers with a scale and a value for void points, coordinates instead of lengths, and counts of eight bytes.
pub fn wide() -> Vec<u8> {
    let axis = |count: usize, step: f64| doubles((0..count).map(|i| 7.0 + step * i as f64));
    let attributes = vec![
        ("units", text("mm")),
        ("scale_factor", doubles([1e-6])),
        ("add_offset", doubles([-1e-6])),
        ("_FillValue", shorts([-9])),
    ];
    let metres = || vec![("units", text("m"))];
    let numbers = heights(-10.0).map(|z| z as i16 + 1);
    let variables: [Variable; 3] = [
        ("Y", &[0], metres(), axis(SHAPE[0], 3e-6)),
        ("X", &[1], metres(), axis(SHAPE[1], 2e-6)),
        ("z", &[0, 1], attributes, shorts(numbers)),
    ];
    Format(5).file(&[("Y", SHAPE[0]), ("X", SHAPE[1])], &variables)
}

/// A profile at positions that are not evenly spaced.
pub fn profile() -> Vec<u8> {
    let unit = || vec![("unit", text("um"))];
    let variables: [Variable; 2] = [
        ("heights", &[0], unit(), doubles([1.0, 9.969_209_968_386_869e36, 3.0])),
        ("x", &[0], unit(), doubles([0.0, 1.0, 3.0])),
    ];
    Format(2).file(&[("n", 3)], &variables)
}

/// A map whose rows are at falling positions along y in some unit.
pub fn falling(unit: &str) -> Vec<u8> {
    let axis = |numbers: Vec<f64>, unit: &str| (vec![("unit", text(unit))], doubles(numbers));
    let (of_y, y) = axis((0..SHAPE[0]).rev().map(|i| 3.0 * i as f64).collect(), unit);
    let (of_x, x) = axis((0..SHAPE[1]).map(|i| 2.0 * i as f64).collect(), "um");
    let rows = (0..SHAPE[0]).rev().flat_map(|iy| (0..SHAPE[1]).map(move |ix| height(ix, iy)));
    let variables: [Variable; 3] =
        [("y", &[0], of_y, y), ("x", &[1], of_x, x), ("heights", &[0, 1], vec![("unit", text("nm"))], doubles(rows))];
    Format(1).file(&[("y", SHAPE[0]), ("x", SHAPE[1])], &variables)
}

/// Heights, and before them a variable along a dimension without limit.
pub fn unlimited() -> Vec<u8> {
    let variables: [Variable; 2] =
        [("series", &[0, 1], vec![], doubles(heights(0.0))), ("z", &[2, 1], vec![], doubles(heights(0.0)))];
    Format(1).file(&[("t", 0), ("x", SHAPE[1]), ("y", SHAPE[0])], &variables)
}
