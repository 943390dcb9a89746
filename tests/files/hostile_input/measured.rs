//! Files of instruments that nobody can use, and steps that they do not allow.

use super::{Folder, LOAD, OUTPUTS, folder, refuse_in_one_sentence, text};
use crate::measured::binaries::{
    self, al3d, bcr, frt, ibw, jpk, metropro, mi, nanoscope, nid, opd, opdx, plu, sdf, tmd, vk4, wsxm,
};
use crate::measured::containers::{self, gwy, hdf5, netcdf, plux, sur, x3p};
use asperity::formats::Measurement;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// A file with other bytes for these, wherever they are in it.
fn changed(file: Vec<u8>, from: &[u8], to: &[u8]) -> Vec<u8> {
    let (mut all, mut rest) = (Vec::new(), &file[..]);
    while let Some(at) = rest.windows(from.len()).position(|it| it == from) {
        all.extend([&rest[..at], to].concat());
        rest = &rest[at + from.len()..];
    }
    assert!(!all.is_empty(), "{from:?} is not in the file");
    [all, rest.to_vec()].concat()
}

/// A surface of X3P whose description is changed.
fn described(from: &str, to: &str) -> Vec<u8> {
    let (main, points) = x3p::doubles();
    assert!(main.contains(from), "{from}");
    x3p::archive(main.replace(from, to).as_bytes(), &points, &[])
}

/// Refuses to describe and to solve each of the files, by their names.
fn refuse_files(files: &[(&str, Vec<u8>, &str)]) {
    let folder = folder();
    for (name, bytes, offence) in files {
        std::fs::write(folder.join(name), bytes).unwrap();
        refuse_in_one_sentence(&folder, &format!("surface {name} --json --out new.sdf"), offence);
        refuse_in_one_sentence(&folder, &format!("solve --height {name} {LOAD} {OUTPUTS}"), offence);
        std::fs::remove_file(folder.join(name)).unwrap();
    }
}

/// Whether channels before a cut are whole.
fn is_read_in_part(file: &[u8]) -> bool {
    Measurement::from_bytes(file, None).is_ok_and(|it| !it.unreadable.is_empty())
}

#[test]
fn files_that_are_cut_short_are_refused() {
    let all = binaries::ALL.iter().chain(containers::ALL);
    let cut = |(name, file): &(&'static str, fn() -> Vec<u8>)| {
        let file = file();
        (name.replace([' ', ','], "-"), file[..file.len() * 7 / 10].to_vec())
    };
    for (name, file) in all.map(cut).filter(|it| !is_read_in_part(&it.1)) {
        refuse_files(&[(&name, file, "is not a valid height file: ")]);
    }
    refuse_files(&[("cut.xyz", b"# x (m), y (m), z (m)\n0 0 1\n0 1 2\n1 0 3\n1".into(), "line 5 has 1 numbers")]);
}

#[test]
fn files_of_absurd_sizes_are_refused() {
    let many = i32::MAX.to_le_bytes();
    let in_tag = |count: &str| [b"Cols".as_slice(), &[0; 16], count.as_bytes()].concat();
    let samples = nanoscope::file();
    let counts = |file: fn() -> Vec<u8>, from: &[i32]| {
        let from: Vec<u8> = from.iter().flat_map(|it| it.to_le_bytes()).collect();
        changed(file(), &from, &many.repeat(from.len() / 4))
    };
    refuse_files(&[
        ("a.al3d", changed(al3d::file(), &in_tag("5\0\0\0\0\0\0\0\0"), &in_tag("999999999")), "999999999"),
        ("a.gwy", changed(gwy::file(), b"xres\0i\x05\0\0\0", &[&b"xres\0i"[..], &many].concat()), "2147483647"),
        ("a.h5", hdf5::huge(), "1000000 x 1000000"),
        ("a.spm", changed(samples, b"line: 5\r\n", b"line: 2147483647\r\n"), "2147483647"),
        ("a.nc", changed(netcdf::file(), b"x\0\0\0\0\0\0\x05", b"x\0\0\0\x7f\xff\xff\xff"), "2147483647"),
        ("a.opd", changed(opd::file(), b"\x05\0\x04\0\x04\0", b"\xff\xff\xff\xff\x04\0"), "65535"),
        ("a.opdx", counts(opdx::file, &[4, 5]), "2147483647"),
        ("a.plu", counts(plu::file, &[4, 5]), "2147483647"),
        ("a.plux", plux::archive(&plux::index([4, 2147483647])), "2147483647"),
        ("a.tmd", counts(tmd::file, &[5, 4]), "2147483647"),
        ("a.vk4", counts(vk4::file, &[5, 4]), "2147483647"),
        ("a.sdf", changed(sdf::file(), b"NumPoints = 5", b"NumPoints = 2147483647"), "2147483647"),
        ("b.sdf", counts(sdf::binary_of_iso_2, &[5, 4]), "2147483647"),
        ("a.sur", counts(sur::file, &[5, 4, 20]), "2147483647"),
        ("a.x3p", described("<SizeX>5", "<SizeX>2147483647"), "2147483647"),
    ]);
    let told = |file: Vec<u8>, from: &str| changed(file, from.as_bytes(), from.replace('5', "2147483647").as_bytes());
    refuse_files(&[
        ("a.bcr", told(bcr::file(), "xpixels = 5"), "2147483647"),
        ("a.frt", counts(frt::file, &[5, 4]), "2147483647"),
        ("a.ibw", ibw::signed(counts(ibw::file, &[5, 4])), "2147483647"),
        ("a.jpk", changed(jpk::file(), &[1, 0, 0, 4, 0, 0, 0, 1, 0, 0], &[1, 0, 0, 4, 0, 0, 0, 1, 9, 9]), "151584773"),
        ("a.dat", changed(metropro::file(), &[0, 5, 0, 4], &[0xff; 4]), "65535"),
        ("a.mi", told(mi::file(), "xPixels       5"), "2147483647"),
        ("a.nid", told(nid::file(), "Points=5"), "2147483647"),
        ("a.stp", told(wsxm::file(), "Number of columns: 5"), "2147483647"),
    ]);
}

#[test]
fn files_of_wrong_units_are_refused() {
    let unit = |from: &str, to: &str| changed(sdf::file(), from.as_bytes(), to.as_bytes());
    refuse_files(&[
        (
            "a.gwy",
            changed(gwy::file(), b"unitstr\0sm\0", b"unitstr\0sV\0"),
            "none of its channels \"Current\", \"Topography\" is a length",
        ),
        ("a.spm", changed(nanoscope::file(), b"10 12 ~m", b"10 12 ~V"), "~V"),
        (
            "a.nc",
            changed(netcdf::file(), b"\0\0\0\x02nm\0\0", b"\0\0\0\x02kV\0\0"),
            "none of its channels \"heights\" is a length",
        ),
        ("a.opd", changed(opd::file(), &0.25_f32.to_le_bytes(), &f32::NAN.to_le_bytes()), "NaN"),
        ("a.plu", changed(plu::file(), &2_f32.to_le_bytes(), &(-2_f32).to_le_bytes()), "-2"),
        ("a.sdf", unit("Xscale = 2.0e-006", "Xscale = -1"), "-1"),
        ("b.sdf", unit("Zscale = 1.0e-9", "Zscale = one"), "one"),
        ("a.x3p", described("<Increment>2e-6<", "<Increment>0<"), "no size is given, and the file has none"),
    ]);
    let told = |file: Vec<u8>, from: &str, to: &str| changed(file, from.as_bytes(), to.as_bytes());
    refuse_files(&[
        ("a.bcr", told(bcr::file(), "bit2nm = 0.5", "bit2nm = 0.x"), "0.x"),
        ("a.frt", changed(frt::file(), &1e-9_f64.to_le_bytes(), &f64::NAN.to_le_bytes()), "NaN"),
        ("a.ibw", ibw::signed(told(ibw::alone(), "micron", "ampere")), "none of its channels \"steel\" is a length"),
        ("a.jpk", changed(jpk::file(), &10e-6_f64.to_be_bytes(), &(-1_f64).to_be_bytes()), "-0.2"),
        ("a.dat", changed(metropro::file(), &2e-6_f32.to_be_bytes(), &f32::NAN.to_be_bytes()), "NaN"),
        ("a.mi", told(mi::file(), "xLength       1.0e-005", "xLength       -1"), "-0.2"),
        ("a.nid", told(nid::file(), "Dim2Range=65.536", "Dim2Range=nan"), "NaN"),
        ("a.stp", told(wsxm::file(), "Z Amplitude: 46 nm", "Z Amplitude: 46 nA"), "is a length"),
    ]);
}

#[test]
fn archives_do_not_reach_beyond_themselves() {
    let link = |to: &str| described("bindata/data.bin", to);
    refuse_files(&[
        ("a.x3p", link("../../x"), "../../x"),
        ("b.x3p", link("/etc/passwd"), "/etc/passwd"),
        ("c.x3p", changed(x3p::file(), b"main.xml", b"../n.xml"), "its format is not known"),
    ]);
    let folder = folder();
    let climbing = changed(link("../../12345/data"), b"bindata/data.bin", b"../../12345/data");
    std::fs::write(folder.join("a.x3p"), climbing).unwrap();
    let described = folder.run("surface a.x3p");
    assert!(described.status.success(), "{}", text(&described.stderr));
    assert!(!folder.join("../../12345").exists());
}

/// A surface that a step is asked of that it does not allow.
fn refuse_steps(folder: &Folder, name: &str, cases: &[(&str, &str)]) {
    for (step, offence) in cases {
        refuse_in_one_sentence(folder, &format!("surface {name} {step} --json --out new.x3p"), offence);
        refuse_in_one_sentence(folder, &format!("solve --height {name} {step} {LOAD} {OUTPUTS}"), offence);
    }
}

#[test]
fn steps_that_heights_do_not_allow_are_refused() {
    let folder = folder();
    std::fs::write(folder.join("a.x3p"), x3p::file()).unwrap();
    refuse_steps(
        &folder,
        "a.x3p",
        &[
            ("--channel phase", "\"phase\""),
            ("--channel 0", "\"0\""),
            ("--channel 1.5", "or its number"),
            ("--file-unit 1um", "leave the unit 1um out"),
            ("--height-unit 1um", "leave the unit 1um out"),
            ("--crop 0,9,0,5", "[0, 9, 0, 5]"),
            ("--crop 3,2,0,5", "[3, 2, 0, 5]"),
            ("--crop 0,4", "[0, 4]"),
            ("--fill harmonic --crop 1,2,3,4", "1 points"),
            ("--taper 0", "the taper is 0.0"),
            ("--taper 0.6", "the taper is 0.6"),
            ("--taper nan", "the taper is NaN"),
            ("--low-pass 1nm", "two spacings"),
            ("--low-pass=-1", "-1.0"),
            ("--low-pass nan", "NaN"),
            ("--high-pass inf", "inf"),
        ],
    );
    assert!(folder.run("surface a.x3p --channel 1").status.success());
    std::fs::write(folder.join("flat.txt"), "1 1 1 1\n".repeat(4)).unwrap();
    std::fs::write(folder.join("void.txt"), "nan nan nan nan\n".repeat(4)).unwrap();
    let flat = [
        ("--size 1 --remove-form sphere", "the shape cannot be fitted"),
        ("--size 1 --remove-form cylinder", "the shape cannot be fitted"),
        ("--size 1 --file-unit 0", "0.0"),
        ("--size 1 --file-unit=-1um", "-1um"),
        ("--size 1 --height-unit 0", "0.0"),
        ("", "--size"),
    ];
    refuse_steps(&folder, "flat.txt", &flat);
    refuse_steps(&folder, "void.txt", &[("--size 1 --fill harmonic", "all heights are void")]);
}

#[test]
fn formats_in_metres_need_to_know_them() {
    let folder = folder();
    std::fs::write(folder.join("rough.txt"), "1 2 1 3\n4 1 5 1\n2 6 1 1\n1 2 1 7\n").unwrap();
    for ending in ["sdf", "x3p", "xyz"] {
        let line = format!("surface rough.txt --size 1 --out new.{ending}");
        refuse_in_one_sentence(&folder, &line, "give them with --file-unit");
        let known = folder.run(&format!("{line} --file-unit 1um"));
        assert!(known.status.success(), "{}", text(&known.stderr));
        let again = folder.run(&format!("surface new.{ending} --out again.{ending}"));
        assert!(again.status.success(), "{}", text(&again.stderr));
        let [once, twice] = ["new", "again"].map(|name| std::fs::read(folder.join(&format!("{name}.{ending}"))));
        assert_eq!(once.unwrap(), twice.unwrap(), "{ending}");
    }
    assert!(folder.run("surface rough.txt --size 1 --out new.npy").status.success());
}

/// A description of 12000 by 12000 points, in an archive that is long enough to unpack to them.
fn bomb() -> Vec<u8> {
    let (main, points) = x3p::doubles();
    let many = main.replace("<SizeX>5</SizeX><SizeY>4<", "<SizeX>12000</SizeX><SizeY>12000<");
    assert_ne!(many, main);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let filling: Vec<u8> = (0..1_200_000).map(|_| random.random()).collect();
    x3p::archive(many.as_bytes(), &points, &filling)
}

/// With the address space limited to 4 GB.
#[cfg(target_os = "linux")]
#[test]
fn points_that_do_not_fit_in_memory_are_refused_before_they_are_unpacked() {
    let folder = folder();
    std::fs::write(folder.join("bomb.x3p"), bomb()).unwrap();
    let lines = [
        "surface bomb.x3p".to_owned(),
        "surface bomb.x3p --crop 0,64,0,64".to_owned(),
        format!("solve --height bomb.x3p {LOAD} --dry-run"),
        format!("solve --height bomb.x3p {LOAD} --crop 0,64,0,64 {OUTPUTS}"),
        format!("solve {} --heights-like bomb.x3p {LOAD} {OUTPUTS}", super::ROUGH),
    ];
    for line in lines {
        let output = super::shell(&folder, r#"ulimit -v 4000000; exec "$@""#, &line);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {complaint}");
        assert!(complaint.contains("its 12000 x 12000 points do not fit in memory"), "{line}: {complaint}");
        super::assert_one_sentence(complaint);
    }
}

#[test]
fn words_of_files_do_not_control_the_terminal() {
    let folder = folder();
    let is_plain = |bytes: &[u8]| !text(bytes).contains(|c: char| c.is_control() && !matches!(c, '\n' | '\t'));
    let head = "# Channel: \u{1b}[31mred\u{9b}2J\n# Width: 4 um\n# Value units: m\n# \u{7}Title: \u{1b}]0;x\u{7}\n";
    std::fs::write(folder.join("a\u{1b}[2J.txt"), format!("{head}{}", "1 2 1 4\n".repeat(4))).unwrap();
    std::fs::write(folder.join("scene.toml"), r#"solver."\u001b[2J" = 1"#).unwrap();
    std::fs::write(folder.join("named.toml"), r#"surface.height = "\u001b[2J\u009b.npy""#).unwrap();
    std::fs::write(folder.join("table.csv"), "time,\u{1b}[2J\n1,2\n").unwrap();
    for arguments in [
        vec!["surface", "a\u{1b}[2J.txt"],
        vec!["surface", "a\u{1b}[2J.txt", "--json"],
        vec!["surface", "a\u{1b}[2J.txt", "--channel", "\u{1b}[1m"],
        vec!["solve", "--height", "\u{1b}[2J.txt", "--pressure", "1"],
        vec!["solve", "--solver", "\u{1b}[2J"],
        vec!["solve", "scene.toml"],
        vec!["solve", "named.toml", "--pressure", "1"],
        vec!["study", "scene.toml", "--out", "s.csv"],
        vec![
            "solve",
            "--path",
            "table.csv",
            "--indenter",
            "sine",
            "--amplitude",
            "1",
            "--points",
            "64",
            "--size",
            "1",
            "--pressure",
            "1",
        ],
        vec!["surface", "--spectrum", "table.csv", "--points", "64", "--size", "1"],
        vec!["\u{1b}[2J"],
    ] {
        let output = folder.finish(assert_cmd::Command::new(env!("CARGO_BIN_EXE_asperity")).args(&arguments));
        assert!(is_plain(&output.stdout) && is_plain(&output.stderr), "{arguments:?}: {output:?}");
    }
    // tables and pictures are shown on terminals and by browsers, too
    for name in ["b.txt", "c\u{1b}[2J.txt"] {
        std::fs::write(folder.join(name), "1 2 1 4\n".repeat(4)).unwrap();
    }
    let study = "surface.height = [\"c\\u001b[2J.txt\", \"b.txt\"]\ngrid.size = 4e-6\nload.reduced-pressure = 0.1\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let output = folder.run("study study.toml --out marked.csv");
    assert_ne!(output.status.code(), Some(2), "{}", text(&output.stderr));
    for name in ["marked.csv", "marked.svg"] {
        assert!(is_plain(&std::fs::read(folder.join(name)).unwrap()), "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_not_utf_8_are_said() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder();
    let name = std::ffi::OsStr::from_bytes(b"a\xff.txt");
    std::fs::write(folder.join(".").join(name), "0 1\n1 2\n2 1\n3 3\n").unwrap();
    for before in [&["surface"][..], &["solve"], &["solve", "--height"], &["surface", "--height"]] {
        let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_asperity"));
        let output = folder.finish(command.args(before).arg(name));
        assert_eq!(output.status.code(), Some(2), "{before:?}: {output:?}");
        super::assert_one_sentence(text(&output.stderr));
        assert!(text(&output.stderr).contains("is not UTF-8"), "{output:?}");
    }
}

#[test]
fn an_empty_file_is_called_empty() {
    let folder = folder();
    std::fs::write(folder.join("empty.txt"), "").unwrap();
    for line in ["surface empty.txt", "surface --height empty.txt --size 1", "solve empty.txt --size 1 --pressure 1"] {
        refuse_in_one_sentence(&folder, line, "it is empty");
    }
}

#[test]
fn heights_may_have_a_unit_of_their_own() {
    let folder = folder();
    std::fs::write(folder.join("line.txt"), "0 1\n1 3\n2 1\n3 2\n").unwrap();
    let line = "surface line.txt --file-unit 1um --height-unit 1nm --json";
    let described: serde_json::Value = serde_json::from_slice(&folder.run(line).stdout).unwrap();
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert!((number(&described["size"][0]) - 4e-6).abs() < 1e-15, "{described}");
    assert!((number(&described["peak"]) - 1.25e-9).abs() < 1e-18, "{described}");
}
