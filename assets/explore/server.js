// The server, in which every tab has a session of its own.

/** How long another page may take to let go of a session before this one takes another, in milliseconds: a page that is left for its
 * successor in the same tab takes a moment, a tab that this one was duplicated from never does. */
const PARTING = 1000;
/** Time between two tries to reach a server that has no room, or is not there. */
const BREAK = 1000;
/** Status of an answer for a session that has ended, and for an invalid order. */
const ENDED = 410;
const REFUSED = 400;

/** The JSON of an answer; a refusal is an error with the sentence of the page, and the status. */
async function answered(request) {
  const answer = await request.catch(() => { throw new Error(say("fault.server")); });
  if (!answer.ok) throw refusal(answer.status, await answer.text());
  return answer.json();
}

/** A refusal of the session as an error. */
const refusal = (status, answer) => Object.assign(new Error(refusalInWords(refusalFrom(answer))), { status });

/** The refusal in an answer, which is JSON unless something else than the session has answered. */
function refusalFrom(answer) {
  try {
    return JSON.parse(answer);
  } catch {
    return { sentence: answer };
  }
}

const sent = (body, type = "application/json") => ({ method: "POST", headers: { "Content-Type": type }, body });
/** The path of the session of this tab, or of an earlier one. */
const below = (path, name = session) => `session/${name}/${path}`;

const askServer = (path) => answered(fetch(below(`api/${path}`)));
const postServer = (path, body, type) => answered(fetch(below(`api/${path}`), sent(body, type)));

/** Takes the session that this tab had before, if there is one that no other tab has, or a new one. */
async function joinServer() {
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
