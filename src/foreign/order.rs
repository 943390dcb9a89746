//! The natural order of file names.

use std::path::Path;

/// A piece of a name: a whole number, or what stands between numbers.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Piece {
    /// A whole number, without leading zeros: fewer digits make a smaller one.
    Number(usize, String),
    /// Anything else.
    Text(String),
}

/// The pieces of a name, by which `step2` comes before `step10`.
pub(crate) fn natural(path: &Path) -> Vec<Piece> {
    let name = path.to_string_lossy();
    let mut pieces = Vec::new();
    let mut rest: &str = &name;
    while let Some(first) = rest.chars().next() {
        let is_number = first.is_ascii_digit();
        let end = rest.find(|c: char| c.is_ascii_digit() != is_number).unwrap_or(rest.len());
        let (piece, after) = rest.split_at(end);
        let digits = piece.trim_start_matches('0');
        pieces.push(if is_number { Piece::Number(digits.len(), digits.into()) } else { Piece::Text(piece.into()) });
        rest = after;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers() {
        let mut names =
            ["b/step10.npy", "b/step2.npy", "a/step30.npy", "b/step002b.npy", "b/step.npy", "b/step1e99.npy"];
        names.sort_by_key(|name| natural(Path::new(name)));
        let expected =
            ["a/step30.npy", "b/step1e99.npy", "b/step2.npy", "b/step002b.npy", "b/step10.npy", "b/step.npy"];
        assert_eq!(names, expected);
    }
}
