//! Files of HDF5: their datasets by their paths, with attributes and numbers.

use super::bytes::{ByteReader, latin};
use super::format::malformed;
use super::limits::{HDF5_DEPTH, HDF5_LINKS, HDF5_OBJECT_HEADER, LARGEST_RATIO, TAG_TEXT, check_points};
use super::number_type::NumberType;
use hdf5_reader::btree_v1::collect_btree_v1_leaves_storage;
use hdf5_reader::btree_v2::BTreeV2Header;
use hdf5_reader::error::Result;
use hdf5_reader::group::Group;
use hdf5_reader::io::Cursor;
use hdf5_reader::messages::HdfMessage;
use hdf5_reader::{
    ByteOrder, Dataset, Datatype, Hdf5File, OpenOptions, ReferenceType, StringSize, VarLenKind, dtype_element_size,
};
use std::io;

/// The first bytes of a file of HDF5.
pub(super) const MAGIC: &[u8] = b"\x89HDF\r\n\x1a\n";
/// The most attributes of a dataset that are read.
const ATTRIBUTES: usize = 128;
/// The most texts and numbers of an attribute that are read: those that say what heights mean have a few.
const MOST_ITEMS: usize = 16;
/// The most bytes of a dataset of records: the links of Zygo Mx have a few thousand.
const MOST_RECORD_BYTES: usize = 1 << 20;
/// Where the number of symbols is in a node of symbols.
const SYMBOLS: u64 = 6;
/// Where sign, exponent and fraction of single and double precision are in the description of a type, the least significant byte first: offset
/// and number of bits, place and bits of the exponent and of the fraction, and the bias of the exponent. Other formats of floating point exist.
const IEEE_SINGLE: [u8; 12] = [0, 0, 32, 0, 23, 8, 0, 23, 127, 0, 0, 0];
const IEEE_DOUBLE: [u8; 12] = [0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0];

/// A file of HDF5.
///
/// # Source
/// "HDF5 File Format Specification Version 3.0" (The HDF Group), as the crate `hdf5-reader` reads it: chunks that are packed with deflate,
/// shuffle, szip, nbit and scale-offset, check sums, and all versions of headers and indices. External files are not opened.
pub(super) struct HdfFile {
    file: Hdf5File,
    /// Its bytes.
    length: usize,
}

impl HdfFile {
    /// # Errors
    /// For a file that is damaged at its start.
    pub(crate) fn new(bytes: &[u8]) -> io::Result<Self> {
        // Nothing can unpack to more than this, except for points that were never written.
        let largest = bytes.len().saturating_mul(LARGEST_RATIO);
        let options = OpenOptions::default()
            .with_chunk_cache_bytes(0)
            .with_max_chunk_bytes(largest)
            .with_max_read_bytes(largest)
            .with_max_object_header_bytes(HDF5_OBJECT_HEADER);
        let file = Hdf5File::from_bytes_with_options(bytes, options).map_err(damaged)?;
        // Without its end, a file may lose units and voids only, which nobody would notice.
        let end = file.superblock().eof_address;
        if end > bytes.len() as u64 {
            return Err(malformed(format!("it states {end} bytes, but has only {}: it is incomplete", bytes.len())));
        }
        Ok(Self { file, length: bytes.len() })
    }

    /// All datasets by their paths, such as `group/name`, in each group by name, and those of a group before those of groups in it. A group
    /// that is damaged is listed as one fault. Each dataset is listed once, whatever leads to it.
    ///
    /// # Errors
    /// For groups in too many groups, and for too many links.
    pub(crate) fn datasets(&self) -> io::Result<Vec<(String, io::Result<Dataset>)>> {
        let root = self.file.root_group().map_err(damaged)?;
        let (mut known, mut links) = (vec![root.address()], 0);
        let (mut groups, mut found) = (vec![(String::new(), 0, root)], Vec::new());
        while let Some((path, depth, group)) = groups.pop() {
            let members = self.members(&group, &mut links)?;
            let (mut inner, mut datasets) = match members {
                Ok(names) => names,
                Err(error) => {
                    found.push((path, Err(damaged(error))));
                    continue;
                }
            };
            // In the file, names follow each other as the version of the library has put them.
            inner.sort();
            datasets.sort();
            for name in datasets {
                let dataset = group.dataset(&name).map_err(damaged);
                if dataset.as_ref().map_or(true, |it| is_new(&mut known, it.address())) {
                    found.push((joined(&path, &name), dataset));
                }
            }
            for name in inner.iter().rev() {
                // A link may lead back to a group around it, so that a walk that did not look would never end.
                let Ok(next) = group.group(name) else { continue };
                if !is_new(&mut known, next.address()) {
                    continue;
                }
                if depth == HDF5_DEPTH {
                    return Err(malformed(format!("its groups are nested more than {HDF5_DEPTH} times")));
                }
                groups.push((joined(&path, name), depth + 1, next));
            }
        }
        Ok(found)
    }

    /// The names of the groups and of the datasets in a group, whose links are added to those of the file so far.
    fn members(&self, group: &Group, links: &mut u64) -> io::Result<Result<(Vec<String>, Vec<String>)>> {
        // Soft links are paths through other links, so that a short file may lead its reader through millions of them.
        let stated = self.links(group);
        *links = links.saturating_add(*stated.as_ref().unwrap_or(&0));
        if *links > HDF5_LINKS {
            return Err(malformed(format!("it has {links} groups and datasets, but at most {HDF5_LINKS} are read")));
        }
        Ok(stated.and_then(|_| group.member_names()))
    }

    /// The number of links in a group, as its header, its index or, for groups of the older kind, the nodes of its symbols say it.
    fn links(&self, group: &Group) -> Result<u64> {
        let (storage, offset_size, length_size) = (self.file.storage(), group.offset_size(), group.length_size());
        let mut count: u64 = 0;
        for message in &self.file.get_or_parse_header(group.address())?.messages {
            match message {
                HdfMessage::Link(_) => count += 1,
                HdfMessage::LinkInfo(info) if !Cursor::is_undefined_offset(info.fractal_heap_address, offset_size) => {
                    let index = info.btree_name_index_address;
                    let index = BTreeV2Header::parse_at_storage(storage, index, offset_size, length_size)?;
                    count = count.saturating_add(index.total_records);
                }
                HdfMessage::SymbolTable(table) => {
                    let tree = table.btree_address;
                    let nodes =
                        collect_btree_v1_leaves_storage(storage, tree, offset_size, length_size, None, &[], None)?;
                    for (_, node) in nodes {
                        let symbols = storage.read_range(node.saturating_add(SYMBOLS), 2)?;
                        count += u64::from(Cursor::new(&symbols).read_u16_le()?);
                    }
                }
                _ => (),
            }
        }
        Ok(count)
    }

    /// The rows of a dataset of records, each with the texts and the numbers in it.
    ///
    /// # Errors
    /// For a dataset that is damaged, and for one that is too long.
    pub(crate) fn records(dataset: &Dataset) -> io::Result<Vec<AttributeValue>> {
        let length = dataset.raw_byte_len().map_err(damaged)?;
        if length > MOST_RECORD_BYTES {
            return Err(malformed(format!(
                "its dataset of links has {length} bytes, but at most {MOST_RECORD_BYTES} are read"
            )));
        }
        let size = dataset.raw_element_size().map_err(damaged)?.max(1);
        let bytes = dataset.read_raw_bytes().map_err(damaged)?;
        bytes.chunks(size).map(|row| AttributeValue::new(dataset, dataset.dtype(), row)).collect()
    }

    /// The array of numbers in a dataset, none for one of another rank or of something else than numbers.
    ///
    /// # Errors
    /// For more points than the file can hold or memory has room for, and for numbers of an unusual kind.
    pub(crate) fn array(&self, path: &str, dataset: Dataset) -> io::Result<Option<NumberArray>> {
        let is_number = matches!(dataset.dtype(), Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. });
        // Axes of one point are no axes of a map: NetCDF and NeXus write a map as one of a series in time.
        let axes: Vec<usize> = (0..dataset.ndim()).filter(|axis| dataset.shape()[*axis] != 1).collect();
        let (rows, columns) = match axes[..] {
            [along] => (1, dataset.shape()[along]),
            [across, along] => (dataset.shape()[across], dataset.shape()[along]),
            _ => return Ok(None),
        };
        if !is_number || rows == 0 || columns == 0 {
            return Ok(None);
        }
        let shape = [rows, columns].map(|count| usize::try_from(count).unwrap_or(usize::MAX));
        check_points(&shape)?;
        let kind = NumberKind::new(&dataset)?;
        let needed = shape[0].saturating_mul(shape[1]).saturating_mul(kind.number.size());
        if needed > self.length.saturating_mul(LARGEST_RATIO) {
            let length = self.length;
            return Err(malformed(format!(
                "it states {rows} x {columns} points, but the file has only {length} bytes"
            )));
        }
        let attributes = attributes(&dataset)?;
        Ok(Some(NumberArray { path: path.to_owned(), shape, axes, kind, attributes, dataset }))
    }
}

/// Whether an address is not known yet; from now on it is.
fn is_new(known: &mut Vec<u64>, address: u64) -> bool {
    let is_new = !known.contains(&address);
    if is_new {
        known.push(address);
    }
    is_new
}

/// The path of something in a group.
fn joined(group: &str, name: &str) -> String {
    if group.is_empty() { name.to_owned() } else { format!("{group}/{name}") }
}

/// The error of a damaged file, in the words of the library.
fn damaged(error: hdf5_reader::error::Error) -> io::Error {
    malformed(format!("it is damaged or not supported HDF5: {error}"))
}

/// The attributes of a dataset.
fn attributes(dataset: &Dataset) -> io::Result<Vec<HdfAttribute>> {
    let all = dataset.raw_attributes().map_err(damaged)?;
    let read = all.into_iter().take(ATTRIBUTES).map(|it| {
        let (message, _) = it.into_parts();
        let value = AttributeValue::new(dataset, &message.datatype, &message.raw_data)?;
        Ok(HdfAttribute { name: message.name, value })
    });
    read.collect()
}

/// An attribute of a dataset.
pub(super) struct HdfAttribute {
    pub name: String,
    pub value: AttributeValue,
}

/// The texts, the numbers and the references of an attribute or a record, each in the order in which they are stored.
#[derive(Default)]
pub(super) struct AttributeValue {
    pub texts: Vec<String>,
    pub numbers: Vec<f64>,
    /// Addresses of datasets and groups.
    pub references: Vec<u64>,
}

impl AttributeValue {
    /// The value in the bytes of one or several elements. What is of another type is left out.
    ///
    /// # Errors
    /// For a reference to a text or a list that is not there: without a unit, heights would be taken for others.
    fn new(dataset: &Dataset, kind: &Datatype, bytes: &[u8]) -> io::Result<Self> {
        let mut value = Self::default();
        value.add_all(dataset, kind, bytes)?;
        Ok(value)
    }

    /// Adds all elements of a type.
    fn add_all(&mut self, dataset: &Dataset, kind: &Datatype, bytes: &[u8]) -> io::Result<()> {
        match dtype_element_size(kind).unwrap_or(0) {
            0 => Ok(()),
            size => bytes.chunks_exact(size).take(MOST_ITEMS).try_for_each(|element| self.add(dataset, kind, element)),
        }
    }

    /// Adds what an element holds.
    fn add(&mut self, dataset: &Dataset, kind: &Datatype, bytes: &[u8]) -> io::Result<()> {
        if self.texts.len() + self.numbers.len() + self.references.len() >= MOST_ITEMS {
            return Ok(());
        }
        match kind {
            Datatype::Compound { fields, .. } => {
                for field in fields {
                    let size = dtype_element_size(&field.datatype).unwrap_or(0);
                    let start = field.byte_offset as usize;
                    if let Some(part) = bytes.get(start..start.saturating_add(size)) {
                        self.add(dataset, &field.datatype, part)?;
                    }
                }
            }
            Datatype::Array { base, .. } => self.add_all(dataset, base, bytes)?,
            Datatype::String { size: StringSize::Fixed(_), .. } => self.add_text(bytes),
            Datatype::String { .. } | Datatype::VarLen { kind: VarLenKind::String, .. } => {
                self.add_text(&dataset.resolve_vlen_reference_bytes(bytes, 1).map_err(damaged)?);
            }
            Datatype::VarLen { base, .. } => {
                let size = dtype_element_size(base).map_err(damaged)?;
                let inner = dataset.resolve_vlen_reference_bytes(bytes, size).map_err(damaged)?;
                self.add_all(dataset, base, &inner)?;
            }
            Datatype::Reference { ref_type: ReferenceType::Object, size: 8 } => {
                self.references.push(ByteReader::new(bytes).u64()?);
            }
            _ => {
                if let Some((number, is_big)) = number_type(kind) {
                    self.numbers.push(number.read(&mut ByteReader::new(bytes).big_endian(is_big))?);
                }
            }
        }
        Ok(())
    }

    fn add_text(&mut self, bytes: &[u8]) {
        let text = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
        self.texts.push(latin(&text[..text.len().min(TAG_TEXT)]).trim().to_owned());
    }

    /// Its first text, empty if it has none.
    pub(crate) fn text(&self) -> &str {
        self.texts.first().map_or("", String::as_str)
    }

    /// The value for people.
    fn words(&self) -> String {
        let numbers = self.numbers.iter().map(f64::to_string);
        self.texts.iter().cloned().chain(numbers).collect::<Vec<_>>().join(" ")
    }
}

/// The type of numbers, and whether their first byte is the most significant one.
fn number_type(kind: &Datatype) -> Option<(NumberType, bool)> {
    let (number, order) = match kind {
        Datatype::FixedPoint { size, signed, byte_order } => {
            let number = match (size, signed) {
                (1, false) => NumberType::U8,
                (1, true) => NumberType::I8,
                (2, false) => NumberType::U16,
                (2, true) => NumberType::I16,
                (4, false) => NumberType::U32,
                (4, true) => NumberType::I32,
                (8, false) => NumberType::U64,
                (8, true) => NumberType::I64,
                _ => return None,
            };
            (number, byte_order)
        }
        Datatype::FloatingPoint { size: 4, byte_order } => (NumberType::F32, byte_order),
        Datatype::FloatingPoint { size: 8, byte_order } => (NumberType::F64, byte_order),
        _ => return None,
    };
    Some((number, *order == ByteOrder::BigEndian))
}

/// How the numbers of an array are stored.
#[derive(Clone, Copy)]
struct NumberKind {
    number: NumberType,
    is_big: bool,
}

impl NumberKind {
    /// # Errors
    /// For numbers that do not fill their bytes, and for other floating point than single and double precision.
    fn new(dataset: &Dataset) -> io::Result<Self> {
        let raw = dataset.raw_datatype().map_err(damaged)?;
        let (found, layout) = (number_type(dataset.dtype()), raw.get(8..).unwrap_or_default());
        let is_plain = found.is_some_and(|(number, _)| match number {
            NumberType::F32 => layout.starts_with(&IEEE_SINGLE),
            NumberType::F64 => layout.starts_with(&IEEE_DOUBLE),
            _ => layout.starts_with(&[0, 0, 8 * number.size() as u8, 0]),
        });
        match found {
            Some((number, is_big)) if is_plain => Ok(Self { number, is_big }),
            _ => Err(malformed(
                "its numbers are neither integers of 1, 2, 4 or 8 bytes nor of single or double precision: save them as doubles",
            )),
        }
    }
}

/// An array of numbers along one or two axes.
pub(super) struct NumberArray {
    pub path: String,
    /// Rows and columns; an array along one axis has one row.
    pub shape: [usize; 2],
    /// Which of the axes of the dataset have more than one point.
    axes: Vec<usize>,
    kind: NumberKind,
    pub attributes: Vec<HdfAttribute>,
    dataset: Dataset,
}

impl NumberArray {
    pub(crate) fn is_profile(&self) -> bool {
        self.axes.len() == 1
    }

    /// Its place in the file, by which others refer to it.
    pub(crate) fn address(&self) -> u64 {
        self.dataset.address()
    }

    /// The addresses of the coordinates along its axes of more than one point, the slow one first; none if it does not state them all.
    pub(crate) fn coordinates(&self) -> Option<Vec<u64>> {
        let scales = &self.attribute("DIMENSION_LIST")?.references;
        // With several scales for an axis, the list does not say where those of the next one begin once it is flat.
        (scales.len() == self.dataset.ndim()).then(|| self.axes.iter().map(|axis| scales[*axis]).collect())
    }

    /// The value of an attribute.
    pub(crate) fn attribute(&self, name: &str) -> Option<&AttributeValue> {
        self.attributes.iter().find(|it| it.name == name).map(|it| &it.value)
    }

    /// The last part of its path.
    pub(crate) fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or_default()
    }

    /// The first text of an attribute, empty if it has none.
    pub(crate) fn text(&self, name: &str) -> &str {
        self.attribute(name).map_or("", AttributeValue::text)
    }

    /// The first number of an attribute.
    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        self.attribute(name)?.numbers.first().copied()
    }

    /// The attributes that can be shown: names and values.
    pub(crate) fn header(&self) -> Vec<(String, String)> {
        let shown = self.attributes.iter().map(|it| (it.name.clone(), it.value.words()));
        shown.filter(|(_, words)| !words.is_empty()).collect()
    }

    /// A function that reads the numbers row by row, NaN where a number is equal to `void` or to the value of an attribute of the names `voids`.
    pub(crate) fn values(&self, voids: &[&str], void: Option<f64>) -> impl FnOnce() -> io::Result<Vec<f64>> + use<> {
        let (dataset, NumberKind { number, is_big }) = (self.dataset.clone(), self.kind);
        let length = self.shape[0] * self.shape[1] * number.size();
        // The mark of a void may be a double where the points are single.
        let rounded = move |value: f64| if number == NumberType::F32 { f64::from(value as f32) } else { value };
        let voids: Vec<f64> = voids.iter().filter_map(|name| self.number(name)).chain(void).map(rounded).collect();
        move || {
            let bytes = dataset.read_raw_bytes().map_err(damaged)?;
            if bytes.len() != length {
                return Err(malformed(format!("its points have {} bytes, not {length}", bytes.len())));
            }
            let value = |bytes: &[u8]| {
                let value = number.read(&mut ByteReader::new(bytes).big_endian(is_big))?;
                Ok(if voids.contains(&value) { f64::NAN } else { value })
            };
            bytes.chunks_exact(number.size()).map(value).collect()
        }
    }
}
