//! `asperity explore`: the interactive page.

use super::command_style::remark;
use super::exit_status::{ExitStatus, Usage, usage, with_file_error};
use super::flags::{OfSetup, SceneArgs};
use super::interrupt::interrupted;
use super::terminal::stdout;
use super::warnings::print;
use anyhow::Result;
use asperity::explore::{Knobs, Lesson, Refusal, SceneFile, Start};
use asperity::formats::HeightFile;
use asperity::serve::{Explorer, Server, Sessions, SiteExport};
use asperity::setup::Setup;
use clap::{Args, ValueEnum};
use std::io::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// The program that opens an address in the user's browser.
#[cfg(target_os = "macos")]
const OPEN: &[&str] = &["open"];
#[cfg(target_os = "windows")]
const OPEN: &[&str] = &["rundll32", "url.dll,FileProtocolHandler"];
#[cfg(not(any(target_os = "macos", target_os = "windows")))]
const OPEN: &[&str] = &["xdg-open"];

const EXAMPLES: &str = "\
Examples:
  asperity explore
  asperity explore hertz-line --port 9000 --no-open
  asperity explore scene.toml
  asperity explore --height patch.x3p
  asperity explore --lessons my-lessons
  asperity explore --export site
  asperity explore --lessons my-lessons --export course --no-recordings";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Explore {
    /// What to show first: hertz-line, hertz-surface, rough-line, rough-surface, or a scene file as for `asperity
    /// solve`
    #[arg(value_name = "START|SCENE.toml", default_value = "rough-line", value_parser = begin)]
    start: Begin,
    /// Show a file of heights first, as if you had dropped it on the page
    #[arg(long, value_name = "FILE")]
    height: Option<PathBuf>,
    /// A folder of lessons (one .toml file each) to show instead of the built-in lessons
    #[arg(long, value_name = "DIR")]
    lessons: Option<PathBuf>,
    /// Write the page as a static site into a new or empty folder: the solver runs in the browser
    #[arg(long, value_name = "DIR", conflicts_with_all = ["height", "port", "no_open"])]
    export: Option<PathBuf>,
    /// Leave out the recordings of the lessons and the viewer for them: a site with the built-in lessons has then 1.5 MB
    /// instead of more than 200 MB
    #[arg(long, requires = "export")]
    no_recordings: bool,
    #[command(flatten)]
    page: PageArgs,
}

/// Where the page is.
#[derive(Args)]
pub(crate) struct PageArgs {
    /// Port on this machine (127.0.0.1); if it is in use, the next free port
    #[arg(long, value_name = "PORT", default_value_t = 8765)]
    port: u16,
    /// Print the address of the page, but do not open a browser
    #[arg(long)]
    no_open: bool,
}

impl Explore {
    pub(crate) fn run(&self) -> Result<ExitStatus> {
        let lessons = match self.lessons.as_deref().map(Lesson::folder).transpose() {
            Ok(lessons) => lessons.unwrap_or_else(Lesson::all),
            Err(refusal) => return usage(refusal.to_string()),
        };
        if let Some(folder) = &self.export {
            let Begin::Start(start) = self.start else {
                return usage(
                    "a site cannot begin with a scene: give hertz-line, hertz-surface, rough-line or rough-surface",
                );
            };
            return export(folder, SiteExport::new(start.knobs(), lessons, !self.no_recordings));
        }
        let (sessions, knobs) = match (&self.start, &self.height) {
            (Begin::Scene(_), Some(_)) => return usage("a scene already has heights: leave --height out"),
            (Begin::Scene(path), None) => with_scene(path)?,
            (Begin::Start(start), Some(path)) => {
                let heights = HeightFile::from(path.clone());
                let sessions =
                    Sessions::with_heights(heights).map_err(|refusal| Usage(refusal.sentence.to_string()))?;
                (sessions, start.knobs())
            }
            (Begin::Start(start), None) => (Sessions::default(), start.knobs()),
        };
        let sessions = Arc::new(sessions);
        let explorer = Explorer::new(sessions.clone(), knobs, lessons)?;
        let served = self.page.open().and_then(|server| Ok(server.run(explorer)?));
        sessions.close();
        served.map(|()| ExitStatus::Done)
    }
}

/// The state that the page starts with.
#[derive(Clone)]
enum Begin {
    /// A state of the knobs.
    Start(Start),
    /// A setup in a file.
    Scene(PathBuf),
}

/// Reads a state to start with: a name of one of the page's own, or else the path of a scene.
fn begin(text: &str) -> Result<Begin, String> {
    let path = Path::new(text);
    match Start::from_str(text, false) {
        Ok(start) => Ok(Begin::Start(start)),
        Err(_) if path.extension().is_some() || path.exists() => Ok(Begin::Scene(path.into())),
        Err(_) => Err("give hertz-line, hertz-surface, rough-line or rough-surface, or the file of a scene".into()),
    }
}

/// Sessions with the scene of a file, and the initial knobs. The errors are those of `solve`.
fn with_scene(path: &Path) -> Result<(Sessions, Knobs)> {
    let mut table = SceneArgs::<OfSetup>::from_file(path.into()).table()?;
    if table.take_auto()?.is_some() {
        return usage("the page cannot use refine = auto or points = auto: give numbers");
    }
    let refused = |refusal: Refusal| Usage(refusal.sentence.to_string());
    let setup = table.setup()?;
    if !setup.loads.is_empty() {
        return usage("the page solves one load at a time, but several are given: give one");
    }
    setup.problem()?;
    let scene = SceneFile::new(setup).map_err(refused)?;
    let knobs = Knobs::from_scene(&scene).map_err(refused)?;
    print(&left_out(&scene.setup));
    Ok((Sessions::with_scene(scene), knobs))
}

/// Warnings about the parts of a setup that the page ignores.
fn left_out(setup: &Setup) -> Vec<String> {
    let load = (!setup.load.is_pressure())
        .then(|| format!("the page sets the load as p*, so it cannot start with {}", setup.load));
    let friction = setup.friction.is_some().then(|| "the page ignores friction and the tangential load".to_owned());
    load.into_iter().chain(friction).collect()
}

/// Writes a site, and prints the progress on standard error.
fn export(folder: &Path, export: Result<SiteExport, Refusal>) -> Result<ExitStatus> {
    let export = match export {
        Ok(export) => export,
        Err(refusal) => return usage(refusal.to_string()),
    };
    let (interrupted, recordings) = (interrupted()?, export.recordings());
    let mut shown = None;
    let mut goes_on = |done: usize| {
        if shown != Some(done) && recordings > 0 {
            shown = Some(done);
            remark(format_args!("recording {} of {recordings}", done + 1));
        }
        if interrupted.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    export.write(folder, &mut goes_on).map_err(with_file_error)?;
    writeln!(
        stdout(),
        "{}: {recordings} recordings. Open index.html there, or copy the folder to any web server.",
        folder.display()
    )?;
    Ok(ExitStatus::Done)
}

impl PageArgs {
    /// Takes the port, prints the address of the page, and opens it.
    pub(crate) fn open(&self) -> Result<Server> {
        let server = match Server::bind(self.port) {
            Ok(server) => server,
            Err(error) => return usage(format!("no port from {} on is free: {error}", self.port)),
        };
        let mut out = stdout();
        if self.port != 0 && server.port() != self.port {
            writeln!(out, "Port {} is in use; using {} instead.", self.port, server.port())?;
        }
        writeln!(out, "{}  (press Ctrl-C to stop)", server.address())?;
        out.flush()?;
        if !self.no_open && !open(&server.address_for_once()) {
            writeln!(out, "No browser could be opened. Open the address above yourself.")?;
        }
        Ok(server)
    }
}

/// Opens `address`. Returns false if no program could be started.
fn open(address: &str) -> bool {
    let mut command = Command::new(OPEN[0]);
    command.args(&OPEN[1..]).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().is_ok()
}
