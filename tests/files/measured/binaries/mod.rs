//! Small valid files of the formats of instruments.

pub mod al3d;
pub mod bcr;
pub mod frt;
pub mod ibw;
pub mod jpk;
pub mod metropro;
pub mod mi;
pub mod nanoscope;
pub mod nid;
pub mod opd;
pub mod opdx;
pub mod plu;
pub mod sdf;
pub mod tmd;
pub mod vk4;
pub mod wsxm;

/// A name of a file and what makes it.
pub type Writer = (&'static str, fn() -> Vec<u8>);

/// All files.
pub const ALL: &[Writer] = &[
    ("al3d", al3d::file),
    ("bcr", bcr::file),
    ("bcr, wide", bcr::wide),
    ("frt", frt::file),
    ("frt, images", frt::images),
    ("ibw", ibw::file),
    ("ibw, alone", ibw::alone),
    ("ibw, profile", ibw::profile),
    ("jpk", jpk::file),
    ("metropro", metropro::file),
    ("metropro, long", metropro::long),
    ("mi", mi::file),
    ("mi, long", mi::long),
    ("mi, text", mi::text),
    ("mi, columns", mi::columns),
    ("nanoscope", nanoscope::file),
    ("nanoscope, long", nanoscope::long),
    ("nid", nid::file),
    ("opd", opd::file),
    ("opd, integers", opd::integers),
    ("opdx", opdx::file),
    ("opdx, profile", opdx::profile),
    ("plu", plu::file),
    ("plu, profile", plu::profile),
    ("sdf", sdf::file),
    ("sdf, text of BCR", sdf::text_of_bcr),
    ("sdf, binary", sdf::binary),
    ("sdf, binary of ISO-2.0", sdf::binary_of_iso_2),
    ("wsxm", wsxm::file),
    ("wsxm, double", wsxm::double),
    ("tmd", tmd::file),
    ("vk4", vk4::file),
];

/// Points along x and y.
pub const POINTS: [usize; 2] = [5, 4];
/// The node along x and y whose height is void where a format knows such heights.
pub const VOID: [usize; 2] = [3, 1];

/// The height of a node in the unit of a file, a whole number that is another one at each node.
pub fn height(ix: usize, iy: usize) -> i8 {
    (ix * ix + 10 * iy) as i8 - 20
}

/// Something of each node, row by row.
pub fn by_rows<T>(of: impl Fn(usize, usize) -> T) -> Vec<T> {
    (0..POINTS[1]).flat_map(|iy| (0..POINTS[0]).map(move |ix| (ix, iy))).map(|(ix, iy)| of(ix, iy)).collect()
}

/// The heights in single precision, row by row, and a number for the void node.
pub fn singles(void: f32) -> Vec<u8> {
    let single = |ix, iy| if [ix, iy] == VOID { void } else { height(ix, iy).into() };
    by_rows(single).into_iter().flat_map(f32::to_le_bytes).collect()
}

/// A text filled with zeros.
pub fn filled(text: &str, length: usize) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(length, 0);
    bytes
}
