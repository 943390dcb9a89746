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
        // the half behind the middle row, which is the cut
        let behind = rows_of / 2;
        assert_eq!(mesh.len(), (rows_of - behind + 1) * (columns + 1));
        assert!(mesh[..=columns].iter().all(|vertex| vertex.y() == 0.0));
        let inner = (0..rows_of - behind).flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column));
        let upwards: Vec<f64> = inner.map(|vertex| f64::from(mesh[vertex].z())).collect();
        let displacement: Vec<f64> = contact.displacement.iter().skip(behind * columns).copied().collect();
        let (rest, scale) = likeness(&upwards, &displacement);
        assert!(rest < 1e-3 && scale < 0.0, "{rest}, {scale}");
        let pressure: Vec<f64> = contact.pressure.iter().skip(behind * columns).copied().collect();
        let lowest = (0..upwards.len()).min_by(|&a, &b| upwards[a].total_cmp(&upwards[b])).unwrap();
        assert!(pressure[lowest] > 0.0, "the lowest place of the solid is not pressed");
    }
}

/// The section of a sphere's dent, in the coordinates of the viewer: the solid fills it from its foot up to its surface, the rigid surface is nowhere
/// below it, and meets it where it is in contact.
#[test]
fn the_section_of_a_dent_shows_solid_contact_and_rigid_surface() {
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(Grid::surface([64, 64], [1.0, 1.0]).unwrap()).unwrap();
    let sphere = Problem::new(sphere, asperity::contact::ContactModulus(1.0), Load::ReducedPressure(0.1)).unwrap();
    let (folder, contact) = records_of(&sphere, 0.1, Part::Mesh);
    let path = folder.path().join("it.rrd");
    let stretch = |entity: &str| {
        let scale = rerun::Transform3D::descriptor_scale();
        let (_, scale) = rows::<rerun::components::Scale3D>(&path, entity, scale).pop().unwrap();
        let shift = rerun::Transform3D::descriptor_translation();
        let (_, shift) = rows::<rerun::components::Translation3D>(&path, entity, shift).pop().unwrap();
        (scale[0].z(), shift[0].z())
    };
    let strips = |entity: &str| {
        let strips = rerun::LineStrips3D::descriptor_strips();
        let (_, strips) = rows::<rerun::components::LineStrip3D>(&path, entity, strips).pop().unwrap();
        strips.into_iter().flat_map(|strip| strip.0).map(|point| [point.x(), point.y(), point.z()]).collect::<Vec<_>>()
    };
    let (factor, shift) = stretch("/it/relief/solid");
    let stretched = |points: Vec<[f32; 3]>| points.into_iter().map(|[x, y, z]| [x, y, factor * z + shift]).collect();
    let solid: Vec<[f32; 3]> = stretched(strips("/it/relief/solid/edge"));
    let touching: Vec<[f32; 3]> = stretched(strips("/it/relief/solid/contact"));
    let [low, high] =
        solid.iter().fold([f32::MAX, f32::MIN], |[low, high], point| [low.min(point[2]), high.max(point[2])]);
    // the relief is 1.6 high, and the corners of the cell, which are highest, are not in the section
    assert!(
        (low + 1.6).abs() < 0.01 && (-0.4..-0.05).contains(&high),
        "a dent nearly as deep as the relief: {low} to {high}"
    );
    let rigid = strips("/it/relief/rigid/edge");
    let height = |line: &[[f32; 3]], x: f32| {
        let pair = line.windows(2).find(|pair| (pair[0][0]..=pair[1][0]).contains(&x))?;
        let share = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
        Some(pair[0][2] + share * (pair[1][2] - pair[0][2]))
    };
    let above = |point: &[f32; 3]| height(&rigid, point[0]).map(|rigid| rigid - point[2]);
    assert!(solid.iter().filter_map(above).all(|gap| gap > -1e-2), "the rigid surface is inside of the solid");
    assert!(touching.iter().filter_map(above).all(|gap| gap < 0.1), "a contact without the rigid surface");
    let width = touching.iter().fold([f32::MAX, f32::MIN], |[a, b], point| [a.min(point[0]), b.max(point[0])]);
    let counted = contact.pressure.row(32).iter().filter(|pressure| **pressure > 0.0).count() as f32;
    assert!(((width[1] - width[0]) - counted * 10.0 / 64.0).abs() < 0.05, "{width:?} for {counted} nodes");
}
