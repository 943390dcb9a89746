//! A Python with one version of the SDK and its viewer.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

/// After which a program counts as hung: a viewer that draws in software takes some seconds for each recording.
const PATIENCE: Duration = Duration::from_secs(1200);
/// The exit code of `look.py` where nothing can be drawn.
const NO_GRAPHICS: i32 = 3;

/// Why a version was not tried.
pub struct Skipped(pub String);

pub struct Python {
    program: PathBuf,
    version: String,
}

impl Python {
    /// The Python of a version, made if it is not there yet.
    pub fn new(version: &str) -> Result<Self, Skipped> {
        let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("viewers").join(version);
        let python = Self { program: home.join("bin/python"), version: version.into() };
        if !python.is_whole() {
            let package = format!("rerun-sdk[catalog]=={version}");
            let make = Command::new("python3").args(["-m", "venv", "--clear"]).arg(&home).output();
            succeed("no Python with pip", make)?;
            let pip = Command::new(&python.program).args(["-m", "pip", "install", "-q", &package]).output();
            succeed(&format!("pip cannot get {package}"), pip)?;
        }
        Ok(python)
    }

    /// Whether the package is there with all that it needs.
    fn is_whole(&self) -> bool {
        let test = format!("import rerun, datafusion; assert rerun.__version__ == {:?}", self.version);
        Command::new(&self.program).args(["-c", &test]).output().is_ok_and(|output| output.status.success())
    }

    /// Whether viewers of this version take a recording for one table.
    pub fn minds_two_types(&self) -> bool {
        let numbers: Vec<u32> = self.version.split('.').filter_map(|number| number.parse().ok()).collect();
        numbers >= vec![0, 38]
    }

    /// What is wrong with recordings as the viewer shows them.
    pub fn look(&self, recordings: &[PathBuf]) -> Result<Vec<String>, Skipped> {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/viewers/look.py");
        let arguments: Vec<&Path> =
            [script.as_path()].into_iter().chain(recordings.iter().map(PathBuf::as_path)).collect();
        let output = self.run(&arguments, Path::new(env!("CARGO_TARGET_TMPDIR")));
        let lines = |bytes: &[u8]| String::from_utf8_lossy(bytes).lines().map(str::to_owned).collect::<Vec<_>>();
        match output.status.code() {
            Some(0) => Ok(Vec::new()),
            Some(NO_GRAPHICS) => Err(Skipped("no Vulkan driver to draw with".into())),
            Some(1) if !output.stdout.is_empty() => {
                Ok(lines(&output.stdout).into_iter().filter(|line| !line.ends_with(": ok")).collect())
            }
            _ => Ok(vec![lines(&output.stderr).join("\n")]),
        }
    }

    /// Runs a program of lines in a folder, and says what it complains of if it fails.
    pub fn fails(&self, program: &str, folder: &Path) -> Option<String> {
        let file = folder.join("program.py");
        std::fs::write(&file, program).unwrap();
        let output = self.run(&[&file], folder);
        let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
        let warned = complaint.contains("Warning");
        (!output.status.success() || warned).then(|| format!("{program}\n{complaint}"))
    }

    /// Runs a file with arguments in a folder.
    pub fn run(&self, arguments: &[&Path], folder: &Path) -> Output {
        assert_cmd::Command::new(&self.program).args(arguments).current_dir(folder).timeout(PATIENCE).output().unwrap()
    }
}

fn succeed(reason: &str, output: std::io::Result<Output>) -> Result<(), Skipped> {
    match output {
        Ok(output) if output.status.success() => Ok(()),
        _ => Err(Skipped(reason.into())),
    }
}
