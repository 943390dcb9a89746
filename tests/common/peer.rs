//! Results of another code, Tamaas 2.9.0, as they lie in `tests/data`.

use asperity::contact::Load;
use asperity::formats::read_heights;
use asperity::surface::Field;
use asperity::{Grid, Surface};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A contact that Tamaas has solved to 1e-12.
pub struct Peer {
    pub name: String,
    pub surface: Surface,
    pub contact_modulus: f64,
    pub mean_pressure: f64,
    pub pressure: Field,
    pub relative_area: f64,
    pub mean_gap: f64,
}

pub fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn field(name: &str) -> Field {
    let values = read_heights(data(name)).unwrap();
    let shape = match *values.shape() {
        [n] => [1, n],
        [ny, nx] => [ny, nx],
        _ => panic!("{name} has rank {}", values.ndim()),
    };
    values.to_shape(shape).unwrap().into_owned()
}

impl Peer {
    fn new(entry: &Value) -> Self {
        let number = |key: &str| entry[key].as_f64().unwrap();
        let name = entry["name"].as_str().unwrap().to_owned();
        let height = field(&format!("{name}.height.npy"));
        let grid = match *height.shape() {
            [1, n] => Grid::line(n, number("size")),
            [ny, nx] => Grid::surface([ny, nx], [number("size"); 2]),
            _ => panic!("a field has two axes"),
        };
        Self {
            surface: Surface::new(grid.unwrap(), height).unwrap(),
            contact_modulus: number("contact_modulus"),
            mean_pressure: number("mean_pressure"),
            pressure: field(&format!("{name}.pressure.npy")),
            relative_area: number("relative_area"),
            mean_gap: number("mean_gap"),
            name,
        }
    }

    pub fn all() -> Vec<Self> {
        let text = std::fs::read_to_string(data("reference.json")).unwrap();
        let entries: Vec<Value> = serde_json::from_str(&text).unwrap();
        assert_eq!(entries.len(), 5);
        entries.iter().map(Self::new).collect()
    }

    pub fn load(&self) -> Load {
        Load::MeanPressure(self.mean_pressure)
    }
}
