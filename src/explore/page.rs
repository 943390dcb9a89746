//! The page and the viewer inside it, all of them in the binary.

use super::site::Reply;
use axum::body::Bytes;
use re_web_viewer_server::WebViewerData;
use std::io;
use std::sync::Arc;

/// Answers to the paths of the page.
#[derive(Clone)]
pub struct Page {
    script: Bytes,
    module: Bytes,
    purpose: Purpose,
}

/// A file of the viewer, which stays where it is.
struct ViewerFile(Arc<WebViewerData>, fn(&WebViewerData) -> &[u8]);

impl AsRef<[u8]> for ViewerFile {
    fn as_ref(&self) -> &[u8] {
        (self.1)(&self.0)
    }
}

/// The purpose of the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Controls and viewer.
    Explore,
    /// The viewer alone.
    View,
}

impl Page {
    /// The page.
    ///
    /// # Errors
    /// If the viewer is not in the binary, as builds for special purposes leave it out.
    pub fn new(purpose: Purpose) -> io::Result<Self> {
        let viewer = Arc::new(WebViewerData::load(None).map_err(io::Error::other)?);
        let file = |content| Bytes::from_owner(ViewerFile(viewer.clone(), content));
        Ok(Self { script: file(WebViewerData::viewer_js), module: file(WebViewerData::viewer_wasm), purpose })
    }

    /// The file at `path`, if it belongs to the page.
    pub fn file(&self, path: &str) -> Option<Reply> {
        let text = |kind, text: &'static str| Reply::Page(kind, Bytes::from_static(text.as_bytes()));
        Some(match path {
            "/" => Reply::Page("text/html; charset=utf-8", self.html().into()),
            "/explore.js" => text("text/javascript; charset=utf-8", include_str!("../../assets/explore/explore.js")),
            "/explore.css" => text("text/css; charset=utf-8", include_str!("../../assets/explore/explore.css")),
            "/favicon.svg" => text("image/svg+xml", include_str!("../../assets/explore/favicon.svg")),
            "/re_viewer.js" => Reply::Fixed("text/javascript; charset=utf-8", self.script.clone()),
            "/re_viewer_bg.wasm" => Reply::Fixed("application/wasm", self.module.clone()),
            _ => return None,
        })
    }

    fn html(&self) -> String {
        let mode = match self.purpose {
            Purpose::Explore => "explore",
            Purpose::View => "view",
        };
        let html = include_str!("../../assets/explore/explore.html");
        html.replace("{mode}", mode).replace("{version}", env!("CARGO_PKG_VERSION"))
    }
}
