//! The key of a server: a port of this machine is open to all of its users, and the key is known to the one who started the program.

use super::sessions::unguessable;
use axum::http::header::COOKIE;
use axum::http::{HeaderMap, Uri};
use std::fmt::{self, Debug, Formatter};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Its name in an address.
const NAME: &str = "key";
/// Hexadecimal digits of a key: 128 bits, which nobody can try one after the other.
const KEY_DIGITS: usize = 32;
/// The file of a login's key, in the folder that the system makes for each login, which nobody else can read.
const FILE: &str = "asperity-key";

/// The key of a server. It stands in the address that is printed. The first request with it gets a cookie, which all others have. Addresses that
/// people share do not have it.
pub(crate) struct ServerKey {
    key: String,
    /// A second key, which is good for one request. The address that a browser is started with has it: all users can read the command lines of
    /// all processes, and this one is worth nothing once the browser has been there.
    ticket: Mutex<Option<String>>,
}

impl ServerKey {
    /// The key of this login, so that open pages go on when the program is started again; a new one where the system has no folder for it.
    pub(crate) fn for_login() -> Self {
        let folder = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from);
        let key = folder.filter(|folder| folder.is_dir()).map_or_else(unguessable, |folder| key_in(&folder));
        Self { key, ticket: Mutex::new(Some(unguessable())) }
    }

    /// The query of the address with the key.
    pub(crate) fn query(&self) -> String {
        format!("{NAME}={}", self.key)
    }

    /// The query of an address that leads to the page once; none if it has been used.
    pub(crate) fn query_for_once(&self) -> Option<String> {
        self.ticket().as_ref().map(|ticket| format!("{NAME}={ticket}"))
    }

    /// The cookie with the key. Browsers send a cookie to all ports of a machine, so its name has the port: servers side by side keep theirs.
    pub(crate) fn cookie(&self, port: u16) -> String {
        format!("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name(port), self.key)
    }

    /// Whether a request has the cookie.
    pub(crate) fn is_in(&self, headers: &HeaderMap, port: u16) -> bool {
        let (name, lines) = (cookie_name(port), headers.get_all(COOKIE));
        let cookies = lines.iter().filter_map(|line| line.to_str().ok()).flat_map(|line| line.split(';'));
        let mut named = cookies.filter_map(|cookie| cookie.trim().split_once('='));
        named.any(|(found, value)| found == name && is_same(value, &self.key))
    }

    /// The address of the page without the key, for a request of the page that has it. A key for one request is then used up.
    pub(crate) fn entrance(&self, uri: &Uri) -> Option<String> {
        if uri.path() != "/" {
            return None;
        }
        let is_key = |pair: &&str| pair.strip_prefix(NAME).is_some_and(|rest| rest.starts_with('='));
        let (keys, others): (Vec<&str>, Vec<&str>) = uri.query()?.split('&').partition(is_key);
        let given = &keys.last()?[NAME.len() + 1..];
        if !is_same(given, &self.key) && !self.takes_ticket(given) {
            return None;
        }
        Some(if others.is_empty() { "/".into() } else { format!("/?{}", others.join("&")) })
    }

    /// Whether a word is the key for one request, which it is no more afterwards.
    fn takes_ticket(&self, word: &str) -> bool {
        let mut ticket = self.ticket();
        let is_it = ticket.as_ref().is_some_and(|ticket| is_same(word, ticket));
        if is_it {
            *ticket = None;
        }
        is_it
    }

    fn ticket(&self) -> MutexGuard<'_, Option<String>> {
        self.ticket.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The key that is kept in a folder, or a new one that is kept there from now on.
fn key_in(folder: &Path) -> String {
    let path = folder.join(FILE);
    let is_key = |text: &String| text.len() == KEY_DIGITS && text.bytes().all(|digit| digit.is_ascii_hexdigit());
    let kept = || std::fs::read_to_string(&path).ok().filter(is_key);
    if let Some(key) = kept() {
        return key;
    }
    let key = unguessable();
    // What is there is no key. A program that begins at the same time may be faster: its key is then that of both.
    std::fs::remove_file(&path).ok();
    if keep(&key, folder, &path).is_ok() { key } else { kept().unwrap_or(key) }
}

/// Writes a key into a new file, which its owner alone can read.
fn keep(key: &str, folder: &Path, path: &Path) -> io::Result<()> {
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(key.as_bytes())?;
    file.persist_noclobber(path)?;
    Ok(())
}

/// Whether a word is a key. The time that it takes does not tell how much of it is right.
fn is_same(word: &str, key: &str) -> bool {
    let difference = key.bytes().zip(word.bytes()).fold(0, |all, (right, found)| all | (right ^ found));
    word.len() == key.len() && difference == 0
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

    fn with_key(key: &str) -> ServerKey {
        ServerKey { key: key.into(), ticket: Mutex::new(Some("fedcba9876543210fedcba9876543210".into())) }
    }

    #[test]
    fn a_login_keeps_its_key_where_nobody_else_can_read_it() {
        let folder = tempfile::tempdir().unwrap();
        let first = key_in(folder.path());
        assert!(first == key_in(folder.path()) && first.len() == KEY_DIGITS);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = std::fs::metadata(folder.path().join(FILE)).unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600);
        }
        std::fs::write(folder.path().join(FILE), "no key").unwrap();
        assert_ne!(first, key_in(folder.path()));
    }

    #[test]
    fn an_address_with_the_key_leads_to_the_page_and_to_nothing_else() {
        let key = with_key("0123456789abcdef0123456789abcdef");
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

    #[test]
    fn the_address_that_a_browser_is_started_with_leads_to_the_page_once() {
        let key = with_key("0123456789abcdef0123456789abcdef");
        let uri: Uri = format!("/?{}", key.query_for_once().unwrap()).parse().unwrap();
        assert!(!uri.to_string().contains(&key.key));
        assert_eq!(key.entrance(&uri), Some("/".into()));
        assert_eq!(key.entrance(&uri), None);
        assert_eq!(key.query_for_once(), None);
    }
}
