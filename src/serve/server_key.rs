//! The key of a server: a port of this machine is open to all of its users, and the key is known to the one who started the program.

use super::sessions::unguessable;
use axum::http::header::COOKIE;
use axum::http::{HeaderMap, Uri};
use std::fmt::{self, Debug, Formatter};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Its name in an address.
const NAME: &str = "key";
/// Digits of a key.
const DIGITS: usize = 32;
/// The file of a login's key, in the folder that the system makes for each login, which nobody else can read.
const FILE: &str = "asperity-key";

/// The key: it stands in the address that is printed. The first request with it gets a cookie, which all others have. Addresses that people share
/// do not have it.
pub struct ServerKey(String);

impl ServerKey {
    /// The key of this login, so that open pages go on when the program is started again; a new one where the system has no folder for it.
    pub fn of_login() -> Self {
        let folder = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from);
        folder.filter(|folder| folder.is_dir()).map_or_else(|| Self(unguessable()), |folder| Self::kept_in(&folder))
    }

    /// The key in a folder, or a new one that is kept there.
    fn kept_in(folder: &Path) -> Self {
        let path = folder.join(FILE);
        let is_key = |text: &String| text.len() == DIGITS && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        let kept = || std::fs::read_to_string(&path).ok().filter(is_key).map(Self);
        kept().unwrap_or_else(|| {
            let key = Self(unguessable());
            // what is there is no key; a program that begins at the same time may be faster, and its key is then that of both
            std::fs::remove_file(&path).ok();
            if key.keep(folder, &path).is_ok() { key } else { kept().unwrap_or(key) }
        })
    }

    /// Writes it into a new file, which its owner alone can read.
    fn keep(&self, folder: &Path, path: &Path) -> io::Result<()> {
        let mut file = tempfile::NamedTempFile::new_in(folder)?;
        file.write_all(self.0.as_bytes())?;
        file.persist_noclobber(path)?;
        Ok(())
    }

    /// The query of the address with the key.
    pub fn query(&self) -> String {
        format!("{NAME}={}", self.0)
    }

    /// The cookie with the key. Cookies do not tell ports apart, so that its name does.
    pub fn cookie(&self, port: u16) -> String {
        format!("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name(port), self.0)
    }

    /// Whether a request has the cookie.
    pub fn is_in(&self, headers: &HeaderMap, port: u16) -> bool {
        let (name, lines) = (cookie_name(port), headers.get_all(COOKIE));
        let cookies = lines.iter().filter_map(|line| line.to_str().ok()).flat_map(|line| line.split(';'));
        let mut named = cookies.filter_map(|cookie| cookie.trim().split_once('='));
        named.any(|(found, value)| found == name && self.is(value))
    }

    /// The address of the page without the key, for a request of the page that has it.
    pub fn entrance(&self, uri: &Uri) -> Option<String> {
        let (mut keys, others): (Vec<&str>, Vec<&str>) =
            uri.query()?.split('&').partition(|pair| pair.starts_with(&format!("{NAME}=")));
        let has_key = keys.pop().is_some_and(|pair| self.is(&pair[NAME.len() + 1..]));
        let query = if others.is_empty() { String::new() } else { format!("?{}", others.join("&")) };
        (has_key && uri.path() == "/").then(|| format!("/{query}"))
    }

    /// Whether a word is the key. The time that it takes does not tell how much of it is right.
    fn is(&self, word: &str) -> bool {
        let difference = self.0.bytes().zip(word.bytes()).fold(0, |all, (right, found)| all | (right ^ found));
        word.len() == self.0.len() && difference == 0
    }
}

impl Debug for ServerKey {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("ServerKey")
    }
}

fn cookie_name(port: u16) -> String {
    format!("asperity-{port}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_login_keeps_its_key_where_nobody_else_can_read_it() {
        let folder = tempfile::tempdir().unwrap();
        let first = ServerKey::kept_in(folder.path());
        assert!(first.is(&ServerKey::kept_in(folder.path()).0) && first.0.len() == DIGITS);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = std::fs::metadata(folder.path().join(FILE)).unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600);
        }
        std::fs::write(folder.path().join(FILE), "no key").unwrap();
        assert!(!first.is(&ServerKey::kept_in(folder.path()).0));
    }

    #[test]
    fn an_address_with_the_key_leads_to_the_page_and_to_nothing_else() {
        let key = ServerKey("0123456789abcdef0123456789abcdef".into());
        let to = |uri: &str| key.entrance(&uri.parse().unwrap());
        let query = key.query();
        assert_eq!(to(&format!("/?{query}")), Some("/".into()));
        assert_eq!(to(&format!("/?a=1&{query}&b=2")), Some("/?a=1&b=2".into()));
        assert_eq!(to(&format!("//example.com/?{query}")), None);
        assert_eq!(to(&format!("/api/state?{query}")), None);
        for wrong in ["/", "/?key=", "/?key=0", &format!("/?{query}0"), &format!("/?{}", &query[..query.len() - 1])] {
            assert_eq!(to(wrong), None, "{wrong}");
        }
    }
}
