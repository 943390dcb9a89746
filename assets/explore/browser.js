// The solver in the browser: a module in Web Workers, which answers as a server does. Nothing that it solves leaves the machine.

/** The report of the session. The first one is of a run that was solved when the site was made, so that there is a picture before the module
 * is loaded; the module then solves it again, for all else that is asked of it. */
let latestNews = { revision: 0, busy: false, run: site?.first.run ?? null, sweep: null, pinned: null, fault: null, known_fault: null };
/** Those who wait for the next report. */
let listeners = [];

function tell(news) {
  latestNews = { ...latestNews, ...news };
  listeners.splice(0).forEach((done) => done(latestNews));
}

/** What a site has without the module, by paths. */
const WRITTEN = { start: "start", lessons: "lessons", observables: "observables" };
/** Orders that end what runs. */
const ENDING = ["solve", "sweep", "cancel", "heights"];

/** One module in its worker: the requests that wait for an answer, and the address that is there as long as the latest order is wanted. */
class Engine {
  constructor(begin) {
    this.waiting = new Map();
    this.asked = 0;
    this.worker = new Worker(URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })));
    this.worker.addEventListener("message", ({ data }) => this.heard(data));
    this.sign = URL.createObjectURL(new Blob());
    this.compiled = this.send({ begin, sign: this.sign });
  }

  /** Ends what the worker solves. A worker that solves hears no message, but sees whether an address is still there. */
  interrupt() {
    URL.revokeObjectURL(this.sign);
    this.sign = URL.createObjectURL(new Blob());
  }

  send(message) {
    const number = ++this.asked;
    this.worker.postMessage({ ...message, number });
    return new Promise((done, failed) => this.waiting.set(number, { done, failed }));
  }

  heard({ number, status, answer, news, broken }) {
    if (news) { tell(JSON.parse(news)); return; }
    if (broken) { restart(broken); return; }
    const { done, failed } = this.waiting.get(number);
    this.waiting.delete(number);
    if (status === 200) done(answer); else failed(refusal(status, answer));
  }

  /** The answer to a request: a text, or bytes. An order ends the one before it. */
  async request(method, path, body) {
    await this.compiled;
    if (ENDING.includes(path.split("?")[0])) this.interrupt();
    return this.send({ method, path, body, sign: this.sign });
  }
}

/** The module that solves, and the one for what a hand holds, which is asked while the other one solves. */
let solver = null;
let hand = null;
/** The orders that led to the file of heights of the session, for another module. */
let heightOrders = [];

/** Loads the module, once. */
function loadModule() {
  solver ??= loadScript("module.js").then(() => {
    document.body.dataset.solver = "loading";
    return begun(new Engine({ compressed: MODULE, after: 0, first: JSON.stringify(site.first.run.knobs) }));
  });
  return solver;
}

async function begun(engine) {
  await engine.compiled;
  document.body.dataset.solver = "ready";
  keepOffline();
  return engine;
}

/** Begins another module in the place of one that broke. It has lost the runs of before. */
function restart(reason) {
  const compiled = solver.then((engine) => { engine.worker.terminate(); return engine.compiled; });
  session = String(Number(session) + 1);
  hand = null;
  const after = Math.max(0, ...runs.map(numberOf));
  solver = compiled.then((module) => begun(new Engine({ module, after })));
  solver.then((engine) => Promise.all(heightOrders.map((order) => engine.request(...order))));
  tell({ busy: false, fault: say("fault.module", { reason }), revision: latestNews.revision + 1 });
}

/** The module for what a hand holds. */
function loadHand() {
  hand ??= loadModule().then(async (engine) => {
    const made = new Engine({ module: await engine.compiled, after: 0 });
    for (const order of heightOrders) await made.request(...order);
    return made;
  });
  return hand;
}

async function joinBrowser() {
  session = "1";
  setTimeout(() => loadModule().catch((error) => fault(error.message)));
}

async function askBrowser(path) {
  if (WRITTEN[path]) return site[WRITTEN[path]];
  const [place, since] = path.split("?since=");
  if (place === "state") return latestNews.revision > Number(since ?? -1) ? latestNews : new Promise((done) => listeners.push(done));
  if (path === `run/${site.first.run.id}/section` && document.body.dataset.solver !== "ready") return site.first.section;
  if (path === `run/${site.first.run.id}/beside` && document.body.dataset.solver !== "ready") return null;
  if (path === "runs") return [];
  if (path === "heights") return null;
  return JSON.parse(await (await loadModule()).request("GET", path));
}

async function postBrowser(path, body) {
  const engine = await (path === "hold" ? loadHand() : loadModule());
  const answer = JSON.parse(await engine.request("POST", path, body));
  const isFile = path.startsWith("heights");
  if (isFile || path === "describe") {
    heightOrders = [...(isFile ? [] : heightOrders.slice(0, 1)), ["POST", path, body]];
    await hand?.then((other) => other.request("POST", path, body));
  }
  return answer;
}

/** The arrays of a run as a file. */
const arraysOf = async (run) => (await loadModule()).request("GET", `save/${run.id}.npz`);

const withoutLoad = ({ load, ...state }) => words(state);

/** The recording that was made beforehand of the state of a run or a sweep, on the ground that the page has. */
function recordedBeforehand(run) {
  const { theme } = document.documentElement.dataset;
  const its = isSweep(run) ? withoutLoad : words;
  return site.recorded.find(({ is_sweep: sweeps, knobs: state }) => sweeps === isSweep(run) && state.theme === theme && its(state) === its(run.knobs));
}

/** Has the browser keep the files of the site for when there is no network. A page that is opened from a folder needs no network. */
function keepOffline() {
  if (location.protocol !== "file:") navigator.serviceWorker?.register("offline.js").catch((error) => console.warn(error));
}
