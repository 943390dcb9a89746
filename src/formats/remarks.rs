//! What the head of a text of numbers says of them.

use super::said::{numbers, plain, said, unit_of};
use super::unit::metres;

/// Names, without white space and in small letters, of the distance of neighbours along both axes.
const PIXEL: [&str; 16] = [
    "pixelsize",
    "xypixelsize",
    "pixelsizexy",
    "pixelpitch",
    "pixelspacing",
    "cellsize",
    "xycalibration",
    "lateralcalibration",
    "lateralresolution",
    "lateralsampling",
    "samplinginterval",
    "samplingdistance",
    "pointspacing",
    "gridspacing",
    "xyspacing",
    "pointdistance",
];
/// Names of the distance of neighbours along x, and along y.
const PIXEL_X: [&str; 12] = [
    "dx",
    "deltax",
    "xdelta",
    "stepx",
    "xstep",
    "spacingx",
    "xspacing",
    "xincrement",
    "incrementx",
    "pixelsizex",
    "xpixelsize",
    "pixelwidth",
];
const PIXEL_Y: [&str; 12] = [
    "dy",
    "deltay",
    "ydelta",
    "stepy",
    "ystep",
    "spacingy",
    "yspacing",
    "yincrement",
    "incrementy",
    "pixelsizey",
    "ypixelsize",
    "pixelheight",
];
/// Names of the length along x, and along y.
const WIDTH: [&str; 10] =
    ["width", "breite", "xsize", "sizex", "xlength", "lengthx", "xrange", "rangex", "scansizex", "xscansize"];
const HEIGHT: [&str; 10] =
    ["height", "höhe", "ysize", "sizey", "ylength", "lengthy", "yrange", "rangey", "scansizey", "yscansize"];
/// Names of the lengths along both axes.
const SIZE: [&str; 4] = ["scansize", "fieldofview", "scanrange", "size"];
/// Names of the number of rows, and of columns.
const ROWS: [&str; 6] = ["nrows", "numrows", "rows", "ny", "vertical", "h"];
const COLUMNS: [&str; 7] = ["ncols", "numcols", "columns", "cols", "nx", "horizontal", "w"];
/// Names of the unit of heights.
const VALUE_UNIT: [&str; 10] = [
    "valueunits",
    "werteinheiten",
    "valueunit",
    "unit",
    "units",
    "zunit",
    "zunits",
    "heightunit",
    "heightunits",
    "unitz",
];
/// Names of the number that stands for a void.
const VOID: [&str; 11] = [
    "nodatavalue",
    "nodata",
    "missingvalue",
    "null",
    "nullvalue",
    "voidvalue",
    "invalidvalue",
    "badvalue",
    "fillvalue",
    "invalidpixelvalue",
    "badpixelvalue",
];
/// What the name of heights begins with that stands alone above a map.
const NAMES_OF_HEIGHTS: [&str; 6] = ["z", "height", "topography", "depth", "elevation", "altitude"];

/// Name, size and units in the lines above a table: in the words of Gwyddion's text export, of holographic microscopes
/// (`pixel size=3.7e-007 m`, `height conversion factor (-> m)=6.3e-008`, `h=650 w=650`), of the grids of geographers (`cellsize 0.5`,
/// `NODATA_value -9999`), of Keyence (`"XY Calibration","500.000","nm"`), and of names above numbers (`numCols numRows pixelSize (um)`); or as
/// units of columns, in brackets after their names or alone on a line.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Remarks {
    pub channel: Option<String>,
    /// Length along x, in metres.
    pub width: Option<f64>,
    /// Length along y, in metres.
    pub height: Option<f64>,
    /// Distances of neighbours.
    pub pixel: Option<Pixel>,
    /// Rows and columns.
    pub shape: [Option<usize>; 2],
    /// Metres in a unit of heights.
    pub value_unit: Option<f64>,
    /// The number that stands for a void.
    pub void: Option<f64>,
    /// Metres in a unit of each column.
    pub column_units: Vec<Option<f64>>,
    /// The names of the columns, if a line has one for each; empty ones of empty columns.
    pub column_names: Vec<String>,
    /// All that is said by name.
    pub said: Vec<(String, String)>,
}

/// Distances of neighbours along y and x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixel {
    pub spacing: [f64; 2],
    /// Metres in their unit, if it is known.
    pub unit: Option<f64>,
}

impl Remarks {
    /// What a head says of a table with so many columns.
    pub(crate) fn new(head: &[String], columns: usize) -> Self {
        let said = NamedValues::new(said(head));
        let size = said.lengths(&SIZE).and_then(|(lengths, unit)| Some((lengths, unit?)));
        let of_size = |axis: usize| size.as_ref().and_then(|(lengths, unit)| Some(lengths.get(axis)? * unit));
        Self {
            channel: said.find(&["channel", "kanal"]).map(|it| it.1.clone()),
            width: said.length(&WIDTH).or(of_size(0)),
            height: said.length(&HEIGHT).or(of_size(1)),
            pixel: said.pixel(),
            shape: [said.count(head, &ROWS), said.count(head, &COLUMNS)],
            value_unit: said.value_unit().or_else(|| head.iter().rev().find_map(|line| unit_of_label(line))),
            void: said.find(&VOID).and_then(|it| it.1.trim_matches('"').replacen(',', ".", 1).parse().ok()),
            column_units: head
                .iter()
                .rev()
                .map(|line| column_units(line, columns))
                .find(|it| !it.is_empty())
                .unwrap_or_default(),
            column_names: head.iter().rev().find_map(|line| column_names(line, columns)).unwrap_or_default(),
            said: said.0,
        }
    }

    /// Rows and columns that the head says, if so many heights fit them.
    pub(crate) fn fitting_shape(&self, count: usize) -> Option<[usize; 2]> {
        match self.shape {
            [Some(rows), Some(columns)] if rows > 1 && rows.checked_mul(columns) == Some(count) => {
                Some([rows, columns])
            }
            _ => None,
        }
    }
}

/// What a head says by name.
struct NamedValues(Vec<(String, String)>);

impl NamedValues {
    fn new(said: Vec<(String, String)>) -> Self {
        Self(said)
    }

    /// The first name of these, and its value.
    fn find(&self, names: &[&str]) -> Option<&(String, String)> {
        self.0.iter().find(|it| names.contains(&plain(&it.0).as_str()))
    }

    /// The positive numbers of the first of these names that has some, and the metres in their unit.
    fn lengths(&self, names: &[&str]) -> Option<(Vec<f64>, Option<f64>)> {
        let named = self.0.iter().filter(|it| names.contains(&plain(&it.0).as_str()));
        let values = named.filter_map(|(name, value)| {
            let (numbers, unit) = numbers(value)?;
            Some((numbers, unit.or_else(|| unit_of(name))))
        });
        values.into_iter().find(|(numbers, _)| numbers.iter().all(|it| *it > 0.0 && it.is_finite()))
    }

    /// A length in metres; one without a unit may be a number of points.
    fn length(&self, names: &[&str]) -> Option<f64> {
        let (numbers, unit) = self.lengths(names)?;
        Some(numbers[0] * unit?)
    }

    /// Distances of neighbours: of both axes at once, or of each, of which that along x holds along y where nothing else is said.
    fn pixel(&self) -> Option<Pixel> {
        if let Some((numbers, unit)) = self.lengths(&PIXEL) {
            let across = numbers[0];
            return Some(Pixel { spacing: [*numbers.last()?, across], unit });
        }
        let (across, unit) = self.lengths(&PIXEL_X)?;
        match self.lengths(&PIXEL_Y) {
            None => Some(Pixel { spacing: [across[0]; 2], unit }),
            Some((along, other)) if other.is_some() == unit.is_some() => {
                let ratio = other.zip(unit).map_or(1.0, |(other, unit)| other / unit);
                Some(Pixel { spacing: [along[0] * ratio, across[0]], unit })
            }
            Some(_) => None,
        }
    }

    /// A whole number: the value of a name, or that behind `name=` among the words of a line.
    fn count(&self, head: &[String], names: &[&str]) -> Option<usize> {
        let words = head.iter().flat_map(|line| line.split_whitespace()).filter_map(|word| word.split_once('='));
        let in_words = || words.into_iter().find(|it| names.contains(&it.0)).and_then(|it| it.1.parse().ok());
        self.find(names).and_then(|it| it.1.trim_matches('"').parse().ok()).or_else(in_words)
    }

    /// Metres in a unit of heights: by its name, or as the factor of whole numbers.
    fn value_unit(&self) -> Option<f64> {
        let named = self.find(&VALUE_UNIT).and_then(|it| metres(it.1.trim_matches('"')));
        let factor = || {
            self.0.iter().find_map(|(name, value)| {
                let unit = name.strip_prefix("height conversion factor (->")?.strip_suffix(')')?;
                Some(value.parse::<f64>().ok()? * metres(unit)?)
            })
        };
        named.or_else(factor)
    }
}

/// Metres in the unit of a line that names heights alone, such as `Z-data (um)`.
fn unit_of_label(line: &str) -> Option<f64> {
    let line = line.trim_start_matches(['#', '%']).trim().trim_matches('"');
    let name = plain(line);
    let is_label = !line.contains([',', ';', '\t', ':', '=']) && NAMES_OF_HEIGHTS.iter().any(|it| name.starts_with(it));
    let is_alone = line.matches(['(', '[']).count() <= 1 && line.matches(" in ").count() <= 1;
    unit_of(line).filter(|_| is_label && is_alone)
}

/// Metres in the units of columns: in round or square brackets after their names, as the last words of their names, as in `x in µm`, or alone on
/// a line, such as `µm nm`; none where there are no units.
fn column_units(line: &str, columns: usize) -> Vec<Option<f64>> {
    let line = line.trim_start_matches(['#', '%']).trim();
    let names: Vec<&str> = line.split([',', ';', '\t']).collect();
    let each: Vec<_> = names.iter().map(|name| in_brackets(name).pop().flatten()).collect();
    if names.len() > 1 && each.iter().any(Option::is_some) {
        return each;
    }
    let all = [in_brackets(line), last_words(&names), behind_names(line)];
    if let Some(units) = all.into_iter().find(|it| it.len() == columns) {
        return units;
    }
    let alone: Vec<_> = line.split([' ', ',', ';', '\t']).filter(|word| !word.is_empty()).map(metres).collect();
    if alone.iter().all(Option::is_some) { alone } else { each.into_iter().filter(Option::is_some).collect() }
}

/// Metres in a word that is a unit, and hardly another word.
fn unit_word(word: &str) -> Option<f64> {
    metres(word).filter(|_| !["A", "in"].contains(&word))
}

/// Metres in the units in all brackets of a text; nothing if none of them is a unit of length.
fn in_brackets(text: &str) -> Vec<Option<f64>> {
    let parts = text.split(['(', '[']).skip(1).filter_map(|part| part.split_once([')', ']']));
    let units: Vec<_> = parts.map(|it| metres(it.0)).collect();
    if units.iter().any(Option::is_some) { units } else { Vec::new() }
}

/// Metres in the units that all names of several words end in, such as `Lateral um`; nothing if one ends otherwise, or none has several words.
fn last_words(names: &[&str]) -> Vec<Option<f64>> {
    let unit = |name: &&str| name.trim().trim_matches('"').rsplit_once(char::is_whitespace).map(|it| unit_word(it.1));
    let units: Vec<_> = names.iter().map(unit).collect();
    let is_known = units.iter().flatten().all(Option::is_some) && units.iter().any(Option::is_some);
    if is_known { units.into_iter().map(Option::flatten).collect() } else { Vec::new() }
}

/// Metres in the units among the words of a line, each behind a name, as in `x in µm z in nm`.
fn behind_names(line: &str) -> Vec<Option<f64>> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let is_behind = |pair: &&[&str]| unit_word(pair[0]).is_none() && unit_word(pair[1]).is_some();
    words.windows(2).filter(is_behind).map(|pair| metres(pair[1])).collect()
}

/// The names of so many columns, if a line has them: parted by commas, semicolons and tabs, or by white space, where units in brackets are no names.
fn column_names(line: &str, columns: usize) -> Option<Vec<String>> {
    let line = line.trim_start_matches(['#', '%']).trim();
    let bare = |name: &str| name.trim().trim_matches('"').trim().to_owned();
    let parted: Vec<String> = line.trim_end_matches([',', ';', '\t']).split([',', ';', '\t']).map(bare).collect();
    let words = line.split_whitespace().filter(|word| !word.starts_with(['(', '[']));
    let names = if parted.len() == columns { parted } else { words.map(bare).collect() };
    let is_name =
        |name: &String| name.is_empty() || (name.starts_with(char::is_alphabetic) && !name.contains([':', '=']));
    (names.len() == columns && names.iter().all(is_name) && names.iter().any(|it| !it.is_empty())).then_some(names)
}
