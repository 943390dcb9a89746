// Picking: a patch of a contact, a step of a curve, a load of a sweep.

/** Facets of runs that have ended, by their names, and how many of them are kept. */
const facets = new Map();
const MOST_FACETS = 42;

/** A facet of a run, asked for once; a server that has ended has none. */
function facet(run, name) {
  const key = `${run.id}/${name}`;
  if (!facets.has(key)) {
    if (!isKept(run)) return Promise.reject(new Error(say("fault.lost", { run: runName(run.id) })));
    facets.set(key, ask(`run/${key}`));
    facets.get(key).catch(() => facets.delete(key));
  }
  for (const old of [...facets.keys()].slice(0, -MOST_FACETS)) facets.delete(old);
  return facets.get(key);
}

/** Shows in the table where the viewer stands in the run or the sweep that it shows, once a person went there. */
async function showMoment() {
  const run = runOf(shownRun);
  const now = run && isInViewer(run) ? viewer.get_time_for_timeline(recordingName(run), timeline(run)) : null;
  if (grip || isHidden() || isSolving() || visited !== shownRun || now === null || now === undefined) return;
  if (isSweep(run)) momentOfLoad(run, run.points.findLast(({ number }) => number <= now));
  else if (run.ended) await momentOfStep(run, Math.round(now));
}

/** A load of a sweep, with its knobs, and its section: that which is kept of a sweep that has ended, or else, and for the stress below, one
 * that is solved anew. */
async function momentOfLoad(its, point) {
  if (!point || moment?.numbers === point) return;
  const { load } = point;
  const rounded = Number(load.toPrecision(4));
  const title = titleOf({ title: its.title.replace("load sweep", `p* = ${rounded}`) });
  const now = { name: say("moment.load", { load: figure(load, 3) }), title, numbers: point, exact: point.exact, sweep: its, knobs: { ...its.knobs, load: rounded } };
  goToState(now);
  const isShown = () => moment === now && !grip;
  const isFlat = its.ended && !isDeep() && isKept(its) && byId("top-box").hidden;
  const motion = isFlat ? await facet(its, "motion").catch(() => null) : null; // a session keeps its latest sweeps
  if (!isShown()) return;
  if (motion) {
    const shown = motion.sections[motion.steps.indexOf(point.number)];
    setPictured(now);
    showSection(shown, null, { ...axesOf(motion.sections), pressure: shown.highest_pressure });
  } else {
    const order = { knobs: { ...its.knobs, load: Number(load.toPrecision(12)) }, "mean-gap": null, "is-deep": isDeep(), "is-still": true };
    hold(() => order, (contact) => {
      if (!isShown()) return;
      setPictured(now);
      showContact(contact);
    });
  }
}

/** What names a state of a process, and the end of the title of a run that is of its last state alone. */
const OF_STATES = { creep: "time", adhesion: "reduced_pressure", slip: "friction", rolling: "friction" };
const OF_LAST = /, (T\/τ|Q\/\(μP\)) = [^,]*$/;

/** The name of a step of a run, or of a state of a process. */
function momentName(run, told) {
  const of = OF_STATES[processOf(run)];
  return of && Number.isFinite(told[of]) ? say(`moment.${of}`, { value: figure(told[of], 3) }) : say("moment.step", { step: told.step });
}

/** The title of a moment of a run: a state in time is at its own time, not at that of the end. */
function momentTitle(run, name) {
  const title = titleOf(run);
  const places = { title: title.replace(OF_LAST, ""), name };
  return places.title === title ? say("title.step", places) : say("title.state", places);
}

/** The step at which a run is at its end: the last one, or the last one of the viewer, which may lack one that is still to be read. */
function endOf(run, steps) {
  const last = rangeOf(run)?.max ?? Infinity;
  const isRead = steps.filter((step) => step > last).length <= 1;
  return isRead ? Math.min(steps.at(-1), last) : steps.at(-1);
}

/** The numbers of a step of a run, the first one before all others; at its end those of the run. */
async function momentOfStep(run, step) {
  const [columns, motion] = await Promise.all(["steps", "motion"].map((name) => facet(run, name))).catch((error) => { fault(error.message); return []; });
  if (!columns || grip || runOf(shownRun) !== run || stateRun !== run.id) return;
  const steps = columns.step;
  if (step >= endOf(run, steps)) { goToState(null); return; }
  const at = Math.max(0, steps.findLastIndex((it) => it <= step));
  const told = rowOf(columns, at);
  const name = momentName(run, told);
  goToState({ name, title: momentTitle(run, name), numbers: told, step, knobs: run.knobs });
  charts();
  setPictured(moment);
  showSection({ ...motion.sections[Math.max(0, motion.steps.findLastIndex((it) => it <= step))], shear: null }, beside, axesOf(motion.sections));
}

/** The latest request for the section of a run, while it is under way. */
let asking = null;

/** Shows the section of a run, if it is not shown, unless a hand holds another or a moment has its own. */
async function showSectionOf(run) {
  if (grip || moment) return;
  if (run.section && !(run.ended && isKept(run))) { showRunning(run); return; }
  if (!run.ended || run.id === sectionRun || run === asking?.run) return;
  if (chosen && chosen.run !== run.id) choosePatch(null);
  const mine = asking = { run };
  await askSection(mine).catch((error) => fault(error.message));
  if (asking === mine) asking = null;
}

/** Asks for the section of a run at its end and shows it, unless another state is asked for or shown by then. */
async function askSection(mine) {
  const { run } = mine;
  const names = ["section", "beside", ...(isDeep() ? ["shear", "shear-beside"] : [])];
  const [shown, shownBeside, shear = null, shearBeside = null] = await Promise.all(names.map((name) => facet(run, name)));
  const top = shown.y === null ? null : await facet(run, "top").catch(() => null);
  if (grip || moment || mine !== asking || run !== shownOrLatest()) return;
  setPictured(run, true);
  showContact({ section: shown, beside: shownBeside, top, shear, shear_beside: shearBeside });
  const columns = await facet(run, "steps").catch(() => null);
  run.steps = columns?.step;
  if (columns && processOf(run) === "adhesion") noteFound(run, { pull_off: pullOffIn(run, columns) });
  document.body.dataset.section = run.id;
}

/** Shows the section of the latest step of a run that has not ended, which the solver reports now and then, or that was ended with its
 * solver. */
function showRunning(run) {
  setPictured(run);
  showSection(run.section, beside, axesOf([run.section, beside].filter(Boolean)));
  document.body.dataset.running = run.id;
}

/** The patch that is chosen, with its number, or none. */
let chosen = null;

function choosePatch(patch) {
  chosen = patch;
  byId("patch").hidden = !patch;
  drawSections();
  drawTop();
  drawPatch();
  document.body.dataset.patch = patch ? patch.number : "none";
}

/** Chooses the patch at a share of the length of the section, or the nearest one. */
async function pickAt(share) {
  const run = shownOrLatest();
  if (run?.id !== sectionRun) return;
  const table = await facet(run, "patches").catch((error) => fault(error.message));
  if (!table) return;
  const [rows, columns] = table.shape;
  const row = section.y === null ? 0 : Math.min(rows - 1, Math.floor(section.y / table.size[0] * rows));
  pickNear(run, table, row, Math.floor(share * columns));
}

/** Chooses the patch whose part of the map is nearest to a place. */
function pickNear(run, table, row, column) {
  if (run.id !== sectionRun) return;
  const [, columns] = table.shape;
  let best = [Infinity, 0];
  table.map.forEach((number, i) => {
    if (!number) return;
    const away = Math.hypot(Math.floor(i / columns) - row, i % columns - column);
    if (away < best[0]) best = [away, number];
  });
  const { count, fewest_nodes: fewest, is_hertzian: isHertzian, patches } = table;
  choosePatch(best[1] ? { run: run.id, number: best[1], count, fewest, isHertzian, ...patches[best[1] - 1] } : null);
}

/** Pixels of the longer side of an image of a surface, the width of the canvas of a line, and the length of a relief. */
const VIEW = { image: 512, line: 1000, relief: 10 };

/** Chooses the patch that was picked in the viewer, in a profile, an image or a relief. */
async function heardPick(recording, items) {
  const run = runWith(recording);
  const item = items.find((it) => it.position && it.entity_path && !it.entity_path.startsWith("/beside"));
  if (!run || !item || isSweep(run) || !run.ended) return;
  const table = await facet(run, "patches").catch((error) => fault(error.message));
  if (!table) return;
  const share = item.entity_path.includes("/relief/") ? onRelief(item.position, table) : onImage(item.position, table);
  pickNear(run, table, ...share.map((it, axis) => Math.floor(it * table.shape[axis])));
}

function onRelief([x, y], { size }) {
  const longest = Math.max(...size);
  return [y, x].map((at, axis) => at * longest / (VIEW.relief * size[axis]) + 0.5);
}

function onImage([x, y], { grid }) {
  if (grid[0] === 1) return [0, x / VIEW.line];
  const scale = Math.min(1, VIEW.image / Math.max(...grid));
  return [y, x].map((at, axis) => at / (grid[axis] * scale));
}

/** Marks the chosen patch in the section. */
function paintChosen(to, at, colour) {
  const middle = chosen.place[1] / section.length;
  const half = Math.max(2, at.w * patchWidth() / section.length / 2);
  to.strokeStyle = colour.green;
  to.lineWidth = 1.5;
  to.strokeRect(at.x(middle) - half - 2, 1, 2 * half + 4, at.h - 2);
}

/** How wide the chosen patch is, of a surface as wide as a circle of its area. */
const patchWidth = () => section.y === null ? chosen.area : 2 * Math.sqrt(chosen.area / Math.PI);

/** Draws the chosen patch beside its Hertz twin: pressures above, profiles below. */
function drawPatch() {
  if (!chosen) return;
  const { twin, profile } = chosen;
  const isLine = section.y === null;
  const share = (part) => `${figure(100 * part, 3)} %`;
  const rows = [["width", patchWidth(), twin && 2 * twin.half_width, inLengths], ["area", !isLine && chosen.area, twin?.area, squareMicrometres],
    ["load", chosen.share, twin && chosen.share, share], ["pressure", chosen.max_pressure, twin?.max_pressure, pressureOf],
    ["kappa-r", chosen.kappa_r, twin?.kappa_r], ["radius", 1 / chosen.curvature, twin && 1 / chosen.curvature, inLengths]];
  byId("patch-name").textContent = say("patch.name", { number: chosen.number, count: chosen.count, nodes: chosen.nodes });
  const cells = ([name, its, of, words = (value) => figure(value, 3)]) =>
    element("tr", {}, element("th", { scope: "row" }, say(`patch.${name}`)), element("td", {}, words(its)), element("td", {}, twin ? words(of) : "–"));
  byId("patch-numbers").tBodies[0].replaceChildren(...rows.filter(([, its]) => its !== false).map(cells));
  const notes = [chosen.nodes < chosen.fewest && say("patch.small", { fewest: chosen.fewest }), !twin && say("patch.hollow"), twin && !chosen.isHertzian && say("patch.solid"), say("patch.counted")];
  byId("patch-note").textContent = notes.filter(Boolean).join(" ");
  if (profile) drawTwin(profile, twin); else byId("patch-picture").replaceChildren();
}

const inLengths = (metres) => withUnit(metres, "length");
const squareMicrometres = (area) => `${figure(1e12 * area * stretch() ** 2, 3)} µm²`;

function drawTwin({ x, height, pressure }, twin) {
  const box = byId("patch-picture").getBoundingClientRect();
  const [w, h] = [Math.max(120, box.width), Math.max(80, box.height)];
  const [first, last] = [x[0], x.at(-1)];
  const half = twin ? twin.half_width : 0;
  const ellipse = (at) => twin.max_pressure * Math.sqrt(Math.max(0, 1 - (at / half) ** 2));
  const most = Math.max(...pressure, twin ? twin.max_pressure : 0);
  const [low, high] = [Math.min(...height), Math.max(...height, 1e-30)];
  const px = (at) => (at - first) / (last - first) * w;
  const above = (p) => h * 0.55 - p / most * h * 0.5;
  const below = (z) => h - (z - low) / (high - low || 1) * h * 0.4;
  const path = (values, y) => values.map((value, i) => `${px(x[i]).toFixed(1)},${y(value).toFixed(1)}`).join(" ");
  const svg = drawn("svg", { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": say("patch.picture") });
  svg.append(drawn("polyline", { class: "second", points: path(pressure, above) }), drawn("polyline", { class: "computed", points: path(height, (z) => below(high + low - z)) }));
  if (twin) {
    const middle = weightedMiddle(x, pressure);
    svg.append(drawn("polyline", { class: "exact", points: path(x.map((at) => ellipse(at - middle)), above) }));
    const top = highestNear(x, height, middle);
    svg.append(drawn("polyline", { class: "exact", points: path(x.map((at) => Math.max(low, top - 0.5 * chosen.curvature * (at - middle) ** 2)), (z) => below(high + low - z)) }));
  }
  byId("patch-picture").replaceChildren(svg);
}

/** Where the middle of a pressure is. */
function weightedMiddle(x, pressure) {
  const sum = pressure.reduce((all, p) => all + p, 0);
  return sum ? x.reduce((all, at, i) => all + at * pressure[i], 0) / sum : 0;
}

/** The height at the point that is nearest to a place. */
const highestNear = (x, height, place) => height[x.reduce((best, at, i) => Math.abs(at - place) < Math.abs(x[best] - place) ? i : best, 0)];
