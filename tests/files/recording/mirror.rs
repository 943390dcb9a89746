//! The measured part of mirrored heights is outlined in the pictures: of a map that was mirrored along both axes a quarter, at node 0.

use super::rows;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::Setup;
use rerun::components::{LineStrip2D, LineStrip3D};
use rerun::{LineStrips2D, LineStrips3D};
use std::path::Path;

/// Left, right, lower and upper end of what is drawn in space under an entity, as it lies in the cell; nothing where nothing is.
fn ends_in_space(path: &Path, entity: &str) -> Option<[f32; 4]> {
    let rows = rows::<LineStrip3D>(path, entity, LineStrips3D::descriptor_strips());
    let points: Vec<[f32; 3]> = rows.last()?.1.iter().flat_map(|it| &it.0).map(|p| [p.x(), p.y(), p.z()]).collect();
    let end = |axis: usize, pick: fn(f32, f32) -> f32| points.iter().map(|p| p[axis]).reduce(pick);
    Some([end(0, f32::min)?, end(0, f32::max)?, end(1, f32::min)?, end(1, f32::max)?])
}

/// Left, right, upper and lower end of what is drawn under an entity; nothing where nothing is.
fn ends(path: &Path, entity: &str) -> Option<[f32; 4]> {
    let rows = rows::<LineStrip2D>(path, entity, LineStrips2D::descriptor_strips());
    let points: Vec<[f32; 2]> =
        rows.into_iter().flat_map(|(_, strips)| strips).flat_map(|it| it.0).map(|p| [p.x(), p.y()]).collect();
    let end = |axis: usize, pick: fn(f32, f32) -> f32| points.iter().map(|p| p[axis]).reduce(pick);
    Some([end(0, f32::min)?, end(0, f32::max)?, end(1, f32::min)?, end(1, f32::max)?])
}

/// The outlines in the picture of the pressure and in the relief of heights in a file that are prepared in some way.
fn outlines(text: &str, prepare: &str) -> [Option<[f32; 4]>; 2] {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("heights.txt");
    std::fs::write(&file, text).unwrap();
    let scene = format!(
        "[surface]\nheight = {:?}\n[surface.prepare]\n{prepare}\n[grid]\nsize = 1.0\n[load]\nreduced-pressure = 0.05\n",
        file.display().to_string()
    );
    let setup = Setup::from_toml(&scene).unwrap();
    let problem = setup.problem().unwrap();
    let path = folder.path().join("it.rrd");
    let recording = Recording::create(&path, &[Scene::from_setup(&setup, &problem)], Options::default()).unwrap();
    setup.solver.solver().solve(&problem, &setup.stop, &mut recording.recorder(0)).unwrap();
    recording.finish().unwrap();
    [ends(&path, "/contact/pressure/measured"), ends_in_space(&path, "/contact/relief/solid/measured")]
}

#[test]
fn the_measured_part_of_mirrored_heights_is_outlined() {
    let height = |y: usize, x: usize| format!("{:.4}", 0.01 * ((x * x + 3 * y) as f64 * 0.21).sin());
    let rows = |ny: usize| {
        (0..ny).map(|y| (0..24).map(|x| height(y, x)).collect::<Vec<_>>().join(" ") + "\n").collect::<String>()
    };
    // A unit is a node of the map, 46 x 46 with its images, and rows are counted upwards.
    assert_eq!(outlines(&rows(24), "mirror = \"both\"")[0], Some([0.0, 23.0, 23.0, 46.0]));
    assert_eq!(outlines(&rows(24), "mirror = \"x\"")[0], Some([0.0, 23.0, 0.0, 24.0]));
    assert_eq!(outlines(&rows(24), "detrend = \"plane\""), [None, None]);
    let [line, relief] = outlines(&rows(1).replace(' ', "\n"), "mirror = \"both\"");
    let [left, right, ..] = line.unwrap();
    assert!(left == 0.0 && (right - 500.0).abs() < 1.0 && relief.is_none(), "a half of the line: {right}");
}

#[test]
fn the_measured_part_is_outlined_on_the_relief() {
    let height = |y: usize, x: usize| format!("{:.4}", 0.01 * ((x * x + 3 * y) as f64 * 0.21).sin());
    let row = |y: usize| (0..24).map(|x| height(y, x)).collect::<Vec<_>>().join(" ") + "\n";
    let map: String = (0..24).map(row).collect();
    // the cell is 10 units long around the middle
    let quarter = outlines(&map, "mirror = \"both\"")[1].unwrap();
    // the front half is cut away, and with it the rest of this part; the last dash ends before the middle
    assert!(quarter[0] == -5.0 && (-1.0..=0.0).contains(&quarter[1]) && quarter[2..] == [0.0, 0.0], "{quarter:?}");
    let half = outlines(&map, "mirror = \"x\"")[1].unwrap();
    assert!(half[0] == -5.0 && half[1].abs() < 0.01 && (0.0..=1.0).contains(&half[2]) && half[3] > 2.5, "{half:?}");
}
