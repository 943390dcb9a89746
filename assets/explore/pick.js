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
  if (grip || visited !== shownRun || now === null || now === undefined) return;
  if (isSweep(run)) momentOfLoad(run.points.findLast(({ number }) => number <= now));
  else if (run.ended) await momentOfStep(run, Math.round(now));
}

/** The numbers of a load of a sweep, and its section: that which is kept of a sweep that has ended, or else, and for the stress below, one
 * that is solved anew. */
async function momentOfLoad(point) {
  if (!point || moment?.numbers === point) return;
  setMoment({ name: say("moment.load", { load: figure(point.reduced_pressure, 3) }), numbers: point, exact: point.exact });
  charts();
  const its = runOf(report.sweep.id) ?? report.sweep;
  const isShown = () => moment?.numbers === point && !grip;
  if (its.ended && !isDeep() && isKept(its) && byId("top-box").hidden) {
    const { steps, sections } = await facet(its, "motion");
    if (!isShown()) return;
    const at = steps.indexOf(point.number);
    sectionRun = null;
    showSection(sections[at], null, { ...axesOf(sections), pressure: sections[at].highest_pressure });
  } else {
    const load = Number(point.reduced_pressure.toPrecision(12));
    hold({ knobs: { ...its.knobs, load }, "mean-gap": null, "is-deep": isDeep() }, (contact) => {
      if (!isShown()) return;
      sectionRun = null;
      showContact(contact);
    });
  }
}

/** The name of a step, or of a state in time, in retardation times.
 * @param {any} numbers */
const momentName = ({ step, time }) => Number.isFinite(time) ? say("moment.time", { state: step, time: figure(time, 3) }) : say("moment.step", { step });

/** The numbers of a step of a run; at its end those of the run. */
async function momentOfStep(run, step) {
  const columns = await facet(run, "steps").catch((error) => fault(error.message));
  if (!columns || runOf(shownRun) !== run) return;
  const steps = columns.step;
  const at = steps.findLastIndex((it) => it <= step);
  const isEnd = at < 0 || step >= Math.min(steps.at(-1), rangeOf(run)?.max ?? Infinity);
  const numbers = isEnd ? null : Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, values[at]]));
  setMoment(numbers && { name: momentName(numbers), numbers, step });
  charts();
  if (numbers) await showMotion(run, step);
}

/** Shows the section of a step, or of the last one before it that is kept, on axes that hold all steps. */
async function showMotion(run, step) {
  const motion = await facet(run, "motion").catch((error) => fault(error.message));
  if (!motion || grip || moment?.step !== step || runOf(shownRun) !== run) return;
  sectionRun = null;
  showSection({ ...motion.sections[motion.steps.findLastIndex((it) => it <= step)], shear: null }, beside, axesOf(motion.sections));
}

/** The run whose section is shown; none while it is that of something else. */
let sectionRun = null;

/** Shows the section of a run that has ended, if it is not shown, unless a hand holds another or a moment has its own. */
async function showSectionOf(run) {
  if (run?.section && !(run.ended && isKept(run))) { showRunning(run); return; }
  if (!run || !run.ended || isSweep(run) || run.id === sectionRun || moment) return;
  if (chosen && chosen.run !== run.id) choosePatch(null);
  sectionRun = run.id;
  const names = ["section", "beside", ...(isDeep() ? ["shear", "shear-beside"] : [])];
  const its = await Promise.all(names.map((name) => facet(run, name))).catch((error) => fault(error.message));
  if (!its || grip || sectionRun !== run.id) return;
  const [shown, shownBeside, shear = null, shearBeside = null] = its;
  const top = shown.y === null ? null : await facet(run, "top").catch(() => null);
  if (grip || sectionRun !== run.id) return;
  showContact({ section: shown, beside: shownBeside, top, shear, shear_beside: shearBeside });
  run.steps = (await facet(run, "steps").catch(() => null))?.step;
  document.body.dataset.section = run.id;
}

/** Shows the section of the latest step of a run that has not ended, which the solver reports now and then, or that was ended with its
 * solver. */
function showRunning(run) {
  if (grip || moment || isSweep(run)) return;
  sectionRun = null;
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
