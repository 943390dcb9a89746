//! Which file uses which, found by following paths through the doors of modules.

use crate::source::Source;
use std::collections::{BTreeMap, BTreeSet};

/// A path of names.
type Names = Vec<String>;

/// The files of a crate, and which of them each uses.
pub struct Uses {
    pub files: Vec<String>,
    pub of: Vec<BTreeSet<usize>>,
}

/// An import: the name that it makes, where that comes from, and whether it is a door, a `pub use`.
struct Import {
    name: String,
    path: Names,
    is_door: bool,
}

/// What the code of one file names.
#[derive(Default)]
struct Code {
    imports: Vec<Import>,
    /// Paths in the code besides imports, and single names.
    paths: Vec<Names>,
}

impl Uses {
    /// Of the code alone, or with its unit tests.
    ///
    /// A file uses the file in which an item stands that it names, however many doors (`pub use`) lie between. A door itself uses
    /// nothing, unless the file also needs the name.
    pub fn new(sources: &[Source], with_tests: bool) -> Self {
        let modules: BTreeMap<Names, usize> = sources.iter().enumerate().map(|(i, s)| (s.module(), i)).rev().collect();
        let tokens = |source: &Source| if with_tests { source.tokens() } else { source.shipped_tokens() };
        let code: Vec<Code> =
            sources.iter().map(|source| Code::new(&tokens(source), &source.module(), &modules)).collect();
        let mut imports: BTreeMap<Names, Vec<&Import>> = BTreeMap::new();
        for (source, code) in sources.iter().zip(&code) {
            imports.entry(source.module()).or_default().extend(&code.imports);
        }
        let map = Map { modules, imports };
        let of = sources.iter().zip(&code).enumerate();
        let of = of.map(|(i, (source, code))| map.used(source, code).into_iter().filter(|&used| used != i).collect());
        Self { of: of.collect(), files: sources.iter().map(|source| source.path.clone()).collect() }
    }

    /// The circles: files that use each other, if only through others.
    pub fn circles(&self) -> Vec<Vec<usize>> {
        circles(&self.of)
    }
}

/// The nodes of a graph that reach each other, in groups of two and more.
pub fn circles(uses: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let reach: Vec<BTreeSet<usize>> = (0..uses.len()).map(|from| reached(uses, from)).collect();
    let group = |i: usize| -> Vec<usize> { reach[i].iter().copied().filter(|&j| reach[j].contains(&i)).collect() };
    let groups: BTreeSet<Vec<usize>> = (0..uses.len()).map(group).filter(|group| group.len() > 1).collect();
    groups.into_iter().collect()
}

fn reached(uses: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut open = vec![from];
    while let Some(at) = open.pop() {
        open.extend(uses[at].iter().copied().filter(|&next| found.insert(next)));
    }
    found
}

/// Modules by path, and what is imported into each.
struct Map<'a> {
    modules: BTreeMap<Names, usize>,
    imports: BTreeMap<Names, Vec<&'a Import>>,
}

impl Map<'_> {
    /// The files that the code of one uses.
    fn used(&self, source: &Source, code: &Code) -> BTreeSet<usize> {
        let needs = |name: &str| code.paths.iter().any(|path| path[0] == name);
        let mut used = BTreeSet::new();
        for import in &code.imports {
            let (path, is_glob) = match import.path.split_last() {
                Some((last, path)) if last == "*" => (path, true),
                _ => (import.path.as_slice(), false),
            };
            // a module is used where the code names something in it
            let is_needed = is_glob || !self.modules.contains_key(path) && (!import.is_door || needs(&import.name));
            if is_needed {
                used.extend(self.file(path, 0));
            }
        }
        for path in code.paths.iter().filter(|path| path.len() > 1) {
            let mut whole = source.module();
            let absolute = match code.imports.iter().find(|import| import.name == path[0]) {
                Some(import) => [&import.path, &path[1..]].concat(),
                None if path[0].is_empty() => path[1..].to_vec(),
                None => {
                    whole.push(path[0].clone());
                    if !self.modules.contains_key(&whole) {
                        continue;
                    }
                    [&whole, &path[1..]].concat()
                }
            };
            used.extend(self.file(&absolute, 0));
        }
        used
    }

    /// The file in which the item at a path stands.
    fn file(&self, path: &[String], doors: usize) -> Option<usize> {
        assert!(doors < 20, "{path:?} goes through doors for ever");
        let inner = (0..=path.len()).rev().find(|&i| self.modules.contains_key(&path[..i]))?;
        let (module, rest) = path.split_at(inner);
        let here = self.imports.get(module).into_iter().flatten();
        // an item that a module inside of its own file imports stands where it is
        let mut others = here.filter(|import| import.path[..] != path[..path.len().min(inner + 1)]);
        match rest.first().and_then(|name| others.find(|import| import.name == *name)) {
            Some(import) => self.file(&[&import.path, &rest[1..]].concat(), doors + 1),
            None => self.modules.get(module).copied(),
        }
    }
}

impl Code {
    fn new(tokens: &[String], module: &[String], modules: &BTreeMap<Names, usize>) -> Self {
        let mut code = Self::default();
        // the modules inside the file that are open, with the depth of their braces
        let (mut inside, mut depth, mut at) = (Vec::new(), 0, 0);
        while at < tokens.len() {
            let next = |i: usize| tokens.get(at + i).map_or("", String::as_str);
            match next(0) {
                "{" => depth += 1,
                "}" => {
                    depth -= 1;
                    inside.pop_if(|(_, opened)| *opened == depth);
                }
                "mod" if next(2) == "{" => inside.push((next(1).to_owned(), depth)),
                "use" => {
                    let is_door = is_public(&tokens[..at]);
                    let end = tokens[at..].iter().position(|token| token == ";").map_or(tokens.len(), |end| at + end);
                    for (path, name) in tree(&tokens[at + 1..end]) {
                        if let Some(path) = absolute(&path, module, inside.len(), modules) {
                            code.imports.push(Import { name, path, is_door });
                        }
                    }
                    at = end;
                }
                name if is_name(name) && tokens[..at].last().is_none_or(|before| before != "::" && before != "mod") => {
                    let mut path = vec![name.to_owned()];
                    while next(2 * path.len() - 1) == "::" && is_name(next(2 * path.len())) {
                        path.push(next(2 * path.len()).to_owned());
                    }
                    at += 2 * (path.len() - 1);
                    let from_root = if path.len() > 1 { absolute(&path, module, inside.len(), modules) } else { None };
                    code.paths.push(match from_root {
                        // an empty name stands before paths from the root
                        Some(path) if is_anchor(name) => [vec![String::new()], path].concat(),
                        _ => path,
                    });
                }
                _ => {}
            }
            at += 1;
        }
        code
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

fn is_anchor(name: &str) -> bool {
    ["crate", "asperity", "super", "self"].contains(&name)
}

/// Whether tokens end in `pub` or `pub(..)`.
fn is_public(before: &[String]) -> bool {
    let before = match before {
        [rest @ .., open, _, close] if open == "(" && close == ")" => rest,
        all => all,
    };
    before.last().is_some_and(|last| last == "pub")
}

/// A path from the root of the crate, for one that begins at a module of it; `inside` modules of the file are open.
fn absolute(path: &[String], module: &[String], inside: usize, modules: &BTreeMap<Names, usize>) -> Option<Names> {
    let supers = path.iter().take_while(|name| *name == "super").count();
    let base = |levels: usize| module[..module.len() - levels.min(module.len())].to_vec();
    let (base, rest) = match path[0].as_str() {
        "crate" | "asperity" => (Vec::new(), &path[1..]),
        "super" => (base(supers.saturating_sub(inside)), &path[supers..]),
        "self" => (base(0), &path[1..]),
        name if modules.contains_key(&[module, &[name.to_owned()]].concat()) => (base(0), path),
        _ => return None,
    };
    Some([base.as_slice(), rest].concat())
}

/// The paths of a use tree, with the names that they make.
fn tree(tokens: &[String]) -> Vec<(Names, String)> {
    let mut found = Vec::new();
    let mut heads: Vec<Names> = vec![Vec::new()];
    let mut path: Names = Vec::new();
    let mut name = None;
    let mut add = |heads: &[Names], path: &mut Names, name: Option<String>| {
        let mut whole = [heads.concat(), std::mem::take(path)].concat();
        whole.pop_if(|last| last == "self");
        if let Some(last) = whole.last() {
            let name = name.unwrap_or_else(|| last.clone());
            found.push((whole, name));
        }
    };
    let mut tokens = tokens.iter().peekable();
    while let Some(token) = tokens.next() {
        match token.as_str() {
            "{" => heads.push(std::mem::take(&mut path)),
            "," | "}" => {
                if !path.is_empty() {
                    add(&heads, &mut path, name.take());
                }
                if token == "}" {
                    heads.pop();
                }
            }
            "as" => name = tokens.next().cloned(),
            "::" => {}
            other => path.push(other.to_owned()),
        }
    }
    if !path.is_empty() {
        add(&heads, &mut path, name.take());
    }
    found
}

/// Made-up files, as `path: code`.
fn made_up(files: &[(&str, &str)]) -> (Vec<Source>, Vec<String>) {
    let source = |(path, text): &(&str, &str)| Source { path: (*path).to_owned(), text: (*text).to_owned() };
    let sources: Vec<Source> = files.iter().map(source).collect();
    let uses = Uses::new(&sources, false);
    let arrows = uses.of.iter().enumerate().flat_map(|(i, used)| used.iter().map(move |&j| (i, j)));
    let arrows = arrows.map(|(i, j)| format!("{} > {}", uses.files[i], uses.files[j])).collect();
    (sources, arrows)
}

#[test]
fn uses_are_seen_in_every_form() {
    let lib = ("lib.rs", "mod a; mod b; pub use a::A;");
    let a = ("a.rs", "pub struct A;");
    for code in [
        "use crate::a::A;",
        "use crate::A;",
        "use crate::{A};",
        "use crate::{\n    a::{self, A as Alias},\n};",
        "use super::a::A;",
        "fn f() -> crate::a::A {}",
        "fn f(a: &super::A) {}",
        "use crate::a; fn f() -> a::A {}",
        "use crate::a::*;",
        "pub use crate::a::A; struct B(A);",
        "mod inner { use super::super::a::A; }",
        "macro_rules! m { () => { crate::a::A } }",
        "use asperity::{A};",
    ] {
        assert_eq!(made_up(&[lib, a, ("b.rs", code)]).1, ["b.rs > a.rs"], "{code}");
    }
    for code in [
        "pub use crate::a::A;",
        "pub(super) use super::A;",
        "//! [`crate::a::A`]",
        "const A: &str = \"crate::a::A {\";",
        "mod inner { use super::a::A; }",
        "struct A; fn f() -> A {}",
        "pub(super) struct B; pub(crate) fn f() {} pub(in crate::b) fn g() {}",
        "use crate::a;",
        "\n#[cfg(test)]\nmod tests {\n    use crate::A;\n}",
    ] {
        assert!(made_up(&[lib, a, ("b.rs", code)]).1.is_empty(), "{code}");
    }
}

#[test]
fn doors_lead_to_the_file_of_the_item() {
    let lib = ("lib.rs", "mod a; mod b;");
    let room = ("a/mod.rs", "mod x; mod y; pub use x::X; use crate::b; pub struct Own;");
    let arrows =
        |y: &str| made_up(&[lib, room, ("a/x.rs", "pub struct X;"), ("a/y.rs", y), ("b.rs", "pub fn f() {}")]).1;
    assert_eq!(arrows("use super::X;"), ["a/y.rs > a/x.rs"]);
    assert_eq!(arrows("use crate::a::X;"), ["a/y.rs > a/x.rs"]);
    assert_eq!(arrows("use super::Own;"), ["a/y.rs > a/mod.rs"]);
    assert_eq!(arrows("use super::b; fn g() { b::f() }"), ["a/y.rs > b.rs"]);
    assert_eq!(arrows("fn g() { super::b::f() }"), ["a/y.rs > b.rs"]);
}

#[test]
fn circles_are_found() {
    let circles = |files: &[(&str, &str)]| {
        let (sources, _) = made_up(files);
        Uses::new(&sources, false).circles().len()
    };
    let lib = ("lib.rs", "mod a; mod b; mod c;");
    let a = ("a.rs", "use crate::b::B; pub struct A;");
    let b = |code| ("b.rs", code);
    assert_eq!(circles(&[lib, a, b("pub struct B;"), ("c.rs", "use crate::a::A;")]), 0);
    assert_eq!(circles(&[lib, a, b("use crate::a::A; pub struct B;"), ("c.rs", "")]), 1);
    assert_eq!(circles(&[lib, a, b("pub struct B(crate::c::C);"), ("c.rs", "use super::a::A; pub struct C;")]), 1);
    // a room whose child needs what stands in its `mod.rs`, which needs the child
    let room = |door: &'static str| ("a/mod.rs", door);
    let child = ("a/x.rs", "use super::Own; pub struct X;");
    assert_eq!(circles(&[lib, room("mod x; pub use x::X; pub struct Own;"), child]), 0);
    assert_eq!(circles(&[lib, room("mod x; pub use x::X; pub struct Own; fn f(x: X) {}"), child]), 1);
    assert_eq!(circles(&[lib, room("mod x; pub struct Own; fn f(x: x::X) {}"), child]), 1);
}
