//! The page and the viewer inside it, all of them in the binary.

use super::language;
use super::packed;
use super::policy::IN_PAGE;
use super::sessions::unguessable;
use super::site::{Reply, Site};
use super::stream::RecordingBytes;
use crate::explore::{self, Request};
use axum::body::Bytes;
use re_web_viewer_server::WebViewerData;
use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

const JAVASCRIPT: &str = "text/javascript; charset=utf-8";

/// A file of the page with its path and its kind.
macro_rules! file {
    ($name:literal, $kind:expr) => {
        (concat!("/", $name), $kind, include_str!(concat!("../../assets/explore/", $name)))
    };
}

/// The text of scripts of the page, one after the other.
macro_rules! scripts {
    ($($name:literal)*) => { concat!($(include_str!(concat!("../../assets/explore/", $name, ".js")), "\n"),*) };
}

/// All scripts of the page in the order in which they run.
const SCRIPTS: &str = scripts!(
    "packed" "say" "backend" "server" "browser" "link" "viewer" "views" "controls" "units" "heights" "runs" "table" "chart" "charts" "save" "address" "welcome" "choices"
    "point" "guess" "lessons" "picture" "top" "solid" "state" "hand" "pick" "why" "race" "undo" "asperity" "begin"
);

/// The files of the page that are as they are written: path, kind and text.
const FILES: &[(&str, &str, &str)] =
    &[file!("explore.css", "text/css; charset=utf-8"), file!("favicon.svg", "image/svg+xml")];

/// The path of the one script of the page.
const SCRIPT: &str = "/explore.js";

/// The script that runs the module in a Web Worker. The page has its text, as a page that is opened from a folder may not load a worker
/// from a file.
const WORKER: &str = scripts!("worker");

/// The module, packed by gzip. `browser/build` makes it.
const MODULE: &[u8] = include_bytes!("../../assets/explore/module.wasm.gz");

/// The module in a script, for a page that is opened from a folder, which may load nothing else.
const MODULE_SCRIPT: &str = "module.js";

/// The service worker of a site, which keeps its files for when there is no network.
const OFFLINE: &str = include_str!("../../assets/explore/offline.js");

/// The script of the page: the schema of the knobs, the texts and all scripts in one function, so that their names are not global.
fn script() -> String {
    let worker = serde_json::Value::from(compact(WORKER));
    format!(
        "(() => {{\n\"use strict\";\n{}const WORKER = {worker};\n{}{}}})();\n",
        explore::schema_script(),
        language::script(),
        compact(SCRIPTS)
    )
}

/// Scripts without indentation, and without the comments that have lines of their own: they are an eighth of all, and are to be read where the
/// scripts are written.
fn compact(scripts: &str) -> String {
    let mut is_inside = false;
    let is_code = |line: &&str| {
        let line = line.trim_start();
        let is_comment = line.starts_with("/**") && line.find("*/").is_none_or(|end| end + 2 == line.len());
        let is_left_out = is_inside || is_comment || line.starts_with("//");
        is_inside = (is_inside || is_comment) && !line.ends_with("*/");
        !is_left_out
    };
    scripts.lines().filter(is_code).fold(String::new(), |all, line| all + line.trim_start() + "\n")
}

/// Answers to the paths of the page.
pub(crate) struct Page {
    script: Bytes,
    /// Scripts of languages by their names.
    languages: Vec<(String, Bytes)>,
    viewer: Bytes,
    module: Bytes,
    /// `explore` for controls and viewer, `view` for the viewer alone.
    mode: &'static str,
    /// The path of the recording that the viewer alone shows.
    recording: String,
}

/// A file of the viewer, which stays where it is.
struct ViewerFile(Arc<WebViewerData>, fn(&WebViewerData) -> &[u8]);

impl AsRef<[u8]> for ViewerFile {
    fn as_ref(&self) -> &[u8] {
        (self.1)(&self.0)
    }
}

/// The file at `path` that is as it is written, if there is one.
fn written(path: &str) -> Option<Reply> {
    let (_, kind, text) = FILES.iter().find(|file| file.0 == path)?;
    Some(Reply::Page(kind, Bytes::from_static(text.as_bytes())))
}

impl Page {
    /// The page; fails if the viewer is not in the binary, as builds for special purposes leave it out.
    pub(crate) fn new(mode: &'static str, recording: String) -> io::Result<Self> {
        let viewer = Arc::new(WebViewerData::load(None).map_err(io::Error::other)?);
        let file = |content| Bytes::from_owner(ViewerFile(viewer.clone(), content));
        Ok(Self {
            script: script().into(),
            languages: language::files()?.into_iter().map(|(name, bytes)| (name, bytes.into())).collect(),
            viewer: file(WebViewerData::viewer_js),
            module: file(WebViewerData::viewer_wasm),
            mode,
            recording,
        })
    }

    /// The file at `path`, if it belongs to the page.
    pub(crate) fn file(&self, path: &str) -> Option<Reply> {
        Some(match path {
            "/" => Reply::Page("text/html; charset=utf-8", self.html().into()),
            SCRIPT => Reply::Page(JAVASCRIPT, self.script.clone()),
            "/re_viewer.js" => Reply::Fixed(JAVASCRIPT, self.viewer.clone()),
            "/re_viewer_bg.wasm" => Reply::Fixed("application/wasm", self.module.clone()),
            _ => return self.language(path).or_else(|| written(path)),
        })
    }

    /// The script of a language at `path`, if there is one.
    fn language(&self, path: &str) -> Option<Reply> {
        let (_, bytes) = self.languages.iter().find(|(name, _)| path.strip_prefix('/') == Some(name))?;
        Some(Reply::Page(JAVASCRIPT, bytes.clone()))
    }

    /// All files of a site, by their names, but for its data in `site.js` and `section.js`, which the page loads first; the viewer if there
    /// is something to view.
    pub(crate) fn files(&self, has_viewer: bool) -> impl Iterator<Item = (&str, Bytes)> {
        let kind = "<meta charset=\"utf-8\">";
        let policy = format!("{kind}\n<meta http-equiv=\"Content-Security-Policy\" content=\"{IN_PAGE}\">");
        let script = "<script src=\"explore.js\" defer></script>";
        let [site, section] = ["site", "section"].map(|name| format!("<script src=\"{name}.js\" defer></script>"));
        let site = format!("{site}\n{section}\n{script}");
        let html = self.html().replace(kind, &policy).replace(script, &site);
        let own = FILES.iter().map(|(path, _, text)| (&path[1..], Bytes::from_static(text.as_bytes())));
        let viewer = [("re_viewer.js", self.viewer.clone()), ("re_viewer_bg.wasm", self.module.clone())];
        let module =
            [("module.packed", Bytes::from_static(MODULE)), (MODULE_SCRIPT, packed::script("MODULE", MODULE).into())];
        let viewer = viewer.into_iter().filter(move |_| has_viewer);
        let languages = self.languages.iter().map(|(name, bytes)| (name.as_str(), bytes.clone()));
        let texts = [(&SCRIPT[1..], self.script.clone()), ("index.html", html.into())];
        own.chain(viewer).chain(languages).chain(module).chain(texts)
    }

    /// The service worker of a site: it keeps these files, under a mark that differs from that of other files.
    pub(crate) fn offline<'n>(&self, mark: &str, files: impl Iterator<Item = &'n str>) -> String {
        // a site that a service worker serves was not opened from a folder
        let is_kept = |name: &&str| !name.starts_with("re_viewer") && *name != MODULE_SCRIPT;
        let kept: Vec<&str> = files.filter(is_kept).collect();
        OFFLINE.replace("{mark}", mark).replace("{files}", &serde_json::Value::from(kept).to_string())
    }

    fn html(&self) -> String {
        let html = include_str!("../../assets/explore/explore.html");
        let html = html.replace("{mode}", self.mode).replace("{recording}", &self.recording);
        html.replace("{version}", env!("CARGO_PKG_VERSION"))
    }
}

/// The viewer, and the one recording that it shows, at a path that nobody can guess.
pub struct Viewing {
    page: Page,
    /// The path below `/`.
    recording: String,
    file: PathBuf,
}

impl Viewing {
    /// The viewer with the recording in `file`.
    ///
    /// # Errors
    /// If the viewer is not in the binary.
    pub fn new(file: PathBuf) -> io::Result<Self> {
        let recording = format!("{}/recording.rrd", unguessable());
        Ok(Self { page: Page::new("view", recording.clone())?, recording, file })
    }

    fn is_recording(&self, path: &str) -> bool {
        path.strip_prefix('/') == Some(&self.recording)
    }
}

impl Site for Viewing {
    fn is_secret(&self, path: &str) -> bool {
        self.is_recording(path)
    }

    fn reply(&self, request: &Request<'_>) -> Reply {
        match request.path {
            _ if request.method != "GET" => Reply::wrong_method("GET"),
            path if self.is_recording(path) => match File::open(&self.file) {
                Ok(file) => Reply::Recording(RecordingBytes::File(file), None),
                Err(error) => Reply::Error(404, error.to_string().into()),
            },
            path => self.page.file(path).unwrap_or_else(|| Reply::missing(path)),
        }
    }
}
