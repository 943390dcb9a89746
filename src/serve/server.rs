//! The server: loopback only, for its own pages only, with bounded requests.

use super::guard;
use super::patience::PatientStream;
use super::policy::IN_HEADER;
use super::server_key::ServerKey;
use super::site::{Intake, Reply, Site};
use crate::explore::{RefusalRule, Request};
use axum::Router;
use axum::body::{Body, HttpBody, to_bytes};
use axum::extract::{Request as Incoming, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_DISPOSITION, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderValue, LOCATION, REFERRER_POLICY,
    SET_COOKIE, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{Method, Response, StatusCode};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::future::poll_fn;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Requests answered at the same time; further ones wait.
const THREADS: usize = 32;
/// Connections at the same time; further ones are closed at once. A page has six.
const CONNECTIONS: usize = 512;
/// Number of ports that are tried after the given one.
const FURTHER_PORTS: u16 = 32;
/// Longest time that the head of a request, and its body, may take.
const PATIENCE: Duration = Duration::from_secs(10);
/// Longest time in which the other end of a connection takes nothing of an answer: a page in the background reads on.
const UNREAD: Duration = Duration::from_secs(60);
/// Time until a connection is accepted again after one could not be.
const PAUSE: Duration = Duration::from_millis(50);
/// Longest time that open connections go on at the end.
const FAREWELL: Duration = Duration::from_millis(500);

/// A port of the loopback interface, taken, and the key to what is served there.
pub struct Server {
    listener: TcpListener,
    port: u16,
    key: ServerKey,
}

impl Server {
    /// Takes `port`, or the next one that is free; 0 takes any.
    ///
    /// # Errors
    /// If none of them is free.
    pub fn bind(port: u16) -> io::Result<Self> {
        let bind = |port| TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
        let mut bound = bind(port);
        for next in (port..).skip(1).take(FURTHER_PORTS.into()) {
            match &bound {
                Err(error) if error.kind() == io::ErrorKind::AddrInUse => bound = bind(next),
                _ => break,
            }
        }
        let listener = bound?;
        listener.set_nonblocking(true)?;
        let port = listener.local_addr()?.port();
        Ok(Self { listener, port, key: ServerKey::for_login() })
    }

    /// The port.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// Where the page is, with the key.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?{}", self.port, self.key.query())
    }

    /// Where the page is, for a browser that is started with this address: it leads there once, since other users of the machine can read the
    /// command lines of programs.
    pub fn address_for_once(&self) -> String {
        let query = self.key.query_for_once().unwrap_or_default();
        format!("http://127.0.0.1:{}/?{query}", self.port)
    }

    /// Serves `site` until the process is interrupted or asked to end.
    ///
    /// # Errors
    /// If the system does not let it.
    pub fn run(self, site: impl Site) -> io::Result<()> {
        let threads = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .max_blocking_threads(THREADS)
            .enable_all()
            .build()?;
        let served = threads.block_on(self.serve(site));
        threads.shutdown_timeout(FAREWELL);
        served
    }

    async fn serve(self, site: impl Site) -> io::Result<()> {
        let listener = tokio::net::TcpListener::from_std(self.listener)?;
        let served = Served { site, port: self.port, key: self.key, taken: Arc::default() };
        let router = Router::new().fallback(answer).with_state(Arc::new(served));
        tokio::select! {
            served = accept(listener, router) => served,
            interrupted = tokio::signal::ctrl_c() => interrupted,
            ended = termination() => ended,
        }
    }
}

/// Answers the requests of all connections. One whose next request is not there to the end of its head in time is closed, as is one whose
/// answer is not read.
async fn accept(listener: tokio::net::TcpListener, router: Router) -> io::Result<()> {
    let open = Arc::new(());
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(PAUSE).await; // too many open files, for example: connections that end make room
            continue;
        };
        if Arc::strong_count(&open) > CONNECTIONS {
            continue; // the connection is closed, as nothing holds it
        }
        let one_of_them = Arc::clone(&open);
        let service = TowerToHyperService::new(router.clone());
        let mut http = http1::Builder::new();
        http.timer(TokioTimer::new()).header_read_timeout(PATIENCE);
        tokio::spawn(async move {
            let _until_the_end = one_of_them;
            http.serve_connection(TokioIo::new(PatientStream::new(stream, UNREAD)), service).await.ok(); // a connection that breaks concerns nobody else
        });
    }
}

/// Waits until the system asks the process to end.
#[cfg(unix)]
async fn termination() -> io::Result<()> {
    use tokio::signal::unix::{SignalKind, signal};
    signal(SignalKind::terminate())?.recv().await;
    Ok(())
}

/// Waits for ever: other systems know nothing but an interrupt.
#[cfg(not(unix))]
async fn termination() -> io::Result<()> {
    std::future::pending().await
}

/// The right to send a body beyond those of orders, which one request has at a time, so that requests cannot fill the
/// memory.
struct Delivery(Arc<AtomicBool>);

impl Delivery {
    /// The right, if no other request has it.
    fn begin(taken: &Arc<AtomicBool>) -> Option<Self> {
        (!taken.swap(true, Ordering::AcqRel)).then(|| Self(Arc::clone(taken)))
    }
}

impl Drop for Delivery {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

/// What a server serves, and under which port.
struct Served<S> {
    site: S,
    port: u16,
    key: ServerKey,
    /// Whether a request has the right of [`Delivery`].
    taken: Arc<AtomicBool>,
}

async fn answer<S: Site>(State(served): State<Arc<Served<S>>>, request: Incoming) -> Response<Body> {
    let (head, body) = request.into_parts();
    let Intake { kind, most } =
        if head.method == Method::POST { served.site.intake(head.uri.path()) } else { Intake::JSON };
    if let Some((status, sentence)) = guard::refuse(&head.method, &head.headers, served.port, kind) {
        return response(Reply::Error(status, sentence.into()));
    }
    if !served.site.is_secret(head.uri.path()) && !served.key.is_in(&head.headers, served.port) {
        return match served.key.entrance(&head.uri) {
            Some(address) => entered(&address, &served.key.cookie(served.port)),
            None => response(Reply::Error(403, NO_KEY.into())),
        };
    }
    if guard::announced(&head.headers) > most as u64 {
        return response(too_large(most));
    }
    let delivery = (most > Intake::JSON.most).then(|| Delivery::begin(&served.taken));
    if let Some(None) = delivery {
        tokio::time::timeout(PATIENCE, pass(body, most)).await.ok();
        return response(Reply::Error(503, RefusalRule::OtherFileComes.into()));
    }
    let body = match tokio::time::timeout(PATIENCE, to_bytes(body, most)).await {
        Ok(Ok(body)) => body,
        Ok(Err(_)) => return response(too_large(most)),
        Err(_) => return response(Reply::Error(408, RefusalRule::RequestTooLate.into())),
    };
    let reply = move || {
        let _until_the_end = delivery;
        let (path, query) = (head.uri.path(), head.uri.query().unwrap_or_default());
        served.site.reply(&Request { method: head.method.as_str(), path, query, body: &body })
    };
    let replied = tokio::task::spawn_blocking(reply).await;
    response(replied.unwrap_or_else(|_| Reply::Error(500, RefusalRule::NoAnswer.into())))
}

/// The sentence with which a request without the key is refused.
const NO_KEY: &str = "other users of this machine may not use this server: open the address that asperity printed when it began, with its key";

/// Sends a browser that has the key on to the page, with a cookie.
fn entered(address: &str, cookie: &str) -> Response<Body> {
    let mut response = response(Reply::Page("text/plain", "go on to the page".into()));
    *response.status_mut() = StatusCode::SEE_OTHER;
    for (name, value) in [(LOCATION, address), (SET_COOKIE, cookie)] {
        if let Ok(value) = value.parse() {
            response.headers_mut().insert(name, value);
        }
    }
    response
}

/// Reads and discards at most `most` bytes of a body: a sender who is refused before everything is sent would see a
/// broken connection instead of the answer.
async fn pass(mut body: Body, most: usize) {
    let mut left = most;
    while let Some(Ok(frame)) = poll_fn(|context| Pin::new(&mut body).poll_frame(context)).await {
        match left.checked_sub(frame.data_ref().map_or(0, |data| data.len())) {
            Some(rest) => left = rest,
            None => return,
        }
    }
}

fn too_large(most: usize) -> Reply {
    Reply::Error(413, RefusalRule::RequestTooLarge.with([("most", most.to_string())]))
}

fn response(reply: Reply) -> Response<Body> {
    let (status, kind, cache, name, body) = match reply {
        Reply::Page(kind, body) => (200, kind, "no-store", None, Body::from(body)),
        Reply::Fixed(kind, body) => (200, kind, "max-age=86400", None, Body::from(body)),
        Reply::Download(name, body) => (200, "application/octet-stream", "no-store", Some(name), Body::from(body)),
        Reply::Recording(source, name) => (200, "application/octet-stream", "no-store", name, source.body()),
        Reply::Error(status, refusal) => (status, "application/json", "no-store", None, Body::from(refusal.to_json())),
    };
    let mut response = Response::new(body);
    *response.status_mut() = StatusCode::from_u16(status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
    let headers = response.headers_mut();
    headers.insert(CONTENT_TYPE, HeaderValue::from_static(kind));
    headers.insert(CACHE_CONTROL, HeaderValue::from_static(cache));
    headers.insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(IN_HEADER));
    headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
    headers.insert("cross-origin-resource-policy", HeaderValue::from_static("same-origin"));
    headers.insert(REFERRER_POLICY, HeaderValue::from_static("no-referrer"));
    let save = name.and_then(|name| format!("attachment; filename=\"{name}\"").parse().ok());
    save.map(|value| headers.insert(CONTENT_DISPOSITION, value));
    response
}
