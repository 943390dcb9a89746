//! The source of the crate: its files, and their code as tokens.

use std::path::{Path, PathBuf};

/// A source file: its path below `src` and its text.
pub struct Source {
    pub path: String,
    pub text: String,
}

impl Source {
    /// All files of the crate.
    pub fn all() -> Vec<Self> {
        let sources = Self::below("src");
        assert!(sources.len() > 30, "only {} files found", sources.len());
        sources
    }

    /// All files of the Python package that are written in Rust.
    pub fn python() -> Vec<Self> {
        let mut sources = Self::below("python/src");
        assert!(sources.len() > 15, "only {} files found", sources.len());
        // in `src` this name is the crate itself, here it is another crate
        sources.iter_mut().for_each(|source| source.text = source.text.replace("asperity::", "library::"));
        sources
    }

    /// The files below a folder of the repository.
    fn below(folder: &str) -> Vec<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let mut folders = vec![root.clone()];
        let mut sources = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path: PathBuf = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "rs") {
                    let below = path.strip_prefix(&root).unwrap().components();
                    let parts: Vec<_> = below.map(|part| part.as_os_str().to_str().unwrap()).collect();
                    sources.push(Self { path: parts.join("/"), text: std::fs::read_to_string(&path).unwrap() });
                }
            }
        }
        sources.sort_by(|a, b| a.path.cmp(&b.path));
        sources
    }

    /// The module of the file, from the root of the crate.
    pub fn module(&self) -> Vec<String> {
        let names = self.path.trim_end_matches(".rs").split('/').map(str::to_owned);
        let mut names: Vec<String> = names.collect();
        if names.last().is_some_and(|last| last == "mod") || names == ["lib"] || names == ["main"] {
            names.pop();
        }
        names
    }

    /// The room of the file: the module at the top of its path, or the file itself.
    pub fn room(&self) -> &str {
        self.path.split('/').next().unwrap().trim_end_matches(".rs")
    }

    /// The tokens of the code, its unit tests included.
    pub fn tokens(&self) -> Vec<String> {
        tokens(&self.text)
    }

    /// The tokens of the code without its unit tests, which may need more of the crate than the code does.
    pub fn shipped_tokens(&self) -> Vec<String> {
        tokens(self.text.split("\n#[cfg(test)]\nmod tests {").next().unwrap()).into_iter().collect()
    }
}

/// Names, `::` and single marks; no comments and no texts.
pub fn tokens(code: &str) -> Vec<String> {
    let bare = without_texts(code);
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let apart: String = bare.chars().map(|c| if is_name(c) { c.into() } else { format!(" {c} ") }).collect();
    apart.replace("::", " :: ").split_whitespace().map(str::to_owned).collect()
}

/// The code with comments, texts and characters left out, line by line.
pub fn without_texts(code: &str) -> String {
    let mut bare = String::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if let Some(text) = rest.strip_prefix("r#\"") {
            text.find("\"#").map_or(rest.len(), |end| end + 5)
        } else if first == '"' {
            1 + end_of_text(&rest[1..])
        } else {
            0
        };
        match length.max(length_of_character(rest)) {
            0 => {
                bare.push(first);
                rest = &rest[first.len_utf8()..];
            }
            length => {
                bare.extend(rest[..length].matches('\n'));
                rest = &rest[length..];
            }
        }
    }
    bare
}

/// The length of a character in single quotes at the start of some code; 0 if there is none. The name of a lifetime has no second quote.
fn length_of_character(code: &str) -> usize {
    let Some(quoted) = code.strip_prefix('\'') else { return 0 };
    let mut chars = quoted.chars();
    match (chars.next(), chars.next()) {
        (Some('\\'), Some(escaped)) => {
            2 + escaped.len_utf8() + quoted[1 + escaped.len_utf8()..].find('\'').map_or(0, |at| at + 1)
        }
        (Some(one), Some('\'')) => 2 + one.len_utf8(),
        _ => 0,
    }
}

/// Where a text ends, its closing mark included.
fn end_of_text(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

/// Whether code names a crate: at the start of a path, or in a bare `use`.
pub fn names(tokens: &[String], name: &str) -> bool {
    let is_named = |i: usize| match (i.checked_sub(1).map(|i| tokens[i].as_str()), tokens.get(i + 1)) {
        (Some("::"), _) => false,
        (Some("use"), _) => true,
        (_, next) => next.is_some_and(|next| next == "::"),
    };
    (0..tokens.len()).any(|i| tokens[i] == name && is_named(i))
}

#[test]
fn texts_and_comments_are_no_code() {
    let code =
        "let a = \"crate::x \\\" {\"; // crate::y\n/// [`crate::z`]\nlet b = r#\"super::w\"#; let c = '\"'; crate::v";
    let expected = "let a = ; let b = ; let c = ; crate :: v";
    assert_eq!(tokens(code).join(" "), expected);
}

#[test]
fn crates_are_seen_where_they_are_named() {
    let names = |code: &str, name: &str| names(&tokens(code), name);
    assert!(names("use rerun::{RecordingStream};", "rerun") && names("let v = glam::Vec3::ZERO;", "glam"));
    assert!(names("use clap;", "clap") && names("#[derive(clap::Args)]", "clap"));
    assert!(!names("\"open it with `rerun {0}`\"", "rerun") && !names("my_rerun::x", "rerun"));
    assert!(!names("a::clap::b", "clap"));
}
