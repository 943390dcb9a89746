// The second way: a page without a server shows what was solved beforehand, which answers in the place of a session.

/** What was solved beforehand; none where there is a server. */
const solved = typeof SOLVED === "object" ? SOLVED : null;

/** The report of a session, and those who wait for the next one. */
let latestNews = { revision: 0, busy: false, run: null, sweep: null, pinned: null, fault: null };
let listeners = [];

function tell(change) {
  latestNews = { ...latestNews, ...change, revision: latestNews.revision + 1 };
  listeners.splice(0).forEach((done) => done(latestNews));
  return { revision: latestNews.revision };
}

/** What is answered at a path: one of a page, or a facet of a run. */
function answerBeforehand(path) {
  const [place, since] = path.split("?since=");
  if (place === "state") return latestNews.revision > Number(since ?? -1) ? latestNews : new Promise((done) => listeners.push(done));
  if (place === "runs") return [];
  if (place === "heights") return null;
  const [, id, name] = place.split("/");
  return name ? solvedFacets(id).then((facets) => facets[name]) : solved[place];
}

/** The facets of a run, which a script of their own holds: other files cannot be read from a folder on disk. */
function solvedFacets(id) {
  return new Promise((done) => {
    if (solved.facets[id]) { done(solved.facets[id]); return; }
    const script = element("script", { src: `run/${id}.js` });
    script.addEventListener("load", () => done(solved.facets[id]));
    script.addEventListener("error", () => done({}));
    document.head.append(script);
  });
}

/** Carries out an order: what was solved comes up, and what was not is refused. */
function orderBeforehand(path, body) {
  if (path === "pin") return tell({ pinned: body });
  if (path === "solve") return bringUp(solvedRun(body), body);
  if (path === "sweep") return bringUp(solvedSweep(body), body);
  if (path === "cancel" || path === "leave") return latestNews;
  throw new Error(say("solved.never"));
}

/** The knobs of what came up last. */
let solvedKnobs = solved && solved.start;

function bringUp(found, wanted) {
  if (!found) {
    knobs = structuredClone(solvedKnobs);
    show();
    throw new Error(say("solved.refused", { list: solvedList() }));
  }
  solvedKnobs = structuredClone(wanted);
  const known = runOf(found.id);
  if (known) recall(known);
  const run = structuredClone(found);
  return tell(isSweep(run) ? { run: null, sweep: run } : { run, sweep: null });
}

/** Makes an earlier run the latest one again. */
function recall(run) {
  runs.push(...runs.splice(runs.indexOf(run), 1));
  listRuns();
  showRun(run.id);
}

const withoutLoad = ({ load, ...state }) => words(state);
/** The run or the sweep that was solved for a state, recorded on the ground that the page has. */
const solvedRun = (wanted) => solved.runs.find((run) => !isSweep(run) && run.knobs.theme === wanted.theme && words(run.knobs) === words(wanted));
const solvedSweep = (wanted) => solved.runs.find((run) => isSweep(run) && run.knobs.theme === wanted.theme && withoutLoad(run.knobs) === withoutLoad(wanted));

/** The knob of a control in a state. */
const knobOf = ({ path }, state) => path.reduce((it, name) => it?.[name], state);

/** A state without the knob of a control, as words; the method of a solver goes with all of its settings. */
function wordsBut({ path: [first, second] }, state) {
  const copy = structuredClone(state);
  if (second && second !== "method") delete copy[first]?.[second]; else delete copy[first];
  return words(copy);
}

/** The solved states that differ from the knobs in one control alone, by its value. */
function alternatives(control) {
  const found = new Map();
  const rest = wordsBut(control, knobs);
  for (const run of solved.runs) {
    const value = knobOf(control, run.knobs);
    if (!isSweep(run) && value !== undefined && !found.has(value) && wordsBut(control, run.knobs) === rest) found.set(value, run.knobs);
  }
  return new Map([...found].sort(([a], [b]) => a < b ? -1 : 1));
}

/** Turns a control to the solved state of a value. */
function takeSolved(control, value) {
  const state = alternatives(control).get(value);
  if (state) Object.assign(knobs, structuredClone(state), { theme: knobs.theme });
}

/** Lets every control turn to what was solved, and to nothing else. */
function offerSolved() {
  for (const control of CONTROLS) {
    const input = byId(`control-${control.id}`);
    const values = [...alternatives(control).keys()];
    const isTurnable = values.length > 1 && (control.slider || isList(control));
    control.values = control.slider ? values : null;
    if (control.slider) Object.assign(input, { min: 0, max: Math.max(1, values.length - 1), step: 1 });
    if (isList(control)) [...input.options].forEach((option) => { option.disabled = !values.includes(chosenOf(control, option.value)); });
    for (const it of [input, ...input.querySelectorAll("input")]) it.disabled = !isTurnable;
    if (byId(`control-${control.id}-value`)) byId(`control-${control.id}-value`).readOnly = true;
  }
  byId("sweep").disabled = !solvedSweep(knobs);
  for (const id of ["dice", "open-file", "beside"]) Object.assign(byId(id), { disabled: true, title: say("solved.never") });
  byId("solved").textContent = say("solved", { list: solvedList() });
  byId("solved").hidden = false;
}

/** What can be turned to from here: controls and their values. */
function solvedList() {
  const turnable = CONTROLS.filter((control) => control.kind !== "choices").map((control) => [control, [...alternatives(control).keys()]]);
  const named = turnable.filter(([, values]) => values.length > 1).map(([control, values]) => `${labelOf(control)} ${values.map((value) => isList(control) ? optionOf(control, value) : inLocale(String(value))).join(say("solved.comma"))}`);
  return named.join("; ") || say("solved.this");
}
