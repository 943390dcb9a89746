//! The sessions of a server: every tab of a browser has its own.

use super::worker;
use crate::explore::{Description, HeightKnobs, Refusal, RefusalRule, SceneFile, Session, Stock};
use crate::formats::HeightFile;
use std::hash::{BuildHasher, RandomState};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The most sessions at the same time, each with a solver thread and recordings of its own.
const MOST: usize = 4;
/// Time without requests after which a new session may replace a session: an open page sends a request every second, the page of a tab that
/// was killed sends none.
const IDLE: Duration = Duration::from_secs(5);

/// The sessions of a server.
#[derive(Default)]
pub struct Sessions {
    /// What every session begins with.
    stock: Stock,
    open: Mutex<Vec<Open>>,
}

/// A session that pages can ask.
struct Open {
    name: String,
    session: Arc<Session>,
    solver: JoinHandle<()>,
    /// When it was last asked; none once its page has said that it leaves.
    asked: Option<Instant>,
}

impl Sessions {
    /// No session yet; all that come begin with a file of heights.
    ///
    /// # Errors
    /// For a file that cannot be read.
    pub fn with_heights(file: HeightFile) -> Result<Self, Refusal> {
        let description = Description::new(&file, HeightKnobs::default())?;
        let stock = Stock { heights: Some((file, description)), ..Stock::default() };
        Ok(Self { stock, open: Mutex::default() })
    }

    /// No session yet; all that come have a scene.
    pub fn with_scene(scene: SceneFile) -> Self {
        let stock = Stock { scene: Some(Arc::new(scene)), ..Stock::default() };
        Self { stock, open: Mutex::default() }
    }

    /// Begins a session, whose runs are numbered on from `after`, and returns its name. If there is no room for it, the
    /// one that was without requests for the longest time ends, if that time is long enough.
    pub(super) fn begin(&self, after: u32) -> Result<String, Refusal> {
        let mut open = self.lock();
        if open.len() >= MOST {
            let longest = (0..open.len()).filter(|&i| open[i].is_idle()).min_by_key(|&i| open[i].asked);
            let all_live = || RefusalRule::ServerFull.with([("most", MOST.to_string())]);
            open.remove(longest.ok_or_else(all_live)?).session.close();
        }
        let name = unguessable();
        let (session, solver) = worker::start(self.stock.clone(), after.into());
        open.push(Open { name: name.clone(), session, solver, asked: Some(Instant::now()) });
        Ok(name)
    }

    /// Whether a session has this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.lock().iter().any(|it| it.name == name)
    }

    /// The session with this name. This counts as a request.
    pub(super) fn session(&self, name: &str) -> Option<Arc<Session>> {
        let mut open = self.lock();
        let found = open.iter_mut().find(|it| it.name == name)?;
        found.asked = Some(Instant::now());
        Some(Arc::clone(&found.session))
    }

    /// Notes that the page of a session leaves: it may make room at once, and lives on if the page comes back before.
    pub(super) fn leave(&self, name: &str) {
        self.lock().iter_mut().filter(|it| it.name == name).for_each(|it| it.asked = None);
    }

    /// Ends all sessions, and waits for their solvers.
    pub fn close(&self) {
        let open = std::mem::take(&mut *self.lock());
        open.iter().for_each(|it| it.session.close());
        for Open { solver, .. } in open {
            solver.join().ok(); // a solver that failed has said so on its page
        }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Open>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Open {
    fn is_idle(&self) -> bool {
        self.asked.is_none_or(|asked| asked.elapsed() >= IDLE)
    }
}

/// A name that cannot be guessed: 128 bits from random keys of the system.
pub(super) fn unguessable() -> String {
    let keys = RandomState::new();
    format!("{:016x}{:016x}", keys.hash_one(0), keys.hash_one(1))
}
