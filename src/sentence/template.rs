//! Templates of sentences, as [`format!`] has them.

/// A part of a template.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum TemplatePiece {
    /// Words that are the same for all values.
    Words(&'static str),
    /// The place of a value: its name, and how it is shown, such as `?` or `.3e`, which may be empty.
    Place { name: &'static str, format: &'static str },
}

/// The parts of a template in their order. Two braces stand for one.
pub(super) fn pieces(template: &'static str) -> impl Iterator<Item = TemplatePiece> {
    let mut rest = template;
    std::iter::from_fn(move || {
        let brace = rest.find(['{', '}']);
        let is_double = |at: usize| rest[at + 1..].starts_with(&rest[at..=at]);
        match brace {
            _ if rest.is_empty() => None,
            Some(at) if is_double(at) => Some(TemplatePiece::Words(taken(&mut rest, at + 1, 1))),
            Some(0) => {
                let inside = &rest[1..rest.find('}').unwrap_or(rest.len())];
                rest = rest.get(inside.len() + 2..).unwrap_or_default();
                let (name, format) = inside.split_once(':').unwrap_or((inside, ""));
                Some(TemplatePiece::Place { name, format })
            }
            _ => {
                let words = brace.unwrap_or(rest.len());
                Some(TemplatePiece::Words(taken(&mut rest, words, 0)))
            }
        }
    })
}

/// Takes words from the begin of the rest, and leaves out what follows them.
fn taken(rest: &mut &'static str, words: usize, left_out: usize) -> &'static str {
    let taken = &rest[..words];
    *rest = &rest[words + left_out..];
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_is_words_and_places() {
        let found: Vec<TemplatePiece> = pieces("the {name} of {value:.3e}, {{x}}").collect();
        let expected = [
            TemplatePiece::Words("the "),
            TemplatePiece::Place { name: "name", format: "" },
            TemplatePiece::Words(" of "),
            TemplatePiece::Place { name: "value", format: ".3e" },
            TemplatePiece::Words(", {"),
            TemplatePiece::Words("x}"),
        ];
        assert_eq!(found, expected);
        assert_eq!(pieces("").count(), 0);
    }
}
