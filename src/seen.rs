//! Text that can be shown anywhere, also on a terminal.

use std::borrow::Cow;

/// Whether a character can be seen and leaves the order of others as it is.
///
/// ```
/// use asperity::seen::is_seen;
/// assert!(is_seen('µ') && !is_seen('\u{1b}') && !is_seen('\u{202e}'));
/// ```
pub fn is_seen(letter: char) -> bool {
    !letter.is_control()
        && !matches!(letter, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

/// A text with `\u{fffd}` for all characters that cannot be seen, such as those of an escape sequence, but for ends of lines and tabs. Titles,
/// channels and names of files come from elsewhere, and a terminal would obey them.
///
/// ```
/// assert_eq!(asperity::seen::plain("a\u{1b}[31mb\n"), "a\u{fffd}[31mb\n");
/// ```
pub fn plain(text: &str) -> Cow<'_, str> {
    let stays = |letter: char| is_seen(letter) || matches!(letter, '\n' | '\t');
    match text.chars().all(stays) {
        true => text.into(),
        false => text.chars().map(|it| if stays(it) { it } else { char::REPLACEMENT_CHARACTER }).collect(),
    }
}

/// A sentence that begins with a capital letter, unless it begins with a symbol such as `kappa_r`.
///
/// ```
/// assert_eq!(asperity::seen::capital("no artefacts were found"), "No artefacts were found");
/// assert_eq!(asperity::seen::capital("kappa_r is unknown"), "kappa_r is unknown");
/// ```
pub fn capital(sentence: &str) -> String {
    if sentence.split(' ').next().is_some_and(|word| word.contains('_')) {
        return sentence.to_owned();
    }
    let mut letters = sentence.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
