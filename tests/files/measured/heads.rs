//! Texts of programs that say distances, units and voids in their heads, and tables whose columns have names.

use asperity::formats::{FileUnits, Measurement};

/// Heights of the maps here, row by row, of which none is at the place [1, 2].
const MAP: [[f64; 5]; 4] = [
    [0.5, -1.25, 2.0, 0.0, 1.5],
    [3.0, 0.25, f64::NAN, -0.5, -2.0],
    [1.0, 1.25, 0.75, 4.0, -3.5],
    [-0.25, 2.5, -1.0, 0.125, 5.0],
];

/// The rows of [`MAP`] with cells parted by a text, and a word for the void.
fn rows(part: &str, void: &str) -> String {
    let cell = |height: &f64| if height.is_nan() { void.to_owned() } else { format!("{height:.3}") };
    MAP.iter().map(|row| row.iter().map(cell).collect::<Vec<_>>().join(part) + "\n").collect()
}

fn read(text: &str) -> Measurement {
    Measurement::from_bytes(text.as_bytes(), None).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn reason(text: &str) -> String {
    Measurement::from_bytes(text.as_bytes(), None).unwrap_err().to_string()
}

fn is_close(found: f64, told: f64) -> bool {
    (found.is_nan() && told.is_nan()) || (found - told).abs() <= 1e-9 * told.abs()
}

/// Asserts that heights are those of [`MAP`] in a unit, with distances along y and x.
fn assert_map(text: &str, unit: f64, spacing: Option<[f64; 2]>) -> Measurement {
    let measured = read(text);
    assert_eq!(measured.height.dim(), (4, 5), "{text}");
    let told = MAP.concat();
    assert!(
        measured.height.iter().zip(told).all(|(found, told)| is_close(*found, told * unit)),
        "{measured:?}\n{text}"
    );
    match (measured.spacing, spacing) {
        (Some(found), Some(told)) => assert!((0..2).all(|axis| is_close(found[axis], told[axis])), "{found:?}\n{text}"),
        (found, told) => assert_eq!(found, told, "{text}"),
    }
    measured
}

#[test]
fn voids_are_spelt_in_many_ways() {
    let words = [
        "-nan(ind)",
        "nan(0x8000)",
        "-1.#IND",
        "1.#J",
        "OUT",
        "NoData",
        "No Data",
        "***",
        "#DIV/0!",
        "-",
        "--.-",
        "#N/A",
        "-nan",
        "inf",
        "out of range",
        "####",
        "\"\"",
    ];
    for word in words {
        for part in [",", ";", "\t", ", "] {
            assert_map(&rows(part, word), 1.0, None);
        }
        if word != "\"\"" {
            assert_map(&rows(" ", word), 1.0, None);
        }
    }
}

#[test]
fn empty_cells_are_void() {
    for part in [",", ";", "\t", ", "] {
        let text = rows(part, "");
        assert_map(&text, 1.0, None);
        // a separator at the end of each line makes no column
        assert_map(&text.replace('\n', &format!("{part}\n")), 1.0, None);
    }
    assert_map(&rows(";", "").replace('.', ","), 1.0, None);
    let quoted = rows("\",\"", "").replace('.', ",").replace('\n', "\"\n\"");
    assert_map(&format!("\"{}", quoted.trim_end_matches('"')), 1.0, None);
    // rows without a height count where nothing but they stands above
    let lines = [",,,,\n", &rows(",", ""), ",,,,\n"].concat();
    assert_eq!(read(&lines).height.dim(), (6, 5));
    assert_eq!(read(&format!("Name,Steel,,,\n,,,,\n{}", rows(",", ""))).height.dim(), (4, 5));
    let profile = read("x (um),z (nm)\n0,1.5\n1,\n2,3.5\n3,4.5\n");
    assert!(profile.is_profile && profile.height[[0, 1]].is_nan() && is_close(profile.height[[0, 3]], 4.5e-9));
    assert!(reason("1,2,3,4\n5,6,7\n8,9,1,2\n").starts_with("line 2 has 3 numbers"));
}

#[test]
fn grids_of_geographers_say_their_cells_and_voids() {
    let head = "ncols 5\nnrows 4\nxllcorner 0.0\nyllcorner 0.0\ncellsize 0.5\nNODATA_value -9999\n";
    let measured = assert_map(&(head.to_owned() + &rows(" ", "-9999.000")), 1.0, Some([0.5, 0.5]));
    assert_eq!((measured.units, measured.is_in_metres), (FileUnits::default(), false));
    assert!(measured.warnings.is_empty());
    let other = head.to_uppercase().replace("CELLSIZE 0.5", "DX 0.5\nDY 2").replace("-9999", "-3.4028235e+38");
    assert_map(&(other + &rows(" ", "-3.4028234663852886e+38")), 1.0, Some([2.0, 0.5]));
    // a void that nobody declares is a height, and told
    let silent = read(&rows(" ", "-9999"));
    assert_eq!(silent.height[[1, 2]], -9999.0);
    assert!(
        silent.warnings[0].to_string().contains("1 heights are -9999, far from all others"),
        "{:?}",
        silent.warnings
    );
    let wrong = read(&(head.replace("nrows 4", "nrows 5") + &rows(" ", "-9999")));
    assert!(wrong.warnings[0].to_string().contains("states 5 rows, but there are 4"));
    let listed: String = rows("\n", "-9999");
    assert_map(&(head.to_owned() + &listed), 1.0, Some([0.5, 0.5]));
}

#[test]
fn heads_say_the_size_of_a_pixel_and_the_unit_of_heights() {
    let quoted = |text: &str, part: &str| -> String {
        let row = |line: &str| format!("\"{}\"\n", line.split(',').collect::<Vec<_>>().join(&format!("\"{part}\"")));
        text.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { row(line) }).collect()
    };
    let keyence =
        "Model,VK-X3000\nXY Calibration,500.000,nm\nHorizontal,5\nVertical,4\nMinimum value,-3.5\nUnit,um\n\nHeight\n"
            .to_owned()
            + &rows(",", "");
    for text in [quoted(&keyence, ","), quoted(&keyence, ";").replace('.', ","), quoted(&keyence, "\t"), keyence] {
        let measured = assert_map(&text, 1e-6, Some([0.5e-6; 2]));
        assert!(measured.is_in_metres && measured.warnings.is_empty(), "{:?}", measured.warnings);
    }
    let heads = [
        "numCols\tnumRows\tpixelSize (um)\n5\t4\t0.5\nZ-data (nm)\n",
        "# pixel size = 0.5 um\n# unit = nm\n",
        "Pixel size [µm]: 0,5\nHeight [nm]\n",
        "pixel_size_um\t0.5\nz_unit\tnm\n",
        "dx = 500 nm\ndy = 0.5um\nz unit: nm\n",
        "Scan size: 2.5 x 2 um\nZ (nm)\n",
        "Lateral resolution\t0.5\tum\nUnits\tnm\n",
    ];
    for head in heads {
        let measured = assert_map(&(head.to_owned() + &rows("\t", "")), 1e-9, Some([0.5e-6; 2]));
        assert!(measured.is_in_metres, "{head}");
    }
    let half = assert_map(&("pixelSize (um): 1.5\n".to_owned() + &rows("\t", "")), 1.0, Some([1.5e-6; 2]));
    assert!(!half.is_in_metres && half.units.height.is_none() && half.units.distance.is_some());
    let heights = assert_map(&("Z (nm)\n".to_owned() + &rows("\t", "")), 1e-9, None);
    assert!(heights.is_in_metres);
}

/// Positions with a step, and two columns of heights, each with what is between the cells.
fn profile(head: &str, step: f64, part: &str) -> String {
    let line = |i: usize| {
        let height = (0.4 * i as f64).sin();
        [step * i as f64, height, height + 2.0].map(|it| format!("{it:.4}")).join(part) + "\n"
    };
    head.to_owned() + "\n" + &(0..40).map(line).collect::<String>()
}

#[test]
fn columns_are_known_by_their_names() {
    for (head, part) in
        [("x [um],z [um],z raw [um]", ","), ("x\tz\tz_raw\n[um]\t[um]\t[um]", "\t"), ("X (um) Z (um) Zraw (um)", " ")]
    {
        let measured = read(&profile(head, 1.0, part));
        assert!(measured.is_profile && measured.is_in_metres && measured.positions.is_none(), "{head}");
        assert!(
            is_close(measured.spacing.unwrap()[1], 1e-6) && is_close(measured.height[[0, 4]], 0.9996e-6),
            "{measured:?}"
        );
        assert_eq!((measured.channels.len(), measured.channel.to_lowercase().as_str()), (2, "z"));
    }
    let raw = profile("x [um],z [um],z raw [um]", 1.0, ",");
    let raw = Measurement::from_bytes(raw.as_bytes(), Some("z raw")).unwrap();
    assert!(is_close(raw.height[[0, 0]], 2e-6));
    // the better heights are taken wherever they stand, and a fourth column is no map
    let turned = read(&profile("x [um],z raw [um],z [um]", 0.5, ","));
    assert!(
        is_close(turned.height[[0, 0]], 2e-6) && turned.channel == "z" && is_close(turned.spacing.unwrap()[1], 0.5e-6)
    );
    // a count and positions, told apart by the evenness of the second column
    let unnamed = profile("", 1.0, ",");
    assert!(reason(&unnamed).contains("may count the points or hold their positions"), "{}", reason(&unnamed));
    let counted: String =
        (0..40).map(|i| format!("{i},{:.4},{:.4}\n", 0.25 * i as f64, (0.4 * i as f64).sin())).collect();
    assert!(is_close(read(&counted).spacing.unwrap()[1], 0.25));
    let four: String =
        (0..40).map(|i| format!("{:.1},{:.3},1,{:.2}\n", 0.5 * i as f64, (0.4 * i as f64).sin(), i % 3)).collect();
    assert!(read(&four).warnings[0].to_string().contains("rises evenly, as positions do"));
    assert!(read(&format!("X;Z;Raw;Form\n{}", four.replace(',', ";"))).is_profile);
}

/// Points of a grid of 12 x 9 whose lines are 0.5 and 0.25 apart, off their places by up to a share of these; a tenth is missing.
fn points(share: f64) -> String {
    let mut random = 1_u64;
    let mut off = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        share * (2.0 * ((random >> 33) as f64 / (1_u64 << 31) as f64) - 1.0)
    };
    let places = (0..9).flat_map(|iy| (0..12).map(move |ix| [iy, ix])).filter(|[iy, ix]| (3 * iy + ix) % 10 != 4);
    let line = |[iy, ix]: [i32; 2]| {
        format!("{:.6} {:.6} {}\n", 0.5 * (f64::from(ix) + off()), 0.25 * (f64::from(iy) + off()), 100 * iy + ix)
    };
    places.map(line).collect()
}

#[test]
fn points_may_be_off_their_grid() {
    for share in [0.0, 1e-6, 0.01, 0.05, 0.08] {
        let measured = read(&points(share));
        assert_eq!(measured.height.dim(), (9, 12), "{share}");
        let spacing = measured.spacing.unwrap();
        assert!(
            (spacing[0] / 0.25 - 1.0).abs() < 0.1 * share + 1e-6 && (spacing[1] / 0.5 - 1.0).abs() < 0.1 * share + 1e-6
        );
        let is_right = |((iy, ix), height): ((usize, usize), &f64)| match (3 * iy + ix) % 10 {
            4 => height.is_nan(),
            _ => *height == (100 * iy + ix) as f64,
        };
        assert!(measured.height.indexed_iter().all(is_right), "{share}");
        let is_told = measured.header.iter().any(|it| it.0 == "points off the grid");
        assert_eq!(is_told, share > 1e-3, "{share}");
    }
    assert!(reason(&points(0.25)).contains("not x, y and height on an evenly spaced grid"));
    let twice = reason(&(points(0.01) + "0.5 0.0 7\n"));
    assert!(twice.contains("two of its points have one place") && twice.contains("x = 0.5 and y = 0.0"), "{twice}");
}

/// A file of points or of phases of Zygo's instruments with origin 10 and 20.
fn zygo(magic: &str, pixel: &str, body: &str) -> String {
    format!(
        "{magic}\n0 3 0 0 \"Tue Aug 25 16:59:23 2026\"\n0 0 5 4 1 255\n10 20 5 4\n\"steel\"\n\"\"\n\"\"\n0 0.5 6.4e-07 0 0.9 0 {pixel} 0\n\
         640 480 0 0 0 0 \"\"\n0 0 1 33 0 0 0.1 60 2 50\n1 1 100 0 0 0 0 0 0 0\n0 \"\"\n1 5 0\n#\n{body}#\n"
    )
}

#[test]
fn texts_of_zygo_say_their_pixels() {
    let point = |(iy, row): (usize, &[f64; 5])| -> String {
        let height = |height: f64| if height.is_nan() { "No Data".to_owned() } else { format!("{height:.4}") };
        (0..5).map(|ix| format!("{} {} {}\n", ix + 10, iy + 20, height(row[ix]))).collect()
    };
    let body: String = MAP.iter().enumerate().map(point).collect();
    let magic = "Zygo XYZ Data File - Format 1";
    let measured = assert_map(&zygo(magic, "2.5e-06", &body), 1e-6, Some([2.5e-6; 2]));
    assert!(measured.is_in_metres && measured.format == "Zygo text" && measured.warnings.is_empty());
    assert_map(&zygo(magic, "0", &body), 1e-6, None);
    let short = read(&zygo(magic, "2.5e-06", &body.replace("10 21 3.0000\n", "")));
    assert!(short.warnings[0].to_string().contains("1 of 20 points are missing"));
    assert!(
        reason(&zygo(magic, "2.5e-06", &body.replace("10 21", "15 21"))).contains("none of its 4 rows of 5 points")
    );
    let phases = rows(" ", "2147483640").replace(".", "");
    let intensities = "1 2 3 4 5\n".repeat(4) + "#\n";
    // 1000 is a fringe of 32768 numbers
    let unit = 1000.0 * 0.5 * 6.4e-7 * 0.9 / 32768.0;
    assert_map(&zygo("Zygo ASCII Data File - Format 2", "2.5e-06", &(intensities + &phases)), unit, Some([2.5e-6; 2]));
}
