// What is shown: one state. Its knobs stand in the controls, and numbers, section and title are its own. What is not of the knobs is grey.

/** The run that is shown; none for the latest one. */
let stateRun = null;
/** What is shown in the place of the end of that run: a step of it, a load of a sweep, what a hand holds, or a surface that is asked about. It has
 * a name, numbers, and mostly knobs; exact values, if those are not those of the run; a title, if it has none of the run; its load, if that is
 * not the one of the knobs. */
let moment = null;
/** The run or the moment whose section is drawn, and the run, if it is drawn at its end. */
let pictured = null;
let sectionRun = null;

/** Milliseconds after which the page says that it solves. */
const QUIET = 400;
let saying = null;

const shownOrLatest = () => runOf(stateRun) ?? latest();

/** The knobs of the state that is shown; none before there is one. */
const shownKnobs = () => moment?.knobs ?? shownOrLatest()?.knobs ?? null;

/** Whether the state that is shown is that of the knobs. */
function isOfKnobs() {
  const its = shownKnobs();
  return its !== null && words(its) === words(knobs);
}

/** The latest run of some knobs; none if there is none. */
const runOfKnobs = (its) => runs.findLast((run) => !isSweep(run) && words(run.knobs) === words(its));

/** Whether a run goes on. One that has failed or was lost has not ended, and does not go on. */
const goesOn = (run) => !run.ended && report.busy && report.run?.id === run.id && document.body.dataset.server !== "gone";

/** Whether numbers, section and title are of one state, that of the knobs. */
function isWhole() {
  const state = moment ?? shownOrLatest();
  return isOfKnobs() && pictured === state && (state === moment || state.ended || goesOn(state));
}

/** Whether a question hides what is solved. */
const isHidden = () => Boolean(moment?.isAsked);

/** Lets what is solved take the place of a surface that was asked about. */
function uncover() {
  if (moment?.isAsked) moment = { ...moment, isAsked: false };
}

const isSolving = () => posting || holding || report.busy;

/** Shows the run of the knobs, where nothing is on its way and yet another state is shown, or its section is not drawn: an order and a step back at
 * the same time can miss each other. */
function heal() {
  const run = runOfKnobs(knobs);
  if (isWhole() || isSolving() || grip || isHidden() || !run?.ended || !byId("fault").hidden) return;
  stateRun = run.id;
  sectionRun = null;
  asking = null;
  goToState(null);
}

/** Says that what is shown is old, for as long as it is. */
function sayOld() {
  byId("unsolved").hidden = false;
  heal();
  saying = isWhole() ? null : setTimeout(sayOld, QUIET);
}

/** Greys what is shown while it is not what the knobs ask for, and says so if that lasts. */
function markState() {
  const isOld = !isWhole();
  document.body.toggleAttribute("data-unsolved", isOld);
  byId("unsolved").textContent = isSolving() ? say("solving") : say("unsolved");
  if (!isOld) { clearTimeout(saying); saying = null; byId("unsolved").hidden = true; }
  else saying ??= setTimeout(sayOld, QUIET);
  markLoad();
}

/** Shows in the field of the load that which a hand needs, where the knobs do not have it. */
function markLoad() {
  const isByHand = moment?.load !== undefined && isOfKnobs();
  const row = byId("row-load");
  const isNews = isByHand !== row.hasAttribute("data-hand");
  row.toggleAttribute("data-hand", isByHand);
  byId("load-hand").hidden = !isByHand;
  if (isByHand || isNews) byId("control-load-value").value = isByHand ? figure(moment.load, 3) : inLocale(written(knobs.load));
}

/** Makes room for what is said of the load. */
function beginState() {
  byId("row-load").after(element("p", { id: "load-hand", hidden: true }, say("load.hand")));
}

/** Notes whose section is drawn next, as its map asks for what is known of the run: that of a moment, or of a run on its way or at its end. */
function setPictured(state, isEnd = false) {
  pictured = state;
  sectionRun = isEnd ? state.id : null;
  markState();
}

/** Shows a moment, or the end of the run again. */
function setMoment(state) {
  moment = state;
  numbers();
}

/** Shows a moment with its knobs, or the end of the run with its own. A hand lets go of what it held. */
function goToState(state) {
  grip = null;
  setMoment(state);
  if (!isOfKnobs()) takeState(shownKnobs());
}

/** Puts the knobs of a state into the controls. */
function takeState(its) {
  knobs = painted(structuredClone(its));
  show();
  charts();
  writeAddress();
  keepState();
}

/** Puts the knobs back to those of the state that is shown. Those of a file are kept, as it may take more than one change to make them
 * solvable. */
function putBack() {
  const good = shownKnobs();
  if (good && knobs.body !== "file" && !isOfKnobs()) takeState(good);
  markState();
}

/** Whether a run that begins takes the place of what is shown: a state of the knobs stays unless the run is of them too, and no question hides
 * it. */
const takesOver = (run) => !isOfKnobs() || (words(run.knobs) === words(knobs) && !isHidden());

/** What stays on one line: a symbol with its value, and a number with an exponent. */
const UNBROKEN = /(\S+ = \S+|\S*\de-\d+\S*)/;

/** A text as parts of an element, of which some stay on one line.
 * @type {(text: string) => (string | Node)[]} */
const unbroken = (text) => text.split(UNBROKEN).map((part, i) => i % 2 ? element("span", { class: "kept" }, part) : part);

/** Shows the title of the state, and of the sweep that the viewer shows or that goes on. */
function showTitle(run) {
  const shown = runOf(shownRun);
  const sweep = shown && isSweep(shown) && (!moment || moment.sweep) ? ` · ${sweepInWords(shown)}` : "";
  const title = `${moment?.title ?? titleOfRun(run)}${sweep}`;
  byId("title").replaceChildren(element("span", {}, ...unbroken(title)));
  byId("title").title = title; // a long one is cut off
}

function sweepInWords(sweep) {
  return say(`title.sweep.${sweep.ended ? "ended" : isLost(sweep) ? "lost" : "running"}`, { count: sweep.points.length });
}

function titleOfRun(run) {
  const isStopped = !run.ended && !isSweep(run) && !goesOn(run);
  const status = isLost(run) ? say("status.lost") : isStopped ? say("status.stopped-by-the-observer") : statusOf(run);
  const places = { title: titleOf(run), status, exact: run.exact && exactOf(run.exact) };
  return run.exact ? say("title.run.exact", places) : say("title.run", places);
}
