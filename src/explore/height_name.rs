//! The name of a file that a page sends.

use crate::seen::is_seen;

/// Largest number of characters of a name.
const LONGEST: usize = 100;
/// The name of a file that has none.
const NAMELESS: &str = "heights";

/// The name in the query of a request, without folders, characters that cannot be seen, and what is beyond a hundred letters.
pub(crate) fn plain_name(encoded: &str) -> String {
    let name = decoded(encoded);
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let name: String = last.chars().filter(|letter| is_seen(*letter)).take(LONGEST).collect();
    let name = name.trim().trim_start_matches('-');
    if name.chars().all(|c| c == '.') { NAMELESS.into() } else { name.into() }
}

/// A text whose bytes may be written as `%` and two hexadecimal digits.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        let byte = digits
            .filter(|it| !it.starts_with('+'))
            .and_then(|digits| u8::from_str_radix(digits, 16).ok())
            .filter(|_| first == b'%');
        bytes.push(byte.unwrap_or(first));
        rest = if byte.is_some() { &after[2..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain() {
        let long = "%41".repeat(300);
        for (encoded, name) in [
            ("sample.sdf", "sample.sdf"),
            ("gro%C3%9Fe%20Probe.txt", "gro\u{df}e Probe.txt"),
            ("..%2F..%2Fetc%2Fpasswd", "passwd"),
            ("C%3A%5Cdata%5Ca.plu", "a.plu"),
            ("a%00b%0Ac%E2%80%AEtxt", "abctxt"),
            ("%", "%"),
            ("%4", "%4"),
            ("%+4", "%+4"),
            ("%zz%41", "%zzA"),
            ("--out.txt", "out.txt"),
            ("", "heights"),
            ("..", "heights"),
            ("a%2F", "heights"),
            (&long, &"A".repeat(100)),
        ] {
            assert_eq!(plain_name(encoded), name, "{encoded}");
        }
        assert_eq!(plain_name("%ff.txt"), "\u{fffd}.txt");
    }
}
