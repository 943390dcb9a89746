//! No command writes over a file that it reads, by whatever name.

use super::*;
use crate::rows::assert_refused;
use std::fs;

const STICKY: &str = "surface = { indenter = { shape = \"sine\", amplitude = 0.01 } }
grid = { points = 64, size = 1.0 }
solid = { contact-modulus = 1.0 }
load = { mean-pressure = 0.001 }
adhesion = { table = \"att.csv\" }
path = { file = \"path.csv\" }
";

const ROUGH: &str =
    "surface = { spectrum = { table = \"psd.csv\", heights-like = \"like.csv\", convention = \"profile\" } }
grid = { points = 64, size = 1.0 }
load = { reduced-pressure = 0.05 }
";

/// A folder with scenes and all files that they name.
fn folder() -> Folder {
    let folder = Folder::new();
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("sticky.toml", STICKY);
    write("rough.toml", ROUGH);
    write("study.toml", &ROUGH.replace("0.05 }", "[0.01, 0.05] }"));
    write("att.csv", "gap,traction\n0,0.02\n0.002,0.01\n0.008,0\n");
    write("path.csv", "load\n0.002\n0.001\n");
    write("psd.csv", "20 1e-6\n100 1e-8\n");
    write("like.csv", &(0..32).map(|i| format!("{}\n", (i * i) % 37)).collect::<String>());
    folder
}

/// The names and contents of all files in a folder.
fn contents(folder: &Folder) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder.join(".")).unwrap().map(Result::unwrap);
    let named = |it: fs::DirEntry| (it.file_name().into_string().unwrap(), fs::read(it.path()).unwrap());
    let mut files: Vec<_> = entries.map(named).collect();
    files.sort();
    files
}

#[test]
fn an_output_that_is_an_input_is_refused_before_anything_is_written() {
    let folder = folder();
    fs::hard_link(folder.join("att.csv"), folder.join("hard.csv")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("psd.csv", folder.join("soft.csv")).unwrap();
    fs::copy(folder.join("like.csv"), folder.join("study.unfinished")).unwrap();
    let before = contents(&folder);
    let mut lines = vec![
        "solve sticky.toml --out att.csv",
        "solve sticky.toml --out ./path.csv",
        "solve sticky.toml --out hard.csv",
        "solve sticky.toml --save-setup sticky.toml",
        "solve rough.toml --out psd.csv",
        "solve rough.toml --out like.csv",
        "solve --indenter sine --amplitude 0.01 --points 64 --size 1 --modulus 1 --pressure 0.001 --adhesion-table att.csv --out att.csv",
        "surface rough.toml --psd psd.csv",
        "surface rough.toml --psd like.csv",
        "study study.toml --out psd.csv",
        "study study.toml --out ./like.csv",
        "certify --setup rough.toml --pressure like.csv --out psd.csv",
    ];
    #[cfg(unix)]
    lines.extend(["solve rough.toml --out soft.csv", "surface rough.toml --psd soft.csv"]);
    for line in lines {
        let written = line.split_whitespace().next_back().unwrap();
        let refused = format!("cannot write {written}: it is also an input file and would be lost: give another name");
        assert_refused(&folder.run(line), &[&refused]);
        assert!(contents(&folder) == before, "{line}");
    }
    // a table of a study has files beside it
    fs::write(folder.join("other.toml"), ROUGH.replace("like.csv", "study.unfinished")).unwrap();
    assert_refused(&folder.run("study other.toml --out study.csv"), &["study.unfinished", "also an input file"]);
    assert!(folder.run("solve sticky.toml --out own.csv").status.success());
}

#[test]
fn a_merged_table_does_not_write_over_what_belongs_to_a_share() {
    let folder = folder();
    for share in ["1/2", "2/2"] {
        assert!(folder.run(&format!("study study.toml --shard {share}")).status.success());
    }
    fs::rename(folder.join("study.1-of-2.csv"), folder.join("all.seconds.csv")).unwrap();
    let refused = folder.run("merge study.toml all.seconds.csv study.2-of-2.csv --out all.csv");
    assert_refused(&refused, &["all.seconds.csv", "also an input file"]);
    assert_refused(&folder.run("merge study.toml all.seconds.csv study.2-of-2.csv --out psd.csv"), &["psd.csv"]);
}
