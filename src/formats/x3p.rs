//! Surfaces and profiles in archives with a description in XML.

use super::archive::{self, Archive, bytes_of, damaged, missing};
use super::axis::{CoordinateAxis, CoordinateType, child, find, number};
use super::bytes::{latin, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::{LARGEST_RATIO, SHORT_TEXT, XML_ATTRIBUTES, text_limit};
use md5::{Context, Digest};
use roxmltree::Node;
use std::io::{self, Read};

/// An archive whose `main.xml` describes three axes and the numbers of points along them, and holds the points as a list or names a file
/// of the archive with them, x fastest, then y, the least significant byte first. Only coordinates along absolute axes are stored, and
/// a coordinate in metres is offset plus number times increment, which is 1 for floating
/// point numbers if it is not there; without the increments of axes that are not stored there are no distances. Void points are NaN, empty in a list, or those whose bit in a file of
/// valid points, the least significant bit first, is zero. Points whose MD5 check sum is not that of the description are refused; a description
/// that was changed after its own sum was made is read, with a doubt.
///
/// # Source
/// ISO 25178-72:2017 and ISO 5436-2:2012, and the published schema and descriptions of openGPS. Layers, point clouds and surfaces that are
/// not on a grid are refused.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "ISO 25178-72 (X3P)", is_it, channels };

/// The name of the description.
const MAIN: &str = "main.xml";
/// The name of the file with the check sum of the description.
const SUM: &str = "md5checksum.hex";
/// Points that are unpacked at a time.
const PIECE: usize = 1 << 16;
/// Entries of a record, and of one of its entries, that are shown.
const SHOWN: usize = 64;

fn is_it(bytes: &[u8]) -> bool {
    archive::names(bytes, MAIN)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut archive = archive::open(bytes)?;
    let (text, found) = description(&mut archive, bytes.len() as u64)?;
    let sum = archive.by_name(SUM).ok().map(|sum| bytes_of(sum, SHORT_TEXT)).transpose()?;
    let document = archive::document(&text, MAIN)?;
    let root = document.root_element();
    let surface = DescribedSurface::new(root, bytes.len().saturating_mul(LARGEST_RATIO))?;
    let doubts = sum
        .filter(|sum| !is_sum(found, &latin(sum)))
        .map(|_| format!("the check sum in {SUM} does not fit the {MAIN}: it was changed after it was written"));
    let channel = surface.channel(archive, header(root))?;
    Ok(vec![Channel { doubts: channel.doubts.into_iter().chain(doubts).collect(), ..channel }])
}

/// Whether a text such as `d41d...427e *main.xml` begins with a check sum. One that begins with no sum says nothing.
fn is_sum(sum: Digest, text: &str) -> bool {
    let word = text.split_whitespace().next().unwrap_or_default();
    let is_hexadecimal = word.len() == 32 && word.bytes().all(|it| it.is_ascii_hexdigit());
    !is_hexadecimal || word.eq_ignore_ascii_case(&format!("{sum:x}"))
}

/// The text of the description, and its check sum.
fn description(archive: &mut Archive, length: u64) -> io::Result<(String, Digest)> {
    let limit = text_limit(length);
    let text = bytes_of(archive.by_name(MAIN).map_err(damaged)?, limit)?;
    match text.iter().filter(|byte| **byte == b'=').count() {
        ..=XML_ATTRIBUTES => Ok((latin(&text), md5::compute(&text))),
        count => Err(malformed(format!("its {MAIN} has {count} attributes, more than {XML_ATTRIBUTES}"))),
    }
}

/// The first elements in an element.
fn elements<'a, 'b>(node: &Node<'a, 'b>) -> impl Iterator<Item = Node<'a, 'b>> {
    node.children().filter(Node::is_element).take(SHOWN)
}

/// What the description says of the measurement.
fn header(root: Node) -> Vec<(String, String)> {
    let entry = |prefix: &str, node: Node| {
        let value = node.text().unwrap_or_default().trim();
        (!value.is_empty()).then(|| (format!("{prefix}{}", node.tag_name().name()), value.to_owned()))
    };
    let pair = |path: &str| Some((path.rsplit_once('/')?.1.to_owned(), find(root, path)?.to_owned()));
    let mut header: Vec<_> = ["Record1/Revision", "Record1/FeatureType"].into_iter().filter_map(pair).collect();
    for node in child(root, "Record2").iter().flat_map(elements) {
        header.extend(entry("", node));
        let prefix = format!("{}/", node.tag_name().name());
        header.extend(elements(&node).filter_map(|it| entry(&prefix, it)));
    }
    header
}

/// Where the points are.
enum PointStorage {
    /// In the description: one text for each.
    List(Vec<String>),
    /// In files of the archive: coordinates and valid points.
    Files(Link, Option<Link>),
}

/// A file of the archive by its name, and its check sum in MD5 if the description says it.
struct Link {
    name: String,
    sum: Option<String>,
}

impl Link {
    /// The link and its sum at paths of names in the third record; none where there is no name.
    fn find(record: Node, name: &str, sum: &str) -> Option<Self> {
        let name = find(record, name).filter(|it| !it.is_empty())?.to_owned();
        Some(Self { name, sum: find(record, sum).map(str::to_owned) })
    }

    /// Unpacks pieces of a file, each of a whole number of points of `size` bytes, `count` points in all, and checks the check sums.
    fn unpack(
        &self,
        archive: &mut Archive,
        count: usize,
        size: usize,
        mut each: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut file = archive.by_name(&self.name).map_err(missing(&self.name))?;
        let (mut sum, mut left, mut piece) = (Context::new(), count, Vec::new());
        while left > 0 {
            let points = left.min(PIECE);
            piece.resize(points * size, 0);
            file.read_exact(&mut piece).map_err(damaged)?;
            sum.consume(&piece);
            each(&piece)?;
            left -= points;
        }
        // an archive compares its own check sum at the end of a file; more than the points is left to a doubt
        let is_at_end = file.read(&mut [0]).map_err(damaged)? == 0;
        match &self.sum {
            Some(stated) if is_at_end && !is_sum(sum.finalize(), stated) => Err(malformed(format!(
                "the MD5 check sum of its file {:?} differs from that in its {MAIN}: the points were changed or damaged",
                self.name
            ))),
            _ => Ok(()),
        }
    }
}

/// A surface or profile as the description has it.
struct DescribedSurface {
    is_profile: bool,
    shape: [usize; 2],
    axes: [CoordinateAxis; 3],
    points: PointStorage,
}

impl DescribedSurface {
    /// The surface of a description whose archive unpacks to at most `bytes` bytes.
    fn new(root: Node, bytes: usize) -> io::Result<Self> {
        let missing = |what: &str| malformed(format!("its {MAIN} has no {what}"));
        let record = |name: &str| child(root, name).ok_or_else(|| missing(name));
        let [first, third] = [record("Record1")?, record("Record3")?];
        let feature = find(first, "FeatureType").unwrap_or_default();
        let is_profile = feature == "PRF";
        if !is_profile && feature != "SUR" {
            return Err(malformed(format!(
                "it contains {feature:?}, which is neither a surface (SUR) nor a profile (PRF)"
            )));
        }
        let axes = child(first, "Axes").ok_or_else(|| missing("Axes"))?;
        let axes =
            [CoordinateAxis::new(axes, "CX")?, CoordinateAxis::new(axes, "CY")?, CoordinateAxis::new(axes, "CZ")?];
        let link = |name: &str, sum: &str| Link::find(third, &format!("DataLink/{name}"), &format!("DataLink/{sum}"));
        let points = match (link("PointDataLink", "MD5ChecksumPointData"), child(third, "DataList")) {
            (Some(points), _) => PointStorage::Files(points, link("ValidPointsLink", "MD5ChecksumValidPoints")),
            (None, Some(list)) => PointStorage::List(data(list)),
            (None, None) => return Err(missing("DataLink and no DataList")),
        };
        let size: usize = axes.iter().filter_map(|it| it.kind).map(CoordinateType::size).sum();
        let shape = match points {
            PointStorage::List(ref list) => shape(third, 1, list.len())?,
            PointStorage::Files(..) => shape(third, size.max(1), bytes)?,
        };
        let surface = Self { is_profile, shape, axes, points };
        surface.checked()
    }

    /// The same surface if it is one that is read here.
    fn checked(self) -> io::Result<Self> {
        match (self.is_profile, self.shape, self.axes.map(|it| it.kind)) {
            (_, _, [_, _, None]) => Err(malformed("its axis CZ is incremental and has no heights")),
            (false, _, [Some(_), _, _] | [_, Some(_), _]) => {
                Err(malformed("its surface has axes CX and CY that are not both incremental"))
            }
            (true, [rows, _], _) if rows > 1 => Err(malformed(format!("its profile has {rows} rows"))),
            _ => Ok(self),
        }
    }

    /// The channel of the surface; positions of a profile that is not even are read at once.
    fn channel(self, mut archive: Archive<'_>, header: Vec<(String, String)>) -> io::Result<Channel<'_>> {
        let [x, y, _] = self.axes;
        let (shape, is_profile) = (self.shape, self.is_profile);
        let positions = x.kind.is_some().then(|| self.coordinates(&mut archive, 0)).transpose()?;
        let along = if is_profile { x } else { y };
        // without increments the file says no size: 1 m, which programs fill in, is none
        let spacing = along.increment.zip(x.increment).map(|(dy, dx)| [dy, dx]).filter(|_| positions.is_none());
        let doubts = self.doubt(&mut archive)?.into_iter().collect();
        let values = move || self.coordinates(&mut archive, 2);
        let [lateral_unit, unit] = [Some(1.0); 2];
        Ok(Channel {
            is_profile,
            positions,
            spacing,
            lateral_unit,
            unit,
            header,
            doubts,
            ..Channel::map("height", shape, values)
        })
    }

    /// The coordinates of all points along an absolute axis, NaN for void points.
    fn coordinates(&self, archive: &mut Archive, axis: usize) -> io::Result<Vec<f64>> {
        match &self.points {
            PointStorage::List(list) => list.iter().take(self.count()).map(|point| self.listed(point, axis)).collect(),
            PointStorage::Files(link, valid) => {
                let mut coordinates = self.stored(archive, link, axis)?;
                if let Some(valid) = valid {
                    blank(archive, valid, &mut coordinates)?;
                }
                Ok(coordinates)
            }
        }
    }

    /// The doubt that there are more points than the description counts.
    fn doubt(&self, archive: &mut Archive) -> io::Result<Option<String>> {
        Ok(match &self.points {
            PointStorage::List(list) => {
                let rest = list.len() - self.count();
                (rest > 0).then(|| format!("{rest} unexpected points follow the stated {}", self.count()))
            }
            PointStorage::Files(link, _) => {
                let stored = archive.by_name(&link.name).map_err(missing(&link.name))?.size();
                let rest = stored.saturating_sub((self.count() * self.size()) as u64);
                left_over(rest as usize, &format!("the points in {:?}", link.name))
            }
        })
    }

    /// Bytes of a point.
    fn size(&self) -> usize {
        self.axes.iter().filter_map(|it| it.kind).map(CoordinateType::size).sum()
    }

    /// The number of points.
    fn count(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// The coordinate of a point of a list along an absolute axis.
    fn listed(&self, point: &str, axis: usize) -> io::Result<f64> {
        if point.is_empty() {
            return Ok(f64::NAN);
        }
        let place = self.axes.iter().take(axis).filter(|it| it.kind.is_some()).count();
        let wrong = || malformed(format!("its point {point:?} does not fit its axes"));
        let number = point.split(';').nth(place).and_then(|it| it.trim().parse().ok()).ok_or_else(wrong)?;
        Ok(self.axes[axis].metres(number))
    }

    /// The coordinates along an absolute axis in a file of the archive.
    fn stored(&self, archive: &mut Archive, link: &Link, axis: usize) -> io::Result<Vec<f64>> {
        let before: usize = self.axes.iter().take(axis).filter_map(|it| it.kind).map(CoordinateType::size).sum();
        let kind = self.axes[axis].kind.ok_or_else(|| malformed("its heights are not stored"))?;
        let size = self.size();
        let mut coordinates = Vec::with_capacity(self.count());
        link.unpack(archive, self.count(), size, |piece| {
            for point in piece.chunks_exact(size) {
                coordinates.push(self.axes[axis].metres(kind.number(&point[before..])?));
            }
            Ok(())
        })?;
        Ok(coordinates)
    }
}

/// The points of a list.
fn data(list: Node) -> Vec<String> {
    let data = list.children().filter(|it| it.tag_name().name() == "Datum");
    data.map(|it| it.text().unwrap_or_default().trim().to_owned()).collect()
}

/// Rows and columns, if their points, each of `size` bytes, fit into `bytes`.
fn shape(record: Node, size: usize, bytes: usize) -> io::Result<[usize; 2]> {
    let [columns, rows, layers] = match number(record, "ListDimension")? {
        Some(points) => [points, 1, 1],
        None => {
            let along =
                |axis: &str| io::Result::Ok(number(record, &format!("MatrixDimension/Size{axis}"))?.unwrap_or(0));
            [along("X")?, along("Y")?, along("Z")?]
        }
    };
    match layers {
        0 | 1 => nodes(rows, columns, size, bytes),
        _ => Err(malformed(format!("it has {layers} layers instead of one surface"))),
    }
}

/// Makes those coordinates void whose bit in a file of the archive is zero.
fn blank(archive: &mut Archive, link: &Link, coordinates: &mut [f64]) -> io::Result<()> {
    let mut parts = coordinates.chunks_mut(8);
    let bytes = parts.len();
    link.unpack(archive, bytes, 1, |piece| {
        for (bits, part) in piece.iter().zip(parts.by_ref()) {
            let void = part.iter_mut().enumerate().filter(|(i, _)| bits >> i & 1 == 0);
            void.for_each(|(_, coordinate)| *coordinate = f64::NAN);
        }
        Ok(())
    })
}
