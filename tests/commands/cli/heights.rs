//! Files of heights from the command line: tables of several of them, images, voids in results, the tip, and a second measurement.

use super::warnings::warnings;
use super::*;

/// Heights with a step of a micrometre between values, 24 rows of 32: a hill with a known rms height.
fn values() -> Array2<u16> {
    Array2::from_shape_fn((24, 32), |(y, x)| (3 * ((y * 5 + x * 7) % 11) + y) as u16)
}

/// The check sum of PNG chunks (ISO 3309).
fn crc(bytes: &[u8]) -> u32 {
    let mut sum = u32::MAX;
    for byte in bytes {
        sum ^= u32::from(*byte);
        for _ in 0..8 {
            sum = if sum & 1 == 1 { (sum >> 1) ^ 0xedb8_8320 } else { sum >> 1 };
        }
    }
    !sum
}

/// A PNG of 16 bits of grey, with its rows in one block that is not compressed.
fn png(values: &Array2<u16>) -> Vec<u8> {
    let mut rows = Vec::new();
    for row in values.rows() {
        rows.push(0);
        row.iter().for_each(|value| rows.extend(value.to_be_bytes()));
    }
    let (mut low, mut high) = (1u32, 0u32);
    for byte in &rows {
        low = (low + u32::from(*byte)) % 65521;
        high = (high + low) % 65521;
    }
    let length = rows.len() as u16;
    let mut data = vec![0x78, 0x01, 1];
    data.extend(length.to_le_bytes());
    data.extend((!length).to_le_bytes());
    data.extend(&rows);
    data.extend(((high << 16) | low).to_be_bytes());
    let mut head = Vec::new();
    let (ny, nx) = values.dim();
    [nx as u32, ny as u32].iter().for_each(|it| head.extend(it.to_be_bytes()));
    head.extend([16, 0, 0, 0, 0]);
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, content) in [(b"IHDR", head), (b"IDAT", data), (b"IEND", Vec::new())] {
        file.extend((content.len() as u32).to_be_bytes());
        let chunk = [&kind[..], &content].concat();
        file.extend(&chunk);
        file.extend(crc(&chunk).to_be_bytes());
    }
    file
}

/// A TIFF of 16 bits of grey in one strip.
fn tiff(values: &Array2<u16>) -> Vec<u8> {
    let (ny, nx) = values.dim();
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let mut file = b"II\x2a\0".to_vec();
    file.extend((8 + data.len() as u32).to_le_bytes());
    file.extend(&data);
    let entries: [(u16, u16, u32); 8] = [
        (256, 4, nx as u32),
        (257, 4, ny as u32),
        (258, 3, 16),
        (259, 3, 1),
        (262, 3, 1),
        (273, 4, 8),
        (278, 4, ny as u32),
        (279, 4, data.len() as u32),
    ];
    file.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, value) in entries {
        file.extend(tag.to_le_bytes());
        file.extend(kind.to_le_bytes());
        file.extend(1u32.to_le_bytes());
        file.extend(value.to_le_bytes());
    }
    file.extend(0u32.to_le_bytes());
    file
}

#[test]
fn images_are_heights_with_a_size_and_a_unit() {
    let folder = Folder::new();
    let values = values();
    std::fs::write(folder.join("grey.png"), png(&values)).unwrap();
    std::fs::write(folder.join("grey.tif"), tiff(&values)).unwrap();
    let heights = values.mapv(|value| 2e-9 * f64::from(value));
    let rms = heights.std(0.0);
    for name in ["grey.png", "grey.tif"] {
        let run = folder.run(&format!("surface {name} --size 24um,32um --height-unit 2nm --json --out back.npy"));
        assert_eq!(run.status.code(), Some(0), "{name}: {}", text(&run.stderr));
        let found = json(&run);
        assert_eq!(found["points"], serde_json::json!([24, 32]));
        assert!((found["rms_height"].as_f64().unwrap() / rms - 1.0).abs() < 1e-9, "{name}: {found}");
        let back: Array2<f64> = read_npy(folder.join("back.npy")).unwrap();
        let span = |map: &Array2<f64>| map[[23, 31]] - map[[0, 0]];
        assert!((span(&back) - span(&heights)).abs() < 1e-15, "{name}");
    }
}

#[test]
fn several_files_are_rows_of_a_table_with_their_mean() {
    let folder = Folder::new();
    for seed in [1, 2, 3] {
        let make =
            "surface --hurst 0.8 --rolloff 20um --short-cutoff 4um --rms-gradient 0.1 --points 40,40 --size 40um";
        let run = folder.run(&format!("{make} --seed {seed} --out map{seed}.x3p"));
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    }
    let run = folder.run("surface map1.x3p map2.x3p map3.x3p --out table.csv");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let table = std::fs::read_to_string(folder.join("table.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 5, "{table}");
    let column = rows[0].iter().position(|name| *name == "rms_height").unwrap();
    let number = |row: usize| -> f64 { rows[row][column].parse().unwrap() };
    let alone = json(&folder.run("surface map2.x3p --json"))["rms_height"].as_f64().unwrap();
    assert!((number(2) / alone - 1.0).abs() < 1e-9, "{table}");
    assert!((number(4) / ((number(1) + number(2) + number(3)) / 3.0) - 1.0).abs() < 1e-9, "{table}");
    assert!(rows[1][0].contains("map1.x3p") && rows[4][0].contains("mean"), "{table}");
    let vain = folder.run("surface map1.x3p map2.x3p --tip-radius 5um");
    assert_eq!(vain.status.code(), Some(2), "{}", text(&vain.stderr));
}

/// A map with a hole in it.
fn write_torn(folder: &Folder) -> Array2<f64> {
    folder.run(
        "surface --hurst 0.8 --rolloff 16 --short-cutoff 6 --rms-gradient 0.1 --points 48,48 --size 48 --out whole.npy",
    );
    let mut map: Array2<f64> = read_npy(folder.join("whole.npy")).unwrap();
    for y in 10..22 {
        (8..20).for_each(|x| map[[y, x]] = f64::NAN);
    }
    write_npy(folder.join("torn.npy"), &map).unwrap();
    map
}

#[test]
fn a_result_keeps_which_heights_were_filled_and_pictures_hatch_them() {
    let folder = Folder::new();
    let map = write_torn(&folder);
    let solve = "solve torn.npy --size 48 --fill harmonic --modulus 1 --reduced-pressure 0.3 --json";
    let run = folder.run(&format!("{solve} --out torn.npz"));
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let mut archive = NpzReader::new(File::open(folder.join("torn.npz")).unwrap()).unwrap();
    let mask: ArrayD<bool> = archive.by_name("filled.npy").unwrap();
    let pressure: ArrayD<f64> = archive.by_name("pressure.npy").unwrap();
    assert!(mask.iter().zip(&map).all(|(filled, height)| *filled == height.is_nan()));
    let contact = pressure.iter().filter(|p| **p > 0.0).count() as f64;
    let on_filled = pressure.iter().zip(&mask).filter(|(p, filled)| **p > 0.0 && **filled).count() as f64;
    let share = json(&run)["filled_area_share"].as_f64().unwrap();
    assert!(share > 0.0 && (share - on_filled / contact).abs() < 1e-12, "{share}");

    for (command, name) in [(solve, "contact.svg"), ("surface torn.npy --size 48 --fill harmonic", "map.svg")] {
        let run = folder.run(&format!("{command} --out {name}"));
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        let picture = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(picture.contains("hatched: filled in"), "{name} hatches what was filled in");
    }
    let whole = folder.run("surface whole.npy --size 48 --out whole.svg");
    assert_eq!(whole.status.code(), Some(0), "{}", text(&whole.stderr));
    assert!(!std::fs::read_to_string(folder.join("whole.svg")).unwrap().contains("hatched"));
}

#[test]
fn a_tip_and_a_second_measurement_are_told_of() {
    let folder = Folder::new();
    write_torn(&folder);
    let whole: Array2<f64> = read_npy(folder.join("whole.npy")).unwrap();
    // two measurements with noise of an rms height of 0.01 that is alternately up and down in one, and none in the other
    let noise = |(y, x): (usize, usize)| if (y + x) % 2 == 0 { 0.01 } else { -0.01 };
    let noisy = Array2::from_shape_fn((48, 48), |node| whole[node] + noise(node));
    write_npy(folder.join("second.npy"), &noisy).unwrap();
    let run = folder.run("surface whole.npy --size 48 --repeat second.npy --tip-radius 20 --json");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let found = json(&run);
    let rms = found["repeat"]["rms"].as_f64().unwrap();
    assert!((rms / (0.01 / 2f64.sqrt()) - 1.0).abs() < 1e-3, "{rms}");
    assert!((found["repeat"]["correlation"][0].as_f64().unwrap() + 1.0).abs() < 1e-3);
    assert_eq!(found["tip"]["radius"], 20.0);
    let unreached = found["tip"]["unreached_share"].as_f64().unwrap();
    assert!(unreached > 0.0 && unreached < 1.0, "{unreached}");
    let said =
        text(&folder.run("surface whole.npy --size 48um --repeat second.npy --tip-radius 20um").stdout).to_owned();
    assert!(said.contains("By the repeated measurement the noise is") && said.contains("of radius 20 µm"), "{said}");

    write_npy(folder.join("small.npy"), &Array2::from_shape_fn((40, 48), |node| noisy[node])).unwrap();
    let refused = folder.run("surface whole.npy --size 48 --repeat small.npy");
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("has 40 x 48 points"), "{}", text(&refused.stderr));
    for radius in ["-1um", "0", "wide"] {
        let refused = folder.run(&format!("surface whole.npy --size 48 --tip-radius={radius}"));
        assert_eq!(refused.status.code(), Some(2), "{radius}: {}", text(&refused.stderr));
    }
    let made = folder.run("surface --indenter sphere --radius 1 --points 24,32 --size 3,4 --tip-radius 1");
    assert_eq!(made.status.code(), Some(2), "{}", text(&made.stderr));
}

/// A wave that begins at 0 has a level first column, which was measured.
#[test]
fn a_wave_that_begins_at_zero_was_measured() {
    let folder = Folder::new();
    let wave = |(y, x): (usize, usize)| {
        let [y, x] = [y, x].map(|i| std::f64::consts::TAU * i as f64 / 64.0);
        1e-7 * x.sin() * (2.0 + y.cos())
    };
    write_npy(folder.join("wave.npy"), &Array2::from_shape_fn((64, 64), wave)).unwrap();
    let run = folder.run("surface wave.npy --size 10um");
    assert!(!text(&run.stdout).contains("were not measured"), "{}", text(&run.stdout));
    assert!(!warnings(&run).iter().any(|it| it.contains("were not measured")), "{}", text(&run.stderr));
}

/// Warnings never advise what was done: an automatic preparation is advised for what it mends, and not once it was made.
#[test]
fn an_automatic_preparation_is_not_advised_after_itself() {
    let folder = Folder::new();
    let make = "surface --hurst 0.8 --rolloff 16 --short-cutoff 5 --rms-gradient 0.1 --points 64,64 --size 64";
    folder.run(&format!("{make} --out rough.npy"));
    let rough: Array2<f64> = read_npy(folder.join("rough.npy")).unwrap();
    let rms = rough.std(0.0);
    // numbers between -1 and 1 that follow no pattern
    let random = |(y, x): (usize, usize)| (((y * 64 + x) as f64 * 12.9898).sin() * 43758.5453).fract();
    let spikes = |share: f64, node| if random(node) > 1.0 - 2.0 * share { 6.0 * rms } else { 0.0 };
    let settling = |y: usize| 40.0 * rms * (-(y as f64) / 3.0).exp();
    let edge = |x: usize| if x % 16 < 8 { 30.0 * rms } else { 0.0 };
    type Height<'a> = Box<dyn Fn((usize, usize)) -> f64 + 'a>;
    let maps: [(&str, Height<'_>); 6] = [
        ("spikes", Box::new(|node| rough[node] + spikes(0.02, node))),
        ("deep.spikes", Box::new(|node| rough[node] - spikes(0.001, node))),
        ("tilt.with.settling", Box::new(|(y, x)| rough[[y, x]] + settling(y) + 20.0 * rms * y as f64)),
        ("noise", Box::new(|node| rough[node] + 0.2 * rms * random(node))),
        ("noise.between.edges", Box::new(|(y, x)| rough[[y, x]] + 0.1 * rms * random((y, x)) + edge(x))),
        ("all", Box::new(|(y, x)| rough[[y, x]] + settling(y) + 0.2 * rms * random((x, y)) + spikes(0.02, (y, x)))),
    ];
    let (auto, mut advised) = ("--prepare auto", 0);
    for (name, height) in maps {
        write_npy(folder.join(&format!("{name}.npy")), &Array2::from_shape_fn((64, 64), height)).unwrap();
        let solve = format!("solve {name}.npy --size 64 --modulus 1 --reduced-pressure 0.2");
        let before = folder.run(&solve);
        advised += usize::from(warnings(&before).iter().any(|it| it.contains(auto)));
        let after = folder.run(&format!("{solve} {auto}"));
        assert_eq!(after.status.code(), Some(0), "{}", text(&after.stderr));
        let again: Vec<&str> = warnings(&after).into_iter().filter(|it| it.contains(auto)).collect();
        assert!(again.is_empty(), "{name}: {again:?}");
    }
    assert!(advised >= 3, "an automatic preparation is advised for {advised} maps");
}
