//! The content security policy of the page: it loads from where it is and talks to that, and to no other place.

/// The policy without what only a header can say.
macro_rules! policy {
    () => {
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
         img-src 'self' data: blob:; worker-src 'self' blob:; connect-src 'self' blob:; base-uri 'none'; form-action 'none'"
    };
}

/// The policy in the page itself, for servers that say none.
pub(crate) const IN_PAGE: &str = policy!();
/// The policy in the header of every answer.
pub(crate) const IN_HEADER: &str = concat!(policy!(), "; frame-ancestors 'none'");
