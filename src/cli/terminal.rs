//! Output on a terminal, of which no word that comes from elsewhere can take control.

use asperity::seen::plain;
use std::io::{self, Stderr, Stdout, Write};

/// Standard output or standard error, without characters that cannot be seen.
pub(crate) struct Terminal<W>(W);

/// Standard output.
pub(crate) fn stdout() -> Terminal<Stdout> {
    Terminal(io::stdout())
}

/// Standard error.
pub(crate) fn stderr() -> Terminal<Stderr> {
    Terminal(io::stderr())
}

impl<W: Write> Write for Terminal<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write_all(plain(&String::from_utf8_lossy(bytes)).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_escape_sequence_is_written() {
        let mut out = Terminal(Vec::new());
        let (title, clear) = ("\u{1b}]0;title\u{7}", "\u{9b}2J\r");
        writeln!(out, "µ {title} {clear}").unwrap();
        assert_eq!(String::from_utf8(out.0).unwrap(), "µ \u{fffd}]0;title\u{fffd} \u{fffd}2J\u{fffd}\n");
    }
}
