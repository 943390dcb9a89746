// The solver in the browser: a module in Web Workers, which answers as a server does. Nothing that it solves leaves the machine.

/** The report of the session. The first one is of a run that was solved when the site was made, so that there is a picture before the module
 * is loaded; the module then solves it again, for all else that is asked of it. */
let latestNews = { revision: 0, busy: false, run: site?.first.run ?? null, sweep: null, pinned: null, fault: null, known_fault: null };
/** Those who wait for the next report. */
let listeners = [];

/** Takes news. Revisions are counted here, as one module may follow another, which knows no run of before. */
function tell(news) {
  latestNews = { ...latestNews, ...news, run: news.run ?? latestNews.run, revision: latestNews.revision + 1 };
  listeners.splice(0).forEach((done) => done(latestNews));
}

/** What a site has without the module, by paths. */
const WRITTEN = ["start", "observables"];
/** Orders that end what runs. */
const ENDING = ["solve", "sweep", "cancel", "heights"];

/** Orders to solve, and the latest of them that was taken. */
const SOLVING = ["solve", "sweep"];
let latestOrder = null;

/** Milliseconds that an order has to end by itself where it cannot be ended. */
const RESPITE = 300;

/** One module in its worker: the requests that wait for an answer, and the address that is there as long as the latest order is wanted. */
class Engine {
  constructor(begin) {
    this.waiting = new Map();
    this.asked = 0;
    this.worker = new Worker(URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })));
    this.worker.addEventListener("message", ({ data }) => this.heard(data));
    this.worker.addEventListener("error", ({ message }) => this.broke(message));
    this.sign = URL.createObjectURL(new Blob());
    this.isBegun = false;
    this.begun = this.send({ begin, sign: this.sign }).then((it) => { this.isBegun = true; return it; });
  }

  /** Ends what the worker solves, and returns whether it can: a worker that solves hears no message, but sees whether an address is still
   * there. Where the browser does not let it look, as on a page from disk, the order has some time to end by itself. */
  async interrupt() {
    if (!latestNews.busy) return true;
    URL.revokeObjectURL(this.sign);
    this.sign = URL.createObjectURL(new Blob());
    if ((await this.begun).canLook) return true;
    for (let waited = 0; latestNews.busy && waited < RESPITE; waited += 20) await new Promise((done) => setTimeout(done, 20));
    return !latestNews.busy;
  }

  send(message) {
    const number = ++this.asked;
    this.worker.postMessage({ ...message, number });
    return new Promise((done, failed) => this.waiting.set(number, { done, failed }));
  }

  heard({ number, status, answer, news, broken }) {
    if (news) { tell(JSON.parse(news)); return; }
    if (broken) { this.broke(broken); return; }
    const { done, failed } = this.waiting.get(number);
    this.waiting.delete(number);
    if (status === 200) done(answer); else failed(refusal(status, answer));
  }

  /** A module that fails is replaced. One that cannot even begin is beyond this browser. */
  broke(reason) {
    if (this.isBegun) replace(this, reason); else this.end(say("fault.old-browser", { reason }));
  }

  /** The answer to a request: a text, or bytes. */
  async request(method, path, body) {
    await this.begun;
    return this.send({ method, path, body, sign: this.sign });
  }

  /** Ends the worker, and with it what waits. */
  end(sentence) {
    this.worker.terminate();
    for (const { failed } of this.waiting.values()) failed(new Error(sentence));
  }
}

/** The module that solves, and the one for what a hand holds, which is asked while the other one solves. */
let solver = null;
let hand = null;
/** The orders that led to the file of heights of the session, for another module. */
let heightOrders = [];

/** The bytes of the module, packed. A page that is opened from a folder may load scripts alone: there, a script has them. */
async function packedModule() {
  if (location.protocol === "file:") return loadScript("module.js").then(() => blobOf(MODULE));
  const name = "module.packed";
  const isLost = () => { throw new Error(say("fault.script", { name })); };
  const answer = await fetch(name).catch(isLost);
  return answer.ok ? answer.blob().catch(isLost) : isLost();
}

async function compileModule() {
  const packed = await packedModule();
  // what was loaded and cannot be unpacked or compiled is beyond this browser
  try {
    return await WebAssembly.compile(await unpackedBlob(packed).arrayBuffer());
  } catch (error) {
    throw new Error(say("fault.old-browser", { reason: error.message }));
  }
}

/** The module, which is compiled once for all workers.
 * @type {Promise<WebAssembly.Module> | null} */
let compiled = null;
function compile() {
  compiled ??= compileModule();
  return compiled;
}

/** Begins the module that solves, once. */
function loadModule() {
  const begin = (module) => begun(new Engine({ module, after: 0, first: JSON.stringify(site.first.run.knobs) }));
  solver ??= compile().then(begin);
  return solver;
}

async function begun(engine) {
  await engine.begun;
  document.body.dataset.solver = "ready";
  keepOffline();
  return engine;
}

/** One more module, with the file of heights. */
async function made(after) {
  const engine = new Engine({ module: await compile(), after });
  for (const order of heightOrders) await engine.request(...order);
  return engine;
}

/** Begins another module in the place of the one that solves, which has lost the runs of before. */
function renew(engine, sentence) {
  engine.end(sentence);
  session = String(Number(session) + 1);
  solver = made(Math.max(0, ...runs.map(numberOf)));
  const { run } = latestNews;
  const stopped = run && !run.ended ? { ...run, ended: true, numbers: run.numbers && { ...run.numbers, status: "stopped by the observer" } } : run;
  tell({ busy: false, run: stopped });
}

/** Begins another module in the place of one that failed, and says so. */
function replace(engine, reason) {
  const sentence = say("fault.module", { reason });
  solver.then((current) => {
    if (current === engine) renew(engine, sentence);
    else { engine.end(sentence); hand = null; }
    tell({ fault: sentence, known_fault: null });
  });
}

/** The module for what a hand holds. */
function loadHand() {
  hand ??= made(0);
  return hand;
}

async function joinBrowser() {
  session = "1";
  setTimeout(() => loadModule().catch((error) => fault(error.message)));
}

async function askBrowser(path) {
  if (WRITTEN.includes(path)) return site[path];
  if (path === "lessons") return loadScript("lessons.js").then(() => unpacked(LESSONS).json());
  const [place, since] = path.split("?since=");
  if (place === "state") return latestNews.revision > Number(since ?? -1) ? latestNews : new Promise((done) => listeners.push(done));
  if (path === `run/${site.first.run.id}/section` && document.body.dataset.solver !== "ready") return unpacked(FIRST_SECTION).json();
  if (path === `run/${site.first.run.id}/beside` && document.body.dataset.solver !== "ready") return null;
  if (path === "runs") return [];
  if (path === "heights") return null;
  return JSON.parse(await (await loadModule()).request("GET", path));
}

async function postBrowser(path, body) {
  const [name] = path.split("?");
  if (name === "hold") return JSON.parse(await (await loadHand()).request("POST", path, body));
  const engine = await loadModule();
  const before = SOLVING.includes(name) && latestNews.busy ? latestOrder : null;
  if (ENDING.includes(name) && !await engine.interrupt()) renew(engine, say("fault.superseded"));
  const answer = JSON.parse(await order(path, body, before));
  if (SOLVING.includes(name)) latestOrder = [path, body];
  if (name === "heights" || name === "describe") {
    heightOrders = [...(name === "describe" ? heightOrders.slice(0, 1) : []), ["POST", path, body]];
    await hand?.then((other) => other.request("POST", path, body));
  }
  return "revision" in answer ? { revision: latestNews.revision } : answer;
}

/** What the module answers to an order. If it refuses, it begins again with the order that it was carrying out. */
async function order(path, body, before) {
  const engine = await loadModule();
  return engine.request("POST", path, body).catch((error) => {
    if (before && error.status === REFUSED) engine.request("POST", ...before).catch(() => {});
    throw error;
  });
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
