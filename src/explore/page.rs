//! The page and the viewer inside it, all of them in the binary.

use super::policy::IN_PAGE;
use super::schema;
use super::site::{Reply, Request, Site};
use super::stream::RecordingBytes;
use axum::body::Bytes;
use re_web_viewer_server::WebViewerData;
use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

const SCRIPT: &str = "text/javascript; charset=utf-8";

/// A file of the page with its path and its kind.
macro_rules! file {
    ($name:literal, $kind:expr) => {
        (concat!("/", $name), $kind, include_str!(concat!("../../assets/explore/", $name)))
    };
}

/// The script with all sentences of the page in all of its languages, and those of the server, which are English, with what the page says in
/// their place.
const TEXTS: &str = concat!(
    "const TEXTS = {\n\"en\": ",
    include_str!("../../assets/explore/texts/en.json"),
    ",\n\"de\": ",
    include_str!("../../assets/explore/texts/de.json"),
    "};\nconst TOLD = {\n\"en\": ",
    include_str!("../../assets/explore/texts/told.en.json"),
    ",\n\"de\": ",
    include_str!("../../assets/explore/texts/told.de.json"),
    "};\n"
);

/// The files of the page: path, kind and text.
const FILES: &[(&str, &str, &str)] = &[
    file!("explore.css", "text/css; charset=utf-8"),
    file!("favicon.svg", "image/svg+xml"),
    file!("address.js", SCRIPT),
    file!("backend.js", SCRIPT),
    file!("beforehand.js", SCRIPT),
    file!("charts.js", SCRIPT),
    file!("controls.js", SCRIPT),
    file!("explore.js", SCRIPT),
    file!("guess.js", SCRIPT),
    file!("hand.js", SCRIPT),
    file!("heights.js", SCRIPT),
    file!("lessons.js", SCRIPT),
    file!("link.js", SCRIPT),
    file!("pick.js", SCRIPT),
    file!("picture.js", SCRIPT),
    file!("runs.js", SCRIPT),
    file!("save.js", SCRIPT),
    file!("say.js", SCRIPT),
    ("/texts.js", SCRIPT, TEXTS),
    file!("viewer.js", SCRIPT),
    file!("views.js", SCRIPT),
    file!("welcome.js", SCRIPT),
    file!("why.js", SCRIPT),
    file!("undo.js", SCRIPT),
    file!("presets.js", SCRIPT),
];

/// The path of the script with the schema of the knobs.
const KNOBS: &str = "/knobs.js";

/// Answers to the paths of the page.
pub struct Page {
    script: Bytes,
    module: Bytes,
    /// The script with the schema of the knobs.
    knobs: Bytes,
    /// `explore` for controls and viewer, `view` for the viewer alone.
    mode: &'static str,
}

/// A file of the viewer, which stays where it is.
struct ViewerFile(Arc<WebViewerData>, fn(&WebViewerData) -> &[u8]);

impl AsRef<[u8]> for ViewerFile {
    fn as_ref(&self) -> &[u8] {
        (self.1)(&self.0)
    }
}

impl Page {
    /// The page; fails if the viewer is not in the binary, as builds for special purposes leave it out.
    pub fn new(mode: &'static str) -> io::Result<Self> {
        let viewer = Arc::new(WebViewerData::load(None).map_err(io::Error::other)?);
        let file = |content| Bytes::from_owner(ViewerFile(viewer.clone(), content));
        Ok(Self {
            script: file(WebViewerData::viewer_js),
            module: file(WebViewerData::viewer_wasm),
            knobs: schema::script().into(),
            mode,
        })
    }

    /// The file at `path`, if it belongs to the page.
    pub fn file(&self, path: &str) -> Option<Reply> {
        Some(match path {
            "/" => Reply::Page("text/html; charset=utf-8", self.html().into()),
            KNOBS => Reply::Page(SCRIPT, self.knobs.clone()),
            "/re_viewer.js" => Reply::Fixed(SCRIPT, self.script.clone()),
            "/re_viewer_bg.wasm" => Reply::Fixed("application/wasm", self.module.clone()),
            _ => {
                let (_, kind, text) = FILES.iter().find(|file| file.0 == path)?;
                Reply::Page(kind, Bytes::from_static(text.as_bytes()))
            }
        })
    }

    /// All files, by their names, as they lie in a folder beside the script `solved.js`, which the page then loads.
    pub fn files(&self) -> impl Iterator<Item = (&'static str, Bytes)> {
        let kind = "<meta charset=\"utf-8\">";
        let policy = format!("{kind}\n<meta http-equiv=\"Content-Security-Policy\" content=\"{IN_PAGE}\">");
        let script = "<script src=\"beforehand.js\" defer></script>";
        let solved = format!("<script src=\"solved.js\" defer></script>\n{script}");
        let html = self.html().replace(kind, &policy).replace(script, &solved);
        let own = FILES.iter().map(|(path, _, text)| (&path[1..], Bytes::from_static(text.as_bytes())));
        let viewer = [("re_viewer.js", self.script.clone()), ("re_viewer_bg.wasm", self.module.clone())];
        own.chain(viewer).chain([(&KNOBS[1..], self.knobs.clone()), ("index.html", html.into())])
    }

    fn html(&self) -> String {
        let html = include_str!("../../assets/explore/explore.html");
        html.replace("{mode}", self.mode).replace("{version}", env!("CARGO_PKG_VERSION"))
    }
}

/// The viewer, and the one recording that it shows.
pub struct Viewing {
    page: Page,
    file: PathBuf,
}

impl Viewing {
    /// The viewer with the recording in `file`.
    ///
    /// # Errors
    /// If the viewer is not in the binary.
    pub fn new(file: PathBuf) -> io::Result<Self> {
        Ok(Self { page: Page::new("view")?, file })
    }
}

impl Site for Viewing {
    fn reply(&self, request: &Request<'_>) -> Reply {
        match request.path {
            _ if request.method != "GET" => Reply::wrong_method("GET"),
            "/recording.rrd" => match File::open(&self.file) {
                Ok(file) => Reply::Recording(RecordingBytes::File(file), None),
                Err(error) => Reply::Error(404, error.to_string()),
            },
            path => self.page.file(path).unwrap_or_else(|| Reply::missing(path)),
        }
    }
}
