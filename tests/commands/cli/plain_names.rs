//! A plain name means the best value that is known, whatever the form of the result.

use super::*;
use std::collections::HashMap;
use std::path::PathBuf;

/// A result by the names of its numbers.
type Numbers<'a> = Box<dyn Fn(&str) -> f64 + 'a>;

/// The numbers of an archive.
fn archived(path: PathBuf) -> Numbers<'static> {
    Box::new(move |name| {
        let mut npz = NpzReader::new(File::open(&path).unwrap()).unwrap();
        let value: ArrayD<f64> = npz.by_name(name).unwrap();
        value.sum()
    })
}

/// The numbers of the first row of a table.
fn tabulated(path: PathBuf) -> Numbers<'static> {
    let mut table = csv::Reader::from_path(&path).unwrap();
    let row: HashMap<String, String> = table.deserialize().next().unwrap().unwrap();
    Box::new(move |name| row[name].parse().unwrap())
}

#[test]
fn plain_names_are_the_resolved_values_in_json_archives_and_tables() {
    let folder = Folder::new();
    let line = format!("{CYLINDER} --modulus 1");
    let json = json(&folder.run(&format!("solve {line} --pressure 0.003 --out a.npz --json")));
    let loads = folder.run(&format!("solve {line} --pressure 0.003,0.004 --out loads.csv"));
    assert_eq!(loads.status.code(), Some(0));
    let study = "surface = { indenter = { shape = 'cylinder', radius = 1.0 } }\n\
                 grid = { points = 64, size = 4.0 }\nload = { mean-pressure = [0.003, 0.004] }\nsolid = { contact-modulus = 1.0 }\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let studied = folder.run("study study.toml");
    assert_eq!(studied.status.code(), Some(0), "{}", text(&studied.stderr));
    let exact = &json["exact"];
    let forms: [(&str, Numbers<'_>); 4] = [
        ("JSON", Box::new(|name| number(&json, name))),
        ("NPZ", archived(folder.join("a.npz"))),
        ("CSV", tabulated(folder.join("loads.csv"))),
        ("study", tabulated(folder.join("study.csv"))),
    ];
    for (form, of) in forms {
        for name in ["relative_area", "kappa_r"] {
            let exact = exact[name].as_f64().unwrap();
            let [plain, counted] = [name.to_owned(), format!("{name}_counted")].map(|it| (of(&it) / exact - 1.0).abs());
            assert!(counted > 0.02 && plain < 0.2 * counted, "{name} of {form}: off by {plain}, counted by {counted}");
            // the error beside it is that of the plain value
            assert!(of(&format!("{name}_error")) > plain, "{name} of {form}");
        }
        let kappa = of("relative_area") / of("reduced_pressure");
        assert!((of("kappa") / kappa - 1.0).abs() < 1e-12, "{form}");
        let kappa_r = of("relative_area") / of("reduced_pressure_contact");
        assert!((of("kappa_r") / kappa_r - 1.0).abs() < 1e-12, "{form}");
    }
}
