// Units: pressures over the contact modulus E*, or those of a solid that people know.

/** Young's modulus in pascals and Poisson's ratio of solids, round values of handbooks.
 * @type {Record<string, [number, number]>} */
const MATERIALS = { steel: [210e9, 0.3], aluminium: [70e9, 0.33], pmma: [3e9, 0.37], rubber: [5e6, 0.5], silicone: [2e6, 0.5] };
/** The largest cell that can be typed, in micrometres. */
const MOST_MICROMETRES = 1e6;
const MICROMETRE = 1e-6;

/** The solid whose pressures are shown, none for pressures over E*, and the length of the cell of surfaces that the knobs make. */
let material = localStorage.getItem("material") ?? "";
let cellLength = Number(localStorage.getItem("cell")) || LIMITS.cell;

/** Units of pressures in pascals, and of energies per area, the largest first.
 * @type {[string, number][]} */
const PRESSURES = [["GPa", 1e9], ["MPa", 1e6], ["kPa", 1e3], ["Pa", 1]];
/** @type {[string, number][]} */
const ENERGIES = [["J/m²", 1], ["mJ/m²", 1e-3], ["µJ/m²", 1e-6]];

/** The contact modulus of the chosen solid below a rigid surface, E/(1 - ν²); none for a scene, which has a solid of its own. */
function chosenModulus() {
  const its = knobs?.body === "scene" ? null : MATERIALS[material];
  return its ? its[0] / (1 - its[1] ** 2) : null;
}

/** How much longer lengths are than the page has them: heights of a file and scenes have their own. */
const stretch = () => knobs && isMade(knobs) ? cellLength / LIMITS.cell : 1;

/** The largest unit of a list in which a value is one or more, or the last one.
 * @type {(units: [string, number][], value: number) => [string, number]} */
const unitFor = (units, value) => units.find(([, size]) => Math.abs(value) >= 0.9995 * size) ?? units.at(-1);

/** The unit in which a quantity of a kind is shown beside a value, and how large it is in the units of the page: metres, and pascals where E* is
 * that of the numbers. Times are in retardation times.
 * @type {(kind: string, value: number, modulus?: number) => { name: string, size: number }} */
function shownUnit(kind, value, modulus = LIMITS.modulus) {
  const [own, longer] = [chosenModulus(), stretch()];
  const found = (units, ratio) => { const [name, size] = unitFor(units, value * ratio); return { name, size: size / ratio }; };
  if (kind === "length") return found(LENGTHS, longer);
  if (kind === "pressure") return own ? found(PRESSURES, own / modulus) : { name: "E*", size: modulus };
  if (kind === "pressure length") return own ? found(ENERGIES, own / modulus * longer) : { name: "E*L", size: modulus * LIMITS.cell };
  if (kind === "time") return { name: "τ", size: 1 };
  return { name: "", size: 1 };
}

/** The same with a power of ten, where numbers up to a value would be too long for an axis. */
function shortUnit(kind, value, modulus) {
  const { name, size } = shownUnit(kind, value, modulus);
  const power = Math.floor(Math.log10(value / size || 1));
  return power >= -2 && power < 4 ? { name, size } : { name: `1e${power} ${name}`.trim(), size: size * 10 ** power };
}

/** A value with its unit. */
function withUnit(value, kind, { digits = 3, modulus = LIMITS.modulus } = {}) {
  if (!Number.isFinite(value)) return "–";
  const { name, size } = shownUnit(kind, value, modulus);
  return `${figure(Number((value / size).toPrecision(digits)), digits)}${name ? ` ${name}` : ""}`;
}

/** A pressure over the contact modulus, with its unit. */
const pressureOf = (share, digits = 3) => withUnit(share * LIMITS.modulus, "pressure", { digits });

/** The contact modulus to which the numbers of a contact belong: that of a scene is its own. */
const modulusOf = (told) => told?.max_pressure_over_modulus > 0 ? told.max_pressure / told.max_pressure_over_modulus : LIMITS.modulus;

/** Shows all that has a unit once more. */
function takeUnits() {
  localStorage.setItem("material", material);
  localStorage.setItem("cell", String(cellLength));
  byId("row-cell").hidden = !material;
  show();
  numbers();
  drawSections();
  drawTop();
  drawPatch();
  charts();
}

/** A list of solids and the length of the cell, below the choices of a solid. */
function beginUnits() {
  const option = (value) => element("option", { value }, say(`material.${value || "none"}`));
  const list = element("select", { id: "material" }, ...["", ...Object.keys(MATERIALS)].map(option));
  list.value = material in MATERIALS ? material : "";
  list.addEventListener("change", () => { material = list.value; takeUnits(); });
  const field = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", id: "cell" });
  field.value = inLocale(String(Number((cellLength / MICROMETRE).toPrecision(4))));
  field.addEventListener("change", () => {
    const value = numberFrom(field.value);
    const sentence = faultOf(say("cell"), field.value, value, [1e-3, MOST_MICROMETRES]);
    fault(sentence);
    if (!sentence) { cellLength = value * MICROMETRE; takeUnits(); }
  });
  const line = (input, name, tip) => {
    const made = element("div", { class: "row wide", id: `row-${input.id}`, title: tip }, element("label", { for: input.id, class: "name" }, name), input);
    explain(made, tip);
    return made;
  };
  byId("choices-solid").after(line(list, say("material"), say("material.tip")), line(field, say("cell"), say("cell.tip")));
  byId("row-cell").hidden = !material;
}
