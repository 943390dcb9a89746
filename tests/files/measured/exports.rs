//! Files that are written for other programs, and what is read of them.

use asperity::formats::{Measurement, Scan};
use asperity::surface::Field;
use std::path::Path;

/// Heights of a map, none of which has few digits, with voids inside and all along a row and a column.
fn map() -> Scan {
    let is_void = |y: usize, x: usize| y == 2 || x == 5 || (y == 4 && x < 2);
    let height =
        |(y, x): (usize, usize)| if is_void(y, x) { f64::NAN } else { 1e-6 * (0.3 + (3 * y + x) as f64).sin() };
    Scan { height: Field::from_shape_fn((6, 9), height), spacing: [1e-6 / 3.0, 0.7e-6] }
}

fn profile() -> Scan {
    let height = |(_, x): (usize, usize)| if x == 3 { f64::NAN } else { 1e-9 * (x as f64 + 0.1).exp() };
    Scan { height: Field::from_shape_fn((1, 8), height), spacing: [1.0, 0.1e-6] }
}

/// What is read of heights that are written to a file of some ending.
fn read_back(scan: &Scan, ending: &str) -> Measurement {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("patch.{ending}"));
    scan.write(&path).unwrap();
    Measurement::read(&path, None).unwrap_or_else(|error| panic!("{error}"))
}

/// The bits of heights, the same ones for all voids.
fn bits(height: &Field) -> Vec<u64> {
    height.iter().map(|h| if h.is_nan() { 0 } else { h.to_bits() }).collect()
}

#[test]
fn maps_come_back_to_the_last_bit() {
    let scan = map();
    for ending in ["sdf", "x3p", "npy", "xyz", "gwy", "SDF"] {
        let read = read_back(&scan, ending);
        assert_eq!((read.height.dim(), read.is_profile), ((6, 9), false), "{ending}");
        assert_eq!(bits(&read.height), bits(&scan.height), "{ending}");
        match (ending, read.spacing) {
            ("npy", spacing) => assert!(spacing.is_none() && !read.is_in_metres),
            ("xyz", Some(found)) => {
                let pairs = found.into_iter().zip(scan.spacing);
                assert!(read.is_in_metres && pairs.into_iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-15), "{found:?}");
            }
            // a length over the points, and their distance again
            ("gwy", Some(found)) => assert!((0..2).all(|axis| (found[axis] / scan.spacing[axis] - 1.0).abs() < 1e-15)),
            (_, spacing) => assert_eq!((spacing, read.is_in_metres), (Some(scan.spacing), true), "{ending}"),
        }
    }
}

#[test]
fn profiles_come_back_to_the_last_bit() {
    let scan = profile();
    for ending in ["sdf", "x3p", "npy", "xyz"] {
        let read = read_back(&scan, ending);
        assert!(read.is_profile && read.positions.is_none(), "{ending}");
        assert_eq!(bits(&read.height), bits(&scan.height), "{ending}");
        let spacing = read.spacing.map(|it| it[1]);
        assert!(
            ending == "npy" || spacing.is_some_and(|dx| (dx / 0.1e-6 - 1.0).abs() < 1e-15),
            "{ending}: {spacing:?}"
        );
    }
}

#[test]
fn files_are_as_their_formats_say() {
    let folder = tempfile::tempdir().unwrap();
    let text = |scan: &Scan, name: &str| {
        scan.write(folder.path().join(name)).unwrap();
        std::fs::read_to_string(folder.path().join(name)).unwrap()
    };
    let small = Scan { height: ndarray::arr2(&[[1e-9, f64::NAN], [0.0, -2.5e-7]]), spacing: [3e-6, 2e-6] };
    let sdf = text(&small, "a.sdf");
    assert!(sdf.starts_with("aISO-1.0\r\n") && sdf.ends_with("*\r\n1e-9 BAD\r\n0e0 -2.5e-7\r\n*\r\n"), "{sdf}");
    for line in ["NumPoints = 2", "NumProfiles = 2", "Xscale = 2e-6", "Yscale = 3e-6", "Zscale = 1", "DataType = 7"] {
        assert!(sdf.lines().any(|it| it == line), "{line} in {sdf}");
    }
    let xyz = text(&small, "a.xyz");
    assert_eq!(xyz, "# x (m), y (m), height (m)\n0e0 0e0 1e-9\n0e0 3e-6 0e0\n2e-6 3e-6 -2.5e-7\n");
    let line = Scan { height: ndarray::arr2(&[[1.0, f64::NAN]]), spacing: [1.0, 2e-6] };
    assert_eq!(text(&line, "b.xyz"), "# x (m), height (m)\n0e0 1e0\n2e-6 NaN\n");
    assert!(text(&line, "b.sdf").contains("NumProfiles = 1\r\nXscale = 2e-6\r\nYscale = 0e0\r\n"));
}

/// The sum of a text of three letters is that of RFC 1321, A.5.
#[test]
fn archives_have_the_check_sums_of_what_is_in_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.x3p");
    map().write(&path).unwrap();
    let mut archive = zip::ZipArchive::new(std::fs::File::open(&path).unwrap()).unwrap();
    let mut read = |name: &str| {
        let mut bytes = Vec::new();
        std::io::Read::read_to_end(&mut archive.by_name(name).unwrap(), &mut bytes).unwrap();
        bytes
    };
    let [main, points, sum] = ["main.xml", "bindata/data.bin", "md5checksum.hex"].map(&mut read);
    assert_eq!(format!("{:x}", md5::compute("abc")), "900150983cd24fb0d6963f7d28e17f72");
    assert_eq!(String::from_utf8(sum).unwrap(), format!("{:x} *main.xml\n", md5::compute(&main)));
    let main = String::from_utf8(main).unwrap();
    assert!(main.contains(&format!("<MD5ChecksumPointData>{:x}<", md5::compute(&points))), "{main}");
    assert_eq!(points.len(), 8 * map().height.len());
}

#[test]
fn the_same_heights_are_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    for ending in Scan::endings() {
        let written = ["a", "b"].map(|name| {
            let path = folder.path().join(name).with_extension(ending);
            // a solid has no voids
            let scan = if ending == "stl" {
                Scan { height: map().height.mapv(|h| if h.is_nan() { 0.0 } else { h }), ..map() }
            } else {
                map()
            };
            scan.write(&path).unwrap();
            std::fs::read(path).unwrap()
        });
        assert_eq!(written[0], written[1], "{ending}");
    }
}

#[test]
fn other_endings_are_refused() {
    let refused = map().write(Path::new("patch.txt")).unwrap_err().to_string();
    assert_eq!(
        refused,
        "cannot write patch.txt: give a name that ends in .npy or .sdf or .x3p or .xyz or .gwy or .stl"
    );
}

/// The triangles of a binary STL: corners as bits, so that equal ones are the same.
fn triangles(bytes: &[u8]) -> Vec<[[u32; 3]; 3]> {
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count);
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let corner = |at: usize| [0, 4, 8].map(|i| number(at + i));
    (0..count).map(|i| [12, 24, 36].map(|place| corner(84 + 50 * i + place))).collect()
}

/// A closed solid: each edge is passed once in each direction, and the volume, by the theorem of divergence, is that under the surface.
#[test]
fn blocks_are_watertight() {
    let height = Field::from_shape_fn((7, 11), |(y, x)| 1e-6 * (0.7 * (3 * y + x) as f64).sin());
    let scan = Scan { height, spacing: [2e-6, 3e-6] };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("block.stl");
    scan.write(&path).unwrap();
    let triangles = triangles(&std::fs::read(&path).unwrap());
    let mut edges = std::collections::HashMap::new();
    for [a, b, c] in &triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge, ()).is_none(), "an edge is passed twice in the same direction");
        }
    }
    assert!(edges.keys().all(|(from, to)| edges.contains_key(&(*to, *from))), "an edge is open");
    let millimetres = |corner: &[u32; 3]| corner.map(|bits| f64::from(f32::from_bits(bits)));
    let volume = |corners: &[[u32; 3]; 3]| {
        let [a, b, c] = [0, 1, 2].map(|i| millimetres(&corners[i]));
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let found = triangles.iter().map(volume).sum::<f64>() / 6.0 * 1e-9;
    // the volume above the base: cells are prisms of triangles, with a diagonal from the first corner
    let [mean, deepest] = [scan.height.mean().unwrap(), scan.height.iter().copied().fold(f64::INFINITY, f64::min)];
    let above = |y: usize, x: usize| scan.height[[y, x]] - mean - (deepest - mean - 0.1 * 12e-6);
    let cell = |y: usize, x: usize| {
        let [a, b, c, d] = [above(y, x), above(y, x + 1), above(y + 1, x + 1), above(y + 1, x)];
        0.5 * 6e-12 * ((a + b + c) / 3.0 + (a + c + d) / 3.0)
    };
    let told: f64 = (0..6).flat_map(|y| (0..10).map(move |x| (y, x))).map(|(y, x)| cell(y, x)).sum();
    assert!((found / told - 1.0).abs() < 1e-5, "{found} of {told}");
    let reason = |scan: &Scan, name: &str| scan.write(folder.path().join(name)).unwrap_err().to_string();
    assert!(reason(&map(), "void.stl").contains("a solid has no void heights"));
    assert!(
        reason(&profile(), "line.stl").contains("this is a profile") && reason(&profile(), "line.gwy").contains("maps")
    );
}

/// The block of a map is read again with its units. Places have single precision, 2^-24 of a length of 180 um, and slopes of about 1 make as much of the
/// heights, along both axes.
#[test]
fn a_block_is_read_again() {
    let height = Field::from_shape_fn((37, 61), |(y, x)| 1e-6 * (0.7 * (3 * y + x) as f64).sin());
    let scan = Scan { height, spacing: [2e-6, 3e-6] };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("block.stl");
    scan.write(&path).unwrap();
    let read = Measurement::read(&path, None).unwrap();
    let mean = scan.height.mean().unwrap();
    assert_eq!((read.height.dim(), read.is_in_metres), ((37, 61), true));
    let spacing = read.spacing.unwrap();
    assert!((spacing[0] / 2e-6 - 1.0).abs() < 1e-6 && (spacing[1] / 3e-6 - 1.0).abs() < 1e-6, "{spacing:?}");
    let off = read.height.iter().zip(&scan.height).map(|(read, h)| (read - (h - mean)).abs()).fold(0.0, f64::max);
    assert!(off < 2.0 * 180e-6 * 2f64.powi(-24), "{off:e}");
}

/// A pyramid on a base of 2 x 4 with its apex at a height of 1 above the middle, as text: `min(1 - |x|, 1 - |y|/2)` at each node, whatever its unit.
#[test]
fn a_tool_of_triangles_has_the_heights_of_its_upper_side() {
    let corners = [[-1.0, -2.0], [1.0, -2.0], [1.0, 2.0], [-1.0, 2.0]];
    let facet = |points: [[f64; 3]; 3]| {
        let vertices: String = points.iter().map(|[x, y, z]| format!("vertex {x} {y} {z:e}\n")).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let mut body = String::from("solid pyramid\n");
    for (i, [x, y]) in corners.into_iter().enumerate() {
        let [next_x, next_y] = corners[(i + 1) % 4];
        body += &facet([[x, y, 0.0], [next_x, next_y, 0.0], [0.0, 0.0, 1.0]]);
        // the flat bottom, seen from below, is not of the upper side
        body += &facet([[next_x, next_y, 0.0], [x, y, 0.0], [0.0, 0.0, 0.0]]);
    }
    body += "endsolid pyramid\n";
    let folder = tempfile::tempdir().unwrap();
    let read = |text: &str| {
        let path = folder.path().join("tool.stl");
        std::fs::write(&path, text).unwrap();
        Measurement::read(&path, None)
    };
    let tool = read(&body).unwrap();
    let (ny, nx) = tool.height.dim();
    assert_eq!((ny, nx, tool.is_in_metres), (512, 256, false));
    for ((row, column), height) in tool.height.indexed_iter() {
        let [y, x] = [4.0 * row as f64 / 511.0 - 2.0, 4.0 * column as f64 / 511.0 - 1.0];
        let told = (1.0 - x.abs()).min(1.0 - y.abs() / 2.0);
        assert!((height - told).abs() < 1e-9, "{row}, {column}: {height} for {told}");
    }
    for (damaged, reason) in [
        (body.replacen("vertex -1 -2 0e0", "vertex -1 x 0", 1), "corner 1 has \"x\" in place of a number"),
        (body.replacen("vertex -1 -2 0e0", "vertex -1 nan 0", 1), "triangle 1 has a corner that is not finite"),
        (body.replacen("vertex -1 -2 0e0", "", 1), "its last triangle has no three corners"),
        (
            format!("solid wall {}", facet([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0]])),
            "none of its triangles faces along z",
        ),
    ] {
        let told = read(&damaged).unwrap_err().to_string();
        assert!(told.contains(reason), "{told}");
    }
}
