//! The scripts of the page, which share the scope of one function, but for those of workers and the module.

use super::texts::sources;
use std::collections::HashMap;

/// The name that a line declares for all scripts, if it does: such lines are not indented.
fn declared(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("async ").unwrap_or(line);
    let (kind, rest) = rest.split_once(' ')?;
    ["let", "const", "function", "class"].contains(&kind).then(|| rest.split([' ', '(', ';']).next())?
}

/// Of two functions of one name the second would silently take the place of the first.
#[test]
fn no_name_is_declared_twice() {
    let sources = sources();
    let is_alone = |file: &str| ["offline.js", "worker.js"].contains(&file);
    let scripts = sources.iter().filter(|(file, _)| file.ends_with(".js") && !is_alone(file));
    let declarations = scripts.flat_map(|(file, text)| text.lines().filter_map(declared).map(move |name| (name, file)));
    let mut places: HashMap<&str, &str> = HashMap::new();
    for (name, file) in declarations {
        assert_eq!(places.insert(name, file), None, "{name} is declared in {file}, too");
    }
    assert!(places.len() > 200, "only {} names were found", places.len());
}
