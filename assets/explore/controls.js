// The controls, and the knobs that they turn.

/** An element of the page, of the kind that the page gives it.
 * @type {(id: string) => any} */
const byId = (id) => document.getElementById(id);
const isGfmd = (k) => k.solver.method === "gfmd";
const isMade = (k) => !["file", "scene"].includes(k.body);
const isOwn = (k) => k.body !== "scene";

/** Whether a state has a knob, by the scenes that have it. */
/** Whether a state moves surfaces with adhesion to gaps, and the loads follow. */
const isAtGaps = (k) => isOwn(k) && k.adhesion > 0 && k.depth > 0;
const HAS = {
  all: () => true, own: isOwn, creeping: (k) => isOwn(k) && k.creep > 0, resting: (k) => isOwn(k) && k.creep > 0 && k.speed === 0, adhering: (k) => isOwn(k) && k.adhesion > 0, pulled: (k) => HAS.adhering(k) && !isAtGaps(k), loaded: (k) => !isAtGaps(k), rubbing: (k) => isOwn(k) && k.friction > 0, yielding: (k) => isOwn(k) && k["yield-stress"] > 0, made: isMade, rough: (k) => isMade(k) && k.roughness > 0, "rough-surface": (k) => isMade(k) && k.roughness > 0 && k.domain === "surface", "power-law": (k) => k.body === "power-law",
  gfmd: isGfmd, damped: (k) => isGfmd(k) && k.solver.dynamics === "damped",
};

/** The knob of a control in a state. */
const knobOf = ({ path }, state) => path.reduce((it, name) => it?.[name], state);

/** The knobs of the program. Labels and what they do in physics are texts.
 * @type {any[]} */
const ALL_KNOBS = KNOBS.map((knob) => ({ ...knob, path: knob.path.split("."), ...(knob.id === "points" && limitsOf(knob)) }));
/** The range and the slider of a number of points, up to the largest line that the solver takes. */
function limitsOf({ range: [least], slider: [first, , step] }) {
  return { range: [least, MOST.line], slider: [first, Math.log2(MOST.line), step] };
}

/** Those with a control in the list, which are not of a file. A slider has a field beside it for values between its notches. */
const CONTROLS = ALL_KNOBS.filter(({ group }) => group && group !== "file");
/** Whether a knob takes one of the options of a list, which are words, and what it takes for one of them. */
const isList = ({ kind }) => ["choice", "switch"].includes(kind);
const optionsOf = ({ kind, options }) => kind === "switch" ? ["true", "false"] : options;
const chosenOf = ({ kind }, option) => kind === "switch" ? option === "true" : option;
const controlOf = (id) => CONTROLS.find((control) => control.id === id);

/** What the knobs of some groups or scenes are to start with, by their names. */
const defaultsOf = (...kinds) => Object.fromEntries(CONTROLS.filter(({ group, scenes }) => kinds.includes(group) || kinds.includes(scenes)).map(({ path, default: usual }) => [path.at(-1), usual]));

/** The state of the knobs, as the server takes it. */
let knobs = null;
/** The knobs that the page starts with, if those are of a scene. */
let sceneStart = null;
/** Settings of GFMD, for when it is chosen again. */
let gfmd = defaultsOf("gfmd", "damped");

/** The object in a state that holds the knob of a control, and the name of the knob in it. */
const place = ({ path }, state = knobs) => [path.slice(0, -1).reduce((it, name) => it[name], state), path.at(-1)];

function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && typeof value !== "string") made[name] = value; else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** The groups that fold away, as few people need them. */
const LATE = ["solver", "recording"];

function build() {
  byId("controls").append(...Object.keys(QUESTIONS).map(questionGroup), ...LATE.map((name) => foldable(name, false)));
  for (const control of CONTROLS) byId(`group-${questionOf(control)}`).append(row(control));
  for (const question of Object.keys(QUESTIONS)) byId(`group-${question}`).append(moreButton(question));
  beginChoices();
  byId("group-load").append(element("div", { class: "buttons" },
    button("sweep", say("control.sweep"), say("control.sweep.tip"), sweep), button("cancel", say("control.cancel"), say("control.cancel.tip"), cancel), button("undo", say("control.undo"), say("control.undo.tip"), undo)));
  offerUndo();
  buildHeights();
  byId("group-recording").hidden = Boolean(site);
  byId("control-body").querySelector("[value=scene]").hidden = !sceneStart;
  byId("controls").addEventListener("submit", (event) => event.preventDefault());
}

/** A group of controls, which folds. */
const foldable = (group, open, ...rows) =>
  element("details", { id: `group-${group}`, open }, element("summary", { id: `summary-${group}` }, say(`group.${group}`)), ...rows);

/** What unfolds an element that is folded away; none for another one. */
function folderOf(it) {
  if (it.closest("#solving")) return byId("show-solving");
  return it.closest("details:not([open])")?.querySelector("summary") ?? it.closest(".question")?.querySelector(":scope > .fold[aria-expanded=false]") ?? (it.closest(".less") ? byId("more") : null);
}

/** Unfolds what hides an element: a group, the menu, the other controls of a question, or how a contact was solved. */
function unfold(it) {
  for (let fold = it.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
  if (it.closest("[popover]:not(:popover-open)")) it.closest("[popover]").showPopover();
  if (it.closest("#solving")?.hidden) foldSolving();
  const question = it.closest(".question")?.id.replace("group-", "");
  if (it.closest(".row")?.hidden && question) openMore(question, true);
}

function button(id, label, tip, action) {
  const made = element("button", { id, type: "button", title: tip }, label);
  made.addEventListener("click", action);
  explain(made, tip);
  return made;
}

const labelOf = ({ id }) => say(`control.${id}`);
const tipOf = ({ id }) => say(`control.${id}.tip`, MOST);
const unitOf = ({ unit }) => say(`unit.${unit}`);
const optionOf = ({ id }, value) => say(`control.${id}.${String(value).replace(" ", "-")}`);

function row(control) {
  const id = `control-${control.id}`;
  const [name, tip] = [labelOf(control), tipOf(control)];
  const line = element("div", { class: "row", id: `row-${control.id}`, title: tip });
  const unit = control.unit ? [" ", element("small", {}, unitOf(control))] : [];
  line.append(control.kind === "choices" ? element("span", { class: "name" }, name) : element("label", { for: id, class: "name" }, name, ...unit));
  if (isList(control)) {
    line.classList.add("wide");
    line.append(element("select", { id }, ...optionsOf(control).map((value) => element("option", { value }, optionOf(control, value)))));
  } else if (control.kind === "choices") {
    line.classList.add("wide");
    const boxes = control.options.map((value) =>
      element("label", {}, element("input", { type: "checkbox", value, id: `${id}-${value}` }), ` ${optionOf(control, value)}`));
    line.append(element("div", { class: "checks", id, role: "group", "aria-label": name }, ...boxes));
  } else if (!control.slider) {
    line.append(typedInput(control, { id }), ...(control.id === "seed" ? [button("dice", say("control.dice"), tip, dice)] : []));
  } else {
    const [min, max, step] = control.slider.map(String);
    line.append(element("input", { type: "range", id, min, max, step }), field(control));
  }
  line.addEventListener("input", (event) => { if (event.target.type !== "text") { take(control); changed(); } });
  explain(line, tip);
  if (site && control.id === "points") line.append(element("small", { id: "points-limit" }, say("solver.points", MOST)));
  return line;
}

/** The field beside a slider: its value, to be read and to be typed. */
function field(control) {
  const name = control.unit ? `${labelOf(control)}, ${unitOf(control)}` : labelOf(control);
  return typedInput(control, { class: "value", id: `control-${control.id}-value`, "aria-label": say("control.typed", { label: name }) });
}

/** A field for a number, with either decimal mark: the browser's own fields for numbers drop a comma, and with it a factor of a hundred. */
function typedInput(control, attributes) {
  const made = element("input", { type: "text", inputmode: control.whole ? "numeric" : "decimal", autocomplete: "off", ...attributes });
  made.addEventListener("change", () => typed(control, made));
  return made;
}

/** Takes a typed value into the knobs, or says which ones can be. */
function typed(control, input) {
  const value = numberFrom(input.value);
  const sentence = faultOf(labelOf(control), input.value, value, control.range, control.whole);
  if (sentence) { fault(sentence); show(); return; }
  set(control, value);
  changed();
}

/** Why a typed number cannot be, in a sentence; none where it can.
 * @type {(label: string, text: string, value: number, range: number[], isWhole?: boolean) => string} */
const faultOf = (label, text, value, [least, most], isWhole = false) => {
  if (Number.isNaN(value)) return say("fault.number", { label });
  if (value >= least && value <= most && (!isWhole || Number.isInteger(value))) return "";
  const places = { label, value: text.trim(), least: inLocale(String(least)), most: most === Infinity ? "∞" : inLocale(String(most)) };
  return isWhole ? say("fault.typed.whole", places) : say("fault.typed", places);
};

/** The fault of the first knob of a state that cannot be, in its words; none where all can. */
function faultOfKnobs(wanted) {
  for (const control of CONTROLS.filter(({ kind }) => kind === "number")) {
    const value = knobOf(control, wanted);
    const sentence = value === undefined ? "" : faultOf(labelOf(control), String(value), Number(value), control.range, control.whole);
    if (sentence) return sentence;
  }
  return "";
}

/** Says below the controls what one does: to who points at it or is at it by keys, and to who taps its name. */
function explain(target, tip) {
  for (const event of ["mouseenter", "focusin"]) target.addEventListener(event, () => { byId("hint").textContent = tip; });
  target.addEventListener("click", (event) => {
    if (!FINGERS.matches || !event.target.closest(".name")) return;
    event.preventDefault();
    hint(tip);
  });
}

/** Whether fingers point, which cannot rest on anything. */
const FINGERS = askSystem("(pointer: coarse)");

/** Says something where hints stand. For fingers it stands at the foot of the screen until the next touch. */
function hint(sentence) {
  byId("hint").textContent = sentence;
  document.body.toggleAttribute("data-told", true);
}

function beginHint() {
  if (FINGERS.matches) byId("hint").textContent = say("hint.tap");
  document.addEventListener("pointerdown", () => document.body.removeAttribute("data-told"), true);
}

/** The parts of a recording of a checkbox. */
const parts = (box) => box.value.split(" ");
const log10 = (position) => Number((10 ** position).toPrecision(4));
const POSITION = { linear: (value) => value, log10: Math.log10, log2: Math.log2, "zero-or-log10": (value, [first]) => value === 0 ? first : Math.log10(value) };
const VALUE = { linear: (position) => position, log10, log2: (position) => Math.round(2 ** position), "zero-or-log10": (position, [first]) => position <= first ? 0 : log10(position) };
const toSlider = (control, value) => control.values ? control.values.indexOf(value) : POSITION[control.scale](value, control.slider);
const fromSlider = (control, position) => control.values ? control.values[position] : VALUE[control.scale](position, control.slider);

/** Takes the value of a control into the knobs. */
function take(control) {
  const input = byId(`control-${control.id}`);
  if (isList(control)) set(control, chosenOf(control, input.value));
  else if (control.kind === "choices") set(control, [...input.querySelectorAll("input:checked")].flatMap(parts));
  else set(control, fromSlider(control, Number(input.value)));
}

function set(control, value) {
  const [holder, name] = place(control);
  holder[name] = value;
  mend(control.id);
  show();
}

/** How many points a state has to start with: fewer where the solid yields below its surface, as each of them stands for all layers below. */
function usualPoints(state) {
  const { line, side } = HAS.yielding(state) ? LIMITS.usualYielding : { line: controlOf("points").default, side: LIMITS.side };
  return state.domain === "line" ? line : side;
}

/** The most points of a state. */
function mostPoints(state) {
  const { line, side } = HAS.yielding(state) ? LIMITS.yielding : MOST;
  return state.domain === "surface" ? Math.min(side, MOST.side) : Math.min(line, MOST.line);
}

/** A kurtosis that heights of a skewness have: it must be above 1 + skewness². */
const leastKurtosis = (skewness) => Math.ceil(10 * (1.5 + skewness ** 2)) / 10;

/** The most waves per cell that the points of a state resolve: across the lay of a surface they are shorter. */
const finestOf = ({ domain, points, peklenik }) => points / 2 / (domain === "surface" ? Math.sqrt(Math.max(peklenik, 1 / peklenik)) : 1);

/** Keeps what goes together together, when a control on which others depend has moved. */
function mend(id) {
  const { method, ...settings } = knobs.solver;
  if ("masses" in settings) gfmd = settings;
  knobs.solver = method === "gfmd" ? { method, ...gfmd } : { method };
  if (id === "body" && !isOwn(knobs)) ({ domain: knobs.domain, scene: knobs.scene } = sceneStart);
  if (id === "domain") {
    knobs.points = usualPoints(knobs);
    if (knobs.cutoff > knobs.points / 2) knobs.cutoff = knobs.points / 8;
    mendAttraction();
  }
  if (id === "skewness") knobs.kurtosis = Math.max(knobs.kurtosis, leastKurtosis(knobs.skewness));
  if (knobs.domain === "surface") knobs.rolling = false;
  if (knobs.domain === "surface") knobs.points = Math.min(knobs.points, MOST.side);
  if (knobs.domain === "surface" || knobs.body === "file") knobs.bumps = [];
  if (knobs.body === "flat" && knobs.roughness === 0) {
    if (id === "roughness") knobs.body = "round"; else knobs.roughness = controlOf("roughness").default;
  }
  if (knobs.cutoff > finestOf(knobs)) {
    if (id === "cutoff") knobs.points = 2 ** Math.ceil(Math.log2(knobs.points * knobs.cutoff / finestOf(knobs))); else knobs.cutoff = Math.floor(finestOf(knobs));
  }
  const most = mostPoints(knobs);
  if (knobs.points > most) { knobs.points = most; knobs.cutoff = Math.floor(finestOf(knobs)); }
  if (knobs.rolloff >= knobs.cutoff) knobs.rolloff = Math.max(1, Math.floor(knobs.cutoff / 2));
}

/** The least number that a field has room for without an exponent. */
const LONG = 1e-4;

/** A number as it stands in a field. */
const written = (value) => value > 0 && value < LONG ? value.toExponential() : String(value);

/** Shows the knobs in the controls. */
function show() {
  for (const control of CONTROLS) {
    const id = `control-${control.id}`;
    const input = byId(id);
    const [holder, name] = place(control);
    const value = holder[name];
    if (isList(control)) input.value = value;
    else if (control.kind === "choices") input.querySelectorAll("input").forEach((box) => { box.checked = value.includes(parts(box)[0]); });
    else input.value = toSlider(control, value);
    const beside = byId(`${id}-value`);
    if (beside) {
      beside.value = inLocale(written(value));
      input.setAttribute("aria-valuetext", control.unit ? `${value} ${unitOf(control)}` : beside.value);
    }
    byId(`row-${control.id}`).hidden = !HAS[control.scenes](knobs);
  }
  showChoices();
  showHeights();
  markState();
}

function dice() {
  knobs.seed = Math.floor(Math.random() * 1e6);
  byId("control-seed").value = knobs.seed;
  changed();
}
