//! `asperity explore`: turn a knob, watch the contact relax.

use super::exit_status::{ExitStatus, Usage, untold, usage};
use super::flags::{OfSetup, SceneArgs};
use super::interrupt::interrupted;
use super::manners::remark;
use super::warnings::print;
use anyhow::Result;
use asperity::explore::{Explorer, Knobs, Lesson, Refusal, SceneFile, Server, Sessions, SiteExport, Start};
use asperity::setup::Setup;
use asperity::surface::HeightFile;
use clap::{Args, ValueEnum};
use std::io::{Write, stdout};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// The program that opens an address in the browser of the person at the keyboard.
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
  asperity explore --lessons my-lessons --export course";

#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Explore {
    /// Where to start: hertz-line, hertz-surface, rough-line or rough-surface, or a scene as `asperity solve` takes it
    #[arg(value_name = "START|SCENE.toml", default_value = "rough-line", value_parser = begin)]
    start: Begin,
    /// A file of heights to start with instead, as if it were dropped on the page
    #[arg(long, value_name = "FILE")]
    height: Option<PathBuf>,
    /// A folder of lessons in the place of those of the page, one in each file that ends in .toml
    #[arg(long, value_name = "DIR")]
    lessons: Option<PathBuf>,
    /// Solve all that the lessons show, and write them as a folder of files for any web server, which is new or empty
    #[arg(long, value_name = "DIR", conflicts_with_all = ["height", "port", "no_open"])]
    export: Option<PathBuf>,
    #[command(flatten)]
    page: PageArgs,
}

/// Where the page is.
#[derive(Args)]
pub struct PageArgs {
    /// Port of the loopback interface; if it is in use, the next free one
    #[arg(long, value_name = "PORT", default_value_t = 8765)]
    port: u16,
    /// Say where the page is, and do not open it
    #[arg(long)]
    no_open: bool,
}

impl Explore {
    pub fn run(&self) -> Result<ExitStatus> {
        let lessons = match self.lessons.as_deref().map(Lesson::folder).transpose() {
            Ok(lessons) => lessons.unwrap_or_else(Lesson::all),
            Err(refusal) => return usage(refusal.to_string()),
        };
        if let Some(folder) = &self.export {
            return export(folder, lessons);
        }
        let (sessions, knobs) = match (&self.start, &self.height) {
            (Begin::Scene(_), Some(_)) => return usage("a scene has heights of its own: give it without --height"),
            (Begin::Scene(path), None) => with_scene(path)?,
            (Begin::Start(start), Some(path)) => {
                let heights = HeightFile::from(path.clone()).with_full_path();
                (Sessions::with_heights(heights)?, start.knobs())
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

/// Sessions with the scene of a file, and the knobs to start with. What `solve` would refuse is refused in its words.
fn with_scene(path: &Path) -> Result<(Sessions, Knobs)> {
    let mut table = SceneArgs::<OfSetup>::from_file(path.into()).table()?;
    if table.take_loads()?.is_some() {
        return usage("the page presses under one load at a time, but several are given: give one");
    }
    if table.take_auto()?.is_some() {
        return usage("the page has one grid, but a grid is to be found: give a number for refine");
    }
    let refused = |Refusal(sentence): Refusal| Usage(sentence);
    let setup = table.setup()?.with_full_path();
    setup.problem()?;
    let scene = SceneFile::new(setup).map_err(refused)?;
    let knobs = Knobs::from_scene(&scene).map_err(refused)?;
    print(&left_out(&scene.setup));
    Ok((Sessions::with_scene(scene), knobs))
}

/// Warnings about what the page does not take from a setup, a sentence each.
fn left_out(setup: &Setup) -> Vec<String> {
    let load = (!setup.load.is_pressure())
        .then(|| format!("the page presses by p*, so that it starts with another load than {}", setup.load));
    let friction = setup.friction.is_some().then(|| "the page leaves friction and the tangential load out".to_owned());
    load.into_iter().chain(friction).collect()
}

/// Writes lessons as a site, and says on standard error how far that is.
fn export(folder: &Path, lessons: Vec<Lesson>) -> Result<ExitStatus> {
    let export = match SiteExport::new(lessons) {
        Ok(export) => export,
        Err(refusal) => return usage(refusal.to_string()),
    };
    let interrupted = interrupted()?;
    let mut shown = None;
    let mut goes_on = |done: usize| {
        if shown != Some(done) {
            shown = Some(done);
            remark(format_args!("solving {} of {}", done + 1, export.runs()));
        }
        if interrupted.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    export.write(folder, &mut goes_on).map_err(untold)?;
    writeln!(stdout(), "{}: {} runs; put it on any web server", folder.display(), export.runs())?;
    Ok(ExitStatus::Done)
}

impl PageArgs {
    /// Takes the port, says where the page will be, and opens it.
    pub fn open(&self) -> Result<Server> {
        let server = match Server::bind(self.port) {
            Ok(server) => server,
            Err(error) => return usage(format!("no port from {} on can be had: {error}", self.port)),
        };
        let mut out = stdout();
        if self.port != 0 && server.port() != self.port {
            writeln!(out, "Port {} is in use; {} is taken instead.", self.port, server.port())?;
        }
        writeln!(out, "{}  (Ctrl-C ends it)", server.address())?;
        out.flush()?;
        if !self.no_open && !open(&server.address()) {
            writeln!(out, "No browser could be opened: open the address above in one.")?;
        }
        Ok(server)
    }
}

/// Opens `address`, and says whether that could be tried.
fn open(address: &str) -> bool {
    let mut command = Command::new(OPEN[0]);
    command.args(&OPEN[1..]).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().is_ok()
}
