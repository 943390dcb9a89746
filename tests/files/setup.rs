//! Setups in TOML and JSON: what people write is read, what is wrong is said in one sentence, and what is written is read
//! again to the last bit.

use asperity::contact::{Contact, Dynamics, Gfmd, Load, Masses};
use asperity::error::SetupError;
use asperity::formats::{read_heights, write_heights};
use asperity::setup::{Body, Cell, Cost, Method, Part, Recipe, Record, Setup, SetupTable, Solid, Theme, YieldLaw};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Stop, Surface};
use std::fs;

const SCENE: &str = "surface = { indenter = { shape = \"cylinder\", radius = 1.0 } }
grid = { points = 64, size = 4.0 }
solid = { contact-modulus = 1.0 }
load = { mean-pressure = 0.01 }
";

/// Numbers whose digits do not end.
fn roughness() -> Spectrum {
    Spectrum { hurst: 0.1 + 0.2, rolloff_wavelength: 1.0 / 7.0, short_cutoff: 1.0 / 70.0, rms_gradient: 1e-3 / 3.0 }
}

fn solve(setup: &Setup) -> Contact {
    setup.solver.solver().solve(&setup.problem().unwrap(), &setup.stop, &mut ()).unwrap().converged().unwrap()
}

/// Setups with each section in several forms.
fn setups() -> Vec<Setup> {
    let line =
        Setup::new(Recipe::rough(roughness(), i64::MAX as u64), Cell::line(512, 1.0), Load::ReducedPressure(0.07));
    let crossed = Recipe { indenter: Some(Indenter::CrossedSine { amplitude: 1.0 / 3.0 }), ..Recipe::default() };
    let wide = Setup {
        solid: Some(Solid::ContactModulus(1e9 / 3.0)),
        solver: Method::Gfmd(Gfmd {
            masses: Masses::Stiffness,
            dynamics: Dynamics::Fire,
            time_step: 0.3,
            damping: 0.7,
        }),
        stop: Stop::new(1e-7 / 3.0, 12_345).unwrap().with_pressure_tolerance(1e-4 / 3.0).unwrap(),
        record: Record {
            what: vec![Part::Traces, Part::Mesh],
            every: Some(3),
            length_unit: "um".into(),
            pressure_unit: "kPa".into(),
            raster_at: Some([2, 35]),
            theme: Theme::Light,
            iterations: false,
        },
        ..Setup::new(crossed, Cell::surface([24, 36], [1.0, 1.0 / 0.7]), Load::MeanPressure(1e8 / 3.0))
    };
    let both = Recipe { indenter: Some(Indenter::Cylinder { radius: 0.1 + 0.2 }), ..Recipe::rough(roughness(), 0) };
    let apart = Setup::new(both, Cell::line(255, 1.0), Load::MeanGap(1e-3 / 3.0));
    let apart = Setup { solver: Method::PolonskyKeer {}, ..apart };
    let [one, other] = [(210e9 / 7.0, 0.3), (0.1 + 0.2, -1.0 / 3.0)].map(|(young, poisson)| Body { young, poisson });
    let on_body = line.clone().on(Solid::Bodies(one, None));
    let on_bodies = apart.clone().on(Solid::Bodies(one, Some(other)));
    let law = YieldLaw {
        yield_stress: Some(210e9 / 70.0),
        hardening_modulus: Some(1e9 / 3.0),
        kinematic_hardening: Some(1e8 / 7.0),
        depth: Some(1.0 / 3.0),
        layers: Some(7),
        errors: true,
    };
    let yielding = line.clone().on(Solid::Yielding(Box::new(Solid::Bodies(one, None)), law));
    vec![line, wide, apart, on_body, on_bodies, yielding]
}

#[test]
fn what_is_left_out_has_its_default() {
    let cylinder = Recipe::indenter(Indenter::Cylinder { radius: 1.0 });
    let expected = Setup::new(cylinder, Cell::line(64, 4.0), Load::MeanPressure(0.01)).on(Solid::ContactModulus(1.0));
    assert_eq!(Setup::from_toml(SCENE).unwrap(), expected);
    let defaults = (Method::Multilevel {}, Stop::new(1e-8, 100_000).unwrap());
    assert_eq!((expected.solver, expected.stop), defaults);
}

#[test]
fn what_is_written_is_read_again_to_the_last_bit() {
    for setup in setups() {
        let text = setup.to_toml();
        assert_eq!(Setup::from_toml(&text).unwrap(), setup, "{text}");
        assert_eq!(setup.to_table().setup().unwrap(), setup);
        assert_eq!(Setup::from_toml(&text).unwrap().to_toml(), text);
    }
}

#[test]
fn the_dark_theme_needs_no_mention() {
    let dark = Setup::from_toml(SCENE).unwrap();
    assert_eq!(dark.record.theme, Theme::Dark);
    assert!(!dark.to_toml().contains("theme"));
    let light = Setup { record: Record { theme: Theme::Light, ..Record::default() }, ..dark };
    assert!(light.to_toml().contains("theme = \"light\""));
}

#[test]
fn a_written_scene_gives_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    for setup in setups() {
        setup.write(&path).unwrap();
        let (expected, found) = (solve(&setup), solve(&SetupTable::read(&path).unwrap().setup().unwrap()));
        assert_eq!((found.pressure, found.gap), (expected.pressure, expected.gap));
        assert_eq!((found.certificate, found.work.transforms), (expected.certificate, expected.work.transforms));
    }
}

#[test]
fn heights_indenter_and_roughness_add_up() {
    let folder = tempfile::tempdir().unwrap();
    let heights = ndarray::Array2::from_shape_fn((20, 24), |(i, j)| ((3 * i + 5 * j) as f64).sin());
    write_heights(folder.path().join("measured.npy"), heights.view().into_dyn()).unwrap();
    let scene = folder.path().join("scene.toml");
    let text = "grid = { size = [2.0, 3.0] }
        load = { reduced-pressure = 0.1 }
        [surface]
        height = \"measured.npy\"
        seed = 5
        indenter = { shape = \"sphere\", radius = 3.0 }
        spectrum = { hurst = 0.8, rolloff-wavelength = 1.5, short-cutoff = 0.5, rms-gradient = 0.2 }";
    fs::write(&scene, text).unwrap();
    let setup = SetupTable::read(&scene).unwrap().setup().unwrap();
    let grid = setup.check().unwrap();
    let measured = Surface::new(grid, heights).unwrap();
    let smooth = Indenter::Sphere { radius: 3.0 }.surface(grid).unwrap();
    let rough = setup.surface.spectrum.as_ref().unwrap().surface(grid, 5).unwrap();
    let parts = [measured.heights(), smooth.heights(), rough.heights()];
    let sum = setup.surface().unwrap();
    for (i, height) in sum.heights().iter().enumerate() {
        let expected: f64 = parts.iter().map(|part| part[i]).sum();
        assert!((height - expected).abs() < 1e-14, "{i}: {height} and not {expected}");
    }
    // each part alone is one of the three, and any two are their sum
    let alone =
        Setup { surface: Recipe { indenter: None, spectrum: None, seed: None, ..setup.surface.clone() }, ..setup };
    assert_eq!(alone.surface().unwrap().heights(), measured.heights());
    assert_eq!(read_heights(alone.surface.height.unwrap().path()).unwrap().shape(), [20, 24]);
}

#[test]
fn a_scene_that_was_written_elsewhere_finds_its_height_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    let heights = ndarray::Array1::from_shape_fn(64, |i| (i as f64).sin());
    write_heights(folder.path().join("h.npy"), heights.view().into_dyn()).unwrap();
    let scene = folder.path().join("scene.toml");
    fs::write(
        &scene,
        "surface.height = \"h.npy\"\ngrid.size = 1.0\nsolid.contact-modulus = 1\nload.mean-pressure = 0.01",
    )
    .unwrap();
    let setup = SetupTable::read(&scene).unwrap().setup().unwrap();
    let moved = folder.path().join("sub/moved.toml");
    setup.write(&moved).unwrap();
    let again = SetupTable::read(&moved).unwrap().setup().unwrap();
    assert_eq!(solve(&again).pressure, solve(&setup).pressure);
}

/// What is wrong with the scene once `from` is replaced by `to`.
fn refusal(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from), "{from}");
    let refused = Setup::from_toml(&SCENE.replacen(from, to, 1)).and_then(|setup| setup.problem());
    refused.map(|_| ()).expect_err(to).to_string()
}

#[test]
fn what_is_wrong_is_said_in_one_sentence() {
    let (cylinder, load) = ("indenter = { shape = \"cylinder\", radius = 1.0 }", "load = { mean-pressure = 0.01 }");
    const SOLID: &str = "solid = { contact-modulus = 1.0 }";
    let (whole, name) = ("expected a whole number, 0 or more", "expected the name of a file");
    for (from, to, words) in [
        (load, "", "no load is given: give a mean pressure, a reduced pressure or a mean gap"),
        (load, "load = {}", "no load is given: give a mean pressure, a reduced pressure or a mean gap"),
        ("= 0.01", "= 0.01, mean-gap = 1.0", "load: both `mean-gap` and `mean-pressure` are given: give one of them"),
        (load, "load = 3", "load: expected a name and a number, such as { mean-pressure = 0.01 }"),
        (load, "load = \"mean-gap\"", "load: expected a name and a number, such as { mean-pressure = 0.01 }"),
        (load, "[[load]]\nmean-gap = 1", "load: expected a name and a number, such as { mean-pressure = 0.01 }"),
        (
            "0.01",
            "true",
            "load.mean-pressure: invalid type: boolean `true`, expected a pressure: a number, or one with a unit",
        ),
        ("0.01", "-1", "the mean pressure is -1.0: give a positive, finite value"),
        (
            "mean-pressure = 0.01",
            "reduced-pressure = \"1\"",
            "load.reduced-pressure: invalid type: text \"1\", expected a number",
        ),
        (cylinder, "", "no surface is given: give a height file, an indenter or a spectrum"),
        (
            "surface = { indenter = { shape = \"cylinder\", radius = 1.0 } }",
            "",
            "no surface is given: give a height file",
        ),
        ("shape = \"cylinder\", ", "", "surface.indenter: missing key `shape`: give it"),
        (", radius = 1.0", "", "surface.indenter: missing key `radius`: give it"),
        (cylinder, "height = 3", name),
        (cylinder, "height = \"none.npy\"", "points are given, but the height file has its own: leave the points out"),
        ("1.0 }", "1.0 }, seed = 3", "a seed is given without roughness"),
        ("1.0 }", "1.0 }, seed = -3", "surface.seed: invalid value: number `-3`, expected a whole number, 0 or more"),
        ("64", "64.5", whole),
        ("64", "\"64\"", whole),
        ("64", "2", "2 points along x are too few: give at least 4"),
        ("64", "[8, 8, 8]", "the grid has 3 axes: give one for a line, two for a surface"),
        ("points = 64, ", "", "the points are missing: give one number for a line, two for a surface"),
        ("4.0", "[1.0, 2.0]", "the size of the cell has 2 lengths for 1 axes: give one for all axes, or one for each"),
        ("4.0", "true", "grid.size: invalid type: boolean `true`, expected one value, or a list"),
        (", size = 4.0", "", "no size is given, and the file has none: give it"),
        ("\"cylinder\"", "\"sphere\"", "a sphere needs a surface, but the grid is a line"),
        (load, "load = { mean-gap = 9.0 }", "at a mean gap of 9.0 nothing touches: give less than 0.66"),
        ("grid", "solver = \"gfmd\"\ngrid", "solver: invalid type: text \"gfmd\", expected a section for the Method"),
        (
            "grid",
            "solver = { masses = \"uniform\" }\ngrid",
            "solver: `masses` is a setting of the method gfmd, but the method is multilevel: give the method gfmd",
        ),
        ("grid", "solver = { method = \"gfmd\", masses = \"x\" }\ngrid", "solver.masses: unknown value `x`, expected"),
        ("grid", "stop = { tolerance = 0 }\ngrid", "the tolerance is 0: it must lie in (0, infinity)"),
        ("grid", "stop = { max-iterations = 1.5 }\ngrid", whole),
        ("grid", "record = { what = \"mesh\" }\ngrid", "record.what: invalid type: text \"mesh\", expected a list"),
        ("grid", "record = { what = [\"mesh\"] }\ngrid", "the recording part mesh does not exist for a line"),
        ("grid", "record = { every = 0 }\ngrid", "the recording interval is 0 steps: give a positive number of steps"),
        (
            "{ contact-modulus = 1.0 }",
            "1e9",
            "solid: invalid type: number `1000000000.0`, expected a section for the Solid",
        ),
        ("modulus = 1.0", "modulus = 0", "the contact modulus is 0.0: give a positive, finite value"),
        (SOLID, "", "the mean pressure 0.01 is given without a modulus: give the contact modulus, or Young's modulus"),
        (
            "contact-modulus = 1.0",
            "",
            "solid: the solid is empty: give the contact modulus, or Young's modulus and Poisson's",
        ),
        (
            "modulus = 1.0",
            "modulus = 1.0, young = 1, poisson = 0",
            "solid: both a contact modulus and elastic constants are given",
        ),
        ("contact-modulus = 1.0", "young = 1", "solid: Poisson's ratio is missing: give one value per body"),
        ("contact-modulus = 1.0", "young = [1, 2], poisson = 0.3", "2 Young's moduli and 1 Poisson's ratio are given"),
        ("contact-modulus = 1.0", "young = 0, poisson = 0.3", "Young's modulus is 0.0: give a positive, finite value"),
        (
            "contact-modulus = 1.0",
            "young = 1, poisson = 0.6",
            "Poisson's ratio is 0.6: it must lie above -1 and at most",
        ),
        ("mean-pressure = 0.01", "mean-pressure = []", "load: the list is empty: give at least one load"),
        (
            "1.0 }",
            "1.0 }, prepare.detrend = \"mean\"",
            "options for reading or preparing heights are given without a height file: give one, or leave them out",
        ),
        ("1.0 }", "1.0, radius = 2.0 }", "line 1: duplicate key"),
        ("load =", "load", "line 4: "),
    ] {
        let said = refusal(from, to);
        assert!(said.contains(words), "{to}: {said}");
        assert!(!said.contains('\n') && !said.contains("usize") && !said.contains("f64"), "{to}: {said}");
    }
}

#[test]
fn elastic_constants_make_the_contact_modulus() {
    let on = |solid: &str| {
        let scene = SCENE.replace("contact-modulus = 1.0", solid).replace("mean-pressure", "reduced-pressure");
        Setup::from_toml(&scene).unwrap().problem().unwrap().contact_modulus()
    };
    let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-15, "{found}, {expected}");
    near(on("young = 2.1, poisson = 0.3"), 2.1 / 0.91);
    near(on("young = [2.1, 0.7], poisson = [0.3, 0.5]"), 1.0 / (0.91 / 2.1 + 0.75 / 0.7));
    // a body twice as stiff as two of its kind
    near(on("young = [1.0, 1.0], poisson = [0.3, 0.3]"), on("young = 0.5, poisson = 0.3"));
}

#[test]
fn without_a_solid_pressures_are_over_the_modulus() {
    let bare = |load| Setup::new(Recipe::indenter(Indenter::Cylinder { radius: 1.0 }), Cell::line(64, 4.0), load);
    assert!(matches!(
        bare(Load::MeanPressure(1e6)).problem().unwrap_err(),
        SetupError::NoModulus { load: "mean pressure", value: 1e6 }
    ));
    for load in [Load::ReducedPressure(0.01), Load::MeanGap(0.3)] {
        let (over, on) = (solve(&bare(load)), solve(&bare(load).on(Solid::ContactModulus(1.0))));
        assert_eq!(over.pressure, on.pressure);
    }
}

#[test]
fn lists_and_ranges_of_loads_are_read_and_written() {
    let loads = |load: &str| {
        let mut table = SetupTable::from_toml(&SCENE.replace("mean-pressure = 0.01", load)).unwrap();
        let loads = table.take_loads().map_err(|error| error.to_string());
        loads.map(|loads| (loads, table))
    };
    let (none, _) = loads("mean-pressure = 0.01").unwrap();
    assert_eq!(none, None);
    let (list, table) = loads("mean-gap = [0.3, 0.2]").unwrap();
    let list = list.unwrap();
    assert_eq!(list, [Load::MeanGap(0.3), Load::MeanGap(0.2)]);
    let setup = table.setup().unwrap().under_loads(list.clone());
    assert_eq!((setup.load, &setup.loads), (list[0], &list));
    assert_eq!(Setup::from_toml(&setup.to_toml()).unwrap(), setup);
    assert_eq!(setup.to_table().setup().unwrap(), setup);
    let (range, _) = loads("reduced-pressure = '1e-3..1e-1:13'").unwrap();
    let range: Vec<f64> = range.unwrap().iter().map(Load::value).collect();
    assert_eq!((range.len(), range[0], range[12]), (13, 1e-3, 1e-1));
    let ratio = 10f64.powf(1.0 / 6.0);
    assert!(range.windows(2).all(|pair| (pair[1] / pair[0] / ratio - 1.0).abs() < 1e-14), "{range:?}");
    for (load, words) in [
        ("mean-pressure = []", "load: the list is empty: give at least one load"),
        ("mean-pressure = [1.0, -2.0]", "the mean pressure is -2.0: give a positive, finite value"),
        ("mean-gap = [1.0, \"x\"]", "load.mean-gap: invalid value: text \"x\", expected a length"),
        ("mean-pressure = '1..10'", "load: `1..10` is not a range: give first..last:number, such as 1e-3..1e-1:13"),
        ("mean-pressure = '1..10:1'", "`1..10:1` is not a range"),
        ("mean-pressure = '0..10:3'", "the mean pressure is 0.0: give a positive, finite value"),
        ("reduced-pressure = '1..x:3'", "load.reduced-pressure: invalid type: text \"x\", expected a number"),
        ("mean_pressure = [1.0]", "load: unknown value `mean_pressure`"),
    ] {
        let said = loads(load).unwrap_err();
        assert!(said.contains(words) && !said.contains('\n'), "{load}: {said}");
    }
}

#[test]
fn measured_heights_lose_their_trend_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let waves = |y: f64, x: f64| (0.7 * y + 2.0).sin() + (0.4 * x).cos();
    for (ny, nx) in [(1, 50), (12, 20)] {
        let height = |tilt: f64| {
            ndarray::Array2::from_shape_fn((ny, nx), |(i, j)| {
                let (y, x) = (i as f64, j as f64);
                waves(y, x) + tilt * (3.0 + 0.2 * y - 0.1 * x)
            })
        };
        let surface = |tilt: f64, detrend: &str| {
            write_heights(folder.path().join("h.npy"), height(tilt).view().into_dyn()).unwrap();
            let scene = folder.path().join("scene.toml");
            fs::write(&scene, format!("surface = {{ height = 'h.npy'{detrend} }}\ngrid.size = [1.0, 2.0]")).unwrap();
            let (recipe, cell) = SetupTable::read(&scene).unwrap().surface().unwrap();
            recipe.surface(recipe.grid(&cell).unwrap()).unwrap()
        };
        let plane = [0.0, 1.0, -20.0].map(|tilt| surface(tilt, ", prepare.detrend = 'plane'"));
        for other in &plane[1..] {
            let pairs = plane[0].heights().iter().zip(other.heights());
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12), "{ny} x {nx}");
        }
        // what is left has no slope: its sums against the positions vanish
        let left = plane[0].height();
        let slope = |f: fn((usize, usize)) -> f64| left.indexed_iter().map(|(at, h)| f(at) * h).sum::<f64>();
        assert!(slope(|(i, _)| i as f64).abs() < 1e-10 && slope(|(_, j)| j as f64).abs() < 1e-10);
        let (mean, whole) = (surface(1.0, ", prepare.detrend = 'mean'"), surface(1.0, ""));
        assert!(mean.mean_height().abs() < 1e-14 && whole.mean_height().abs() > 0.1);
        assert!(mean.heights().iter().zip(whole.heights()).all(|(a, b)| (a - b).abs() < 1e-14));
    }
}

#[test]
fn a_solver_that_cannot_take_the_load_says_so() {
    let said = refusal("load = { mean-pressure = 0.01 }", "load = { mean-gap = 0.1 }\nsolver = { method = \"gfmd\" }");
    assert!(said.starts_with("gfmd needs a given mean pressure: give one, or choose"), "{said}");
}

#[test]
fn seeds_that_no_scene_can_hold_are_refused() {
    let setup = Setup::new(Recipe::rough(roughness(), u64::MAX), Cell::line(512, 1.0), Load::ReducedPressure(0.1));
    let refused = setup.problem().unwrap_err();
    assert!(matches!(refused, SetupError::Seed { seed: u64::MAX }), "{refused}");
}

#[cfg(feature = "units")]
mod with_units {
    use super::*;
    use asperity::surface::RandomRoughness;

    #[test]
    fn lengths_and_pressures_have_units() {
        let scene = "
            [surface]
            seed = 1
            indenter = { shape = \"cylinder\", radius = \"40 um\" }
            spectrum = { hurst = 0.8, rolloff-wavelength = \"20um\", short-cutoff = \"1e3 nm\", rms-gradient = 1e-3 }
            [grid]
            points = 512
            size = \"0.16 mm\"
            [solid]
            contact-modulus = \"1 GPa\"
            [load]
            mean-pressure = \"8000 kPa\"";
        let found = Setup::from_toml(scene).unwrap();
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 1e-6, rms_gradient: 1e-3 };
        let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-15, "{found}, {expected}");
        let Some(Indenter::Cylinder { radius }) = found.surface.indenter else { panic!("{found:?}") };
        let Load::MeanPressure(pressure) = found.load else { panic!("{found:?}") };
        let read = found.surface.spectrum.as_ref().and_then(RandomRoughness::self_affine).unwrap();
        for (found, expected) in [
            (radius, 40e-6),
            (read.rolloff_wavelength().unwrap(), spectrum.rolloff_wavelength),
            (read.short_cutoff, spectrum.short_cutoff),
            (found.grid.size[0], 160e-6),
            (found.contact_modulus().unwrap(), 1e9),
            (pressure, 8e6),
        ] {
            near(found, expected);
        }
        assert!(solve(&found).counted().relative_area > 0.0);
        assert_eq!(Setup::from_toml(&found.to_toml()).unwrap(), found);
    }

    #[test]
    fn json_is_read_like_toml_and_as_part_of_a_result() {
        for setup in setups() {
            let json = serde_json::to_string(&setup).unwrap();
            assert_eq!(SetupTable::from_json(&json).unwrap().setup().unwrap(), setup, "{json}");
            let result = format!("{{\"kappa_r\": 1.75, \"setup\": {json}}}");
            assert_eq!(SetupTable::from_json(&result).unwrap().setup().unwrap(), setup);
        }
        let json = r#"{"surface": {"indenter": {"shape": "sine", "amplitude": "1 um"}},
            "grid": {"points": 64, "size": "1 mm"}, "load": {"mean-gap": "100 nm"}}"#;
        let setup = SetupTable::from_json(json).unwrap().setup().unwrap();
        assert!(matches!(setup.load, Load::MeanGap(gap) if (gap / 100e-9 - 1.0).abs() < 1e-15));
    }

    #[test]
    fn json_that_is_no_setup_is_refused_in_one_sentence() {
        let object = "give an object with sections such as `surface` and `load`, and no value that is null";
        for (json, words) in [
            ("", "this is not a setup in JSON: the text ends too early, in line 1"),
            ("{", "this is not a setup in JSON: the text ends too early, in line 1"),
            ("3", object),
            ("[]", object),
            ("null", object),
            ("{\"setup\": 3}", object),
            ("{\"load\": {\"mean-pressure\": null}}", object),
            ("{}", "no surface is given"),
            ("{\"surface\": {\"seed\": 1}}", "no load is given"),
        ] {
            let said = SetupTable::from_json(json).and_then(SetupTable::setup).unwrap_err().to_string();
            assert!(said.contains(words) && !said.contains('\n'), "{json}: {said}");
        }
    }

    #[test]
    fn unknown_names_are_refused_with_the_nearest_known_one() {
        for (from, to, place, nearest) in [
            ("load =", "loda =", "", "load"),
            ("mean-pressure", "mean_pressure", "load: ", "mean-pressure"),
            ("mean-pressure", "pressure", "load: ", "mean-pressure"),
            ("grid", "gird", "", "grid"),
            ("points", "pionts", "grid: ", "points"),
            ("indenter", "indentor", "surface: ", "indenter"),
            ("radius", "raduis", "surface.indenter: ", "radius"),
            ("cylinder", "cilinder", "surface.indenter.shape: ", "cylinder"),
            ("grid", "solver = { method = \"gmfd\" }\ngrid", "solver.method: ", "gfmd"),
            ("grid", "solver = { method = \"gfmd\", timestep = 0.1 }\ngrid", "solver: ", "time-step"),
            ("grid", "solver = { method = \"gfmd\", masses = \"uniforn\" }\ngrid", "solver.masses: ", "uniform"),
            ("grid", "stop = { tol = 1e-8 }\ngrid", "stop: ", "tolerance"),
            ("contact-modulus", "modulus", "solid: ", "contact-modulus"),
            ("grid", "record = { what = [\"mask\", \"trace\"] }\ngrid", "record.what: ", "traces"),
        ] {
            let said = refusal(from, to);
            assert!(said.starts_with(&format!("{place}unknown ")), "{to}: {said}");
            assert!(said.ends_with(&format!(": did you mean `{nearest}`?")) && !said.contains('\n'), "{to}: {said}");
        }
    }

    #[test]
    fn units_that_do_not_fit_are_refused() {
        for (from, to, words) in [
            ("0.01", "\"1 parsnip\"", "load.mean-pressure: invalid value: text \"1 parsnip\", expected a pressure"),
            ("0.01", "\"1 um\"", "load.mean-pressure: invalid value: text \"1 um\", expected a pressure"),
            ("4.0", "\"4 GPa\"", "grid.size: invalid value: text \"4 GPa\", expected a length"),
            (
                "radius = 1.0",
                "radius = \"wide\"",
                "surface.indenter.radius: invalid value: text \"wide\", expected a length",
            ),
        ] {
            let said = refusal(from, to);
            assert!(said.starts_with(words) && said.contains("a number, or one with a unit such as"), "{to}: {said}");
        }
    }
}

#[test]
fn grids_that_exceed_memory_are_refused_in_numbers() {
    let grid = Grid::surface([1 << 17, 1 << 17], [1.0, 1.0]).unwrap();
    let refused = Cost::from_fields(&grid, 1e4).check("a test").unwrap_err().to_string();
    assert!(refused.contains("131072 x 131072 points") && refused.contains("1374 TB"), "{refused}");
    assert!(Cost::from_fields(&Grid::line(4, 1.0).unwrap(), 5.0).check("a test").is_ok());
}
