//! Names of types: each has one meaning in the crate.

use crate::source::{Source, tokens};
use std::collections::BTreeMap;

/// The names of structs, enums, traits, unions and type aliases in code, wherever they stand. Associated types of traits are none: their names are
/// those of the trait.
fn type_names(tokens: &[String]) -> Vec<&str> {
    let mut names = Vec::new();
    // for each open brace, whether it opens a trait or an implementation
    let mut blocks: Vec<bool> = Vec::new();
    // the code from which a brace would be opened
    let mut head: Vec<&str> = Vec::new();
    let mut brackets = 0_usize;
    for (i, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "{" => {
                let has = |word: &str| head.contains(&word);
                blocks.push(!has("fn") && (has("impl") || has("trait")));
                head.clear();
            }
            "}" => {
                blocks.pop();
                head.clear();
            }
            "(" | "[" => brackets += 1,
            ")" | "]" => brackets = brackets.saturating_sub(1),
            ";" if brackets == 0 => head.clear(),
            word => head.push(word),
        }
        let is_alias = token == "type" && !blocks.last().is_some_and(|is_associated| *is_associated);
        if is_alias || ["struct", "enum", "trait", "union"].contains(&token.as_str()) {
            let name = tokens.get(i + 1).map_or("", |name| name.trim_end_matches(':'));
            names.extend(Some(name).filter(|name| name.starts_with(char::is_uppercase)));
        }
    }
    names
}

/// The names that occur in more than one file, each with its files. In one file a name may stand for another type without a feature.
fn repeated(sources: &[Source]) -> Vec<String> {
    let mut files: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for source in sources {
        for name in type_names(&source.tokens()) {
            files.entry(name.to_owned()).or_default().push(&source.path);
        }
    }
    files.values_mut().for_each(|paths| paths.dedup());
    assert!(files.len() > 30, "only {} types found", files.len());
    let repeated = files.into_iter().filter(|(_, files)| files.len() > 1);
    repeated.map(|(name, files)| format!("{name} is a type in {}", files.join(" and in "))).collect()
}

#[test]
fn each_type_name_occurs_once() {
    for sources in [Source::all(), Source::python()] {
        let found = repeated(&sources);
        assert!(found.is_empty(), "{} names have several meanings:\n{}", found.len(), found.join("\n"));
    }
}

#[test]
fn constructors_are_not_called_of() {
    for source in Source::all().into_iter().chain(Source::python()) {
        let has_of = source.tokens().windows(2).any(|pair| pair == ["fn", "of"]);
        assert!(!has_of, "{} has a function `of`: constructors are `new` or `from_*`", source.path);
    }
}

#[test]
fn types_are_found_wherever_they_stand() {
    let code = "pub struct A<T>(T); pub(super) enum B { Struct(u8) } trait C: Debug { type Of; } impl C for [A<u8>; 3] { type Of = u8; \
                fn f(&self) -> impl Fn() { type D = u8; struct E { a: [u8; 2] } } } type F = fn(); mod g { union H { h: u8 } } // struct I;";
    assert_eq!(type_names(&tokens(code)), ["A", "B", "C", "D", "E", "F", "H"]);
}
