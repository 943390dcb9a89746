"use strict";
// The page of `asperity explore` and `asperity view`: controls, viewer, numbers, charts and lessons. No framework.

const byId = (id) => document.getElementById(id);
const isView = document.body.dataset.mode === "view";

// ---------------------------------------------------------------- controls

const isGfmd = (k) => k.solver.method === "gfmd";
const rough = (k) => k.roughness > 0;

/** Every control: its group, the path of the knob that it sets if that is not its id, and what it does in physics. */
const CONTROLS = [
  { group: "Load", id: "load", label: "p*", kind: "range", log: true, min: -4, max: 1.5, step: 0.02, wide: "load",
    tip: "Reduced pressure p* = mean pressure / (rms gradient × E*). Contact grows in proportion to it at first, and is full at p* of about 2." },
  { group: "Surface", id: "domain", label: "Geometry", kind: "select", options: { line: "Line (2-D)", surface: "Surface (3-D)" },
    tip: "A line is a profile in plane strain; a surface has both directions." },
  { group: "Surface", id: "body", label: "Shape", kind: "select",
    options: { flat: "None: rough only", round: "Cylinder / sphere", sine: "Sine", "power-law": "Power law" },
    tip: "The smooth body under the roughness, one per periodic cell of 160 µm. Without roughness on it the exact solution is known." },
  { group: "Surface", id: "exponent", label: "Exponent n", kind: "range", min: 1, max: 12, step: 0.5, shown: (k) => k.body === "power-law",
    tip: "Profile −A rⁿ: 1 is a wedge or cone, 2 the cylinder or sphere, large values a flat punch." },
  { group: "Surface", id: "roughness", label: "Roughness", kind: "range", min: 0, max: 0.01, step: 0.0002, unit: "", digits: 4,
    tip: "Rms gradient of the roughness. At 0 the body is smooth: with the cylinder or sphere that is Hertz. A rough flat has no other scale, so there only p* counts." },
  { group: "Surface", id: "hurst", label: "Hurst H", kind: "range", min: 0.1, max: 1, step: 0.05, shown: rough,
    tip: "Hurst exponent: how heights grow with length. Small H is jagged on short waves; 0.8 is typical of fractured and ground surfaces." },
  { group: "Surface", id: "rolloff", label: "Roll-off", kind: "range", min: 1, max: 32, step: 1, unit: "waves", shown: rough,
    tip: "Waves per cell at which the self-affine spectrum begins; longer waves are all equally strong. More of them: more asperities, better statistics." },
  { group: "Surface", id: "cutoff", label: "Cut-off", kind: "range", log2: true, min: 3, max: 13, step: 0.5, unit: "waves", shown: rough,
    tip: "Waves per cell at the short end of the spectrum. Needs at least two points per wave, and 8 to 32 for accurate areas." },
  { group: "Surface", id: "seed", label: "Seed", kind: "number", min: 0, max: 4294967295, step: 1, shown: rough, dice: true,
    tip: "Which random surface of this spectrum. The same seed gives the same surface everywhere. The dice (key D) takes another." },
  { group: "Surface", id: "points", label: "Points", kind: "range", power2: true, min: 5, max: 18, step: 1,
    tip: "Points of the line, or along each side of the surface (at most 1024). More points cost more, and need no more steps of the multilevel solver." },
  { group: "Solver", id: "solver", path: ["solver", "method"], label: "Method", kind: "select",
    options: { multilevel: "Multilevel", "polonsky-keer": "Conjugate gradients", gfmd: "GFMD" },
    tip: "Multilevel: whole-set updates on nested grids. Conjugate gradients: Polonsky and Keer. GFMD: damped dynamics of the surface modes, the method of the paper." },
  { group: "Solver", id: "masses", path: ["solver", "masses"], label: "Masses", kind: "select", options: { uniform: "Uniform", stiffness: "∝ stiffness" }, shown: isGfmd,
    tip: "Uniform: long waves are soft and heavy, and relax last. Proportional to stiffness: all waves swing alike." },
  { group: "Solver", id: "dynamics", path: ["solver", "dynamics"], label: "Dynamics", kind: "select", options: { damped: "Damped", fire: "FIRE" }, shown: isGfmd,
    tip: "Damped: constant friction. FIRE: velocities turn towards the force and are dropped when they go uphill." },
  { group: "Solver", id: "damping", path: ["solver", "damping"], label: "Damping", kind: "range", log: true, min: -1.5, max: 1, step: 0.05, shown: (k) => isGfmd(k) && k.solver.dynamics === "damped",
    tip: "Friction over the critical friction of the slowest mode. Too little: it rings. Too much: it creeps." },
  { group: "Solver", id: "time-step", path: ["solver", "time-step"], label: "Time step", kind: "range", min: 0.05, max: 0.95, step: 0.05, shown: isGfmd,
    tip: "Time step over the stability limit of the stiffest mode." },
  { group: "Solver", id: "tolerance", path: ["stop", "tolerance"], label: "Tolerance", kind: "range", log: true, min: -12, max: -1, step: 1,
    tip: "Certificate to reach: a proven bound of the error in energy, over load times rms height." },
  { group: "Recording", id: "record", label: "Fields", kind: "checks",
    options: { traces: "traces", "profile mesh": "shape", fields: "fields", mask: "contact", spectrum: "spectrum" },
    tip: "What the viewer gets of each step: curves, profile or relief, pressure and gap, contact, power spectra of each wavelength." },
];

/** The state of the knobs, as the server takes it. */
let knobs = null;
/** Settings of GFMD, for when it is chosen again. */
let gfmd = { masses: "uniform", dynamics: "damped", "time-step": 0.5, damping: 1 };

/** The object that holds the knob of a control, and the name of the knob in it. */
function place({ id, path }) {
  const [first, second] = path || [id];
  return second ? [knobs[first], second] : [knobs, first];
}

function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && typeof value !== "string") made[name] = value; else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

function build() {
  const groups = new Map();
  for (const control of CONTROLS) {
    if (!groups.has(control.group)) {
      const fieldset = element("fieldset", { id: `group-${control.group.toLowerCase()}` }, element("legend", {}, control.group));
      groups.set(control.group, fieldset);
      byId("controls").append(fieldset);
    }
    groups.get(control.group).append(row(control));
  }
  groups.get("Load").append(element("div", { class: "buttons" },
    button("sweep", "Sweep the load", "From first touch to full contact, each load from the contact before: contact, area, kappa and kappa_r in the viewer as they come, and below (key S).", sweep),
    button("cancel", "Stop", "End what is being solved; its latest state stays (Esc).", cancel)));
  byId("controls").addEventListener("submit", (event) => event.preventDefault());
}

function button(id, label, tip, action) {
  const made = element("button", { id, type: "button", title: tip }, label);
  made.addEventListener("click", action);
  explain(made, tip);
  return made;
}

function row(control) {
  const id = `control-${control.id}`;
  const line = element("div", { class: `row ${control.wide || ""}`, id: `row-${control.id}`, title: control.tip });
  line.append(element("label", { for: id }, control.label));
  if (control.kind === "select") {
    line.classList.add("wide");
    const options = Object.entries(control.options).map(([value, label]) => element("option", { value }, label));
    line.append(element("select", { id }, ...options));
  } else if (control.kind === "checks") {
    line.classList.add("wide");
    const boxes = Object.entries(control.options).map(([value, label]) =>
      element("label", {}, element("input", { type: "checkbox", value, id: `${id}-${value}` }), ` ${label}`));
    line.append(element("div", { class: "checks", id, role: "group", "aria-label": control.label }, ...boxes));
  } else {
    line.append(element("input", { type: control.kind, id, min: `${control.min}`, max: `${control.max}`, step: `${control.step}` }));
    line.append(control.dice ? button("dice", "⚄ Dice", control.tip, dice) : element("output", { id: `${id}-value`, for: id }));
  }
  line.addEventListener("input", () => { take(control); changed(); });
  explain(line, control.tip);
  return line;
}

function explain(target, tip) {
  for (const event of ["mouseenter", "focusin"]) target.addEventListener(event, () => { byId("hint").textContent = tip; });
}

/** The parts of a recording that a box stands for. */
const parts = (box) => box.value.split(" ");
const toSlider = (c, v) => c.log ? Math.log10(v) : c.log2 || c.power2 ? Math.log2(v) : v;
const fromSlider = (c, v) => c.log ? Number((10 ** v).toPrecision(4)) : c.power2 ? 2 ** v : c.log2 ? Math.round(2 ** v) : v;

/** Takes the value of a control into the knobs. */
function take(control) {
  const input = byId(`control-${control.id}`);
  const [holder, name] = place(control);
  if (control.kind === "select") holder[name] = input.value;
  else if (control.kind === "checks") holder[name] = [...input.querySelectorAll("input:checked")].flatMap(parts);
  else holder[name] = fromSlider(control, Number(input.value));
  mend(control.id);
  show();
}

/** Keeps what goes together together, when a control on which others depend has moved. */
function mend(id) {
  const { method, ...settings } = knobs.solver;
  if ("masses" in settings) gfmd = settings;
  knobs.solver = method === "gfmd" ? { method, ...gfmd } : { method };
  if (id === "domain") {
    knobs.points = knobs.domain === "line" ? 4096 : 256;
    if (knobs.cutoff > knobs.points / 2) knobs.cutoff = knobs.points / 8;
  }
  if (knobs.domain === "surface" && knobs.points > 1024) knobs.points = 1024;
  if (knobs.body === "flat" && knobs.roughness === 0) {
    if (id === "roughness") knobs.body = "round"; else knobs.roughness = 0.001;
  }
  if (knobs.cutoff > knobs.points / 2) {
    if (id === "cutoff") knobs.points = 2 ** Math.ceil(Math.log2(2 * knobs.cutoff)); else knobs.cutoff = knobs.points / 2;
  }
  if (knobs.domain === "surface" && knobs.points > 1024) { knobs.points = 1024; knobs.cutoff = 512; }
  if (knobs.rolloff >= knobs.cutoff) knobs.rolloff = Math.max(1, Math.floor(knobs.cutoff / 2));
}

/** Shows the knobs in the controls. */
function show() {
  for (const control of CONTROLS) {
    const id = `control-${control.id}`;
    const input = byId(id);
    const [holder, name] = place(control);
    const value = holder[name];
    if (control.kind === "select") input.value = value;
    else if (control.kind === "checks") input.querySelectorAll("input").forEach((box) => { box.checked = value.includes(parts(box)[0]); });
    else if (document.activeElement !== input || control.kind !== "number") input.value = toSlider(control, value);
    const output = byId(`${id}-value`);
    if (output) output.value = control.log && control.id !== "load" ? (value < 0.01 ? value.toExponential(0) : figure(value, 2)) : `${control.power2 ? value : figure(value, 3)}${control.unit ? ` ${control.unit}` : ""}`;
    byId(`row-${control.id}`).hidden = control.shown ? !control.shown(knobs) : false;
  }
}

function dice() {
  knobs.seed = Math.floor(Math.random() * 1e6);
  byId("control-seed").value = knobs.seed;
  changed();
}

// ---------------------------------------------------------------- the server

let posting = false;
let waiting = false;

async function post(path, body) {
  const answer = await fetch(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

/** Solves anew; while one request is under way, only the latest change waits. */
async function changed() {
  if (posting) { waiting = true; return; }
  posting = true;
  asked = performance.now();
  do {
    waiting = false;
    await post("/api/solve", knobs).then(() => fault(""), (error) => fault(error.message));
  } while (waiting);
  posting = false;
}

const sweep = () => post("/api/sweep", knobs).then(() => fault(""), (error) => fault(error.message));
const cancel = () => post("/api/cancel", {}).catch((error) => fault(error.message));

function fault(sentence) {
  byId("fault").textContent = sentence;
  byId("fault").hidden = !sentence;
}

let report = { revision: 0 };
let asked = 0;

/** Asks for news for as long as the page is open. */
async function listen() {
  for (;;) {
    try {
      const answer = await fetch(`/api/state?since=${report.revision}`);
      const news = await answer.json();
      if (news.revision !== report.revision) heard(news);
      if (document.body.dataset.server === "gone") fault("");
      document.body.dataset.server = "there";
    } catch {
      document.body.dataset.server = "gone";
      fault("The server has ended: start asperity explore again and reload this page.");
      await new Promise((done) => setTimeout(done, 1000));
    }
  }
}

function heard(news) {
  report = news;
  if (news.fault) fault(news.fault);
  if (news.run) heardRun(news.run);
  if (news.sweep) heardSweep(news.sweep);
  showPin(news.pinned);
  byId("cancel").disabled = !news.busy;
  byId("save-rrd").disabled = news.busy || !(news.run || news.sweep);
  byId("save-npz").disabled = !(news.run && news.run.ended);
  byId("save-setup").disabled = byId("copy-command").disabled = !news.run;
  charts();
  document.body.dataset.revision = news.revision;
  document.body.dataset.busy = news.busy;
}

// ---------------------------------------------------------------- runs

/** How many runs the viewer keeps. */
const KEEP = 6;
let runs = [];

/** A sweep stands among the runs, with loads for steps; one that is older than the latest run was there before the page. */
function heardSweep(sweep) {
  const number = (run) => Number(run.id.split("-")[1]);
  if (runOf(sweep.id) || !(report.run && number(report.run) > number(sweep))) heardRun(sweep);
}

function heardRun(run) {
  const known = runOf(run.id);
  if (known) Object.assign(known, run);
  else {
    runs.push(run);
    byId("title").textContent = run.title;
    if (viewer) follow(run);
    while (runs.length > KEEP) forget(runs.splice(runs.findIndex((old) => old.id !== pinned), 1)[0]);
    listRuns();
  }
  numbers();
}

const address = (run) => `${location.origin}/run/${run.id}.rrd`;

/** The least time between two runs that the viewer gets, in milliseconds: of those in between only the last counts. */
const BREATH = { line: 120, surface: 400 };
let followed = 0;
let next = null;

/** Lets the viewer read a run as it grows. */
function follow(run) {
  shownRun = run.id;
  clearTimeout(next);
  next = setTimeout(() => {
    followed = performance.now();
    stopPlaying();
    run.followed = true;
    viewer.add_receiver(address(run));
    wake();
    byId("scrub").value = 1000;
    byId("scrub-step").value = "latest";
    watchFirst(run, asked);
  }, Math.max(0, followed + BREATH[run.knobs.domain] - performance.now()));
}

/** Has the viewer look at what it was told, which it does when it draws: closing a channel that never was makes it draw. */
function wake() {
  viewer.close_channel("wake");
}

/** Notes how long after the change of a control the viewer had the first steps of its run. */
function watchFirst(run, since) {
  const range = viewer && viewer.get_timeline_time_range(run.id, timeline(run));
  if (range) {
    document.body.dataset.shown = `${run.id} ${Math.round(performance.now() - since)} ms`;
    byId("viewer-note").hidden = true;
  } else if (shownRun === run.id) requestAnimationFrame(() => watchFirst(run, since));
}

function forget(run) {
  if (viewer && run.followed) viewer.remove_receiver(address(run));
}

function listRuns() {
  const options = [...runs].reverse().map((run, i) => element("option", { value: run.id }, `${"ABCDEF"[i]}: ${run.id}, ${run.title}`));
  byId("runs").replaceChildren(...options);
  byId("runs").title = `Switch the viewer between the latest runs. The viewer keeps ${KEEP}; older ones are dropped.`;
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
  post("/api/pin", pinned || !shown ? null : shown.id).then(() => fault(""), (error) => fault(error.message));
}

function showPin(id) {
  if (pinned === id) return;
  pinned = id;
  byId("pin").setAttribute("aria-pressed", String(pinned !== null));
  byId("pin").textContent = pinned ? `Pinned ${pinned}` : "Pin";
  byId("rival").textContent = pinned ? "pinned" : "before";
  numbers();
}

function showRun(id) {
  stopPlaying();
  shownRun = id;
  byId("runs").value = id;
  const run = runOf(id);
  if (viewer && run.followed) viewer.set_active_recording_id(id);
  else if (viewer) follow(run);
  numbers();
}

// ---------------------------------------------------------------- numbers

function figure(value, digits = 5) {
  if (value === null || value === undefined) return "–";
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return size < 1e-3 || size >= 1e6 ? value.toExponential(Math.max(0, digits - 3)) : String(Number(value.toPrecision(digits)));
}

/** The observables that the server knows: those that change step by step are shown, and these. */
let observables = [];
const SHOWN = ["relative_area_corrected", "kappa_r_corrected", "iterations", "transforms", "seconds"];
/** The exact values that stand beside corrected observables. */
const EXACT = { relative_area_corrected: "relative_area", kappa_r_corrected: "kappa_r" };
const SECONDS = { name: "seconds", sentence: "Seconds of the solver alone, recording left out." };

/** The name of an observable for people. */
const label = (name) => name.replace("kappa_r", "κ_r").replace("kappa", "κ").replaceAll(/(?<!κ)_/g, " ");

function numbers() {
  const shown = runOf(shownRun);
  if (shown && isSweep(shown)) byId("title").textContent = `${shown.title}: ${shown.ended ? "ended" : "running"}, ${shown.points.length} loads`;
  const run = shownOrLatest();
  if (!run) return;
  const before = rival(run);
  const cell = (text, name) => element("td", { "data-number": name }, text);
  const body = observables.map(({ name, sentence }) => {
    const values = [run, before].map((r) => figure(r?.numbers?.[name]));
    const theory = run.exact && EXACT[name] ? figure(run.exact[EXACT[name]]) : "";
    return element("tr", { title: sentence }, element("th", { scope: "row" }, label(name)), cell(values[0], name), cell(values[1], ""), cell(theory, `exact ${name}`));
  });
  byId("numbers").tBodies[0].replaceChildren(...body);
  const status = run.numbers ? run.numbers.status : "begun";
  if (!shown || shown === run) byId("title").textContent = `${run.title}: ${status}${run.exact ? `; exact: ${run.exact.name}` : ""}`;
  Object.assign(document.body.dataset, { run: run.id, status, ended: run.ended });
}

// ---------------------------------------------------------------- charts

const SVG = "http://www.w3.org/2000/svg";

function drawn(tag, attributes, text) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  return made;
}

/** A chart against log10 p*: curves are { name, points: [[p*, y]], style }. */
function chart(target, title, top, curves) {
  const box = target.getBoundingClientRect();
  const [w, h, left, right, above, below] = [Math.max(200, box.width), Math.max(120, box.height), 30, 14, 20, 20];
  const xs = curves.flatMap((curve) => curve.points.map(([x]) => Math.log10(x)));
  const [low, high] = xs.length ? [Math.floor(Math.min(...xs)), Math.ceil(Math.max(...xs))] : [-4, 1];
  const x = (v) => left + (Math.log10(v) - low) / (high - low || 1) * (w - left - right);
  const y = (v) => h - below - v / top * (h - above - below);
  const svg = drawn("svg", { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": title });
  svg.append(drawn("rect", { class: "axis", x: left, y: above, width: w - left - right, height: h - above - below }));
  svg.append(drawn("text", { class: "title", x: left, y: 13 }, title));
  for (let e = low; e <= high; e++) svg.append(drawn("text", { x: x(10 ** e), y: h - 5, "text-anchor": "middle" }, e === 0 ? "1" : `1e${e}`));
  for (let i = 0; i <= 2; i++) svg.append(drawn("text", { x: left - 4, y: y(i * top / 2) + 4, "text-anchor": "end" }, String(i * top / 2)));
  if (knobs && knobs.load >= 10 ** low && knobs.load <= 10 ** high) svg.append(drawn("line", { class: "now", x1: x(knobs.load), x2: x(knobs.load), y1: above, y2: h - below }));
  curves.filter((curve) => curve.points.length).forEach((curve) => {
    svg.append(drawn("polyline", { class: curve.style, points: curve.points.map(([a, b]) => `${x(a).toFixed(1)},${y(b).toFixed(1)}`).join(" ") }));
  });
  let place = w - right;
  for (const curve of [...curves].reverse().filter((c) => c.points.length)) {
    svg.append(drawn("text", { class: `of-${curve.style}`, x: place, y: 13, "text-anchor": "end" }, curve.name));
    place -= 7.2 * curve.name.length + 8;
  }
  if (!curves.some((curve) => curve.points.length)) svg.append(drawn("text", { x: w / 2, y: h / 2, "text-anchor": "middle" }, "Sweep the load to draw this"));
  target.replaceChildren(svg);
}

function charts() {
  const points = report.sweep ? report.sweep.points : [];
  const curve = (name, style, of, top) => ({ name, style, points: points.map((p) => [p.reduced_pressure, of(p)]).filter(([, v]) => Number.isFinite(v) && v <= top) });
  chart(byId("chart-area"), "Area / p*", 1, [
    curve("Persson", "persson", (p) => p.persson, 1), curve("exact", "exact", (p) => p.exact?.relative_area, 1), curve("a_rel", "computed", (p) => p.relative_area_corrected, 1)]);
  chart(byId("chart-kappa"), "κ, κ_r / p*", 4, [
    curve("Persson", "persson", (p) => p.persson / p.reduced_pressure, 4), curve("exact", "exact", (p) => p.exact?.kappa_r, 4),
    curve("κ", "computed", (p) => p.kappa_corrected, 4), curve("κ_r", "second", (p) => p.kappa_r_corrected, 4)]);
  document.body.dataset.sweep = report.sweep ? (report.sweep.ended ? "ended" : points.length) : "none";
}

// ---------------------------------------------------------------- viewer

let viewer = null;

async function startViewer() {
  const query = new URLSearchParams(location.search);
  await wasm_bindgen({ module_or_path: `/re_viewer_bg.wasm` });
  const canvas = element("canvas", { id: "canvas" });
  byId("viewer").append(canvas);
  const handle = new wasm_bindgen.WebHandle({
    url: isView ? [`${location.origin}/recording.rrd`] : null, hide_welcome_screen: true, enable_history: false, notebook: !isView,
    render_backend: query.get("renderer"),
    panel_state_overrides: isView ? {} : { top: "Hidden", blueprint: "Hidden", selection: "Hidden", time: "Hidden" },
  });
  await handle.start(canvas);
  if (isView) byId("viewer-note").hidden = true; else noteViewer("Waiting for the first picture.");
  viewer = handle;
  document.body.dataset.viewer = "started";
  runs.slice(-1).forEach(follow);
  setInterval(guardViewer, 1000);
}

function guardViewer() {
  if (!viewer || !viewer.has_panicked()) return;
  document.body.dataset.viewer = "failed";
  noteViewer("The viewer has failed. Reload the page; if it fails again, add ?renderer=webgl to the address.");
  viewer = null;
}

function noteViewer(sentence) {
  byId("viewer-note").textContent = sentence;
  byId("viewer-note").hidden = false;
}

// ---------------------------------------------------------------- playing

let playing = null;

/** The step at a share of the run: early steps, in which most happens, take most of the time. Loads take as long each. */
function stepAt(run, share) {
  const range = viewer && run && viewer.get_timeline_time_range(run.id, timeline(run));
  if (!range) return null;
  const length = range.max - range.min;
  return Math.round(range.min + (isSweep(run) ? share * length : Math.expm1(share * Math.log1p(length))));
}

function seek(share) {
  const run = runOf(shownRun);
  const step = stepAt(run, share);
  if (step === null) return false;
  viewer.set_playing(run.id, false);
  viewer.set_active_timeline(run.id, timeline(run));
  viewer.set_time_for_timeline(run.id, timeline(run), step);
  byId("scrub").value = 1000 * share;
  byId("scrub-step").value = `${timeline(run)} ${step}`;
  return true;
}

/** Seconds that the whole relaxation takes. */
const duration = () => 30 / 2 ** Number(byId("speed").value);

function play() {
  if (playing) { stopPlaying(); return; }
  const begun = performance.now();
  const frame = (now) => {
    const share = Math.min(1, (now - begun) / 1000 / duration());
    if (!seek(Math.max(0, share)) || share >= 1) { stopPlaying(); return; }
    playing = requestAnimationFrame(frame);
  };
  playing = requestAnimationFrame(frame);
  byId("play").textContent = "Pause";
}

function stopPlaying() {
  if (playing) cancelAnimationFrame(playing);
  playing = null;
  byId("play").textContent = "Play";
}

// ---------------------------------------------------------------- lessons

const HERTZ = { domain: "line", body: "round", roughness: 0, points: 4096, solver: { method: "multilevel" }, record: ["traces", "profile", "mesh", "fields", "mask"] };
const ROUGH = { ...HERTZ, body: "flat", roughness: 0.001, hurst: 0.8, rolloff: 8, cutoff: 128, seed: 1 };
const SLOW = { method: "gfmd", masses: "uniform", dynamics: "damped", "time-step": 0.5, damping: 1 };
const CRAWL = { ...ROUGH, points: 4096, cutoff: 64, load: 0.05, solver: SLOW, stop: { tolerance: 1e-8, "max-iterations": 20000 }, record: ["traces", "spectrum"] };

const LESSONS = {
  "Hertz against rough contact": [
    [{ ...HERTZ, load: 0.001 }, "A smooth cylinder. The pressure is Hertz's half ellipse; the exact one is drawn beside it in white, and the exact numbers stand in green below."],
    [{ ...HERTZ, load: 0.01 }, "Ten times the load. The contact is only about three times as wide, so κ = a_rel / p* falls to a third. The gradient in contact grew instead, and κ_r, which takes that one, stays: compare “this run” with “before”."],
    [{ ...ROUGH, load: 0.01 }, "Now a rough line under the small load. Contact breaks into many patches, each of them a little Hertz contact of its own."],
    [{ ...ROUGH, load: 0.1 }, "Ten times the load on the rough line. The area grows almost in proportion now, because new patches join. κ still falls by a third; κ_r stays within a few per cent."],
    [{ ...ROUGH, load: 0.1, sweep: true }, "A sweep from first touch to full contact draws it all: κ falls with the load, κ_r keeps its level until most of the surface touches. The gradient that matters is the one in contact, not that of the whole surface."],
  ],
  "Why does my solver crawl": [
    [{ ...CRAWL }, "GFMD with the same mass for all waves. Long waves are thousands of times softer than short ones, so they move slowest. Press Play: the blue spectrum of the displacement settles on the right first and on the left last. Finer grids make it worse: four times the points take twice the steps."],
    [{ ...CRAWL, solver: { ...SLOW, damping: 0.1 } }, "A tenth of the friction. Less damping is not the cure: the slow waves ring, and it takes many times the steps. Look at the certificate."],
    [{ ...CRAWL, solver: { ...SLOW, masses: "stiffness" } }, "Masses in proportion to stiffness: every wave swings with the same period, so all of them relax together, on any grid in about as many steps. A step costs two transform pairs instead of one; the total still falls."],
    [{ ...CRAWL, solver: { method: "multilevel" } }, "The multilevel solver settles the long waves on coarse grids, where they are short, and needs few steps on the finest one: compare the transforms. That is why it does not crawl."],
  ],
};

let lesson = null;

function openLesson(name) {
  lesson = LESSONS[name] ? { steps: LESSONS[name], at: 0 } : null;
  byId("lesson-card").hidden = !lesson;
  if (lesson) showLesson();
}

function showLesson() {
  const [state, text] = lesson.steps[lesson.at];
  const { sweep: sweeps, ...values } = state;
  Object.assign(knobs, structuredClone(values));
  show();
  byId("lesson-text").textContent = text;
  byId("lesson-place").textContent = `${lesson.at + 1} / ${lesson.steps.length}`;
  byId("lesson-back").disabled = lesson.at === 0;
  byId("lesson-next").disabled = lesson.at + 1 === lesson.steps.length;
  document.body.dataset.lesson = lesson.at;
  if (sweeps) sweep(); else changed();
}

function step(by) {
  lesson.at = Math.max(0, Math.min(lesson.steps.length - 1, lesson.at + by));
  showLesson();
}

// ---------------------------------------------------------------- the page

/** The viewer follows the theme of the system and no other: here the page answers for the system. */
const THEMES = new Map(["dark", "light"].map((theme) => [`(prefers-color-scheme: ${theme})`, new EventTarget()]));
const askSystem = window.matchMedia.bind(window);
window.matchMedia = (query) => THEMES.get(query) || askSystem(query);

function paint(theme) {
  for (const [media, answer] of THEMES) {
    answer.matches = media.includes(theme);
    answer.dispatchEvent(new MediaQueryListEvent("change", { media, matches: answer.matches }));
  }
  document.documentElement.dataset.theme = theme;
  byId("theme").textContent = theme === "dark" ? "Light" : "Dark";
  localStorage.setItem("theme", theme);
}

function save(path, name = "") {
  element("a", { href: path, download: name }).click();
}

function saveSetup() {
  const address = URL.createObjectURL(new Blob([shownOrLatest().setup], { type: "application/toml" }));
  save(address, "scene.toml");
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

async function copyCommand() {
  const run = shownOrLatest();
  try {
    await navigator.clipboard.writeText(run.command);
    byId("hint").textContent = `Copied: ${run.command}`;
  } catch {
    byId("hint").textContent = run.command;
  }
}

function key(event) {
  const typing = ["SELECT", "TEXTAREA"].includes(event.target.tagName) || ["number", "text"].includes(event.target.type) || event.target.id === "canvas";
  const actions = { " ": play, s: sweep, d: dice, b: swap, p: pin, t: toggleTheme, Escape: cancel };
  const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action || typing || event.ctrlKey || event.metaKey || event.altKey || (event.key === " " && event.target.tagName === "BUTTON")) return;
  event.preventDefault();
  action();
}

function toggleTheme() {
  paint(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
}

async function begin() {
  const wished = new URLSearchParams(location.search).get("theme") || localStorage.getItem("theme");
  paint(wished === "light" || wished === "dark" ? wished : askSystem("(prefers-color-scheme: light)").matches ? "light" : "dark");
  byId("theme").addEventListener("click", toggleTheme);
  startViewer().catch((error) => {
    document.body.dataset.viewer = "failed";
    noteViewer(`The viewer could not start (${error}). Try another browser, or add ?renderer=webgl to the address.`);
  });
  if (isView) { byId("title").textContent = "a recording, from this machine"; return; }
  const ask = async (path) => (await fetch(path)).json();
  const before = await ask("/api/state");
  observables = [...await ask("/api/observables"), SECONDS].filter((row) => row.is_traced || SHOWN.includes(row.name));
  knobs = before.run ? before.run.knobs : before.sweep ? before.sweep.knobs : await ask("/api/start");
  build();
  show();
  charts();
  byId("lesson").append(element("option", { value: "" }, "none"), ...Object.keys(LESSONS).map((name) => element("option", { value: name }, name)));
  byId("lesson").addEventListener("change", () => openLesson(byId("lesson").value));
  byId("lesson-back").addEventListener("click", () => step(-1));
  byId("lesson-next").addEventListener("click", () => step(1));
  byId("lesson-close").addEventListener("click", () => { byId("lesson").value = ""; openLesson(""); });
  byId("save-rrd").addEventListener("click", () => save("/api/run.rrd"));
  byId("save-npz").addEventListener("click", () => save("/api/run.npz"));
  byId("save-setup").addEventListener("click", saveSetup);
  byId("copy-command").addEventListener("click", copyCommand);
  byId("runs").addEventListener("change", () => showRun(byId("runs").value));
  byId("play").addEventListener("click", play);
  byId("swap").addEventListener("click", swap);
  byId("pin").addEventListener("click", pin);
  byId("scrub").addEventListener("input", () => { stopPlaying(); seek(Number(byId("scrub").value) / 1000); });
  const speed = () => { byId("speed-value").value = `${figure(duration(), 2)} s`; };
  byId("speed").addEventListener("input", speed);
  speed();
  document.addEventListener("keydown", key);
  window.addEventListener("resize", charts);
  if (before.run || before.sweep) heard(before); else changed();
  listen();
}

begin();
