//! Bumps on lines, and curvatures.

use asperity::setup::{Setup, command};
use asperity::surface::{Bump, Bumps};
use asperity::{Grid, Indenter};

/// A bump at the rim of a period is on both sides of it.
#[test]
fn a_bump_goes_on_across_the_period() {
    let bumps = Bumps(vec![Bump { at: 0.0, height: 2e-3, width: 0.1 }, Bump { at: 0.5, height: -1e-3, width: 0.05 }]);
    let line = bumps.surface(Grid::line(20, 1.0).unwrap()).unwrap().heights_as_given();
    // exp(-1/2) = 0.606531, exp(-2) = 0.135335
    let expected = [(0, 2e-3), (2, 1.213061e-3), (18, 1.213061e-3), (4, 2.70671e-4), (10, -9.92547e-4)];
    for (node, height) in expected {
        let far = if node == 10 { 2e-3 * (-12.5f64).exp() - 1e-3 } else { height };
        assert!((line[[0, node]] - far).abs() < 1e-9, "{node}: {}", line[[0, node]]);
    }
}

#[test]
fn bumps_of_a_scene_repeat_from_its_command_and_its_text() {
    let text = r#"
        grid = { points = [64], size = [1.6e-4] }
        solid = { contact-modulus = 1e9 }
        load = { reduced-pressure = 0.1 }
        surface = { indenter = { shape = "cylinder", radius = 1e-3 }, bumps = [4e-5, 1e-7, 5e-6, 1e-4, -5e-8, 2e-6] }
    "#;
    let setup = Setup::from_toml(text).unwrap();
    let of = |[at, height, width]: [f64; 3]| Bump { at, height, width };
    assert_eq!(setup.surface.bumps.0, [of([4e-5, 1e-7, 5e-6]), of([1e-4, -5e-8, 2e-6])]);
    assert_eq!(Setup::from_toml(&setup.to_toml()).unwrap(), setup);
    assert!(command(&setup).contains("--bumps 4e-5,1e-7,5e-6,1e-4,-5e-8,2e-6"), "{}", command(&setup));
    assert!(setup.surface.smooth().is_none(), "a cylinder with bumps is no cylinder of Hertz");
}

#[test]
fn bumps_that_cannot_be_are_refused() {
    let two = "bumps = [1e-5, 1e-7]";
    let flat = "bumps = [1e-5, 1e-7, 0.0]";
    let scene = |bumps: &str, points: &str| {
        let text = format!(
            "grid = {{ points = {points}, size = [1e-4] }}\nsolid = {{ contact-modulus = 1e9 }}\n\
             load = {{ reduced-pressure = 0.1 }}\nsurface = {{ {bumps} }}\n"
        );
        Setup::from_toml(&text).and_then(|setup| setup.surface().map(|_| ())).unwrap_err().to_string()
    };
    assert!(
        scene(two, "[64]").contains("2 lengths do not describe bumps: give three per bump"),
        "{}",
        scene(two, "[64]")
    );
    assert!(scene(flat, "[64]").contains("the width of a bump is 0.0"), "{}", scene(flat, "[64]"));
    let surface = scene("bumps = [1e-5, 1e-7, 1e-6]", "[64, 64]");
    assert!(surface.contains("a bump needs a line"), "{surface}");
}

/// Parabolas have one curvature; a sine has `(2 pi/L)^2` times its height, but for the second difference.
#[test]
fn curvatures_are_those_of_the_body() {
    let (line, plane) = (Grid::line(64, 1.0).unwrap(), Grid::surface([48, 64], [0.75, 1.0]).unwrap());
    let cylinder = Indenter::Cylinder { radius: 3.0 }.surface(line).unwrap();
    let sphere = Indenter::Sphere { radius: 3.0 }.surface(plane).unwrap();
    assert!((cylinder.curvature()(32) * 3.0 - 1.0).abs() < 1e-9);
    assert!((sphere.curvature()(24 * 64 + 30) * 3.0 - 1.0).abs() < 1e-9);
    let sine = Indenter::Sine { amplitude: 0.01 }.surface(line).unwrap();
    let steepest = 0.01 * std::f64::consts::TAU.powi(2);
    assert!((sine.curvature()(32) / steepest - 1.0).abs() < 1e-3);
    assert!((sine.curvature()(0) / steepest + 1.0).abs() < 1e-3);
    let free = cylinder.curvature();
    let rim = Indenter::Cylinder { radius: 3.0 }.surface(line.with_periodic([true, false])).unwrap();
    assert_eq!(rim.curvature()(0), 0.0);
    assert!(free(0) < 0.0, "the ridge between two cylinders is hollow");
}
