//! What the page says: each language says all of it, and all that is said is asked for.

use asperity::contact::Quantity;
use asperity::error::{Conflict, ConflictRule, GridError, PreparationError, ProblemError, SetupError, SurfaceError};
use asperity::explore::{KNOBS, KNOWN_ERRORS, Knob, KnobGroup, KnobKind, KnownFault, RefusalRule};
use asperity::sentence::Worded;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use strum::IntoEnumIterator;

type Texts = BTreeMap<String, String>;

/// Scripts and the page, by name.
pub fn sources() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/explore");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_text = |path: &Path| path.extension().is_some_and(|it| it == "js" || it == "html");
    let sources = files.filter(|path| is_text(path));
    sources
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read_to_string(&path).unwrap()))
        .collect()
}

fn texts(json: &str) -> Texts {
    serde_json::from_str(json).unwrap()
}

fn english() -> Texts {
    texts(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/explore/texts/en.json")))
}

fn german() -> Texts {
    texts(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/explore/texts/de.json")))
}

/// What stands between two marks, each time it does.
fn between<'a>(text: &'a str, open: &'a str, close: char) -> impl Iterator<Item = &'a str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split(close).next())
}

fn places(text: &str) -> BTreeSet<&str> {
    between(text, "{", '}').collect()
}

#[test]
fn languages_say_the_same() {
    let (english, german) = (english(), german());
    assert_eq!(english.keys().collect::<Vec<_>>(), german.keys().collect::<Vec<_>>());
    for (key, text) in &english {
        assert_eq!(places(text), places(&german[key]), "{key}");
        assert!(!text.is_empty() && !german[key].is_empty(), "{key}");
    }
}

#[test]
fn numbers_are_explained_as_everywhere() {
    let english = english();
    for row in Quantity::found().map(Quantity::row) {
        let explained = english.get(&format!("number.{}.tip", row.name));
        assert_eq!(explained.is_some(), english.contains_key(&format!("number.{}", row.name)), "{}", row.name);
        assert!(row.page.is_none() || explained.is_some(), "{} is in the table without a name", row.name);
        explained.into_iter().for_each(|text| assert_eq!(text, row.sentence, "{}", row.name));
    }
}

/// Faults that the English page words with the names of its knobs, and not like the library.
const OWN_WORDS: [&str; 4] = ["surface-points", "cutoff-of-rolloff", "cutoff-of-points", "no-size"];

#[test]
fn every_refusal_has_a_text() {
    let english = english();
    let conflicts = ConflictRule::iter().map(|rule| (rule.id(), Some(Conflict::from(rule).sentence().template())));
    let refusals = RefusalRule::iter().map(|rule| (rule.id(), Some(rule.sentence().to_owned())));
    let errors = KNOWN_ERRORS
        .into_iter()
        .chain([KnownFault::ABOVE_HARDNESS, KnownFault::YIELDS_EVERYWHERE])
        .map(|id| (id, None));
    let mut ids = BTreeSet::new();
    for (id, sentence) in conflicts.chain(refusals).chain(errors) {
        assert!(ids.insert(id), "two faults are called {id}");
        let text = english.get(&format!("refused.{id}")).unwrap_or_else(|| panic!("{id} has no text"));
        if let Some(sentence) = sentence.as_ref().filter(|_| !OWN_WORDS.contains(&id)) {
            assert_eq!(text, sentence, "{id}");
        }
        assert_eq!(places(text), sentence.as_deref().map_or(places(text), places), "{id}");
    }
    for id in english.keys().filter_map(|key| key.strip_prefix("refused.")) {
        assert!(ids.contains(id), "nothing is refused as {id}");
    }
}

/// What the library says of a file of heights that it refuses, and what the page says.
#[test]
fn known_errors_are_said_as_the_library_says_them() {
    let english = english();
    let path = || "h.txt".into();
    let errors = [
        SetupError::Uneven { path: path() },
        SetupError::Voids { path: path(), voids: 1, points: 64 },
        SetupError::UnitOfFile { unit: 1e-6 },
    ];
    for error in errors {
        let known = KnownFault::from_setup(&error).unwrap();
        let text = &english[&format!("refused.{}", known.key)];
        let said = known
            .places
            .iter()
            .fold(text.clone(), |said, (name, value)| said.replace(&format!("{{{name}}}"), &value.to_string()));
        assert_eq!(said, error.to_string());
    }
}

/// Keys that a text asks for; those that it puts together at run time are patterns with `*` for what is put in.
fn asked(source: &str) -> BTreeSet<String> {
    let named = ["say(\"", "data-text=\"", "data-tip=\"", "data-name=\""].into_iter();
    let mut keys: BTreeSet<String> = named.flat_map(|open| between(source, open, '"')).map(str::to_owned).collect();
    for made in between(source, "say(`", '`') {
        let mut parts = made.split("${");
        let first = parts.next().unwrap().to_owned();
        keys.insert(parts.fold(first, |key, part| key + "*" + part.split_once('}').map_or("", |(_, rest)| rest)));
    }
    keys
}

/// Whether a key is what a pattern asks for.
fn fits(key: &str, pattern: &str) -> bool {
    match pattern.split_once('*') {
        None => key == pattern,
        Some((start, rest)) => key.strip_prefix(start).is_some_and(|tail| {
            tail.char_indices().any(|(i, _)| i > 0 && fits(&tail[i..], rest)) || (rest.is_empty() && !tail.is_empty())
        }),
    }
}

#[test]
fn every_text_that_is_asked_for_is_there_and_the_other_way_round() {
    let english = english();
    let patterns: BTreeSet<String> = sources().iter().flat_map(|(_, text)| asked(text)).collect();
    assert!(patterns.len() > 100, "{patterns:?}");
    for pattern in &patterns {
        assert!(english.keys().any(|key| fits(key, pattern)), "there is no text {pattern}");
    }
    for key in english.keys().filter(|key| *key != "language") {
        assert!(patterns.iter().any(|pattern| fits(key, pattern)), "nobody asks for the text {key}");
    }
}

#[test]
fn every_knob_and_all_that_it_offers_have_names() {
    let english = english();
    for Knob { group, id, kind, .. } in KNOBS {
        let Some(group) = group else { continue };
        let name = format!("{}.{id}", if *group == KnobGroup::File { "heights" } else { "control" });
        let options = match kind {
            KnobKind::Choice { options, .. } | KnobKind::Choices { options, .. } => options,
            KnobKind::Switch { .. } => &["true", "false"][..],
            _ => &[],
        };
        let offered =
            |option: &&str| format!("{name}.{}", if option.is_empty() { "no" } else { option }.replace(' ', "-"));
        let unit = match kind {
            KnobKind::Number(number) => number.unit.map(|unit| format!("unit.{unit}")),
            _ => None,
        };
        let keys = [name.clone(), format!("{name}.tip"), format!("group.{}", json!(group).as_str().unwrap())];
        for key in keys.into_iter().chain(unit).chain(options.iter().map(offered)) {
            assert!(english.contains_key(&key), "there is no text {key}");
        }
    }
}

/// Literals of a script: what stands between quotes, without comments and what is put in at run time.
fn literals(script: &str) -> Vec<String> {
    let code: String = script
        .lines()
        .filter(|line| !["//", "/*", "*"].iter().any(|start| line.trim_start().starts_with(start)))
        .map(|line| line.split(" // ").next().unwrap().to_owned() + "\n")
        .collect();
    let (mut found, mut open) = (Vec::new(), None::<(char, String)>);
    for letter in code.chars() {
        match &mut open {
            Some((mark, text)) if letter == *mark || (letter == '\n' && *mark == '"') => {
                found.push(std::mem::take(text));
                open = None;
            }
            Some((_, text)) => text.push(letter),
            None if letter == '"' || letter == '`' => open = Some((letter, String::new())),
            None => {}
        }
    }
    found
}

/// Whether a literal is words for people: two words or more, one of which begins with a capital.
fn is_said(literal: &str) -> bool {
    let is_word =
        |word: &&str| word.len() > 1 && word.trim_end_matches(['.', ',', ':', ';']).chars().all(char::is_alphabetic);
    let words: Vec<&str> = literal.split(' ').filter(is_word).collect();
    words.len() > 1 && words.iter().any(|word| word.starts_with(char::is_uppercase))
}

#[test]
fn scripts_say_nothing_of_their_own() {
    assert!(
        is_said("Copied: the address") && is_said("Your curve") && !is_said("use strict") && !is_said("M 0 0 L 1 1")
    );
    for (name, text) in sources().iter().filter(|(name, _)| name.ends_with(".js")) {
        for literal in literals(text) {
            assert!(!is_said(&literal), "{name} says {literal:?}: put it among the texts");
        }
    }
}

#[test]
fn the_page_itself_says_nothing_but_symbols() {
    let html = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/explore/explore.html"));
    for text in between(html, ">", '<').map(str::trim).filter(|text| !text.is_empty()) {
        let is_symbol = text.chars().count() < 8 || text.starts_with("asperity") || text.contains('{');
        assert!(is_symbol, "the page says {text:?} in one language: put it among the texts");
    }
    for attribute in [" title=\"", "aria-label=\"", "placeholder=\""] {
        assert!(!html.contains(attribute), "{attribute} is in one language");
    }
}

/// What the server tells in English, and the same in German.
fn told() -> Texts {
    texts(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/explore/texts/told.de.json")))
}

/// What the server tells in English, and what the English page says in its place.
fn told_in_english() -> Texts {
    texts(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/explore/texts/told.en.json")))
}

/// All sources of the library with their texts on one line each.
fn code() -> String {
    code_in("")
}

/// The sources in a folder, or in a file, of the library with their texts on one line each.
fn code_in(place: &str) -> String {
    fn read(path: &Path, into: &mut String) {
        match std::fs::read_dir(path) {
            Ok(entries) => entries.for_each(|entry| read(&entry.unwrap().path(), into)),
            Err(_) => into.push_str(&std::fs::read_to_string(path).unwrap_or_default()),
        }
    }
    let mut all = String::new();
    read(&Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")).join(place), &mut all);
    all.replace("\\\"", "\"").replace("\\\n", " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The templates of all sentences that are made in some code, with places such as `{length}`.
fn templates_in(code: &str) -> BTreeSet<String> {
    let literal =
        |rest: &str| rest.trim_start().strip_prefix('"').and_then(|it| it.split_once('"')).map(|it| bare(it.0));
    code.split("sentence!(").skip(1).filter_map(literal).collect()
}

/// A template without the formats of its places.
fn bare(template: &str) -> String {
    let mut parts = template.split('{');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |words, part| {
        let (place, rest) = part.split_once('}').unwrap_or((part, ""));
        words + "{" + place.split(':').next().unwrap_or_default() + "}" + rest
    })
}

/// What the page is told is looked up by its words, which must be those of the library to the letter.
#[test]
fn what_the_server_tells_is_told_in_each_language() {
    let (told, code) = (told(), code());
    let bare_all = |templates: Vec<&str>| templates.into_iter().map(bare).collect::<BTreeSet<String>>();
    // an error of a setup says what any error of its parts says
    let of_errors = bare_all(SetupError::templates());
    let known: BTreeSet<String> = templates_in(&code).into_iter().chain(of_errors).collect();
    for (english, own) in told.iter().chain(&told_in_english()) {
        assert_eq!(places(english), places(own), "{english}");
        let is_known = known.contains(english) || (!english.contains('{') && code.contains(english.as_str()));
        assert!(is_known, "nobody tells {english:?}");
        assert!(told.contains_key(english), "{english:?} is not told in German");
    }
    // Those that no knob of the page leads to are not asked for.
    let of_knobs =
        [GridError::templates(), SurfaceError::templates(), ProblemError::templates(), PreparationError::templates()];
    for template in bare_all(of_knobs.concat()) {
        assert!(told.contains_key(&template), "{template:?} is not told in German");
    }
    let of_page = [
        "surface/survey/",
        "surface/preparation/",
        "contact/warnings.rs",
        "explore/description.rs",
        "explore/height_knobs.rs",
    ];
    for template in of_page.iter().flat_map(|place| templates_in(&code_in(place))) {
        assert!(told.contains_key(&template), "{template:?} is not told in German");
    }
}
