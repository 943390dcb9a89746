//! Archives of PLUX: a layer of heights, and one whose file is not there.

use super::{SHAPE, heights, zipped};

/// The description of a map of some rows and columns.
pub fn index([ny, nx]: [usize; 2]) -> String {
    format!(
        "<?xml version=\"1.0\"?><xml><GENERAL><DATE>2026-11-22</DATE><IMAGE_SIZE_X>{nx}</IMAGE_SIZE_X><IMAGE_SIZE_Y>{ny}</IMAGE_SIZE_Y>\
         <FOV_X>2.0</FOV_X><FOV_Y>3.0</FOV_Y></GENERAL><LAYER_0><FILENAME_Z>LAYER_0.raw</FILENAME_Z></LAYER_0>\
         <LAYER_1><FILENAME_Z>LAYER_1.raw</FILENAME_Z></LAYER_1></xml>"
    )
}

/// The archive of a description and the heights.
pub fn archive(index: &str) -> Vec<u8> {
    let points: Vec<u8> = heights(f64::NAN).flat_map(|z| ((z * 1e-3) as f32).to_le_bytes()).collect();
    zipped(&[("LAYER_0.raw", &points), ("index.xml", index.as_bytes())])
}

pub fn file() -> Vec<u8> {
    archive(&index(SHAPE))
}
