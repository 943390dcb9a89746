// Watching a solver converge, alone or in a race with another one on the same contact: the contact step by step, the error by wavelength, the
// certificate and the numbers. The clock is the work that has been done, in transforms, which are most of it in all solvers.

/** Seconds that a race takes, and how many stills there are of it where the system wants no motion. */
const RACE = { seconds: 14, stills: 14 };
/** The lowest error of the pictures, as a power of ten. */
const LOWEST = -8;
/** The share of a race at which the lane with the least work ends, at least, and the powers of time by which this is made. */
const EARLIEST = 0.3;
const POWERS = [2, 6];
/** How many times the work of the winner is about as much. */
const CLOSE = 1.1;
/** Highest value of the numbers over their final ones. */
const HIGHEST = 2;
/** Styles of the lanes, and their colours. */
const LANES = ["computed", "second"];
const PAINTS = ["accent", "warm"];

/** The solvers that a run can race with.
 * @type {[string, () => any][]} */
const RIVALS = [
  ["multilevel", () => ({ method: "multilevel" })], ["polonsky-keer", () => ({ method: "polonsky-keer" })],
  ["gfmd-uniform", () => ({ method: "gfmd", ...defaultsOf("gfmd", "damped"), masses: "uniform" })], ["gfmd-stiffness", () => ({ method: "gfmd", ...defaultsOf("gfmd", "damped"), masses: "stiffness" })],
];

/** The lanes, how much work the clock shows, and the most of all lanes; none while the dialog is closed. */
let race = null;

function beginRace() {
  byId("watch").addEventListener("click", () => watch(shownOrLatest()));
  byId("race-dialog").addEventListener("close", endRace);
  byId("race-rival").append(element("option", { value: "" }, say("race.none")), ...RIVALS.map(([name]) => element("option", { value: name }, say(`race.${name}`))));
  byId("race-rival").addEventListener("change", chooseRival);
  byId("race-play").addEventListener("click", () => race?.playing ? stopRace() : playRace());
  byId("race-back").addEventListener("click", () => stepRace(-1));
  byId("race-on").addEventListener("click", () => stepRace(1));
  byId("race-scrub").addEventListener("input", () => { stopRace(); showWork(workAt(Number(byId("race-scrub").value) / 1000)); });
  new ResizeObserver(() => { if (race?.lanes) drawRace(); }).observe(byId("race-dialog"));
}

/** Opens the dialog on a run, and on another one beside it. */
async function watch(run, other = null) {
  if (!run?.ended) { fault(say("why.early")); return; }
  const { dialog, mine } = openRace(run);
  byId("race-rival").disabled = isOfStates(run);
  byId("race-rival").value = "";
  if (isOfStates(run)) noteRace(say("race.states"));
  if (!dialog.open) dialog.showModal();
  await Promise.all([run, other].filter(Boolean).map(laneOf)).then((lanes) => { if (race === mine) setLanes(lanes); }, (error) => noteRace(error.message));
  if (race === mine) await findCures(run);
}

function openRace(run) {
  endRace();
  race = { run, lanes: null, at: 0, most: 1, power: 1, playing: null };
  byId("race-title").replaceChildren(...unbroken(say("race.title", { title: titleOf(run) })));
  byId("race-lanes").replaceChildren();
  byId("race-cures").replaceChildren();
  noteRace(say("race.waiting"));
  return { dialog: byId("race-dialog"), mine: race };
}

function endRace() {
  if (!race) return;
  stopRace();
  if (race.isSolving) cancel();
  race = null;
  numbers();
}

const noteRace = (sentence) => { byId("race-note").textContent = sentence; };

/** The name of the solver of a run, as in the list of those to race with. */
function solverOf({ knobs: { solver: { method, masses, dynamics, damping } } }) {
  if (method !== "gfmd") return say(`race.${method}`);
  const its = dynamics === "fire" ? ", FIRE" : damping === 1 ? "" : `, ${say("race.damping", { damping: figure(damping, 2) })}`;
  return `${say(`race.gfmd-${masses}`)}${its}`;
}

/** What is known of a run step by step, and where it is drawn. */
async function laneOf(run) {
  const [steps, motion, end] = await Promise.all(["steps", "motion", "section"].map((name) => facet(run, name)));
  const lane = { run, steps, motion, end, why: null, name: solverOf(run), work: steps.transforms, picture: element("canvas", { role: "img", class: "race-section" }), bars: element("canvas", { role: "img", class: "race-errors" }), told: element("p", {}), shown: null, finals: null };
  const numbersOf = (name) => steps[name].at(-1);
  lane.finals = { kappa_r: numbersOf("kappa_r"), relative_area: numbersOf("relative_area") };
  return lane;
}

/** Shows lanes from their first step on, and plays them unless the system wants no motion. */
function setLanes(lanes) {
  race.lanes = lanes;
  const ends = lanes.map(({ work }) => Math.max(1, work.at(-1)));
  race.most = Math.max(...ends);
  race.power = Math.min(POWERS[1], Math.max(POWERS[0], Math.log(Math.min(...ends) / race.most) / Math.log(EARLIEST)));
  const every = lanes.flatMap(({ motion, end }) => [...motion.sections, end]);
  race.axes = { ...axesOf(every), pressure: 1.25 * Math.max(...lanes.map(({ end }) => end.highest_pressure)) };
  byId("race-lanes").replaceChildren(...lanes.map(({ name, picture, bars, told }, i) => element("section", { class: "race-lane" }, element("h3", { class: `of-${LANES[i]}` }, name), picture, told, bars)));
  const isSurface = lanes[0].end.y !== null;
  noteRace([say(lanes.length > 1 ? "race.clock" : "race.alone"), isSurface && say("race.cut")].filter(Boolean).join(" "));
  tellGoals();
  for (const lane of lanes) facet(lane.run, "why").then((why) => { lane.why = why; lane.shown = null; if (race?.lanes === lanes) showWork(race.at); }, () => {});
  document.body.dataset.race = lanes.map(({ run }) => run.id).join(" ");
  showWork(0);
  drawTraces();
  if (!isCalm()) playRace();
}

/** Whether the system wants no motion. */
const isCalm = () => askSystem("(prefers-reduced-motion: reduce)").matches;

/** The work at a share of a race: the early steps, in which most happens, are slow. */
const workAt = (share) => race.most * share ** race.power;
const shareOfWork = (work) => (work / race.most) ** (1 / race.power);

/** The last row of a lane that no more work has led to than the clock shows. */
const rowAt = ({ work }) => Math.max(0, work.findLastIndex((it) => it <= race.at * (1 + 1e-9)));

/** Shows all lanes after some work. */
function showWork(work) {
  race.at = Math.min(race.most, Math.max(0, work));
  byId("race-scrub").value = String(1000 * shareOfWork(race.at));
  race.lanes.forEach(showLane);
  byId("race-work").value = say("race.work", { work: String(Math.max(...race.lanes.map((lane) => lane.work[rowAt(lane)]))) });
  for (const line of document.querySelectorAll("#race-charts .now")) placeNow(line);
}

/** Shows where a lane stands, and draws what has changed. */
function showLane(lane, place) {
  const row = rowAt(lane);
  if (row === lane.shown) return;
  lane.shown = row;
  const { steps, motion, why } = lane;
  const isEnd = row === steps.step.length - 1;
  const step = steps.step[row];
  const shown = isEnd ? lane.end : motion.sections[Math.max(0, motion.steps.findLastIndex((it) => it <= step))];
  drawLane(lane.picture, { ...shown, exact: null, shear: null, zone: null });
  drawErrors(lane.bars, why && why.errors, step, isEnd, PAINTS[place]);
  lane.told.textContent = say(isEnd ? "race.ended" : steps.level[row] ? "race.coarse" : "race.step", {
    status: statusOf(lane.run), step: figure(step), work: figure(steps.transforms[row]), certificate: figure(knownCertificate(lane, row), 2), area: figure(100 * steps.relative_area[row], 3), kappa: figure(steps.kappa_r[row], 3) });
}

function drawLane(canvas, shown) {
  const { pen, width, height } = penOf(canvas);
  if (!width || !height) return;
  const at = frame(canvas, race.axes);
  paintSection(pen, at, shown);
  Object.assign(pen, { font: FONT, fillStyle: colours().ink });
  pen.fillText(scaleInWords(shown), 6, 14);
  pen.fillText(say("label.rigid"), 6, at.top + 15);
  pen.fillText(say("label.solid"), 6, height - 8);
  canvas.ariaLabel = inWords(shown);
}

/** The error of each band of wavelengths after a step, as bars from long waves to short ones. */
function drawErrors(canvas, errors, step, isEnd, paint) {
  const { pen, width, height } = penOf(canvas);
  const colour = colours();
  const [left, below, above] = [44, 18, 20];
  const high = height - below - above;
  const y = (error) => above + high * Math.min(1, Math.max(0, Math.log10(Math.max(error, 1e-300)) / LOWEST));
  Object.assign(pen, { font: FONT, fillStyle: colour.soft, strokeStyle: colour.edge, textBaseline: "middle", textAlign: "right" });
  for (let power = 0; power >= LOWEST; power -= 4) {
    pen.fillText(power ? `1e${power}` : "1", left - 6, y(10 ** power));
    pen.fillRect(left, y(10 ** power), width - left, 0.5);
  }
  Object.assign(pen, { textAlign: "left", fillStyle: colour.ink });
  pen.fillText(say("race.errors"), left, 9, width - left);
  if (!errors) { pen.fillText(say("race.comparing"), left + 8, above + high / 4); return; }
  const at = isEnd ? null : errors.rows[Math.max(0, errors.steps.findLastIndex((it) => it <= step))];
  const wide = (width - left) / Math.max(1, errors.wavelengths.length);
  pen.fillStyle = colour[paint];
  if (isEnd) pen.fillText(say("race.solution"), left + 8, above + high / 4);
  at?.forEach((error, band) => { if (error > 0) pen.fillRect(left + band * wide + 1, y(error), Math.max(1, wide - 2), above + high - y(error)); });
  if (!errors.wavelengths.length) return;
  Object.assign(pen, { fillStyle: colour.soft, textBaseline: "bottom" });
  pen.fillText(lengthOf(errors.wavelengths[0][0], 2), left, height);
  pen.textAlign = "right";
  pen.fillText(lengthOf(errors.wavelengths.at(-1)[1], 2), width, height);
  canvas.ariaLabel = say("race.errors");
}

/** The certificate on the grid of the run, and the numbers over their final ones, against the work. */
function drawTraces() {
  const pointsOf = ({ work, steps, finals }, name) => work.map((it, row) => [it, (steps[name][row] ?? NaN) / (finals[name] ?? 1)]).filter(([, value]) => Number.isFinite(value));
  const curves = (names) => race.lanes.flatMap((lane, i) => names.map((name, j) => ({ name: say(`race.${name}`, { solver: lane.name }), style: LANES[i], isDashed: j > 0, points: pointsOf(lane, name) })));
  const certificates = race.lanes.map((lane, i) => ({ name: lane.name, style: LANES[i], points: lane.work.map((work, row) => [work, certificateAt(lane, row)]).filter(([, value]) => value > 0) }));
  const powers = certificates.flatMap(({ points }) => points.map(([, value]) => Math.log10(value)));
  const [high, low] = [Math.ceil(Math.max(0, ...powers)), Math.floor(Math.min(-2, ...powers))];
  const marks = Array.from({ length: high - low + 1 }, (_, i) => [i / (high - low), high === i ? "1" : `1e${high - i}`]);
  trace(byId("race-certificate"), say("race.certificate"), marks, (value) => (high - Math.log10(value)) / (high - low), certificates);
  trace(byId("race-numbers"), say("race.numbers"), [[0, String(HIGHEST)], [0.5, "1"], [1, "0"]], (value) => 1 - value / HIGHEST, curves(["kappa_r", "relative_area"]));
}

/** A number down to its first digit. */
function roundedDown(value) {
  const unit = 10 ** Math.floor(Math.log10(Math.max(1, value)));
  return Math.floor(value / unit) * unit;
}

/** A chart against the work, whose axis is that of the clock: `down` is the share of its height, from its top, at which a value stands. */
function trace(target, title, marks, down, curves) {
  const box = target.getBoundingClientRect();
  const [w, h] = [Math.max(160, box.width), Math.max(110, box.height)];
  const room = { left: 42, right: 12, above: 20, below: 32 };
  const [wide, high] = [w - room.left - room.right, h - room.above - room.below];
  const x = (work) => room.left + shareOfWork(work) * wide;
  const y = (share) => room.above + Math.min(1, Math.max(0, share)) * high;
  const svg = drawn("svg", { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": title });
  svg.append(drawn("text", { class: "title", x: room.left, y: 13 }, title), drawn("rect", { class: "axis", x: room.left, y: room.above, width: wide, height: high }));
  const every = Math.max(1, Math.ceil(marks.length * 16 / high));
  marks.forEach(([share, text], i) => { if (i % every === 0) svg.append(drawn("text", { x: room.left - 5, y: y(share) + 4, "text-anchor": "end" }, text)); });
  for (const work of [0, race.most / 16, race.most / 4, race.most].map(roundedDown)) svg.append(drawn("text", { x: x(work), y: h - 18, "text-anchor": "middle" }, String(work)));
  svg.append(drawn("text", { x: room.left + wide / 2, y: h - 4, "text-anchor": "middle" }, say("race.axis")));
  for (const { name, style, isDashed, points } of curves) {
    const line = drawn("polyline", { class: `${style}${isDashed ? " dashed" : ""}`, points: points.map(([work, value]) => `${x(work).toFixed(1)},${y(down(value)).toFixed(1)}`).join(" ") });
    line.append(drawn("title", {}, name));
    svg.append(line);
  }
  const now = drawn("line", { class: "now", y1: room.above, y2: room.above + high });
  Object.assign(now.dataset, { from: room.left, to: room.left + wide });
  svg.append(now);
  target.replaceChildren(svg);
  placeNow(now);
}

/** Puts the line of the clock into a chart. */
function placeNow(line) {
  const [from, to] = [line.dataset.from, line.dataset.to].map(Number);
  for (const end of ["x1", "x2"]) line.setAttribute(end, from + shareOfWork(race.at) * (to - from));
}

/** Draws all anew, after the dialog has another size. */
function drawRace() {
  race.lanes.forEach((lane) => { lane.shown = null; });
  drawTraces();
  showWork(race.at);
}

function playRace() {
  if (!race?.lanes) return;
  const begun = performance.now() - (race.at >= race.most ? 0 : shareOfWork(race.at)) * RACE.seconds * 1000;
  const tick = (now) => {
    const share = Math.min(1, Math.max(0, (now - begun) / 1000 / RACE.seconds));
    showWork(workAt(isCalm() ? Math.floor(share * RACE.stills) / RACE.stills : share));
    if (share < 1) race.playing = requestAnimationFrame(tick); else stopRace();
  };
  race.playing = requestAnimationFrame(tick);
  byId("race-play").textContent = say("play.pause");
}

function stopRace() {
  if (race?.playing) cancelAnimationFrame(race.playing);
  if (race) race.playing = null;
  byId("race-play").textContent = say("play");
}

/** Goes to the next state of any lane that is kept, or to the one before. */
function stepRace(by) {
  if (!race?.lanes) return;
  stopRace();
  const works = race.lanes.flatMap(({ steps, motion, work }) => [...motion.steps.map((step) => work[Math.max(0, steps.step.findLastIndex((it) => it <= step))]), work.at(-1)]).sort((a, b) => a - b);
  showWork((by > 0 ? works.find((work) => work > race.at + 1e-9) : works.findLast((work) => work < race.at - 1e-9)) ?? race.at);
}

/** The certificate of a row, none on a coarser grid: there it is that of another problem. */
const certificateAt = ({ steps }, row) => steps.level[row] ? null : steps.certificate[row];

/** The last certificate up to a row: some solvers find one at some steps only. */
function knownCertificate(lane, row) {
  for (let at = row; at >= 0; at--) {
    const its = certificateAt(lane, at);
    if (its !== null) return its;
  }
  return null;
}

/** The work after which a lane first had a certificate; none if it never had. */
function workFor(lane, goal) {
  const row = lane.work.findIndex((_, it) => certificateAt(lane, it) !== null && certificateAt(lane, it) <= goal);
  return row < 0 ? null : lane.work[row];
}

/** Tells who had which certificate when, and who won. */
function tellGoals() {
  const { lanes } = race;
  const tolerance = Math.max(...lanes.map(({ run }) => run.knobs.stop.tolerance));
  const goals = [...[1e-2, 1e-4, 1e-6, 1e-8].filter((goal) => goal > 3 * tolerance), tolerance].filter((goal) => lanes.some((lane) => workFor(lane, goal) !== null));
  byId("race-goals").hidden = !goals.length;
  const cell = (work) => element("td", {}, work === null ? "–" : figure(work));
  byId("race-goals").tHead.rows[0].replaceChildren(element("th", { scope: "col" }, say("race.goal")), ...lanes.map(({ name }, i) => element("th", { scope: "col", class: `of-${LANES[i]}` }, name)));
  byId("race-goals").tBodies[0].replaceChildren(...goals.map((goal) => element("tr", {}, element("th", { scope: "row" }, figure(goal, 2)), ...lanes.map((lane) => cell(workFor(lane, goal))))));
  byId("race-verdict").textContent = lanes.length > 1 ? verdict(lanes, goals) : "";
}

/** Who needed less work for the best certificate that both had. */
function verdict(lanes, goals) {
  const goal = goals.findLast((it) => lanes.every((lane) => workFor(lane, it) !== null));
  if (!goal) return "";
  const [first, second] = lanes.map((lane) => ({ name: lane.name, work: workFor(lane, goal) })).sort((a, b) => a.work - b.work);
  const places = { goal: figure(goal, 2), first: first.name, second: second.name, fewer: figure(first.work), more: figure(second.work), times: figure(second.work / Math.max(1, first.work), 2) };
  return second.work < CLOSE * first.work ? say("race.draw", places) : say("race.won", places);
}

/** Solves the contact of the run with another solver, which takes the second lane. The knobs stay. */
async function chooseRival() {
  const mine = race;
  const rival = RIVALS.find(([name]) => name === byId("race-rival").value);
  if (!mine?.lanes) return;
  stopRace();
  const [first] = mine.lanes;
  if (!rival) { setLanes([first]); return; }
  const its = painted({ ...mine.run.knobs, solver: rival[1]() });
  const before = runOfKnobs(its);
  const known = before?.numbers?.status === "converged" && isKept(before) ? before : null;
  noteRace(say("race.solving", { solver: say(`race.${rival[0]}`) }));
  mine.isSolving = !known;
  const run = known ?? await solved(its).catch((error) => { noteRace(error.message); return null; });
  mine.isSolving = false;
  if (run && race === mine) await laneOf(run).then((lane) => setLanes([first, lane]), (error) => noteRace(error.message));
}

/** The run of some knobs, which the page does not show unless they are its own, once it has ended. */
async function solved(its) {
  const { revision } = await post("solve", its);
  while (report.revision < revision || report.busy) await new Promise((done) => setTimeout(done, 20));
  const run = runOfKnobs(its);
  if (!run?.ended) throw new Error(report.fault ? inWordsOfPage(report) : say("unsolved"));
  return run;
}

/** What would help against a cause, as a change of the knobs; none where the knobs have no remedy. */
function cureOf({ cause, eta }, its) {
  const { solver, stop } = its;
  const other = ({ solver: { method: "multilevel" } });
  const cures = {
    damping: { solver: { ...solver, damping: 1 } }, masses: { solver: { ...solver, masses: "stiffness" } },
    rounding: { stop: { ...stop, tolerance: 10 ** Math.ceil(Math.log10(2 * eta)) } },
    slow_band: other, condition: other, cycle: other, plateau: other, flips: other,
  };
  const cure = cures[cause];
  return cure && words({ ...its, ...cure }) !== words(its) ? cure : null;
}

/** The name of a cure. */
function cureInWords(cause, { solver, stop }) {
  if (stop) return say("race.cure.tolerance", { tolerance: figure(stop.tolerance, 2) });
  return say(cause === "damping" ? "race.cure.damping" : cause === "masses" ? "race.cure.masses" : "race.cure.multilevel");
}

/** A button that tries a cure: the knobs change, and what comes of it races with the run before. None without a cure. */
function cureButton(found, run) {
  const cure = cureOf(found, run.knobs);
  if (!cure) return null;
  const made = element("button", { type: "button", class: "race-cure" }, say("race.try", { cure: cureInWords(found.cause, cure) }));
  made.addEventListener("click", () => tryCure(run, cure));
  return made;
}

/** Tells what held the run up, each cause with its cure, and no cure twice. */
async function findCures(run) {
  const mine = race;
  const why = await facet(run, "why").catch(() => null);
  if (race !== mine || !why) return;
  const told = new Set();
  byId("race-cures").replaceChildren(...why.causes.map((found) => {
    const made = cureButton(found, run);
    const isNew = made && !told.has(made.textContent);
    if (made) told.add(made.textContent);
    return element("li", {}, `${causeInWords(found)} `, ...(isNew ? [made] : []));
  }));
}

async function tryCure(run, cure) {
  byId("why-dialog").close();
  takeState({ ...run.knobs, ...cure });
  openRace(run);
  const mine = race;
  mine.isSolving = true;
  noteRace(say("race.solving", { solver: solverOf({ knobs }) }));
  if (!byId("race-dialog").open) byId("race-dialog").showModal();
  const before = faults;
  changed();
  while (race === mine && faults === before && !isSolved()) await new Promise((done) => setTimeout(done, 20));
  mine.isSolving = false;
  if (race !== mine) return;
  if (isSolved()) await watch(run, shownOrLatest()); else noteRace(byId("fault").textContent);
}
