//! The last lines of a command: the files that it wrote, and how to open each of them.

use super::command_style::remark;
use std::path::Path;

/// Prints on standard error that a file was written, and how to open it.
pub(crate) fn wrote(path: &Path) {
    remark(format_args!("wrote {}: {}", path.display(), opened(path)));
}

/// The way to open a file by its ending.
fn opened(path: &Path) -> String {
    let (name, word) = (path.display().to_string(), word(path));
    match path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("rrd") => format!("asperity view {word}"),
        Some("sdf" | "x3p" | "xyz") => format!("asperity surface {word}"),
        Some("toml") => format!("asperity solve {word}"),
        Some("npy" | "npz") => format!("numpy.load({name:?}) in Python"),
        Some("png" | "svg" | "pdf") => "a picture".into(),
        Some("parquet") => format!("pandas.read_parquet({name:?}) in Python"),
        Some("csv") => format!("pandas.read_csv({name:?}) in Python, or any spreadsheet"),
        _ => "a folder of tables, figures and recordings".into(),
    }
}

/// A path as one word of a shell.
fn word(path: &Path) -> String {
    let name = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "._-+/\\:".contains(c);
    if name.chars().all(is_plain) { name } else { format!("'{}'", name.replace('\'', r"'\''")) }
}
