//! The commands of the README and of the guide, run in order as a reader runs them, each page in an empty folder.
//!
//! - A block whose first line is a comment with a file name, such as `# scene.toml`, is written to that file.
//! - A block `sh` is run. A block `text` after it must be found in what was printed: line by line, where `...` stands for any
//!   lines. Numbers may differ by 1 %, durations and errors at the level of rounding by any amount.
//! - A block `sh interactive`, `sh install`, `sh python` or `sh slow` is not run, and the number of these is bounded.

use crate::command::{Folder, text};
use assert_cmd::Command;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Why a block cannot run in a test.
const REASONS: [&str; 4] = ["interactive", "install", "python", "slow"];

/// The largest number of blocks that are not run, in all pages together.
const MOST_NOT_RUN: usize = 16;

/// The largest relative difference between a number on a page and the one that is printed.
const TOLERANCE: f64 = 0.01;

/// After which the commands of a block count as hung, on a machine that is busy with other things.
const PATIENCE: Duration = Duration::from_secs(300);

/// Values below this are errors that were pushed down to a tolerance: their digits depend on the processor.
const ROUNDING: f64 = 1e-6;

macro_rules! pages {
    ($($name:ident $path:literal)*) => {
        const PAGES: &[&str] = &[$($path),*];
        $(#[test]
        fn $name() {
            run_page($path);
        })*
    };
}

pages! {
    readme "README.md"
    first_contact "assets/guide/first-contact.md"
    measured_surfaces "assets/guide/measured-surfaces.md"
    boundaries_and_solids "assets/guide/boundaries-and-solids.md"
    hardness "assets/guide/hardness.md"
    yielding "assets/guide/yielding.md"
    history "assets/guide/history.md"
    time_and_friction "assets/guide/time-and-friction.md"
    adhesion "assets/guide/adhesion.md"
    roughness "assets/guide/roughness.md"
    flow "assets/guide/flow.md"
    recordings "assets/guide/recordings.md"
    studies "assets/guide/studies.md"
    explorer "assets/guide/explorer.md"
    other_solvers "assets/guide/other-solvers.md"
    slow_solvers "assets/guide/slow-solvers.md"
    python "assets/guide/python.md"
    gallery "assets/guide/gallery.md"
    from_tamaas "assets/guide/from-tamaas.md"
    from_contact_mechanics "assets/guide/from-contact-mechanics.md"
    how_it_works "assets/guide/how-it-works.md"
    trust "assets/guide/trust.md"
    words "assets/guide/words.md"
}

/// A fenced block of a page: the words after the fence, and its lines.
struct Block<'a> {
    info: Vec<&'a str>,
    lines: Vec<&'a str>,
}

impl<'a> Block<'a> {
    fn all(page: &'a str) -> Vec<Self> {
        let mut blocks = Vec::new();
        let mut lines = page.lines();
        while let Some(line) = lines.next() {
            if let Some(info) = line.strip_prefix("```") {
                let inside = lines.by_ref().take_while(|line| !line.starts_with("```"));
                blocks.push(Self { info: info.split([' ', ',']).collect(), lines: inside.collect() });
            }
        }
        blocks
    }

    /// The reason for which a block of commands is not run.
    fn reason(&self) -> Option<&'a str> {
        (self.info[0] == "sh").then(|| self.info.get(1).copied()).flatten()
    }

    /// The file that the block is to be written to.
    fn file(&self) -> Option<&'a str> {
        let name = self.lines.first()?.strip_prefix("# ")?.split([':', ' ']).next()?;
        let is_file = [".toml", ".py"].iter().any(|ending| name.ends_with(ending));
        (self.info[0] != "sh" && is_file).then_some(name)
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn run_page(path: &str) {
    let (page, folder) = (read(path), Folder::new());
    let mut printed = None;
    for block in Block::all(&page) {
        if let Some(file) = block.file() {
            let path = folder.join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, block.lines.join("\n") + "\n").unwrap();
        } else if block.info == ["sh"] {
            printed = Some(run_block(path, &block, &folder));
        } else if block.info == ["text"] {
            let printed = printed.take().unwrap_or_else(|| panic!("{path}: no command before {}", block.lines[0]));
            if let Some(missing) = first_missing(&block.lines, &printed) {
                panic!("{path}: the command does not print\n{missing}\nbut\n{printed}");
            }
        } else {
            printed = None;
        }
    }
}

/// What the commands of a block print, in the order in which they print it.
fn run_block(path: &str, block: &Block, folder: &Folder) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_asperity")).parent().unwrap();
    let search = std::env::join_paths(
        std::iter::once(program.to_path_buf())
            .chain(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()).collect::<Vec<PathBuf>>()),
    );
    let script = format!("exec 2>&1\n{}", block.lines.join("\n"));
    let mut shell = Command::new("bash");
    shell.args(["-euo", "pipefail", "-c", &script]).env("PATH", search.unwrap()).current_dir(folder.join(""));
    let output = shell.timeout(PATIENCE).output().unwrap();
    let printed = text(&output.stdout).to_owned();
    assert!(output.status.success(), "{path}: {}\n{printed}", block.lines.join("\n"));
    printed
}

/// The first line of an excerpt that does not come where it should; `...` stands for any number of lines.
fn first_missing<'a>(excerpt: &[&'a str], printed: &str) -> Option<&'a str> {
    let mut printed = printed.lines();
    let mut may_skip = true;
    for &line in excerpt {
        if line.trim() == "..." {
            may_skip = true;
            continue;
        }
        let is_found = if may_skip { printed.any(|found| agree(line, found)) } else { agree(line, printed.next()?) };
        if !is_found {
            return Some(line);
        }
        may_skip = false;
    }
    None
}

/// Whether a line on a page says the same as a line that was printed.
fn agree(page: &str, printed: &str) -> bool {
    let [page, printed] = [page, printed].map(|line| line.split_whitespace().collect::<Vec<_>>());
    let is_duration = |words: &[&str], i: usize| words.get(i + 1).is_some_and(|unit| unit.trim_end_matches(',') == "s");
    page.len() == printed.len()
        && (0..page.len())
            .all(|i| words_agree(page[i], printed[i]) || (is_duration(&page, i) && is_duration(&printed, i)))
}

fn words_agree(page: &str, printed: &str) -> bool {
    let number = |word: &str| word.trim_matches(|c: char| "(),;:%".contains(c)).parse::<f64>();
    match (number(page), number(printed)) {
        (Ok(a), Ok(b)) => (a - b).abs() <= TOLERANCE * a.abs().max(b.abs()) || a.abs().max(b.abs()) < ROUNDING,
        _ => page == printed,
    }
}

#[test]
fn an_excerpt_is_held_against_what_is_printed() {
    let printed = "area 0.1000 (1.3e-9)\nkappa 2.00\nwork 85 steps, 0.014 s\n";
    for excerpt in [&["area 0.1001 (8.1e-10)", "kappa  2.0"][..], &["area 0.1 (2e-10)", "...", "work 85 steps, 1.5 s"]]
    {
        assert_eq!(first_missing(excerpt, printed), None);
    }
    for wrong in ["area 0.1020 (1.3e-9)", "area 0.1000 (1.3e-3)", "gap 0.1000 (1.3e-9)", "kappa 2.00 of"] {
        assert_eq!(first_missing(&[wrong], printed), Some(wrong));
    }
    assert_eq!(first_missing(&["area 0.1 (2e-10)", "work 85 steps, 0.014 s"], printed), Some("work 85 steps, 0.014 s"));
}

#[test]
fn few_blocks_are_left_out_and_each_says_why() {
    let mut left_out = 0;
    for path in PAGES {
        for block in Block::all(&read(path)) {
            if let Some(reason) = block.reason() {
                assert!(REASONS.contains(&reason), "{path}: `sh {reason}` is not one of {REASONS:?}");
                left_out += 1;
            }
        }
    }
    assert!(left_out <= MOST_NOT_RUN, "{left_out} blocks are not run");
}

#[test]
fn every_page_of_the_guide_is_run_and_in_the_crate_documentation() {
    let entries = std::fs::read_dir(root().join("assets/guide")).unwrap();
    let files: BTreeSet<String> =
        entries.map(|entry| format!("assets/guide/{}", entry.unwrap().file_name().display())).collect();
    let pages = PAGES.iter().skip(1).map(|path| path.to_string()).collect();
    assert_eq!(files, pages);
    let module = read("src/guide.rs");
    for path in &files {
        assert!(module.contains(path.as_str()), "src/guide.rs has no {path}");
    }
}

#[test]
fn readme_is_short_and_links_lead_somewhere() {
    assert!(read("README.md").lines().count() <= 180);
    for path in PAGES.iter().chain(&[".github/CONTRIBUTING.md"]) {
        let page = read(path);
        for link in links(&without_code(&page)).filter(|link| !link.contains("://") && !link.starts_with('#')) {
            let target = root().join(path).parent().unwrap().join(link.split('#').next().unwrap());
            assert!(target.exists(), "{path} links to {link}, which is not there");
        }
    }
}

/// A page without what stands between its fences.
fn without_code(page: &str) -> String {
    page.split("```").step_by(2).collect()
}

/// Targets of links and pictures, in the line and as references.
fn links(page: &str) -> impl Iterator<Item = &str> {
    let inline = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let references = page.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: ").map(|(_, link)| link));
    inline.chain(references)
}
