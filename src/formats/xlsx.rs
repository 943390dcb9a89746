//! The workbooks of Mitutoyo's roughness testers SurfTest.

use super::archive::{self, Archive};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::unit::metres;
use roxmltree::Node;
use std::collections::HashMap;
use std::io;

/// An Office Open XML workbook with two sheets: `DATA` has positions in column E, heights in column F, and in column A results such as
/// `Ra 0.018 µm`, in whose unit the heights are; `Certificate` has the date in E2 and the cut-off in E48, in whose unit the positions are. A row
/// with a position whose height is not a number is void. Other workbooks are refused.
///
/// # Source
/// ECMA-376 for workbooks, of which only values of cells are read; SurfaceTopography 1.27 (`Mitutoyo.py`) for what the cells mean.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Mitutoyo SurfTest (XLSX)", is_it, channels };

/// The files that name the sheets, say where they are, and have texts of cells.
const WORKBOOK: &str = "xl/workbook.xml";
const LINKS: &str = "xl/_rels/workbook.xml.rels";
const TEXTS: &str = "xl/sharedStrings.xml";
/// Rows of a sheet that are searched for results.
const RESULTS: usize = 64;
/// Letters of a text that many cells may share.
const LONGEST: usize = 256;

fn is_it(bytes: &[u8]) -> bool {
    archive::names(bytes, WORKBOOK)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut workbook = Workbook::new(bytes)?;
    let [data, certificate] = [workbook.sheet("DATA", "AEF")?, workbook.sheet("Certificate", "E")?];
    let number = |row: &u32, column: char| data.get(&(*row, column)).and_then(|it| it.parse::<f64>().ok());
    let mut rows: Vec<u32> = data.keys().filter(|it| it.1 == 'E').map(|it| it.0).collect();
    rows.sort_unstable();
    rows.retain(|row| number(row, 'E').is_some());
    let positions: Vec<f64> = rows.iter().filter_map(|row| number(row, 'E')).collect();
    let heights: Vec<f64> = rows.iter().map(|row| number(row, 'F').unwrap_or(f64::NAN)).collect();
    if positions.is_empty() {
        return Err(malformed("its sheet DATA has no positions in column E"));
    }
    let cut_off =
        certificate.get(&(48, 'E')).ok_or_else(|| malformed("its sheet Certificate has no cut-off in E48"))?;
    let lateral_unit = unit(cut_off)?;
    let results = (1..=RESULTS as u32).map_while(|row| data.get(&(row, 'A')));
    let results: Vec<(String, String)> = results.filter_map(|it| result(it)).collect();
    let height_unit = results.first().map_or(Ok(lateral_unit), |it| unit(&it.1))?;
    let date = certificate.get(&(2, 'E')).map(|it| ("Date".to_owned(), it.clone()));
    let header = date.into_iter().chain([("Cut-off".to_owned(), cut_off.clone())]).chain(results).collect();
    let shape = [1, positions.len()];
    Ok(vec![Channel {
        is_profile: true,
        positions: Some(positions),
        lateral_unit: Some(lateral_unit),
        unit: Some(height_unit),
        header,
        ..Channel::map("height", shape, move || Ok(heights))
    }])
}

/// Name and value of a result such as `Ra 0.018 µm`.
fn result(text: &str) -> Option<(String, String)> {
    let (name, value) = text.trim().split_once(char::is_whitespace)?;
    Some((name.to_owned(), value.split_whitespace().collect::<Vec<_>>().join(" ")))
}

/// Metres in the unit behind a number, as in `0.08mm`.
fn unit(value: &str) -> io::Result<f64> {
    let unit = value.trim().trim_start_matches(|letter: char| letter.is_ascii_digit() || "+-. ".contains(letter));
    metres(unit).ok_or_else(|| malformed(format!("its value {value:?} has no unit of length")))
}

/// Values of cells by row and column.
type SheetCells = HashMap<(u32, char), String>;

struct Workbook<'a> {
    archive: Archive<'a>,
    /// Bytes of the file.
    length: usize,
    texts: Vec<String>,
}

impl<'a> Workbook<'a> {
    fn new(bytes: &'a [u8]) -> io::Result<Self> {
        let mut workbook = Self { archive: archive::open(bytes)?, length: bytes.len(), texts: Vec::new() };
        if workbook.archive.index_for_name(TEXTS).is_some() {
            workbook.texts =
                workbook.with(TEXTS, |root| Ok(elements(root, "si").map(text).map(shortened).collect()))?;
        }
        Ok(workbook)
    }

    /// What is read of the document in a file.
    fn with<T>(&mut self, name: &str, read: impl FnOnce(Node) -> io::Result<T>) -> io::Result<T> {
        let text = archive::text(&mut self.archive, name, self.length)?;
        let document = archive::document(&text, name)?;
        read(document.root_element())
    }

    /// The cells of some columns of a sheet that have a value.
    fn sheet(&mut self, name: &str, columns: &str) -> io::Result<SheetCells> {
        let missing = || {
            malformed(format!(
                "it is a workbook without a sheet {name}, not one of Mitutoyo SurfTest: save its numbers as text or CSV"
            ))
        };
        let id = self.with(WORKBOOK, |root| {
            let mut sheets = root.descendants().filter(|it| it.tag_name().name() == "sheet");
            let sheet = sheets.find(|it| it.attribute("name") == Some(name));
            Ok(sheet.and_then(|it| Some(it.attributes().find(|it| it.name() == "id")?.value().to_owned())))
        })?;
        let id = id.ok_or_else(missing)?;
        let target = self.with(LINKS, |root| {
            let link = elements(root, "Relationship").find(|it| it.attribute("Id") == Some(id.as_str()));
            Ok(link.and_then(|it| it.attribute("Target")).map(str::to_owned))
        })?;
        let target = target.ok_or_else(missing)?;
        let target = target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_owned);
        let texts = std::mem::take(&mut self.texts);
        let cells = self.with(&target, |root| {
            let cells = root.descendants().filter(|it| it.tag_name().name() == "c");
            Ok(cells.filter_map(|cell| Some((place(cell, columns)?, value(cell, &texts)?))).collect())
        });
        self.texts = texts;
        cells
    }
}

/// The elements of a name in another one.
fn elements<'a, 'b>(node: Node<'a, 'b>, name: &str) -> impl Iterator<Item = Node<'a, 'b>> {
    node.children().filter(move |it| it.tag_name().name() == name)
}

/// All text in an element.
fn text(node: Node) -> String {
    node.descendants().filter(|it| it.tag_name().name() == "t").filter_map(|it| it.text()).collect()
}

/// The first letters of a text that many cells may share.
fn shortened(text: String) -> String {
    if text.len() > LONGEST { text.chars().take(LONGEST).collect() } else { text }
}

/// Row and column of a cell, if it is in one of some columns.
fn place(cell: Node, columns: &str) -> Option<(u32, char)> {
    let place = cell.attribute("r")?;
    let column = place.chars().next().filter(|it| columns.contains(*it))?;
    Some((place[1..].parse().ok()?, column))
}

/// The value of a cell.
fn value(cell: Node, texts: &[String]) -> Option<String> {
    match cell.attribute("t") {
        Some("inlineStr") => Some(text(cell)),
        Some("s") => texts.get(elements(cell, "v").next()?.text()?.trim().parse::<usize>().ok()?).cloned(),
        _ => elements(cell, "v").next()?.text().map(str::to_owned),
    }
}
