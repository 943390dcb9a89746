// The three questions of the controls: what is pressed, on what, and how. Each has choices with a picture, which set some knobs and open others.

const ROUGH_LINE = "M0 12 3 14 5 11 8 18 11 13 13 20 16 14 19 9 22 16 25 22 28 15 31 10 34 17 37 13 40 19 43 12 48 12";
const BALL = "M2 2Q24 40 46 2";
const WAVE = "M0 8Q12 -4 18 10T30 20T42 8L48 6";
const DENT = "M0 20H12Q24 26 36 20H48";
/** How soft rubber becomes with time, and works of adhesion at which a rough surface, and another one, sticks in a part of it. */
const RUBBER = 9;
const STICKY = { rough: 1e-8, other: 1e-7 };
/** A friction, and half of the pull at which all slides. */
const RUBBING = { friction: 0.3, sideways: 0.5 };
const rubs = (k) => k.friction > 0 && k.sideways > 0;
/** The part of the largest elastic pressure at which a solid yields below its surface to start with. */
const YIELDS_AT = 0.4;
/** What pulls surfaces off: a cylinder is moved to gaps; reduced pressures part a ball, which at gaps has no jump under an attraction that a usual grid
 * resolves, and hardly anything else. */
const PULLS = { line: { depth: 0.5, pull: 0 }, surface: { depth: 0, pull: 0.02 }, other: { depth: 0, pull: 0.01 } };
/** Spacings over which an attraction acts at the edge of a contact, where it is as short as the grid resolves well. */
const SHORT_ZONE = 5;
/** Points over the reach of an attraction at the edge of a contact, times pi. */
const REACH = 8;

/** Choices by the group of their question: `is` says whether a state is one of them, `sets` what it puts in a state, `opens` which controls
 * stand below it, `holds` which others are of its question; `on` are the solids that it goes with, the usual one first, and `domain` the geometry that it needs. `rigid`, `solid` and
 * `sign` are the lines of its picture, 48 by 32.
 * @type {Record<string, any[]>} */
const QUESTIONS = {
  surface: [
    { id: "rough", is: (k) => k.body === "flat", sets: (k) => ({ body: "flat", roughness: k.roughness || controlOf("roughness").default }), opens: ["domain", "hurst", "cutoff", "seed"], rigid: ROUGH_LINE, solid: "M0 20Q13 24 25 22T48 20" },
    { id: "round", is: (k) => k.body === "round" && k.roughness === 0, sets: () => ({ body: "round", roughness: 0 }), opens: ["domain"], rigid: BALL, solid: DENT },
    { id: "rough-round", is: (k) => k.body === "round" && k.roughness > 0, sets: (k) => ({ body: "round", roughness: k.roughness || controlOf("roughness").default }), opens: ["domain", "roughness", "hurst", "seed"], rigid: "M2 2 7 5 9 10 14 11 16 17 20 15 23 21 27 16 31 19 34 11 38 10 40 6 46 2", solid: DENT },
    { id: "wave", is: (k) => k.body === "sine", sets: () => ({ body: "sine", roughness: 0 }), opens: ["domain", "roughness"], rigid: "M0 6C8 6 8 20 16 20S24 6 32 6 40 20 48 20", solid: "M0 22H48" },
    { id: "punch", is: (k) => k.body === "power-law", sets: () => ({ body: "power-law", roughness: 0 }), opens: ["domain", "exponent"], rigid: "M4 2C10 24 14 23 24 23S38 24 44 2", solid: "M0 20H8Q12 24 16 24H32Q36 24 40 20H48" },
    { id: "file", is: (k) => k.body === "file", take: takeFileAgain, opens: [], rigid: "M10 5H20V12H10ZM28 7H38V17H28ZM15 17H25V23H15Z", solid: "M5 1H43V27H5Z" },
    { id: "scene", is: (k) => k.body === "scene", take: takeScene, opens: [], isOffered: () => Boolean(sceneStart), rigid: "M8 4H40M8 10H32", solid: "M4 22H44" },
  ],
  solid: [
    { id: "elastic", is: () => true, opens: [], rigid: "", solid: "M0 12H10Q24 28 38 12H48" },
    { id: "coated", is: (k) => k.layer > 0, sets: () => ({ layer: 0.02 }), opens: ["layer"], rigid: "M0 24H48M4 28 8 24M16 28 20 24M28 28 32 24M40 28 44 24", solid: "M0 12H14Q24 18 34 12H48" },
    { id: "rubber", is: (k) => k.creep > 0, sets: (k) => ({ creep: RUBBER, ...withoutGfmd(k) }), opens: ["creep"], rigid: "", solid: "M0 8H10Q24 20 38 8H48M0 14H8Q24 36 40 14H48" },
    { id: "hard", is: (k) => k.hardness > 0, sets: (k) => ({ hardness: yieldingHardness(), ...withoutGfmd(k) }), opens: ["hardness"], rigid: "", solid: "M0 12H8L12 8 16 22H32L36 8 40 12H48" },
    { id: "yielding", is: (k) => HAS.yielding(k), sets: (k) => ({ "yield-stress": Number((YIELDS_AT * highestPressure()).toPrecision(2)), ...withoutGfmd(k) }), opens: ["yield-stress", "hardening"], rigid: "M18 16Q24 14 30 16Q33 23 24 27Q15 23 18 16Z", solid: "M0 12H10Q24 20 38 12H48" },
    { id: "sticky", is: (k) => k.adhesion > 0, sets: (k) => ({ adhesion: k.body === "flat" ? STICKY.rough : STICKY.other, range: rangeFor(k), solver: { method: "multilevel" } }), opens: ["adhesion", "range"], rigid: "M8 0Q24 16 40 0", solid: "M0 20Q12 20 18 9Q24 11 30 9Q36 20 48 20" },
  ],
  load: [
    { id: "pressed", is: () => true, take: takePressed, opens: [], rigid: "M8 8Q24 36 40 8", solid: DENT, sign: "M24 0V10M20 6 24 10 28 6" },
    { id: "leaking", is: (k) => k.domain === "surface" && LEAKS.includes(shownMap), take: takeLeak, opens: [], domain: "surface", rigid: "M0 10H48", solid: "M0 26H48", sign: "M2 18Q8 12 14 18T26 18T38 18H46M42 14 46 18 42 22" },
    { id: "in-time", is: (k) => k.creep > 0 && k.speed === 0 && k.time > 0, sets: () => ({ time: 1 }), opens: ["time"], on: ["rubber"], rigid: "M8 2Q24 26 40 2", solid: DENT, sign: "M24 2A8 8 0 1 1 23.9 2M24 5V10H28" },
    { id: "sliding", is: (k) => k.creep > 0 && k.speed > 0, sets: () => ({ speed: 0.5 }), opens: ["speed"], on: ["rubber"], rigid: "M8 8Q24 36 40 8", solid: "M0 20H12Q26 28 38 16L48 20", sign: "M14 4H34M30 0 34 4 30 8" },
    { id: "sideways", is: (k) => rubs(k) && !k.rolling, sets: (k) => ({ ...RUBBING, rolling: false, ...withoutGfmd(k) }), opens: ["sideways", "friction"], holds: ["rolling"], on: ["elastic", "coated"], rigid: "M8 8Q24 36 40 8", solid: DENT, sign: "M12 4H36M16 0 12 4 16 8M32 0 36 4 32 8" },
    { id: "rolling", is: (k) => rubs(k) && k.rolling, sets: (k) => ({ ...RUBBING, rolling: true, ...withoutGfmd(k) }), opens: ["sideways", "friction"], on: ["elastic", "coated"], domain: "line", rigid: "M24 4A9 9 0 1 1 23.9 4", solid: "M0 22H48", sign: "M16 13A8 8 0 0 1 32 13M28 11 32 14 35 10" },
    { id: "released", is: (k) => HAS.yielding(k) && k.release, sets: () => ({ release: true }), opens: [], holds: ["release"], on: ["yielding"], rigid: "M10 0Q24 18 38 0", solid: "M0 20H10Q24 30 38 20H48", sign: "M24 17V4M20 8 24 4 28 8" },
    { id: "pulled", is: (k) => k.adhesion > 0 && (k.pull > 0 || k.depth > 0), sets: pulledOff, opens: ["pull", "depth"], on: ["sticky"], rigid: "M8 6Q24 20 40 6", solid: "M0 26Q14 26 18 13Q24 15 30 13Q34 26 48 26", sign: "M24 12V0M20 4 24 0 28 4" },
  ],
};

/** The choice of a question that a state is. */
const choiceOf = (question, state = knobs) => QUESTIONS[question].findLast(({ is }) => is(state));

/** The knobs that the choices of a question turn. */
const turnedBy = (question) => QUESTIONS[question].flatMap(({ opens, holds = [] }) => [...opens, ...holds]);

/** The question of a control, or else its group: what a way to press opens belongs to that, whatever it is a property of. */
function questionOf({ id, group }) {
  return turnedBy("load").includes(id) ? "load" : group;
}

/** Whether a control stands below the choice of its question; the others are shown when a person asks for more. The load always is. */
function isInFront(control) {
  const question = questionOf(control);
  return !QUESTIONS[question] || control.id === "load" || choiceOf(question).opens.includes(control.id);
}

/** What all choices of a question but the plain one set, as it is to start with. */
function plainOf(question) {
  const ids = question === "surface" ? [] : turnedBy(question);
  return Object.fromEntries(CONTROLS.filter(({ id }) => ids.includes(id)).map(({ path, default: usual }) => [path.at(-1), usual]));
}

const withoutGfmd = (k) => isGfmd(k) ? { solver: { method: "multilevel" } } : {};

/** The largest pressure of what is shown. */
const highestPressure = () => section?.highest_pressure || 7e-4;

/** A hardness between the mean and the largest pressure of what is shown, at which a part of the contact yields. */
function yieldingHardness() {
  const { pressure = [1e-4] } = section ?? {};
  const mean = pressure.reduce((sum, p) => sum + p, 0) / pressure.length;
  return Number(((mean + highestPressure()) / 2).toPrecision(2));
}

/** A range of the attraction that the points of a state resolve. */
const rangeFor = ({ points }) => Number(Math.max(controlOf("range").default, Math.sqrt(REACH * STICKY.other / points)).toPrecision(2));

/** What pulls the surfaces of a state off. A cylinder has a wide loop under an attraction of short range. */
function pulledOff({ body, roughness, domain, adhesion, points }) {
  const pulls = PULLS[body === "round" && roughness === 0 ? domain : "other"];
  const range = Math.sqrt(SHORT_ZONE * Math.PI * (adhesion || STICKY.other) / points);
  return pulls === PULLS.line ? { ...pulls, range: Number(range.toPrecision(2)) } : pulls;
}

/** Resolves the attraction on the grid of another geometry, and pulls its surfaces off if those before were. */
function mendAttraction() {
  if (!HAS.adhering(knobs)) return;
  knobs.range = Math.max(knobs.range, rangeFor(knobs));
  if (choiceOf("load").id === "pulled") Object.assign(knobs, pulledOff(knobs));
}

/** Whether a way to press goes with the solid and the geometry of a state. */
const goesWith = ({ on, domain }, state) => (!on || on.includes(choiceOf("solid", state).id)) && (!domain || domain === state.domain);

/** What the plain choices put in a state.
 * @type {(state: any) => any} */
const setsNothing = () => ({});

/** A state with a choice. A way to press takes the solid and the geometry that it needs; what is pressed, and on what, end a way to press
 * that does not go with it. */
function withChoice(state, question, choice) {
  const { sets = setsNothing, on, domain } = choice;
  const kept = isOwn(state) ? state : { ...state, ...defaultsOf("load", "solid", "surface") };
  let next = { ...kept, ...plainOf(question), ...sets(kept) };
  if (question === "surface") next.bumps = [];
  if (on && !on.includes(choiceOf("solid", next).id)) next = withChoice(next, "solid", QUESTIONS.solid.find(({ id }) => id === on[0]));
  if (domain) next.domain = domain;
  if (question === "load") return on ? { ...next, ...sets(kept) } : next;
  return goesWith(choiceOf("load", state), next) ? next : { ...next, ...plainOf("load") };
}

/** What a person sees of a state beside a choice of a question, in words. */
const consequences = (question, state) => [
  ...Object.keys(QUESTIONS).filter((other) => other !== question).map((other) => say(`choice.${choiceOf(other, state).id}`)),
  optionOf(controlOf("domain"), state.domain), optionOf(controlOf("solver"), state.solver.method)];

/** Solves a choice, and says what else it has changed. */
function takeChoice(question, choice) {
  if (choice === choiceOf(question)) return;
  if (choice.take) { choice.take(choice); return; }
  put(question, choice);
}

function put(question, choice) {
  const { beside: others, scene: _, ...state } = knobs;
  const before = consequences(question, knobs);
  const next = withChoice(state, question, choice);
  const isOther = next.domain !== knobs.domain;
  const isCoarser = HAS.yielding(next) !== HAS.yielding(knobs);
  knobs = structuredClone(others && !isOther ? { ...next, beside: others } : next);
  if (isOther || isCoarser) mend("domain");
  mend("body");
  tellChanges(choice, before, consequences(question, knobs));
  show();
  changed();
}

function tellChanges({ id }, before, after) {
  const changes = after.flatMap((word, i) => word === before[i] ? [] : [say("choice.changed", { choice: say(`choice.${id}`), before: before[i], after: word })]);
  hint(changes.join(" ") || say(`choice.${id}.tip`));
}

/** Presses the file once more, or asks for one. */
function takeFileAgain() {
  if (description) takeDescription(description); else openFile();
}

function takeScene() {
  knobs.body = "scene";
  mend("body");
  show();
  changed();
}

/** Presses and no more, and shows the pressures. */
function takePressed(choice) {
  put("load", choice);
  if (LEAKS.includes(shownMap)) chooseMap("pressure");
  showChoices();
}

/** Shows where a surface leaks. */
function takeLeak(choice) {
  put("load", choice);
  chooseMap("flux");
  showChoices();
}

/** A question with its choices; its controls follow. */
function questionGroup(question) {
  const title = element("h2", { id: `summary-${question}` }, say(`group.${question}`));
  const offered = QUESTIONS[question].filter(({ isOffered = () => true }) => isOffered());
  const choices = element("div", { class: "choices", id: `choices-${question}` }, ...offered.map((choice) => choiceButton(question, choice)));
  return element("section", { class: "question", id: `group-${question}`, role: "group", "aria-labelledby": title.id }, title, choices);
}

function choiceButton(question, choice) {
  const { id, rigid, solid, sign = "" } = choice;
  const made = button(`choice-${id}`, "", say(`choice.${id}.tip`), () => takeChoice(question, choice));
  const picture = drawn("svg", { viewBox: "0 0 48 32", "aria-hidden": "true" });
  picture.append(drawn("path", { class: "second", d: rigid }), drawn("path", { class: "computed", d: solid }), drawn("path", { class: "sign", d: sign }));
  made.append(picture, element("span", {}, say(`choice.${id}`)));
  return made;
}

/** The button that shows the other controls of a question. */
function moreButton(question) {
  const made = button(`more-${question}`, "", say("question.more.tip"), () => openMore(question, made.ariaExpanded !== "true"));
  made.ariaExpanded = "false";
  made.classList.add("fold");
  return made;
}

function openMore(question, isOpen) {
  byId(`more-${question}`).ariaExpanded = String(isOpen);
  show();
}

/** Whether the load can be swept: not of what has a history. */
const canSweep = () => !["sticky", "yielding"].includes(choiceOf("solid").id) && ["pressed", "leaking", "sliding"].includes(choiceOf("load").id);

/** Marks the choices that the knobs are, and shows the controls that they open. */
function showChoices() {
  for (const [question, choices] of Object.entries(QUESTIONS)) {
    const taken = choiceOf(question);
    for (const { id } of choices) byId(`choice-${id}`)?.setAttribute("aria-pressed", String(taken.id === id));
    byId(`choices-${question}`).hidden = question !== "surface" && !isOwn(knobs);
    const its = CONTROLS.filter((control) => questionOf(control) === question && HAS[control.scenes](knobs));
    const folded = its.filter((control) => !isInFront(control));
    const more = byId(`more-${question}`);
    const isOpen = more.ariaExpanded === "true";
    for (const control of folded) byId(`row-${control.id}`).hidden = !isOpen;
    more.hidden = folded.length === 0;
    more.textContent = isOpen ? say("question.less") : moreInWords(folded, taken);
  }
  Object.assign(byId("sweep"), { disabled: !canSweep(), title: say(canSweep() ? "control.sweep.tip" : "control.sweep.never") });
  sketchLay();
}

/** How many of the controls that are folded away are not as the choice of their question has them; the points follow the geometry. */
function moreInWords(folded, { sets = setsNothing }) {
  const usual = sets(knobs);
  const turned = folded.filter(({ id, kind, path, default: first }) => id !== "points" && kind === "number" && knobs[path[0]] !== (usual[path[0]] ?? first)).length;
  return turned ? say("question.more.set", { count: turned }) : say("question.more");
}

/** Waves of the sketch of a lay, and the pixels along its sides. */
const SKETCH = { waves: 40, side: 72 };

/** A sketch of waves with the Peklenik number and the lay of the knobs, as the map of the surface shows them. */
function sketchLay() {
  const canvas = byId("lay-sketch");
  byId("row-lay-sketch").hidden = byId("row-peklenik").hidden;
  if (byId("row-lay-sketch").hidden) return;
  const { peklenik, "lay-angle": angle } = knobs;
  const [along, across] = [1 / Math.sqrt(peklenik), Math.sqrt(peklenik)];
  const [cos, sin] = [Math.cos(angle * Math.PI / 180), Math.sin(angle * Math.PI / 180)];
  const waves = Array.from({ length: SKETCH.waves }, (_, i) => {
    const [turn, length] = [i * 2.39996, 0.35 * (1 + i % 5 / 4)];
    return [along * length * Math.cos(turn), across * length * Math.sin(turn), i * i * 1.7];
  });
  const image = new ImageData(SKETCH.side, SKETCH.side);
  for (let i = 0; i < SKETCH.side ** 2; i++) {
    const [x, y] = [i % SKETCH.side, Math.floor(i / SKETCH.side)];
    const [u, v] = [x * cos + y * sin, y * cos - x * sin];
    const height = waves.reduce((sum, [p, q, phase]) => sum + Math.cos(p * u + q * v + phase), 0) / Math.sqrt(SKETCH.waves / 2);
    image.data.set([...colourOf(RAMPS.gap, 0.5 + height / 4), 255], 4 * i);
  }
  Object.assign(canvas, { width: SKETCH.side, height: SKETCH.side }).getContext("2d").putImageData(image, 0, 0);
}

function beginChoices() {
  byId("row-lay-angle").after(element("div", { class: "row wide", id: "row-lay-sketch" }, element("span", {}, say("lay.sketch")), element("canvas", { id: "lay-sketch", role: "img", "aria-label": say("lay.sketch.words") })));
  byId("maps").addEventListener("click", showChoices);
}
