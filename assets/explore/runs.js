// The orders of the page, the runs that come of them, and their numbers.

let posting = false;
let waiting = false;
/** How many orders there were, and the knobs of the last one that was sent. */
let orders = 0;
let ordered = "";

/** The answer to the last order that was sent. */
let lastAnswer = Promise.resolve();

/** Sends an order once the one before is answered: on its own way it could come first, and be undone by that. */
function postInTurn(path, body) {
  const sending = lastAnswer.then(() => post(path, body));
  lastAnswer = sending.catch(() => {});
  return sending;
}

/** Solves anew; while one request is under way, only the latest change waits. What is shown is greyed at once, and a hand lets go. */
async function changed() {
  if (isAsked()) setAside();
  grip = null;
  orders += 1;
  charts();
  writeAddress();
  keepState();
  if (posting) { waiting = true; markState(); return; }
  posting = true;
  markState();
  asked = performance.now();
  do {
    waiting = false;
    const before = faults;
    ordered = words(knobs);
    await postInTurn("solve", knobs).then(() => settleFault(before), refused);
  } while (waiting);
  posting = false;
  followOrder();
  markState();
}

/** Puts the knobs to those of the last order, if that is what is shown: the state to which they were put since then is gone. */
function followOrder() {
  const run = shownOrLatest();
  if (run && !moment && !posting && !grip && !isOfKnobs() && words(run.knobs) === ordered) takeState(run.knobs);
}

/** Says why an order was refused, unless a newer one waits. */
function refused(error) {
  fault(error.status === REFUSED && faultOfKnobs(knobs) || error.message);
  if (error.status === REFUSED && !waiting) putBack();
}

/** Sweeps the load, once the state of the knobs is solved, so that it is the one that is shown. */
async function sweep() {
  repainted = null;
  if (isAsked()) setAside();
  if (isSolved()) orders += 1; else changed();
  const [mine, before] = [orders, faults];
  while (orders === mine && faults === before && !isSolved()) await new Promise((done) => setTimeout(done, 20));
  if (orders === mine && isSolved()) await postInTurn("sweep", knobs).then(() => settleFault(before), (error) => fault(error.message));
}

function cancel() {
  orders += 1;
  postInTurn("cancel", {}).catch((error) => fault(error.message));
}

/** How many sentences there were. */
let faults = 0;

/** Removes the sentence, unless a newer one has come. */
function settleFault(before) {
  if (faults === before) fault("");
}

function fault(sentence) {
  if (sentence) faults += 1;
  byId("fault").textContent = sentence;
  byId("fault").hidden = !sentence;
}

/** @type {any} */
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

/** The sweep that is drawn while it is solved again for other colours; none at other times. */
let repainted = null;

/** Whether a sweep that is solved again for other colours has as many loads as the one that is drawn, or has ended. */
const hasCaughtUp = (sweep) => Boolean(sweep && repainted && sweep.id !== repainted.id && (sweep.ended || sweep.points.length >= repainted.points.length));

/** Takes the news; a sweep of an earlier session stays until there is another, and one that is solved again until that has caught up. */
function heard(news) {
  if (news.fault || hasCaughtUp(news.sweep)) repainted = null;
  report = { ...news, sweep: repainted || news.sweep || report.sweep };
  if (news.fault) fault(inWordsOfPage(news));
  if (news.run) heardRun(news.run);
  if (news.fault && !posting) putBack();
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

/** A fault in the words of the page, where it has some, or else in those of the server. */
function inWordsOfPage({ fault: sentence, known_fault: known }) {
  return refusalInWords({ ...known, sentence });
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
  if (run.ended && !isSweep(run)) keepSeen(run.knobs, run.numbers);
  const known = runOf(run.id);
  if (known) Object.assign(known, { section: undefined }, run); else keepRun(run);
  numbers();
}

/** Takes a run that begins, and shows it. One that goes on no more, and whose end was not heard, is not kept. */
function keepRun(run) {
  runs.filter((before) => !before.ended).forEach(dropRun);
  const isShown = takesOver(run);
  runs.push(Object.assign(run, { session }));
  if (isShown) {
    moment = null;
    if (!isSweep(run)) stateRun = run.id;
    follow(run);
    followOrder();
  }
  const isFree = ({ id }) => ![pinned, stateRun, shownRun].includes(id);
  if (runs.length > KEEP) dropRun(runs.find(isFree));
  listRuns();
}

/** Drops a run from the list. */
function dropRun(run) {
  runs = runs.filter((other) => other !== run);
  forget(run);
}

/** Takes the runs of before this page was opened, as far as they can still be read. */
function remember(earlier) {
  runs = earlier.map((run) => Object.assign(run, { session }));
  stateRun = latest()?.id ?? null;
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
  stopPlaying();
  byId("scrub").value = 1000;
  byId("scrub-step").value = say("play.latest");
  if (!viewer || !offerRecording(run)) return;
  next = setTimeout(() => {
    followed = performance.now();
    run.followed = true;
    if (rangeOf(run)) viewer.set_active_recording_id(recordingName(run)); else viewer.add_receiver(recordingAddress(run));
    wake();
    watchFirst(run, asked);
  }, Math.max(0, followed + BREATH[run.knobs.domain] - performance.now()));
}

/** Notes how long after the change of a control the viewer had the first steps of its run. */
function watchFirst(run, since) {
  if (isInViewer(run) && rangeOf(run)) {
    document.body.dataset.shown = `${run.id} ${Math.round(performance.now() - since)} ms`;
    wake();
    byId("viewer-note").hidden = true;
  } else if (shownRun === run.id) requestAnimationFrame(() => watchFirst(run, since));
}

function forget(run) {
  const isShared = runs.some((other) => other !== run && other.followed && recordingName(other) === recordingName(run));
  if (started && run.followed && !isShared) started.remove_receiver(recordingAddress(run));
}

function listRuns() {
  const options = [...runs].reverse().map((run, i) => element("option", { value: run.id }, `${"ABCDEF"[i]}: ${runName(run.id)} · ${titleOf(run)}${methodOf(run)}`));
  byId("runs").replaceChildren(...options);
  byId("runs").title = say("runs.tip", { count: KEEP });
}

/** Whether a run has several states, or slides, which have methods of their own. */
const isOfStates = (run) => Boolean(run.process) || run.knobs.speed > 0;

/** The method of a run at the end of its title; none of a sweep, and where there is no choice. */
const methodOf = (run) => isSweep(run) || isOfStates(run) ? "" : `, ${solverOf(run)}`;

/** The name of a run or a sweep for people. */
const runName = (id) => say(`run.${id.split("-")[0]}`, { number: numberOf({ id }) });

let shownRun = null;
/** The run that others are compared with, instead of the one before. */
let pinned = null;

const runOf = (id) => runs.find((run) => run.id === id);
const isSweep = (run) => "points" in run;
const timeline = (run) => isSweep(run) ? "load" : "step";
const latest = () => runs.findLast((run) => !isSweep(run));

/** What a run is compared with. */
const rival = (run) => pinned && pinned !== run.id ? runOf(pinned) : runBefore(run);

/** The last run before another one that was not stopped, as those are through which a slider went. */
const runBefore = (run) => runs.slice(0, runs.indexOf(run)).findLast((other) => !isSweep(other) && other.numbers?.status !== "stopped by the observer");

/** What the table has beside the state that is shown: the run that is pinned, or else the one before; before a contact under the hand, and one that
 * is asked about, the run that is shown at other times is the one before. */
function besideInTable(run) {
  const isOfRun = !moment || moment.step !== undefined || moment.sweep;
  return pinned ? runOf(pinned) : isOfRun ? runBefore(run) : run;
}

/** What the viewer shows, or will show: a run or a sweep. */
const current = () => runOf(shownRun) || runs.at(-1);

/** Whether the run that is shown is of the knobs, and has ended. */
function isSolved() {
  const run = shownOrLatest();
  return Boolean(run?.ended && words(run.knobs) === words(knobs));
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
  if (!pinned && !shown?.ended) { fault(say("why.early")); return; }
  setPin(pinned ? null : shown.id);
}

async function setPin(id) {
  if (id !== pinned) await post("pin", id).then(() => fault(""), (error) => fault(error.message));
}

function showPin(id) {
  if (pinned === id) return;
  pinned = runOf(id) ? id : null;
  byId("pin").setAttribute("aria-pressed", String(pinned !== null));
  byId("pin").textContent = pinned ? say("pin.pinned", { run: runName(pinned) }) : say("pin");
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

/** Shows a run with its knobs, or the load of a sweep that is nearest to that of the knobs. */
function showRun(id) {
  if (isHidden()) { byId("runs").value = shownRun; return; }
  showInViewer(id);
  const run = runOf(id);
  if (isSweep(run)) { momentOfLoad(run, nearestLoad(run, knobs.load)); return; }
  stateRun = id;
  goToState(null);
}

/** Has the viewer show a run or a sweep. */
function showInViewer(id) {
  stopPlaying();
  visited = null;
  shownRun = id;
  byId("runs").value = id;
  const run = runOf(id);
  clearTimeout(next);
  if (viewer && run.followed) { viewer.set_active_recording_id(recordingName(run)); watchFirst(run, performance.now()); }
  else follow(run);
  offerSaves();
  wake();
}

function figure(value, digits = 5) {
  if (value === null || value === undefined) return "–";
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return inLocale(size < 1e-3 || size >= 1e6 ? Number(value.toPrecision(Math.min(3, digits))).toExponential() : String(Number(value.toPrecision(digits))));
}

/** Units of lengths in metres, the longest first.
 * @type {[string, number][]} */
const LENGTHS = [["m", 1], ["mm", 1e-3], ["µm", 1e-6], ["nm", 1e-9]];

/** A length in metres with the unit that makes it a number of one to three digits before its mark. */
function lengthOf(metres, digits = 3) {
  const [unit, size] = LENGTHS.find(([, size]) => Math.abs(metres) >= 0.9995 * size) ?? LENGTHS[metres ? 3 : 0];
  return `${figure(Number((metres / size).toPrecision(digits)), digits)} ${unit}`;
}

/** All quantities that the server knows, and the numbers of a contact that stand in the table: those that the table of quantities says, and two that no
 * state knows. */
let known = [];
let observables = [];
const SECONDS = { name: "seconds", page: "solving" };
const CONDUCTANCE = { name: "conductance" };

/** The text of a status, which the server reports in English; of surfaces that were pulled apart, whether they hold, and of a process that goes on,
 * how far it is.
 * @param {any} run */
function statusOf(run) {
  const { numbers, process } = run;
  const status = (numbers ? numbers.status : "begun").replaceAll(" ", "-");
  if (status === "converged" && isPulledOff(run)) return say(hasLetGo(run, numbers) ? "status.parted" : "status.holds");
  const of = status === "running" && numbers[OF_STATES[process?.kind]];
  return Number.isFinite(of) ? say("status.running.at", { at: say(`moment.${OF_STATES[process.kind]}`, { value: figure(of, 3) }) }) : say(`status.${status}`);
}

/** The process of which the steps of a run are states; none of a single contact.
 * @param {any} run */
const processOf = (run) => run?.process?.kind ?? null;

/** Whether surfaces that attract each other are apart: nothing carries a load, so that the state has no mean gap of its own. */
const isParted = (told) => told?.mean_attraction === 0 && told.relative_area === 0;
/** Whether the surfaces of a run that pulls them apart have let go of each other: at a gap they still attract each other a little. */
const hasLetGo = (run, told) => isAtGaps(run.knobs) ? told.relative_area === 0 : isParted(told);
const LOST_BY_PARTING = ["mean_gap", "mean_gap_over_rms_height"];

/** The row of a state in the columns of a run. */
const rowOf = (columns, at) => Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, values[at]]));

/** The lowest mean pressure that the surfaces of a run held before they parted, from its columns; none where they hold. */
function pullOffIn(run, columns) {
  const states = columns.step.map((_, at) => rowOf(columns, at));
  return hasLetGo(run, states.at(-1)) ? Math.min(...states.filter((told) => !isParted(told)).map((told) => told.mean_pressure)) : null;
}

/** Whether the server has gone before a run or a sweep has ended. */
const isLost = ({ ended }) => !ended && document.body.dataset.server === "gone";

/** The title of a run in the language of the page: for a surface of the page, the server reports an English title. */
function titleOf({ title }) {
  const [, surface, rest] = /^([^,]*)(.*)$/.exec(title);
  const name = slug(surface);
  const words = rest.split(", ").map((part) => knows(`title.${slug(part)}`) ? say(`title.${slug(part)}`) : inLocale(part)).join(", ");
  return `${knows(`surface.${name}`) ? say(`surface.${name}`) : surface}${words}`;
}

/** The name of an exact solution, such as "cylinder, periodic". */
const exactOf = ({ name }) => name.split(", ").map((part) => knows(`exact.${slug(part)}`) ? say(`exact.${slug(part)}`) : part).join(", ");

/** What a mean gap over the height of the surface can be by rounding alone; it is shown as zero. */
const ROUNDING = 1e-12;

const withoutRounding = (gap) => Math.abs(gap) < ROUNDING ? 0 : gap;

/** A number of a state, without rounding where there is nothing else; none of those that surfaces lose when they part. */
const cleared = (told, name) => isParted(told) && LOST_BY_PARTING.includes(name) ? null : name === "mean_gap_over_rms_height" ? withoutRounding(told?.[name]) : told?.[name];

/** Notes what was found for a run after its end. */
function noteFound(run, found) {
  run.found = { ...run.found, ...found };
  numbers();
}

/** Shows the numbers of the state, and all that goes with them. */
function numbers() {
  const run = shownOrLatest();
  if (!run) return;
  const before = besideInTable(run);
  byId("this").textContent = moment ? moment.name : say("numbers.this");
  byId("rival").title = run.beside ? say("beside.tip") : "";
  byId("rival").textContent = run.beside ? named(say("numbers.beside"), run.beside.numbers ?? {}) : pinned ? say("numbers.pinned") : say("numbers.before");
  showTable(run, run.beside || before, before);
  const status = run.numbers ? run.numbers.status : "begun";
  showTitle(run);
  byId("beside").setAttribute("aria-pressed", String(Boolean(knobs.beside)));
  showSectionOf(run);
  markState();
  warn(run);
  findConductance(run);
  judge(run);
  watchWish(run);
  Object.assign(document.body.dataset, { run: run.id, status, ended: run.ended });
}
