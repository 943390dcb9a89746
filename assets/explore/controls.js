"use strict";
// The controls, and the knobs that they turn.

const byId = (id) => document.getElementById(id);
const isGfmd = (k) => k.solver.method === "gfmd";
const isMade = (k) => k.body !== "file";
const rough = (k) => isMade(k) && k.roughness > 0;

/** Every control: its group, the path of the knob that it sets if that is not its id, and what it does in physics. A slider has
 * a field beside it for values between its notches, from `least` to `most` if that is not the range of the slider. */
const CONTROLS = [
  { group: "Load", id: "load", label: "p*", kind: "range", log: true, min: -4, max: 1.5, step: 0.02, least: 1e-5, most: 1e3, wide: "load",
    tip: "Reduced pressure p* = mean pressure / (rms gradient × E*). Contact grows in proportion to it at first, and is full at p* of about 2." },
  { group: "Load", id: "hardness", label: "Hardness H_c/E*", kind: "range", min: 0, max: 0.002, step: 0.00002, most: 1,
    tip: "Hardness of the softer body over E*, a pressure above which it yields: no pressure is higher. At 0 the body is elastic. Not with GFMD." },
  { group: "Load", id: "layer", label: "Layer t/L", kind: "range", min: 0, max: 0.5, step: 0.005, most: 10,
    tip: "Thickness of an elastic layer (bonded to a rigid base, ν = 0.3) over the length of the cell. At 0 it is a half-space." },
  { group: "Surface", id: "domain", label: "Geometry", kind: "select", shown: isMade, options: { line: "Line (2-D)", surface: "Surface (3-D)" },
    tip: "A line is a profile in plane strain; a surface has both directions." },
  { group: "Surface", id: "body", label: "Shape", kind: "select",
    options: { flat: "None: rough only", round: "Cylinder / sphere", sine: "Sine", "power-law": "Power law", file: "A file of heights" },
    tip: "The smooth body under the roughness, one per periodic cell of 160 µm. Without roughness on it the exact solution is known." },
  { group: "Surface", id: "exponent", label: "Exponent n", kind: "range", min: 1, max: 12, step: 0.5, shown: (k) => k.body === "power-law",
    tip: "Profile −A rⁿ: 1 is a wedge or cone, 2 the cylinder or sphere, large values a flat punch." },
  { group: "Surface", id: "roughness", label: "Roughness", kind: "range", shown: isMade, min: 0, max: 0.01, step: 0.0002,
    tip: "Rms gradient of the roughness. At 0 the body is smooth: with the cylinder or sphere that is Hertz. A rough flat has no other scale, so there only p* counts." },
  { group: "Surface", id: "hurst", label: "Hurst H", kind: "range", min: 0.1, max: 1, step: 0.05, shown: rough,
    tip: "Hurst exponent: how heights grow with length. Small H is jagged on short waves; 0.8 is typical of fractured and ground surfaces." },
  { group: "Surface", id: "rolloff", label: "Roll-off", kind: "range", min: 1, max: 32, step: 1, unit: "waves", shown: rough,
    tip: "Waves per cell at which the self-affine spectrum begins; longer waves are all equally strong. More of them: more asperities, better statistics." },
  { group: "Surface", id: "cutoff", label: "Cut-off", kind: "range", log2: true, min: 3, max: 13, step: 0.5, unit: "waves", whole: true, shown: rough,
    tip: "Waves per cell at the short end of the spectrum. Needs at least two points per wave, and 8 to 32 for accurate areas." },
  { group: "Surface", id: "seed", label: "Seed", kind: "number", min: 0, max: 4294967295, step: 1, shown: rough, dice: true,
    tip: "Which random surface of this spectrum. The same seed gives the same surface everywhere. The dice (key D) takes another." },
  { group: "Surface", id: "points", label: "Points", kind: "range", power2: true, min: 5, max: 18, step: 1, whole: true, shown: isMade,
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
    options: { traces: "traces", "profile mesh": "shape", fields: "fields", mask: "contact", spectrum: "spectrum", stress: "stress below", fringes: "fringes" },
    tip: "What the viewer gets of each step: curves, profile or relief, pressure and gap, contact, power spectra of each wavelength; below the surface the largest shear stress in colour, and as the fringes that a photoelastic model shows between crossed polarisers." },
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
  buildHeights();
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
  const unit = control.unit ? [" ", element("small", {}, control.unit)] : [];
  line.append(control.kind === "checks" ? element("span", {}, control.label) : element("label", { for: id }, control.label, ...unit));
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
    line.append(control.dice ? button("dice", "⚄ Dice", control.tip, dice) : field(control));
  }
  line.addEventListener("input", (event) => { if (!event.target.matches(".value")) { take(control); changed(); } });
  explain(line, control.tip);
  return line;
}

/** The field beside a slider: its value, to be read and to be typed. */
function field(control) {
  const [least, most] = limits(control);
  const step = control.whole ? "1" : "any";
  const unit = control.unit ? `, ${control.unit}` : "";
  const made = element("input", { type: "number", class: "value", id: `control-${control.id}-value`, min: `${least}`, max: `${most}`, step, "aria-label": `${control.label}${unit}, typed` });
  made.addEventListener("change", () => typed(control, made));
  return made;
}

const limits = (control) => [control.least ?? fromSlider(control, control.min), control.most ?? fromSlider(control, control.max)];

/** Takes a typed value into the knobs, or says which ones can be. */
function typed(control, input) {
  if (input.value === "" || !input.checkValidity()) {
    const [least, most] = limits(control);
    fault(`${control.label} cannot be ${input.value || "empty"}: give ${control.whole ? "a whole number, " : ""}${least} to ${most}.`);
    show();
    return;
  }
  set(control, Number(input.value));
  changed();
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
  if (control.kind === "select") set(control, input.value);
  else if (control.kind === "checks") set(control, [...input.querySelectorAll("input:checked")].flatMap(parts));
  else set(control, fromSlider(control, Number(input.value)));
}

function set(control, value) {
  const [holder, name] = place(control);
  holder[name] = value;
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
  if (knobs.domain === "surface" || knobs.body === "file") knobs.bumps = [];
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
    const beside = byId(`${id}-value`);
    if (beside) {
      beside.value = String(value);
      input.setAttribute("aria-valuetext", control.unit ? `${value} ${control.unit}` : String(value));
    }
    byId(`row-${control.id}`).hidden = control.shown ? !control.shown(knobs) : false;
  }
  showHeights();
}

function dice() {
  knobs.seed = Math.floor(Math.random() * 1e6);
  byId("control-seed").value = knobs.seed;
  changed();
}
