//! Lengths and pressures with units, and bytes, as users write and read them.

use asperity::quantity::{bytes_in_words, force, length, pressure};
use serde::de::IntoDeserializer as _;
use serde::de::value::{Error, StrDeserializer};

type Text<'t> = StrDeserializer<'t, Error>;

fn read<'t>(text: &'t str, read: fn(Text<'t>) -> Result<f64, Error>) -> Result<f64, String> {
    read(text.into_deserializer()).map_err(|error| error.to_string())
}

#[test]
fn bytes_read_well() {
    let read: Vec<String> = [200.0, 57_300.0, 2.1e6, 9.99e8, 5.6e11, 1e13].map(bytes_in_words).into();
    assert_eq!(read, ["0.2 kB", "57 kB", "2.1 MB", "999 MB", "560 GB", "10 TB"]);
}

#[test]
fn units_become_metres_and_pascals() {
    for text in ["160 um", "160um", "1.6e-4 m", " 160 µm ", "160000 nm", "0.16mm", "1.6e-4"] {
        assert_eq!(read(text, length), Ok(160e-6), "{text}");
    }
    for text in ["2 GPa", "2000MPa", "2e9 Pa", "2e9", "2000 N/mm2", "2000N/mm²", "2e3 N/mm^2"] {
        assert_eq!(read(text, pressure), Ok(2e9), "{text}");
    }
    for text in ["5 N/mm", "5kN/m", "5000 N/m", "5000"] {
        assert_eq!(read(text, force), Ok(5e3), "{text}");
    }
    assert_eq!(read("1 in", length), Ok(0.0254));
    assert_eq!(read("40 um", length), Ok(40e-6));
}

#[test]
fn other_texts_are_refused_in_one_sentence() {
    for text in ["", "um", "160 GPa", "160 parsnips", "1 2 um"] {
        let refused = read(text, length).unwrap_err();
        assert!(refused.contains(text) && refused.contains("160 um") && refused.contains("a length"), "{refused}");
    }
}
