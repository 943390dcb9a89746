"use strict";
// The server, the runs that it tells of, and their numbers.

let posting = false;
let waiting = false;

/** Solves anew; while one request is under way, only the latest change waits. The curves of another surface are greyed at once. */
async function changed() {
  charts();
  writeAddress();
  if (posting) { waiting = true; return; }
  posting = true;
  asked = performance.now();
  do {
    waiting = false;
    const before = faults;
    await post("solve", knobs).then(() => settleFault(before), (error) => fault(error.message));
  } while (waiting);
  posting = false;
}

async function sweep() {
  const before = faults;
  await post("sweep", knobs).then(() => settleFault(before), (error) => fault(error.message));
}

const cancel = () => post("cancel", {}).catch((error) => fault(error.message));

/** How many sentences there were. */
let faults = 0;

/** Takes the sentence off, unless one came since there were so many. */
function settleFault(before) {
  if (faults === before) fault("");
}

function fault(sentence) {
  if (sentence) faults += 1;
  byId("fault").textContent = sentence;
  byId("fault").hidden = !sentence;
}

let report = { revision: 0 };
let asked = 0;

/** Asks for news for as long as the page is open. */
async function listen() {
  for (;;) {
    try {
      const news = await ask(`state?since=${report.revision}`);
      if (news.revision !== report.revision) heard(news);
      if (["gone", "full"].includes(document.body.dataset.server)) fault("");
      document.body.dataset.server = "there";
    } catch (error) {
      if (error.status === ENDED) await beginAgain();
      else { miss(error); await pause(); }
    }
  }
}

/** Begins a session in the place of one that the server no longer has, and solves in it what is seen: what is pinned first. Earlier runs stay
 * as far as the viewer has them. */
async function beginAgain() {
  const kept = pinned && runOf(pinned);
  await beginSession(Math.max(0, ...runs.map(numberOf)));
  runs.filter((run) => !run.ended || !run.followed).forEach(forget);
  runs = runs.filter((run) => run.ended && run.followed);
  Object.assign(report, { revision: 0, busy: false, pinned: null });
  listRuns();
  fault("");
  carryOut({ knobs, pinned: kept && !isSweep(kept) ? kept.knobs : null }).catch((error) => fault(error.message));
}

/** Takes the news; a sweep of an earlier session stays until there is another. */
function heard(news) {
  report = { ...news, sweep: news.sweep || report.sweep };
  if (news.fault) fault(news.fault);
  if (news.run) heardRun(news.run);
  showHeights();
  if (news.sweep) heardSweep(news.sweep);
  showPin(news.pinned);
  byId("cancel").disabled = !news.busy;
  offerSaves();
  charts();
  wake();
  document.body.dataset.revision = news.revision;
  document.body.dataset.busy = news.busy;
}

/** How many runs the viewer keeps. */
const KEEP = 6;
let runs = [];

/** A sweep stands among the runs, with loads for steps; one that is older than the latest run was there before the page. */
function heardSweep(sweep) {
  if (runOf(sweep.id) || !(report.run && numberOf(report.run) > numberOf(sweep))) heardRun(sweep);
}

const numberOf = (run) => Number(run.id.split("-")[1]);

function heardRun(run) {
  const known = runOf(run.id);
  if (known) Object.assign(known, run);
  else {
    runs.push(Object.assign(run, { session }));
    moment = null;
    byId("title").textContent = run.title;
    follow(run);
    while (runs.length > KEEP) forget(runs.splice(runs.findIndex((old) => old.id !== pinned), 1)[0]);
    listRuns();
  }
  numbers();
}

/** Takes the runs of before this page was opened, as far as they can still be read. */
function remember(earlier) {
  runs = earlier.map((run) => Object.assign(run, { session }));
  listRuns();
  runs.slice(-1).forEach(follow);
}

/** The least time between two runs that the viewer gets, in milliseconds: of those in between only the last counts. */
const BREATH = { line: 120, surface: 400 };
let followed = 0;
let next = null;

/** Lets the viewer read a run as it grows. */
function follow(run) {
  shownRun = run.id;
  visited = null;
  clearTimeout(next);
  if (!viewer) return;
  next = setTimeout(() => {
    followed = performance.now();
    stopPlaying();
    run.followed = true;
    viewer.add_receiver(recordingAddress(run));
    wake();
    byId("scrub").value = 1000;
    byId("scrub-step").value = say("play.latest");
    watchFirst(run, asked);
  }, Math.max(0, followed + BREATH[run.knobs.domain] - performance.now()));
}

/** Notes how long after the change of a control the viewer had the first steps of its run. */
function watchFirst(run, since) {
  const range = viewer && viewer.get_timeline_time_range(run.id, timeline(run));
  if (range) {
    document.body.dataset.shown = `${run.id} ${Math.round(performance.now() - since)} ms`;
    wake();
    byId("viewer-note").hidden = true;
  } else if (shownRun === run.id) requestAnimationFrame(() => watchFirst(run, since));
}

function forget(run) {
  if (viewer && run.followed) viewer.remove_receiver(recordingAddress(run));
}

function listRuns() {
  const options = [...runs].reverse().map((run, i) => element("option", { value: run.id }, `${"ABCDEF"[i]}: ${run.id}, ${run.title}`));
  byId("runs").replaceChildren(...options);
  byId("runs").title = say("runs.tip", { count: KEEP });
}

let shownRun = null;
/** The run that others are compared with, instead of the one before. */
let pinned = null;

const runOf = (id) => runs.find((run) => run.id === id);
const isSweep = (run) => "points" in run;
const timeline = (run) => isSweep(run) ? "load" : "step";
const latest = () => runs.findLast((run) => !isSweep(run));

/** What a run is compared with. */
function rival(run) {
  return pinned && pinned !== run.id ? runOf(pinned) : runs.slice(0, runs.indexOf(run)).findLast((other) => !isSweep(other));
}

/** What the viewer shows, or will show: a run or a sweep. */
const current = () => runOf(shownRun) || runs.at(-1);

/** The run that is shown; behind a sweep the latest one. */
function shownOrLatest() {
  const shown = runOf(shownRun);
  return shown && !isSweep(shown) ? shown : latest();
}

/** Switches between the latest run and what it is compared with. */
function swap() {
  const shown = runOf(shownRun) || latest();
  const other = shown && shown === latest() ? rival(shown) : latest();
  if (other) showRun(other.id);
}

/** Keeps the run that is shown to compare with, its curves beside those of the next ones, or lets it go. */
function pin() {
  const shown = shownOrLatest();
  setPin(pinned || !shown ? null : shown.id);
}

async function setPin(id) {
  if (id !== pinned) await post("pin", id).then(() => fault(""), (error) => fault(error.message));
}

function showPin(id) {
  if (pinned === id) return;
  pinned = runOf(id) ? id : null;
  byId("pin").setAttribute("aria-pressed", String(pinned !== null));
  byId("pin").textContent = pinned ? say("pin.pinned", { run: pinned }) : say("pin");
  writeAddress();
  numbers();
}

/** Presses the surface of the pinned run, or of the one before, beside this one with the same mean pressure, or takes it away. */
function putBeside() {
  const run = shownOrLatest();
  const other = run && rival(run);
  if (!knobs.beside && !other) { fault(say("beside.none")); return; }
  if (knobs.beside) delete knobs.beside; else knobs.beside = besideOf(other.knobs);
  changed();
}

const besideOf = ({ beside: _, ...its }) => its;

function showRun(id) {
  stopPlaying();
  moment = null;
  visited = null;
  shownRun = id;
  byId("runs").value = id;
  const run = runOf(id);
  clearTimeout(next);
  if (viewer && run.followed) { viewer.set_active_recording_id(id); watchFirst(run, performance.now()); }
  else follow(run);
  numbers();
  offerSaves();
  wake();
}

function figure(value, digits = 5) {
  if (value === null || value === undefined) return "–";
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return size < 1e-3 || size >= 1e6 ? value.toExponential(Math.max(0, digits - 3)) : String(Number(value.toPrecision(digits)));
}

/** The observables that the server knows, and those that are shown: those that change step by step, and these. */
let known = [];
let observables = [];
const SHOWN = ["kappa_r_error", "iterations", "transforms", "seconds"];
/** The exact values that stand beside resolved observables. */
const EXACT = { relative_area_resolved: "relative_area", kappa_r_resolved: "kappa_r" };
const SECONDS = { name: "seconds" };

/** The words of a status, which the server tells in English. */
const statusOf = ({ numbers }) => say(`status.${(numbers ? numbers.status : "begun").replaceAll(" ", "-")}`);

function titleSweep({ title, ended, points }) {
  const places = { title, count: points.length };
  byId("title").textContent = ended ? say("title.sweep.ended", places) : say("title.sweep.running", places);
}

function titleRun(run) {
  const places = { title: run.title, status: statusOf(run), exact: run.exact?.name };
  byId("title").textContent = run.exact ? say("title.run.exact", places) : say("title.run", places);
}

/** A state that the table shows in the place of the end of the run: a name and its numbers. */
let moment = null;

function setMoment(state) {
  moment = state;
  numbers();
}

function numbers() {
  const shown = runOf(shownRun);
  if (shown && isSweep(shown)) titleSweep(shown);
  const run = shownOrLatest();
  if (!run) return;
  const before = rival(run);
  const cell = (text, name) => element("td", { "data-number": name }, text);
  const body = observables.map(({ name }) => {
    const values = [moment || run, run.beside || before].map((it) => figure(it?.numbers?.[name]));
    const theory = run.exact && EXACT[name] ? figure(run.exact[EXACT[name]]) : "";
    return element("tr", { title: say(`number.${name}.tip`) }, element("th", { scope: "row" }, say(`number.${name}`)), cell(values[0], name), cell(values[1], ""), cell(theory, `exact ${name}`));
  });
  byId("numbers").tBodies[0].replaceChildren(...body);
  const status = run.numbers ? run.numbers.status : "begun";
  if (!shown || shown === run) titleRun(run);
  byId("this").textContent = moment ? moment.name : say("numbers.this");
  byId("rival").textContent = run.beside ? named(say("numbers.beside"), run.beside.numbers ?? {}) : pinned ? say("numbers.pinned") : say("numbers.before");
  byId("beside").setAttribute("aria-pressed", String(Boolean(knobs.beside)));
  showSectionOf(run);
  warn(run);
  judge(run);
  Object.assign(document.body.dataset, { run: run.id, status, ended: run.ended });
}
