//! The archive of ISO 25178-72.

use super::file_writer::FileWriter;
use crate::formats::Scan;
use md5::{Context, Digest};
use std::io::{self, Seek, Write};
use zip::ZipWriter;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;

/// The name of the file with the heights.
const POINTS: &str = "bindata/data.bin";
/// The name of the file with the check sum of the description.
const SUM: &str = "md5checksum.hex";

/// Writes an archive with heights in metres as doubles, NaN for voids, along an absolute axis over an even grid. The check sums are those
/// that the format asks for; of when and by what the heights were measured it says nothing.
///
/// # Source
/// ISO 25178-72:2017 and ISO 5436-2:2012, and the published schema of openGPS, whose second record is optional.
pub(super) fn write(scan: &Scan, file: &mut FileWriter) -> io::Result<()> {
    archive(scan, ZipWriter::new(file)).map_err(io::Error::from)
}

fn archive(scan: &Scan, mut archive: ZipWriter<impl Write + Seek>) -> ZipResult<()> {
    let options = SimpleFileOptions::default();
    let is_large = scan.height.len() >= u32::MAX as usize / size_of::<f64>();
    archive.start_file(POINTS, options.large_file(is_large))?;
    let main = description(scan, points(scan, &mut archive)?);
    archive.start_file("main.xml", options)?;
    archive.write_all(main.as_bytes())?;
    archive.start_file(SUM, options)?;
    writeln!(archive, "{:x} *main.xml", md5::compute(&main))?;
    archive.finish()?;
    Ok(())
}

/// Writes the heights row by row; their check sum.
fn points(scan: &Scan, file: &mut impl Write) -> io::Result<Digest> {
    let mut sum = Context::new();
    for row in scan.height.rows() {
        let bytes: Vec<u8> = row.iter().flat_map(|height| height.to_le_bytes()).collect();
        sum.consume(&bytes);
        file.write_all(&bytes)?;
    }
    Ok(sum.finalize())
}

/// The description of heights with this check sum.
fn description(scan: &Scan, sum: Digest) -> String {
    let ([rows, points], [dy, dx]) = (scan.shape(), scan.spacing);
    let feature = if scan.is_line() { "PRF" } else { "SUR" };
    let axis = |name: &str, kind: &str, step: f64| {
        format!(
            "<{name}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>{step:e}</Increment><Offset>0</Offset></{name}>"
        )
    };
    let axes = [axis("CX", "I", dx), axis("CY", "I", dy), axis("CZ", "A", 1.0)].concat();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 http://www.opengps.eu/2008/ISO5436_2/ISO5436_2.xsd">
  <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>{feature}</FeatureType><Axes>{axes}</Axes></Record1>
  <Record3>
    <MatrixDimension><SizeX>{points}</SizeX><SizeY>{rows}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink><PointDataLink>{POINTS}</PointDataLink><MD5ChecksumPointData>{sum:x}</MD5ChecksumPointData></DataLink>
  </Record3>
  <Record4><ChecksumFile>{SUM}</ChecksumFile></Record4>
</p:ISO5436_2>
"#
    )
}
