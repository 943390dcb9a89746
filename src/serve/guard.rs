//! Access control: only pages of this server may send requests.

use axum::http::header::{CONTENT_LENGTH, CONTENT_TYPE, HOST, HeaderName, ORIGIN};
use axum::http::{HeaderMap, Method};

/// Names under which the loopback interface is known.
const HOSTS: [&str; 2] = ["127.0.0.1", "localhost"];

/// Status and sentence with which a request is refused; none if it may pass. What is posted is of a kind that no page of others may send
/// without asking first, such as JSON.
pub(crate) fn refuse(method: &Method, headers: &HeaderMap, port: u16, kind: &str) -> Option<(u16, String)> {
    let is_own = |host: &str| HOSTS.iter().any(|own| host == format!("{own}:{port}"));
    let text = |name: &HeaderName| headers.get(name).map(|value| value.to_str().unwrap_or("?"));
    if headers.get_all(HOST).iter().count() != 1 || !text(&HOST).is_some_and(is_own) {
        return Some((403, format!("this server accepts requests to http://127.0.0.1:{port} only")));
    }
    if text(&ORIGIN).is_some_and(|origin| !origin.strip_prefix("http://").is_some_and(is_own)) {
        return Some((403, "other pages may not use this server".into()));
    }
    // a page on another port is of the same site, but not of this server
    let is_own_page = |site: &str| matches!(site, "same-origin" | "none");
    if text(&HeaderName::from_static("sec-fetch-site")).is_some_and(|site| !is_own_page(site)) {
        return Some((403, "other pages may not use this server".into()));
    }
    if method == Method::POST && text(&CONTENT_TYPE) != Some(kind) {
        return Some((415, format!("send it with the content type {kind}")));
    }
    (method != Method::GET && method != Method::POST).then(|| (405, "only GET and POST requests are accepted".into()))
}

/// Bytes that the body is said to have; none if nothing is said.
pub(crate) fn announced(headers: &HeaderMap) -> u64 {
    headers.get(CONTENT_LENGTH).and_then(|length| length.to_str().ok()?.parse().ok()).unwrap_or(0)
}
