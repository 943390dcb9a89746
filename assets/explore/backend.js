// The way to the solver: what the page asks, what it orders, and where recordings are. A server solves, or the module in the browser, which
// has the same answers.

/** What a site of files has in the place of a server: the state to start with, a first run, and which runs have recordings. None where there
 * is a server. */
const site = typeof SITE === "object" ? SITE : null;
/** The largest grids that the solver takes. */
const MOST = site ? LIMITS.module : LIMITS.program;

/** The name of the session of this tab. A solver that begins again has another one, and has lost the runs of before. */
let session = null;

/** The JSON at a path of the session. */
const ask = async (path) => site ? askBrowser(path) : askServer(path);

/** What the session answers to an order. */
const post = async (path, body) => site ? postBrowser(path, JSON.stringify(body)) : postServer(path, JSON.stringify(body));

/** What the session answers to a file. */
const postFile = async (path, file) => site ? postBrowser(path, await file.arrayBuffer()) : postServer(path, file, "application/octet-stream");

/** Begins to work with the session that this tab has. */
const joinSession = async () => site ? joinBrowser() : joinServer();

/** The address of a file beside the page. */
const nextTo = (path) => new URL(path, document.baseURI).href;

/** Loads a script beside the page. A page that is opened from a folder may load nothing else. */
function loadScript(name) {
  return new Promise((done, failed) => {
    const script = element("script", { src: name });
    script.addEventListener("load", done);
    script.addEventListener("error", () => failed(new Error(say("fault.script", { name }))));
    document.head.append(script);
  });
}

/** The name of the recording of a run or a sweep; none without one. */
const recordingName = (run) => site ? recordedBeforehand(run)?.id ?? null : run.id;

/** The address of the recording of a run, from which the viewer reads as it grows. */
const recordingAddress = (run) => nextTo(site ? `run/${recordingName(run)}.rrd` : below(`run/${run.id}.rrd`, run.session));

/** Whether the session still has what belongs to a run. */
const isKept = (run) => run.session === session;

/** Which solver runs, in the words of the page. */
function nameSolver() {
  const kind = site ? "browser" : "server";
  byId("solver").textContent = say(`solver.${kind}`);
  byId("solver").title = say(`solver.${kind}.tip`, { line: MOST.line, side: MOST.side });
}
