//! The two bodies in recordings, read back from their files: the rigid surface keeps its shape, and the solid is pressed down.
//!
//! Places on a canvas grow downwards, those of a relief upwards. They are compared with each other, whatever the size of the canvas.

use super::instruments::record;
use super::{cylinder, rough_line, rough_surface, rows, strips};
use asperity::contact::{Contact, Load, Multilevel};
use asperity::setup::Part;
use asperity::{Grid, Indenter, Problem};
use std::path::Path;

/// What is left of `values` after their best multiple of `of`, both less their means, over the largest of them; and that multiple.
fn likeness(values: &[f64], of: &[f64]) -> (f64, f64) {
    let centred = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|value| value - mean).collect::<Vec<_>>()
    };
    let (values, of) = (centred(values), centred(of));
    let scale = values.iter().zip(&of).map(|(a, b)| a * b).sum::<f64>() / of.iter().map(|b| b * b).sum::<f64>();
    let most = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    let rest = values.iter().zip(&of).map(|(a, b)| (a - scale * b).abs()).fold(0.0, f64::max);
    (rest / most, scale)
}

/// The places of the last indenter and the last solid of a profile at each node, downwards.
fn profile(path: &Path, nodes: usize) -> [Vec<f64>; 2] {
    ["indenter", "solid"].map(|body| {
        let (_, strip) = strips(path, &format!("/it/profile/{body}")).pop().unwrap();
        assert!(strip.len() >= nodes, "a point for each node: {}", strip.len());
        strip[..nodes].iter().map(|point| f64::from(point[1])).collect()
    })
}

fn records_of(problem: &Problem, load: f64, part: Part) -> (tempfile::TempDir, Contact) {
    let folder = tempfile::tempdir().unwrap();
    let problem = problem.clone().with_load(Load::ReducedPressure(load)).unwrap();
    let contact = record(&folder.path().join("it.rrd"), &problem, &Multilevel, &[part], true);
    (folder, contact)
}

/// Peaks of the indenter point down, at every load by the same amount for a height; the solid follows its displacement, in the same scale.
#[test]
fn a_profile_shows_the_heights_and_the_displacement_downwards() {
    for problem in [cylinder(), rough_line()] {
        let height = problem.height();
        let mut scales = Vec::new();
        for load in [0.02, 0.2, 0.6] {
            let (folder, contact) = records_of(&problem, load, Part::Profile);
            let [indenter, solid] = profile(&folder.path().join("it.rrd"), height.len());
            let displacement: Vec<f64> = contact.displacement.iter().copied().collect();
            let (rest, of_indenter) = likeness(&indenter, height);
            assert!(rest < 1e-3 && of_indenter > 0.0, "the indenter at {load}: {rest}, {of_indenter}");
            let (rest, of_solid) = likeness(&solid, &displacement);
            assert!(
                rest < 1e-2 && (of_solid / of_indenter - 1.0).abs() < 1e-2,
                "the solid at {load}: {rest}, {of_solid}"
            );
            let lies_below = indenter.iter().zip(&solid).all(|(indenter, solid)| *solid > indenter - 1e-2);
            assert!(lies_below, "the solid is above the indenter at {load}");
            scales.push(of_indenter);
        }
        assert!(scales.iter().all(|scale| (scale / scales[0] - 1.0).abs() < 1e-3), "{scales:?}");
    }
}

/// A cylinder presses a dent: the solid is further down below it than anywhere else.
#[test]
fn a_cylinder_dents_the_solid_of_a_profile() {
    let (folder, contact) = records_of(&cylinder(), 0.2, Part::Profile);
    let pressure: Vec<f64> = contact.pressure.iter().copied().collect();
    let [indenter, solid] = profile(&folder.path().join("it.rrd"), pressure.len());
    let below = |is_pressed: bool| {
        let chosen = solid.iter().zip(&pressure).filter(|(_, pressure)| (**pressure > 0.0) == is_pressed);
        chosen.map(|(down, _)| *down).fold(f64::INFINITY, f64::min)
    };
    assert!(below(true) > below(false), "{} below the contact and {} beside it, downwards", below(true), below(false));
    let deepest = |values: &[f64]| (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap();
    assert_eq!(deepest(&indenter), deepest(&solid));
    assert!(pressure[deepest(&solid)] > 0.0);
}

/// The relief of the solid follows its displacement downwards, and is lowest below a sphere.
#[test]
fn a_relief_shows_the_displacement_downwards() {
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(Grid::surface([32, 32], [1.0, 1.0]).unwrap()).unwrap();
    let sphere = Problem::new(sphere, asperity::contact::ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap();
    for problem in [sphere, rough_surface()] {
        let [rows_of, columns] = problem.surface().grid().shape();
        let (folder, contact) = records_of(&problem, 0.1, Part::Mesh);
        let positions = rerun::Mesh3D::descriptor_vertex_positions();
        let path = folder.path().join("it.rrd");
        let (_, mesh) = rows::<rerun::components::Position3D>(&path, "/it/relief/solid", positions).pop().unwrap();
        assert_eq!(mesh.len(), (rows_of + 1) * (columns + 1));
        let inner = (0..rows_of).flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column));
        let upwards: Vec<f64> = inner.map(|vertex| f64::from(mesh[vertex].z())).collect();
        let displacement: Vec<f64> = contact.displacement.iter().copied().collect();
        let (rest, scale) = likeness(&upwards, &displacement);
        assert!(rest < 1e-3 && scale < 0.0, "{rest}, {scale}");
        let pressure: Vec<f64> = contact.pressure.iter().copied().collect();
        let lowest = (0..upwards.len()).min_by(|&a, &b| upwards[a].total_cmp(&upwards[b])).unwrap();
        assert!(pressure[lowest] > 0.0, "the lowest place of the solid is not pressed");
    }
}
