//! Files that the page saves.

use super::page::Page;
use rerun::{ChunkStore, ChunkStoreConfig, StoreKind};
use serde_json::Value;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Saves by a button what goes by `name`, and returns where it is.
pub fn save(page: &mut Page, button: &str, name: &str) -> PathBuf {
    page.until(&format!("!document.getElementById('{button}').disabled"));
    let known = page.chromium.events("Browser.downloadWillBegin").count();
    page.click(button);
    let begun = page.chromium.told_after(known, "Browser.downloadWillBegin");
    assert_eq!(begun["suggestedFilename"], name);
    let is_whole = |event: &Value| event["guid"] == begun["guid"] && event["state"] == "completed";
    let ended = page.chromium.told("Browser.downloadProgress", is_whole);
    ended["filePath"].as_str().map_or_else(|| page.chromium.downloads().join(name), PathBuf::from)
}

/// Name and content of a recording in a file, without its layout.
pub fn recording(path: &Path) -> (String, ChunkStore) {
    let stores = ChunkStore::from_rrd_reader(&ChunkStoreConfig::ALL_DISABLED, &mut File::open(path).unwrap()).unwrap();
    let (id, store) = stores.into_iter().find(|(id, _)| id.kind() == StoreKind::Recording).unwrap();
    (id.recording_id().as_str().to_owned(), store)
}
