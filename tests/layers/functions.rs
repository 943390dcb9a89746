//! Functions: short ones, whose arguments have names.

use crate::source::{Source, tokens, without_texts};

const LONGEST_FUNCTION: usize = 70;

/// The most parts of a tuple in the type of an argument; more of them are a struct without names.
const MOST_PARTS: usize = 2;

/// Files whose functions still take larger tuples.
const WITH_TUPLES: &[&str] = &["contact/outcome.rs"];

/// A function: its name, the tokens of its parameters, and its lines from `fn` to the closing brace, or those of its head if it has no body.
struct Function {
    name: String,
    parameters: Vec<String>,
    lines: usize,
}

/// All functions of a file, in the order of their names; functions inside of others are listed as well.
fn functions(code: &str) -> Vec<Function> {
    let bare = without_texts(code);
    let by_line = bare.lines().enumerate();
    let tokens: Vec<(usize, String)> =
        by_line.flat_map(|(line, text)| tokens(text).into_iter().map(move |token| (line, token))).collect();
    let words: Vec<&str> = tokens.iter().map(|(_, token)| token.as_str()).collect();
    let is_function = |i: &usize| {
        words[*i] == "fn"
            && words.get(i + 1).is_some_and(|next| next.starts_with(|c: char| c.is_alphabetic() || c == '_'))
    };
    let found = (0..words.len()).filter(is_function).map(|at| {
        let open = after_generics(&words, at + 2);
        let close = closing(&words, open);
        let start =
            (close + 1..words.len()).find(|&i| ["{", ";"].contains(&words[i]) && is_level(&words[close + 1..i]));
        let start = start.expect("a function has a body or ends in a semicolon");
        let end = if words[start] == "{" { closing(&words, start) } else { start };
        Function {
            name: words[at + 1].into(),
            parameters: tokens[open + 1..close].iter().map(|(_, token)| token.clone()).collect(),
            lines: tokens[end].0 - tokens[at].0 + 1,
        }
    });
    found.collect()
}

/// Where the parameters open: behind the generics, if any begin at `at`.
fn after_generics(words: &[&str], at: usize) -> usize {
    let mut depth = 0;
    (at..words.len())
        .find(|&i| {
            depth += step(words, i);
            depth == i32::from(words[i] == "(")
        })
        .map(|i| if words[i] == "(" { i } else { i + 1 })
        .expect("a function has parameters")
}

/// By how much a token changes the depth of brackets of all kinds. The `>` of an arrow closes none.
fn step(words: &[&str], i: usize) -> i32 {
    match words[i] {
        "(" | "[" | "{" | "<" => 1,
        ">" if i > 0 && ["-", "="].contains(&words[i - 1]) => 0,
        ")" | "]" | "}" | ">" => -1,
        _ => 0,
    }
}

/// Where the bracket closes that opens at `open`. Comparisons in bodies are no brackets.
fn closing(words: &[&str], open: usize) -> usize {
    let pair = if words[open] == "(" { ["(", ")"] } else { ["{", "}"] };
    let mut depth = 0;
    let is_end = |i: &usize| {
        depth += i32::from(words[*i] == pair[0]) - i32::from(words[*i] == pair[1]);
        depth == 0
    };
    (open..words.len()).find(is_end).expect("brackets are closed")
}

/// Whether all round and square brackets of some tokens are closed.
fn is_level(words: &[&str]) -> bool {
    let count = |mark: &str| words.iter().filter(|word| **word == mark).count();
    count("(") == count(")") && count("[") == count("]")
}

/// The largest number of parts of a tuple that a function takes, however deep in the type of an argument. The arguments of closures are no
/// tuples, nor is what they return.
fn largest_tuple(parameters: &[String]) -> usize {
    let words: Vec<&str> = parameters.iter().map(String::as_str).collect();
    let (mut depth, mut in_type, mut most) = (0, false, 0);
    for (i, word) in words.iter().enumerate() {
        let is_returned = i > 1 && words[i - 2..i] == ["-", ">"];
        let is_called = i > 0 && ["Fn", "FnMut", "FnOnce", "fn"].contains(&words[i - 1]);
        if in_type && *word == "(" && !is_returned && !is_called {
            most = most.max(parts(&words[i + 1..closing(&words, i)]));
        }
        depth += step(&words, i);
        match *word {
            "," if depth == 0 => in_type = false,
            name if depth == 0 && name.ends_with(':') && name != "::" => in_type = true,
            _ => {}
        }
    }
    most
}

/// The number of parts between the commas of a tuple.
fn parts(words: &[&str]) -> usize {
    let mut depth = 0;
    let mut commas = 0;
    for (i, word) in words.iter().enumerate() {
        depth += step(words, i);
        commas += usize::from(depth == 0 && *word == "," && i + 1 < words.len());
    }
    commas + usize::from(!words.is_empty())
}

#[test]
fn functions_are_short() {
    let mut found = Vec::new();
    for source in Source::all().into_iter().chain(Source::python()) {
        let long = functions(&source.text).into_iter().filter(|function| function.lines > LONGEST_FUNCTION);
        found.extend(long.map(|function| format!("{}: `{}` has {} lines", source.path, function.name, function.lines)));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A list in order that is taken apart where it arrives is a struct whose parts have no names. The Python package is left out: there, tuples
/// are what Python calls tuples.
#[test]
fn functions_take_structs_and_no_large_tuples() {
    let mut found = Vec::new();
    for source in Source::all() {
        let functions = functions(&source.text);
        let large = functions.iter().filter(|function| largest_tuple(&function.parameters) > MOST_PARTS);
        found.extend(large.map(|function| (source.path.clone(), function.name.clone())));
    }
    for path in WITH_TUPLES {
        assert!(
            found.iter().any(|(file, _)| file == path),
            "{path} has no large tuples any more: take it off the list"
        );
    }
    found.retain(|(path, _)| !WITH_TUPLES.contains(&path.as_str()));
    assert!(found.is_empty(), "give these parameters a struct: {found:?}");
}

#[test]
fn tuples_are_counted_in_the_types_of_arguments_alone() {
    let largest = |code: &str| functions(code).iter().map(|it| largest_tuple(&it.parameters)).collect::<Vec<_>>();
    assert_eq!(largest("fn f((a, b, c): (A, B, C)) {}"), [3]);
    assert_eq!(largest("fn f<T: Fn(A, B) -> C>(a: &[(A, Vec<(B, C, D, E)>)], t: T) {}"), [4]);
    assert_eq!(largest("pub fn f<'a, const N: usize>(\n    &self,\n    a: (A, [u8; 3],),\n) -> (A, B, C);"), [2]);
    assert_eq!(largest("fn f(a: impl Fn(A, B, C) -> (A, B, C), Wrapped(b, c, d): Wrapped) {}"), [0]);
    assert_eq!(largest("fn f(a: crate::A, b: HashMap<A, (B, HashMap<C, D>)>) { g((a, b, c)) }"), [2]);
    assert_eq!(largest("type F = fn(A, B, C); fn f(a: F) { if a < b { \"fn g((\" } } fn g() {}"), [0, 0]);
}

#[test]
fn lines_of_functions_are_counted() {
    let lines = |code: &str| functions(code).iter().map(|it| it.lines).collect::<Vec<_>>();
    assert_eq!(lines("fn f() {}\n\nfn g(\n    a: A,\n) -> [u8; 2] {\n    \"{\n    \"; // {\n    '{';\n}\n"), [1, 7]);
    assert_eq!(lines("trait T {\n    fn f(&self)\n    where\n        A: B;\n}\n"), [3]);
}
