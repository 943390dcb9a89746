// The one way to the server: what the page asks, what it orders, and where recordings are. Every tab has a session of its own there.

/** The name of the session of this tab, below which all of its paths lie. */
let session = null;
/** How long another page may take to let go of a session before this one takes another, in milliseconds: a page that is left for its
 * successor in the same tab takes a moment, a tab that this one was duplicated from never does. */
const PARTING = 1000;
/** Time between two tries to reach a server that has no room, or is not there. */
const BREAK = 1000;
/** Status of an answer for a session that has ended, and for an invalid order. */
const ENDED = 410;
const REFUSED = 400;

/** The JSON of an answer; a refusal is an error with the sentence of the server, and the status. */
async function answered(request) {
  const answer = await request.catch(() => { throw new Error(say("fault.server")); });
  if (!answer.ok) throw Object.assign(new Error(translated(await answer.text())), { status: answer.status });
  return answer.json();
}

const sent = (body, type = "application/json") => ({ method: "POST", headers: { "Content-Type": type }, body });
const below = (path, name = session) => solved ? path : `session/${name}/${path}`;

/** The reply of the session at a path. */
const ask = async (path) => solved ? answerBeforehand(path) : answered(fetch(below(`api/${path}`)));

/** What the session answers to an order. */
const post = async (path, body) => solved ? orderBeforehand(path, body) : answered(fetch(below(`api/${path}`), sent(JSON.stringify(body))));

/** What the session answers to a file. */
const postFile = async (path, file) => solved ? orderBeforehand(path) : answered(fetch(below(`api/${path}`), sent(file, "application/octet-stream")));

/** The address of a file beside the page. */
const nextTo = (path) => new URL(path, document.baseURI).href;

/** The address of the recording of a run, from which the viewer reads as it grows. */
const recordingAddress = (run) => nextTo(below(`run/${run.id}.rrd`, run.session));

/** The address under which something of a run is saved, by its ending. */
const savingAddress = (run, ending) => nextTo(below(`${solved ? "run" : "save"}/${run.id}.${ending}`, run.session));

/** Whether there still is what belongs to a run: a server lost the runs of sessions before, a course page keeps all. */
const isKept = (run) => Boolean(solved) || run.session === session;

/** Takes the session that this tab had before, if there is one that no other tab has, or a new one. */
async function joinSession() {
  if (solved) return;
  window.addEventListener("pagehide", () => { fetch(below("api/leave"), { ...sent("{}"), keepalive: true }); });
  session = sessionStorage.getItem("session");
  const isMine = session !== null && await holdSession(session) && await ask("state").then(() => true, () => false);
  if (!isMine) await beginSession(0);
}

/** Begins a session, as soon as the server has room for it, whose runs are numbered on from a number. */
async function beginSession(after) {
  for (;;) {
    try {
      ({ session } = await answered(fetch("api/session", sent(String(after)))));
      sessionStorage.setItem("session", session);
      holdSession(session);
      return;
    } catch (error) {
      miss(error);
      await pause();
    }
  }
}

const pause = () => new Promise((done) => setTimeout(done, BREAK));

/** Says why the server does not answer. */
function miss(error) {
  document.body.dataset.server = error.status ? "full" : "gone";
  fault(error.message);
  numbers();
}

/** Holds the name of a session for as long as this page is open; false if another page does not let go of it. */
function holdSession(name) {
  return new Promise((told) => {
    const taken = () => { told(true); return new Promise(() => {}); };
    navigator.locks.request(`session ${name}`, { signal: AbortSignal.timeout(PARTING) }, taken).catch(() => told(false));
  });
}
