//! Stress in files and partial slip, from the command line.

use super::*;

const HERTZ: &str = "--indenter cylinder --radius 1 --points 8192 --size 4 --pressure 1e-4";

fn open(folder: &Folder, name: &str) -> NpzReader<File> {
    NpzReader::new(File::open(folder.join(name)).unwrap()).unwrap()
}

fn field(npz: &mut NpzReader<File>, name: &str) -> Array2<f64> {
    npz.by_name(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn scalar(npz: &mut NpzReader<File>, name: &str) -> f64 {
    npz.by_name::<ndarray::OwnedRepr<f64>, ndarray::Ix0>(name).unwrap().into_scalar()
}

#[test]
fn the_stress_below_a_cylinder_is_written_and_says_its_poisson_ratio() {
    let folder = Folder::new();
    let output = folder.run(&format!("solve {HERTZ} --young 0.91 --poisson 0.3 --stress below.npz --json"));
    let (found, said) = (json(&output), text(&output.stderr).to_owned());
    assert!(said.contains("wrote below.npz") && !said.contains("assumed"), "{said}");
    let mut npz = open(&folder, "below.npz");
    let (tau, zz) = (field(&mut npz, "tau_max"), field(&mut npz, "sigma_zz"));
    let depth: ndarray::Array1<f64> = npz.by_name("depth").unwrap();
    let pressure: ndarray::Array1<f64> = npz.by_name("pressure").unwrap();
    assert_eq!(tau.dim(), (depth.len(), 8192));
    let highest = tau.fold(0.0, |most: f64, &tau| most.max(tau)) / number(&found, "max_pressure");
    assert!((highest - 0.30).abs() < 0.005, "{highest}");
    assert!(zz.row(0).iter().zip(&pressure).all(|(zz, p)| (zz + p).abs() < 1e-13) && depth[0] == 0.0);
    assert_eq!(scalar(&mut npz, "poisson"), 0.3);
    assert!(npz.names().unwrap().iter().all(|name| !name.starts_with("tau_xy")), "lines have no tau_xy");
    // nobody gives the ratio: said in both places
    let output = folder.run(&format!("solve {HERTZ} --modulus 1 --stress below.npz"));
    assert!(text(&output.stderr).contains("The stress assumes a Poisson's ratio of 0.3"));
    let assumed = open(&folder, "below.npz").by_name::<ndarray::OwnedRepr<bool>, ndarray::Ix0>("poisson_is_assumed");
    assert!(assumed.unwrap().into_scalar());
}

#[test]
fn the_stress_below_a_row_of_a_surface_has_all_components() {
    let folder = Folder::new();
    let output = folder.run(&format!("solve {SPHERE} --modulus 1 --pressure 1e-3 --stress below.npz --stress-row 5"));
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut npz = open(&folder, "below.npz");
    for name in ["sigma_xx", "sigma_yy", "sigma_zz", "tau_xy", "tau_xz", "tau_yz", "tau_max", "von_mises"] {
        assert_eq!(field(&mut npz, name).dim(), (64, 32), "{name}");
    }
    let row: ndarray::Array0<u64> = npz.by_name("row").unwrap();
    assert_eq!(row.into_scalar(), 5);
}

#[test]
fn a_tangential_load_is_carried_by_what_sticks_and_what_slips() {
    let folder = Folder::new();
    let pull = format!("{HERTZ} --modulus 1 --friction 0.5 --tangential 2e-5 --out slip.npz");
    let found = json(&folder.run(&format!("solve {pull} --json --save-setup scene.toml")));
    let slip = &found["slip"];
    let of = |name: &str| slip[name].as_f64().unwrap_or_else(|| panic!("no {name} in {slip}"));
    assert!((of("tangential_over_sliding") - 0.4).abs() < 1e-12 && (of("mean_traction") / 2e-5 - 1.0).abs() < 1e-9);
    let share = of("stick_area") / number(&found, "relative_area");
    assert!((share - 0.6f64.sqrt()).abs() < 2e-3, "{share}");
    let mut npz = open(&folder, "slip.npz");
    let traction: ndarray::Array1<f64> = npz.by_name("traction").unwrap();
    assert!((traction.mean().unwrap() / 2e-5 - 1.0).abs() < 1e-9);
    assert_eq!((scalar(&mut npz, "friction_coefficient"), scalar(&mut npz, "stick_area")), (0.5, of("stick_area")));
    // coupling is said where there is some: of one body beside a rigid one, unless it is incompressible, and of unequal bodies
    for (solid, beta) in [
        ("--young 1GPa --poisson 0.3", Some("0.29")),
        ("--young 1GPa --poisson 0.5", None),
        ("--young 1GPa,1GPa --poisson 0.3,0.3", None),
        ("--young 1GPa,2GPa --poisson 0.3,0.3", Some("0.10")),
    ] {
        let hertz = HERTZ.replace("1e-4", "100kPa");
        let line = format!("solve {hertz} {solid} --friction 0.5 --tangential 20kPa");
        let told = text(&folder.run(&line).stderr).to_owned();
        let is_told =
            beta.map_or(!told.contains("Dundurs"), |beta| told.contains(&format!("(Dundurs' beta is {beta})")));
        assert!(is_told, "{solid}: {told}");
    }
    // by a force, with units: the same share of the force at which all slides, on a line and on a surface
    let force = |cell: &str, force: &str, pull: &str| {
        let line = format!("solve {cell} --modulus 1GPa --force {force} --friction 0.5 --tangential {pull} --json");
        json(&folder.run(&line))["slip"]["tangential_over_sliding"].as_f64().unwrap()
    };
    let line = "--indenter cylinder --radius 10m --points 256 --size 1m";
    let sphere = "--indenter sphere --radius 10m --points 32,32 --size 1m";
    for (cell, [whole, part]) in
        [(line, ["500kN/m", "100kN/m"]), (line, ["0.5MN/m", "100N/mm"]), (sphere, ["500kN", "0.1MN"])]
    {
        assert!((force(cell, whole, part) - 0.4).abs() < 1e-12, "{cell}, {whole}, {part}");
    }
    // by the scene that was saved, for reading, and by a reduced pressure
    let again = folder.run("solve scene.toml");
    assert!(text(&again.stdout).contains("stick area"), "{}", text(&again.stdout));
    let line = pull.replace("--pressure 1e-4", "--reduced-pressure 1e-4");
    assert_eq!(json(&folder.run(&format!("solve {line} --json")))["slip"]["tangential_over_sliding"], 0.4);
}

/// Over a period the waves of the pressure have no mean: what is left of `sigma_xx` at any depth is the part of the mean pressure, which a
/// periodic solid carries without lateral strain.
#[test]
fn the_stress_of_a_confined_mean_pressure_is_told_and_can_be_taken_off() {
    let folder = Folder::new();
    let line = "--indenter cylinder --radius 1 --points 4096 --size 4 --modulus 1 --pressure 1e-4 --stress s.npz";
    let output = folder.run(&format!("solve {line}"));
    assert!(text(&output.stderr).contains("without lateral strain"), "{}", text(&output.stderr));
    let mut npz = open(&folder, "s.npz");
    let (xx, confined) = (field(&mut npz, "sigma_xx"), scalar(&mut npz, "sigma_confined"));
    assert!((confined / (-0.3 / 0.7 * 1e-4) - 1.0).abs() < 1e-9);
    for depth in xx.rows() {
        let mean = depth.mean().unwrap();
        assert!((mean / confined - 1.0).abs() < 1e-9, "{mean} for {confined}");
    }
}
