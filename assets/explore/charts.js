// Which charts are drawn: area and kappa against the load, or what the process of a run is about.

/** The contacts that a person has seen, their knobs and numbers, each once, and how many of them are kept.
 * @type {{ its: any, numbers: any }[]} */
let visitedContacts = [];
const MOST_SEEN = 400;
/** Upper ends of the axis of kappa: the lowest that holds all curves and dots, and the guess while one is asked for, or the last one; further ones
 * for the state that is shown, which is never left out. */
const TOPS = [4, 10];
const HIGHER_TOPS = [20, 50, 100, 200, 500, 1000];
/** Exponents at the ends of the axis of the load where nothing is drawn. */
/** @type {[number, number]} */
const USUAL_LOADS = [-4, 1];

/** Keeps the numbers of a contact that has converged for the charts; with adhesion each one under the hand is another one. */
function keepSeen(its, numbers) {
  if (numbers?.status !== "converged" || isParted(numbers)) return;
  const isSame = (seen) => seen.numbers.reduced_pressure === numbers.reduced_pressure && seen.numbers.mean_gap === numbers.mean_gap && words(seen.its) === words(its);
  const before = visitedContacts.find(isSame)?.numbers;
  visitedContacts = [...visitedContacts.filter((seen) => !isSame(seen)), { its: structuredClone(its), numbers: { ...before, ...numbers } }].slice(-MOST_SEEN);
}

/** Keeps how much leaks through a contact that was seen. */
function keepLeak(run, { axes: [{ hydraulic_gap: gap }] }) {
  keepSeen(run.knobs, run.numbers);
  for (const seen of visitedContacts) if (words(seen.its) === words(run.knobs)) seen.numbers = { ...seen.numbers, hydraulic_gap_x: gap };
  if (run.found?.hydraulic_gap_x !== gap) noteFound(run, { hydraulic_gap_x: gap });
  charts();
}

/** The knobs that make surface and solid of a sweep. */
function pressedOf({ domain, body, exponent, roughness, hurst, rolloff, cutoff, "rolloff-form": form, peklenik, "lay-angle": angle, skewness, kurtosis, seed, points, heights, scene, bumps, hardness, "yield-stress": yieldStress, hardening, layer, creep, speed, time, adhesion, range, friction, sideways, rolling }) {
  if (body === "scene") return scene;
  const memory = creep > 0 && [creep, speed, speed === 0 && time];
  const attraction = adhesion > 0 && [adhesion, range];
  const rubbing = friction > 0 && sideways > 0 && [friction, rolling];
  const yielding = yieldStress > 0 && [yieldStress, hardening];
  if (body === "file") return JSON.stringify([heights, hardness, yielding, layer, memory, attraction, rubbing]);
  return JSON.stringify([hardness, yielding, layer, memory, attraction, rubbing, domain, body, body === "power-law" && exponent, points, bumps, roughness, roughness > 0 && [hurst, rolloff, cutoff, form, domain === "surface" && [peklenik, angle], skewness, kurtosis, seed]]);
}

/** The dots of contacts that a person has seen of what is pressed now. */
function dotsOf(style, x, y) {
  const own = pressedOf(knobs);
  const its = visitedContacts.filter((seen) => pressedOf(seen.its) === own);
  return its.map(({ numbers: told }) => ({ style, at: [told[x], told[y]] })).filter(({ at: [a, b] }) => a > 0 && Number.isFinite(b));
}

/** Upper end of the axis of kappa. */
function topOf(curves, dots = [], shown = 0) {
  const highest = Math.max(0, guess?.top ?? 0, ...curves.flatMap(({ points }) => points.map(([, value]) => value)), ...dots.map(({ at }) => at[1]));
  const tops = [...TOPS, ...HIGHER_TOPS];
  return tops.find((top) => top >= Math.max(shown, Math.min(highest, TOPS.at(-1)))) ?? tops.at(-1);
}

/** The numbers of the state that is shown, if it is that of the knobs and no question hides it; a step is under the load of its run. */
const shownNumbers = () => isOfKnobs() && !isHidden() ? { reduced_pressure: shownOrLatest()?.numbers?.reduced_pressure, ...(moment ?? shownOrLatest()).numbers } : {};

/** Rings around the numbers of the state that is shown: they go along where a run is played. */
const ringsOf = (names) => names.map(([style, of]) => ({ style, at: [shownNumbers().reduced_pressure, shownNumbers()[of]] })).filter(({ at: [load, value] }) => load > 0 && Number.isFinite(value));

/** The run whose process the charts are about; none for a sweep, and while a question asks for a curve over the load. */
function runOfProcess() {
  const run = shownOrLatest();
  return run?.process && !guess?.target && !isSweep(current()) ? run : null;
}

/** Draws both charts. */
function charts() {
  const run = runOfProcess();
  document.body.toggleAttribute("data-process", Boolean(run));
  if (run) chartsOfProcess(run);
  else if (HAS.creeping(knobs) && knobs.speed > 0) chartsOfSliding();
  else chartsOfLoads();
}

/** Where a curve over states is drawn: the columns of both quantities, and the state that is shown. */
async function chartsOfProcess(run) {
  const columns = run.ended && isKept(run) ? await facet(run, "steps").catch(() => null) : null;
  if (runOfProcess() !== run) return;
  describeCharts(columns?.step.length ?? 0, (moment?.step ?? columns?.step.at(-1) ?? 1) - 1);
  run.process.charts.forEach(([across, up], i) => chartOfStates(byId(["chart-area", "chart-kappa"][i]), run, columns, [across ?? "step", up]));
}

/** Where a loop of adhesion jumps: from a state at the end of a curve to surfaces that are apart, which are drawn at the end of the axis. */
const jumpFrom = ([x, y], up, apart) => up === "mean_pressure" ? [[x, y], [apart, y]] : [[x, y], [x, 0], [apart, 0]];

/** The curves between the jumps of some states. */
function partsOf(states, name, style) {
  const begins = states.flatMap(({ told }, i) => i === 0 || told.jump > 0 ? [i] : []);
  return begins.map((begin, i) => ({ name: i ? "" : name, style, points: states.slice(begin, begins[i + 1]).map(({ at }) => at) }));
}

/** The curves of a run that presses sticking surfaces and pulls them apart: the approach to the least gap, the retreat, and the jumps between their states and,
 * where loads are given, from surfaces that are apart and to them. */
function loopOf(states, { up, isFromApart, hasParted, apart, now }) {
  const gaps = states.map(({ at: [gap] }) => gap);
  const pressed = gaps.indexOf(Math.min(...gaps));
  const [retreat, ...further] = partsOf(states.slice(pressed), say("chart.retreat"), "computed");
  const jumps = [
    ...(isFromApart ? [jumpFrom(states[0].at, up, apart)] : []),
    ...states.flatMap(({ at, told }, i) => i > 0 && told.jump > 0 ? [[states[i - 1].at, at]] : []),
    ...(hasParted ? [jumpFrom(states.at(-1).at, up, apart)] : [])];
  return [
    ...partsOf(states.slice(0, pressed + 1), say("chart.approach"), "approach"), { ...retreat, now }, ...further,
    ...jumps.map((line, i) => ({ name: i ? "" : say("chart.jumps"), style: "jump", points: line })),
  ];
}

/** What theories say of the pull-off in a chart of pressures: their names, styles and values. */
function theoriesOfPullOff(run, up) {
  if (up !== "mean_pressure" || !run.pull_off) return [];
  const { jkr, dmt } = run.pull_off;
  return [{ name: "JKR", style: "exact", value: jkr }, { name: "DMT", style: "persson", value: dmt }].filter(({ value }) => value !== null);
}

/** Whether a run presses surfaces that stick, and then pulls them apart. */
const isPulledOff = (run) => processOf(run) === "adhesion" && isOwn(run.knobs) && (run.knobs.pull > 0 || isAtGaps(run.knobs));
/** How much longer than its curves the axis of a loop over loads is, to show where surfaces that are apart come from. */
const BEYOND = 1.25;

/** A chart over the states of a run, with the contacts that a hand has found. */
function chartOfStates(target, run, columns, [across, up]) {
  const modulus = modulusOf(run.numbers);
  const [xs, ys] = [across, up].map((name) => columns?.[name] ?? []);
  const states = xs.map((x, i) => ({ at: [x, ys[i]], told: rowOf(columns, i) })).filter(({ at, told }) => at.every(Number.isFinite) && !isParted(told));
  const points = states.map(({ at }) => at);
  const isLoop = isPulledOff(run) && points.length > 0;
  const theories = isLoop ? theoriesOfPullOff(run, up) : [];
  const isFromApart = isLoop && !isAtGaps(run.knobs);
  const hasParted = xs.length > 0 && isParted(rowOf(columns, xs.length - 1));
  const dots = dotsOf("computed", across, up);
  const shownAt = moment?.numbers ?? run.numbers ?? {};
  const now = isParted(shownAt) ? [NaN, NaN] : [shownAt[across] ?? xs.at(-1), shownAt[up]];
  const axis = (i, name) => {
    const own = [...points, ...dots.map(({ at }) => at)].map((at) => at[i]);
    const values = [...own, ...(i ? theories.map(({ value }) => value) : isFromApart ? [BEYOND * Math.max(...own)] : [])];
    const unit = shortUnit(kindOf(name), Math.max(...values.map(Math.abs), 0), modulus);
    return { name: inUnit(name, unit), axis: roundAxis(values, unit.size) };
  };
  const [x, y] = [axis(0, across), axis(1, up)];
  const pickState = (value, height) => {
    const away = ([a, b]) => (x.axis.share(a) - x.axis.share(value)) ** 2 + (y.axis.share(b) - y.axis.share(height)) ** 2;
    const nearest = xs.reduce((best, _, i) => away([xs[i], ys[i]]) < away([xs[best], ys[best]]) ? i : best, 0);
    if (columns) seekStep(columns.step[nearest]);
  };
  const ring = now.every(Number.isFinite) && points.length ? now : null;
  const [first, apart] = [x.axis.marks[0][0], x.axis.marks.at(-1)[0]];
  const curves = isLoop ? loopOf(states, { up, isFromApart, hasParted, apart, now: ring }) : [{ name: "", style: "computed", points, now: ring }];
  const lines = theories.map(({ name, style, value }) => ({ name, style, points: [[first, value], [apart, value]] }));
  const note = hasParted && !isLoop ? say("chart.parted") : run.ended ? "" : say("chart.running");
  chart(target, { title: y.name, name: x.name, x: x.axis, y: y.axis, curves: [...lines, ...curves], dots, note, isStale: false, now: NaN, pick: pickState });
}

/** The name of a quantity and of its unit. */
const inUnit = (name, unit) => `${say(`number.${name}`)}${unit.name ? ` / ${unit.name}` : ""}`;

/** Mean pressures at which surfaces part: that of a loop, and the limits of theory. They are numbers of a run, which no state has. */
const PULL_OFFS = ["pull_off", "jkr", "dmt"];

/** The kind of the unit of a number. */
const kindOf = (name) => known.find((row) => row.name === name)?.unit ?? (PULL_OFFS.includes(name) ? "pressure" : "1");

/** Friction and area against the speed of sliding: a dot for each speed that was seen under this load. */
function chartsOfSliding() {
  describeCharts(0, 0);
  const still = (its) => pressedOf({ ...its, speed: 0, time: 0 });
  const alike = visitedContacts.filter(({ its }) => its.speed > 0 && its.load === knobs.load && still(its) === still(knobs));
  for (const [id, up] of [["chart-area", "friction"], ["chart-kappa", "relative_area"]]) {
    const dots = alike.map(({ its, numbers: told }) => ({ style: "computed", at: [its.speed, told[up]] })).filter(({ at }) => Number.isFinite(at[1]));
    const x = logAxis(dots.map(({ at }) => at[0]), [-4, 2], roomOf(byId(id)).wide);
    const unit = shortUnit(kindOf(up), Math.max(0, ...dots.map(({ at }) => at[1])), LIMITS.modulus);
    const y = roundAxis(dots.map(({ at }) => at[1]), unit.size);
    chart(byId(id), { title: inUnit(up, unit), name: "Vτ/L", x, y, curves: [], dots, note: dots.length > 1 ? "" : say("chart.speeds"), isStale: false, now: knobs.speed, pick: null });
  }
}

/** Draws area and kappa against the load; a sweep of another surface than that of the knobs is grey, and says so. */
function chartsOfLoads() {
  const { sweep: shown } = report;
  const points = shown ? shown.points : [];
  const isStale = points.length > 0 && pressedOf(shown.knobs) !== pressedOf(knobs);
  const note = isStale ? say("chart.stale") : "";
  const curve = (name, style, of) => ({ name, style, points: points.map((p) => [p.reduced_pressure, of(p)]).filter(([, v]) => Number.isFinite(v)) });
  const overLoad = (target, title, top, curves, dots, rings) => {
    const loads = [...curves.flatMap((it) => it.points), ...[...dots, ...rings].map(({ at }) => at)].map(([load]) => load);
    const x = logAxis(loads, USUAL_LOADS, roomOf(target).wide);
    const y = linearAxis(0, top, [0, top / 2, top].map((value) => [value, inLocale(String(value))]));
    chart(target, { title, name: "p*", x, y, curves, dots, rings, note, isStale, now: isOfKnobs() && !isHidden() ? shownNumbers().reduced_pressure : knobs?.load, pick: pickLoad });
  };
  overLoad(byId("chart-area"), say("chart.area"), 1, [
    curve("Persson", "persson", (p) => p.persson ?? NaN), curve("a_rel", "computed", (p) => p.relative_area),
    curve(say("chart.exact"), "exact", (p) => p.exact?.relative_area), ...guessOf("chart-area")], dotsOf("computed", "reduced_pressure", "relative_area"), ringsOf([["computed", "relative_area"]]));
  if (knobs.domain === "surface" && !byId("top-box").hidden && LEAKS.includes(shownMap)) chartOfLeak(); else chartOfKappas(overLoad, curve);
  describeCharts(points.length, points.findLastIndex(({ load }) => load <= (moment?.numbers.load ?? knobs.load)));
  Object.assign(document.body.dataset, { sweep: shown ? (shown.ended ? "ended" : points.length) : "none", stale: isStale });
}

/** How much leaks against the load: a dot for each load that was seen. */
function chartOfLeak() {
  const target = byId("chart-kappa");
  const dots = dotsOf("computed", "reduced_pressure", "hydraulic_gap_x").filter(({ at }) => at[1] > 0);
  const unit = shownUnit("length", Math.max(0, ...dots.map(({ at }) => at[1])));
  const x = logAxis(dots.map(({ at }) => at[0]), USUAL_LOADS, roomOf(target).wide);
  const y = logAxis(dots.map(({ at }) => at[1] / unit.size), [-3, 3], roomOf(target).high);
  const scaled = dots.map(({ style, at: [load, gap] }) => ({ style, at: [load, gap / unit.size] }));
  chart(target, { title: `${say("chart.leak")} / ${unit.name}`, name: "p*", x, y, curves: [], dots: scaled, note: scaled.length > 1 ? "" : say("chart.loads"), isStale: false, now: knobs.load, pick: null });
}

function chartOfKappas(overLoad, curve) {
  const kappas = [
    curve("Persson", "persson", (p) => (p.persson ?? NaN) / p.reduced_pressure), curve("κ", "computed", (p) => p.kappa),
    curve("κ_r", "second", (p) => p.kappa_r), curve(say("chart.exact"), "exact", (p) => p.exact?.kappa_r), ...guessOf("chart-kappa")];
  const dots = [...dotsOf("computed", "reduced_pressure", "kappa"), ...dotsOf("second", "reduced_pressure", "kappa_r")];
  const rings = ringsOf([["computed", "kappa"], ["second", "kappa_r"]]);
  overLoad(byId("chart-kappa"), say("chart.kappa"), topOf(kappas, dots, Math.max(0, ...rings.map(({ at }) => at[1]))), kappas, dots, rings);
}

/** Tells both charts as sliders: how many places they have, and which of them is shown. */
function describeCharts(count, at) {
  for (const target of [byId("chart-area"), byId("chart-kappa")]) {
    target.tabIndex = count ? 0 : -1;
    target.ariaValueMin = 0;
    target.ariaValueMax = Math.max(1, count - 1);
    target.ariaValueNow = Math.max(0, at);
    target.setAttribute("aria-valuetext", moment ? moment.name : say("moment.load", { load: figure(knobs.load, 4) }));
  }
}

/** The load of a sweep that is nearest to one, as the knob has it or as the chart does; none of a sweep without loads. */
function nearestLoad({ points }, load, of = "load") {
  const away = (point) => Math.abs(Math.log(point[of] / load));
  return points.reduce((best, point) => best && away(best) <= away(point) ? best : point, null);
}

/** Shows the load of the sweep that is nearest to one, in the viewer, the table and the picture. */
function pickLoad(load) {
  const point = report.sweep && nearestLoad(report.sweep, load, "reduced_pressure");
  if (point) showLoad(point);
}

/** Goes from one state of a process, or load of the sweep, to its neighbours by keys. */
function stepChart(event) {
  const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
  if (!by || event.currentTarget.tabIndex < 0) return;
  event.preventDefault();
  const run = runOfProcess();
  if (run) seekStep((moment?.step ?? run.steps.at(-1)) + by); else stepLoad(by);
}

function stepLoad(by) {
  const points = report.sweep.points;
  const load = moment?.numbers.load ?? knobs.load;
  const now = points.findLastIndex((point) => point.load <= load * (1 + 1e-9));
  showLoad(points[Math.min(points.length - 1, Math.max(0, now + by))]);
}

function showLoad(point) {
  if (isHidden()) return;
  const { id } = report.sweep;
  const run = runOf(id);
  if (shownRun !== id && run) showInViewer(id);
  if (run && isInViewer(run) && rangeOf(run)) goTo(recordingName(run), "load", point.number);
  momentOfLoad(run ?? report.sweep, point);
}
