// A contact of a surface from above: its pressure, its gap, its patches or what flows through it, and where the section cuts it.

/** What a map shows: fields of the contact, its patches, further fields of its state, its leakage, and the contact in space. */
const MAPS = ["pressure", "gap", "height", "patches", "traction", "slip", "attraction", "flux", "fluid", "solid"];
const LEAKS = ["flux", "fluid"];
/** Room around a map for its axes, in pixels, and the width of its colour bar. */
const MARGIN = { left: 44, right: 92, above: 10, note: 24, below: 34 };
const BAR = 14;
/** Colours from the lowest to the highest value: of pressures, from where nothing touches on, of gaps, of the leakage, and of what has two signs. */
const RAMPS = {
  pressure: [[0x5a, 0x1e, 0x63], [0x93, 0x2b, 0x63], [0xcb, 0x46, 0x4b], [0xf6, 0x92, 0x1f], [0xfd, 0xf3, 0xa0]],
  gap: [[0x0b, 0x3c, 0x5d], [0x1f, 0x7a, 0x8c], [0x62, 0xb6, 0xa0], [0xb9, 0xdf, 0xb2], [0xf2, 0xf7, 0xe4]],
  leak: [[0x14, 0x2a, 0x5c], [0x1f, 0x66, 0xb0], [0x35, 0xa7, 0xdc], [0x9a, 0xdc, 0xf0], [0xff, 0xff, 0xff]],
  signed: [[0x1f, 0x4e, 0x9c], [0x7f, 0xb2, 0xe5], [0xd9, 0xd9, 0xd9], [0xf0, 0xa8, 0x5a], [0xa8, 0x4b, 0x00]],
};
/** Symbols of what maps show. */
const SYMBOLS = { pressure: "p", gap: "g", height: "h", traction: "τ", slip: "s", attraction: "σ" };
/** Colours of patches, taken in turn. */
const PATCHES = [[0xe6, 0x9f, 0x00, 255], [0x56, 0xb4, 0xe9, 255], [0x00, 0x9e, 0x73, 255], [0xf0, 0xe4, 0x42, 255], [0xd5, 0x5e, 0x00, 255], [0xcc, 0x79, 0xa7, 255]];
/** The colour of what touches in a map of gaps. */
const TOUCHING = [0xd5, 0x5e, 0x00, 255];
/** Colours of a ramp that a map is painted with. */
const SHADES = 256;

/** The map that is shown, and where the section that a person has chosen cuts it, as a share of its rows; none for the row of the largest
 * pressure. */
let above = null;
let cut = null;
let shownMap = "pressure";

/** Shows a map of the contact of which the section is shown; without one the map of before is pale, as it is of another state. */
function showTop(its) {
  const isLine = !section || section.y === null;
  if (isLine) cut = null;
  above = isLine ? null : its ?? above;
  byId("top-box").hidden = !above;
  byId("top-box").toggleAttribute("data-stale", Boolean(above) && !its);
  drawTop();
}

/** The section along a row of a map, on the axes of a section of the same contact. */
function sectionAlong(its, share, like) {
  const [rows, columns] = its.shape;
  const row = Math.min(rows - 1, Math.floor(share * rows));
  const along = (all) => all.slice(row * columns, (row + 1) * columns);
  const [rigid, gap, pressure] = [its.rigid, its.gap, its.pressure].map(along);
  const fields = Object.fromEntries(Object.entries(its.fields).map(([name, field]) => [name, along(field.values)]));
  const solid = rigid.map((z, i) => z - gap[i]);
  const y = row / rows * its.size[0];
  const isItsRow = Math.abs(y - like.y) < 0.5 * its.size[0] / rows;
  return { ...like, y, rigid, solid, pressure, highest_pressure: Math.max(...pressure), fields, exact: null, shear: null, zone: isItsRow ? like.zone : null };
}

/** The section that is to be shown of a contact: its own, or where a person has cut its map. */
const sectionOfCut = (own, its) => cut === null || !its || own.y === null ? own : sectionAlong(its, cut, own);

/** Places of a map in pixels. */
function frameOfTop() {
  const { width: w, height: h } = byId("top").getBoundingClientRect();
  const top = noteOfTop() ? MARGIN.note : MARGIN.above;
  const [wide, high] = [Math.max(1, w - MARGIN.left - MARGIN.right), Math.max(1, h - top - MARGIN.below)];
  const [ly, lx] = above.size;
  const scale = Math.min(wide / lx, high / ly);
  return { w, h, x: MARGIN.left, y: top, wide: lx * scale, high: ly * scale };
}

/** The colour of a share of a ramp. */
function colourOf(ramp, share) {
  const place = Math.min(1, Math.max(0, share)) * (ramp.length - 1);
  const part = Math.min(ramp.length - 2, Math.floor(place));
  return ramp[part].map((from, i) => Math.round(from + (place - part) * (ramp[part + 1][i] - from)));
}

/** The values of a map: row by row, with their kind, their ends, their colours, and how the colours follow them. Places without a value have
 * none: what does not touch has no pressure.
 * @type {(name: string) => any} */
function mapOf(name) {
  const { shape, pressure, gap, highest_pressure: highest, fields } = above;
  const most = (values) => values.reduce((best, it) => Math.max(best, Math.abs(it ?? 0)), 0) || 1;
  if (name === "pressure") return { shape, values: pressure.map((p) => p > 0 ? p * LIMITS.modulus : null), kind: "pressure", low: 0, high: highest * LIMITS.modulus, ramp: RAMPS.pressure, power: 1 };
  if (name === "gap") return { shape, values: gap, kind: "length", low: 0, high: most(gap), ramp: RAMPS.gap, power: 1 };
  if (name === "height") return heightMap();
  if (LEAKS.includes(name)) {
    const { shape: its, flux, fluid } = leakOfTop.axes[0];
    return name === "flux" ? { shape: its, values: flux.map((it) => it || null), kind: "1", low: 0, high: most(flux), ramp: RAMPS.leak, power: 0.5 } : { shape: its, values: fluid, kind: "1", low: 0, high: 1, ramp: RAMPS.leak, power: 1 };
  }
  const { unit, values } = fields[name];
  const own = values.map((it, i) => pressure[i] > 0 || name === "attraction" ? it * (unit === "pressure" ? LIMITS.modulus : 1) : null);
  const isSigned = name !== "attraction";
  return { shape, values: own, kind: unit, low: isSigned ? -most(own) : 0, high: most(own), ramp: isSigned ? RAMPS.signed : RAMPS.gap, power: 1 };
}

/** The heights of the surface over their mean, of which the highest touch first. */
function heightMap() {
  const { shape, rigid } = above;
  const mean = rigid.reduce((sum, z) => sum + z, 0) / rigid.length;
  const values = rigid.map((z) => mean - z);
  const [low, high] = values.reduce(([least, most], z) => [Math.min(least, z), Math.max(most, z)], [0, 0]);
  return { shape, values, kind: "length", low, high, ramp: RAMPS.gap, power: 1 };
}

/** Where a value is between the ends of a map, and the value at a share. */
const shareOf = ({ low, high, power }, value) => ((value - low) / (high - low)) ** power;
const valueAt = ({ low, high, power }, share) => low + (high - low) * share ** (1 / power);

/** The colours of a map; what touches has a colour of its own in a map of gaps. */
function paintedMap(ground) {
  const map = shownMap === "patches" ? null : mapOf(shownMap);
  const [rows, columns] = map?.shape ?? above.shape;
  const image = new ImageData(columns, rows);
  const shades = map && Array.from({ length: SHADES }, (_, i) => [...colourOf(map.ramp, i / (SHADES - 1)), 255]);
  const shade = (value) => shades[Math.min(SHADES - 1, Math.max(0, Math.round(shareOf(map, value) * (SHADES - 1))))];
  const patch = (i) => { const number = patchesOfTop ? patchAt(patchesOfTop, i) : Number(above.pressure[i] > 0); return number ? PATCHES[(number - 1) % PATCHES.length] : ground; };
  const isGap = shownMap === "gap";
  const value = (i) => isGap && above.pressure[i] > 0 ? TOUCHING : map.values[i] === null ? ground : shade(map.values[i]);
  for (let i = 0; i < rows * columns; i++) image.data.set(map ? value(i) : patch(i), 4 * i);
  const source = element("canvas", { width: columns, height: rows });
  source.getContext("2d").putImageData(image, 0, 0);
  return { source, map };
}

/** The number of the patch at a node of the map. */
function patchAt({ shape: [patchRows, patchColumns], map }, i) {
  const [rows, columns] = above.shape;
  return map[Math.floor((Math.floor(i / columns) + 0.5) / rows * patchRows) * patchColumns + Math.floor((i % columns + 0.5) / columns * patchColumns)];
}

/** The numbers of patches, and the leakage, of the run whose section is shown, once they are known. */
let patchesOfTop = null;
let leakOfTop = null;

/** Whether a map can be drawn of the state that is shown: the leakage is that of a run that has ended. */
const hasMap = (name) => LEAKS.includes(name) ? Boolean(leakOfTop) : !["traction", "slip", "attraction"].includes(name) || name in above.fields;

/** Shows a map of a name. */
function chooseMap(name) {
  shownMap = name;
  drawTop();
  charts();
}

/** Has what a map needs besides the contact, if that of the run is shown and no other one by then. */
async function findForTop() {
  const mine = sectionRun;
  const run = !grip && sectionRun ? runOf(sectionRun) : null;
  const wanted = (isWanted, name) => isWanted && run?.ended ? facet(run, name).catch((error) => fault(error.message)) : null;
  const [patches, leak] = await Promise.all([wanted(shownMap === "patches", "patches"), wanted(LEAKS.includes(shownMap), "leak")]);
  if (sectionRun !== mine) return;
  [patchesOfTop, leakOfTop] = [patches ?? null, leak ?? null];
  if (leakOfTop) keepLeak(run, leakOfTop);
}

async function drawTop() {
  if (!above) return;
  const isSolid = shownMap === "solid";
  byId("top").hidden = isSolid;
  for (const id of ["solid", "solid-scale"]) byId(id).hidden = !isSolid;
  for (const name of MAPS) {
    byId(`map-${name}`).setAttribute("aria-pressed", String(name === shownMap));
    byId(`map-${name}`).hidden = !LEAKS.includes(name) && !hasMap(name);
  }
  tellTop();
  if (isSolid) { drawSolid(); return; }
  await findForTop();
  tellTop();
  if (above && shownMap !== "solid") paintTop();
}

/** What is said above a map: that it is old, that nothing touches, that the attraction is not in it, how much leaks, or that this is not known yet;
 * nothing where it speaks for itself. */
function noteOfTop() {
  if (byId("top-box").hasAttribute("data-stale")) return say("top.stale");
  if (LEAKS.includes(shownMap)) return leakInWords();
  if (shownMap === "solid") return say("solid.legend", { pressure: pressureOf(above.highest_pressure) });
  if (shownMap === "pressure" && !(above.highest_pressure > 0)) return say("top.nothing");
  return shownMap === "pressure" && "attraction" in above.fields ? say("top.pressure.alone") : "";
}

/** How much leaks, or that the leakage is not known yet. */
function leakInWords() {
  const gap = leakOfTop?.axes[0].hydraulic_gap;
  if (gap === undefined) return say(!grip && sectionRun ? "top.leak.finding" : "top.leak.waits");
  return gap > 0 ? say("top.leak", { gap: withUnit(gap, "length") }) : say("top.leak.sealed");
}

function tellTop() {
  const note = noteOfTop();
  Object.assign(byId("top-note"), { hidden: !note, textContent: note });
}

function paintTop() {
  const canvas = byId("top");
  const box = canvas.getBoundingClientRect();
  if (!box.width) return;
  const scale = window.devicePixelRatio || 1;
  canvas.width = Math.round(box.width * scale);
  canvas.height = Math.round(box.height * scale);
  const to = canvas.getContext("2d");
  to.scale(scale, scale);
  const [at, colour] = [frameOfTop(), colours()];
  if (!hasMap(shownMap)) { to.clearRect(0, 0, box.width, box.height); return; }
  // where nothing flows is grey, as the strongest flow is as light as the page
  const { source, map } = paintedMap([...rgb(LEAKS.includes(shownMap) ? colour.edge : colour.ground), 255]);
  to.imageSmoothingEnabled = false;
  to.drawImage(source, at.x, at.y, at.wide, at.high);
  to.strokeStyle = colour.soft;
  to.strokeRect(at.x - 0.5, at.y - 0.5, at.wide + 1, at.high + 1);
  paintCut(to, at, colour);
  paintAxesOfTop(to, at, colour);
  if (map && map.high > map.low) paintBar(to, at, colour, map);
  const y = section.y ?? 0;
  Object.assign(canvas, { ariaLabel: say("top.words", { map: say(`top.${shownMap}`) }), ariaValueNow: String(Number((y / above.size[0]).toPrecision(3))), ariaValueText: say("top.cut", { y: withUnit(y, "length") }) });
}

/** A colour of the style sheet in numbers. */
function rgb(words) {
  const to = element("canvas", { width: 1, height: 1 }).getContext("2d", { willReadFrequently: true });
  to.fillStyle = words;
  to.fillRect(0, 0, 1, 1);
  return [...to.getImageData(0, 0, 1, 1).data.slice(0, 3)];
}

/** Where the section cuts the map. */
function paintCut(to, at, colour) {
  const y = at.y + (section.y + 0.5 * above.size[0] / above.shape[0]) / above.size[0] * at.high;
  for (const [style, width] of [[colour.ground, 3], [colour.accent, 1.5]]) {
    Object.assign(to, { strokeStyle: style, lineWidth: width });
    to.beginPath();
    to.moveTo(at.x - 6, y);
    to.lineTo(at.x + at.wide + 6, y);
    to.stroke();
  }
  if (!chosen || chosen.run !== sectionRun) return;
  const [py, px] = chosen.place.map((place, axis) => place / above.size[axis]);
  to.strokeStyle = colour.green;
  to.lineWidth = 2;
  to.beginPath();
  to.arc(at.x + px * at.wide, at.y + py * at.high, Math.max(5, Math.sqrt(chosen.area / Math.PI) / above.size[1] * at.wide + 3), 0, 2 * Math.PI);
  to.stroke();
}

/** Lengths along both axes. */
function paintAxesOfTop(to, at, colour) {
  Object.assign(to, { font: FONT, fillStyle: colour.soft, textBaseline: "top", textAlign: "center" });
  const [ly, lx] = above.size;
  const { unit, size, every } = scaleOf(Math.max(lx, ly));
  for (let x = 0; x <= lx * (1 + 1e-9); x += every) to.fillText(marked(x / size), at.x + x / lx * at.wide, at.y + at.high + 5);
  to.fillText(`x / ${unit}`, at.x + at.wide / 2, at.y + at.high + 19);
  Object.assign(to, { textBaseline: "middle", textAlign: "right" });
  for (let y = 0; y <= ly * (1 + 1e-9); y += every) to.fillText(marked(y / size), at.x - 9, at.y + y / ly * at.high);
  to.save();
  to.translate(10, at.y + at.high / 2);
  to.rotate(-Math.PI / 2);
  to.textAlign = "center";
  to.fillText(`y / ${unit}`, 0, 0);
  to.restore();
}

/** The colour bar of a map, with its ends and its middle in the unit of the largest. */
function paintBar(to, at, colour, map) {
  const x = at.x + at.wide + 14;
  for (let i = 0; i < at.high; i++) {
    to.fillStyle = `rgb(${colourOf(map.ramp, 1 - i / at.high).join(" ")})`;
    to.fillRect(x, at.y + i, BAR, 1.5);
  }
  Object.assign(to, { font: FONT, fillStyle: colour.soft, textAlign: "left" });
  const { name, size } = shownUnit(map.kind, map.high);
  /** @type {[number, CanvasTextBaseline][]} */
  const marks = [[1, "top"], [0.5, "middle"], [0, "bottom"]];
  for (const [share, baseline] of marks) {
    to.textBaseline = baseline;
    to.fillText(figure(Number((valueAt(map, share) / size).toPrecision(2)), 2), x + BAR + 4, at.y + (1 - share) * at.high);
  }
  to.textBaseline = "top";
  const symbol = LEAKS.includes(shownMap) ? say(`top.${shownMap}.symbol`) : SYMBOLS[shownMap];
  const lines = [[symbol, name].filter(Boolean).join(" / "), ...(map.power === 1 ? [] : [say("top.roots")])];
  lines.forEach((line, i) => to.fillText(line, Math.min(x, at.w - to.measureText(line).width - 2), at.y + at.high + 5 + 15 * i));
}

/** The node of the map below a pointer, and its place; none beside the map. */
function placeOnTop({ clientX, clientY }) {
  const box = byId("top").getBoundingClientRect();
  const at = frameOfTop();
  const shares = [(clientY - box.y - at.y) / at.high, (clientX - box.x - at.x) / at.wide];
  if (shares.some((share) => !(share >= 0 && share < 1))) return null;
  const node = shares.map((share, axis) => Math.floor(share * above.shape[axis]));
  return { shares, node };
}

/** Tells pressure and gap below the pointer. */
function pointAtTop(event) {
  const place = above && placeOnTop(event);
  const label = byId("top-value");
  label.hidden = !place;
  if (!place) return;
  const i = place.node[0] * above.shape[1] + place.node[1];
  const [y, x] = place.shares.map((share, axis) => withUnit(share * above.size[axis], "length"));
  const own = above.pressure[i] > 0 ? say("top.touches", { x, y, pressure: pressureOf(above.pressure[i]) }) : say("top.apart", { x, y, gap: withUnit(above.gap[i], "length") });
  label.textContent = [own, further(place.shares)].filter(Boolean).join(", ");
}

/** What a map other than those of pressure and gap has at a place, in words. */
function further(shares) {
  if (["pressure", "gap", "patches", "solid"].includes(shownMap) || !hasMap(shownMap)) return "";
  const map = mapOf(shownMap);
  const [row, column] = shares.map((share, axis) => Math.floor(share * map.shape[axis]));
  const value = map.values[row * map.shape[1] + column];
  return value === null ? "" : `${say(`top.${shownMap}`)} ${withUnit(value, map.kind)}`;
}

/** Cuts the map along another row, and chooses the patch at a place of it. A map of another state than the one that is shown is not cut. */
function cutAt(share, column = null) {
  if (!above || grip || byId("top-box").hasAttribute("data-stale")) return;
  cut = Math.min(1 - 1e-9, Math.max(0, share));
  const run = shownOrLatest();
  const row = sectionAlong(above, cut, section);
  showSection(row, beside, { ...axes, low: Math.min(axes.low, ...row.solid), high: Math.max(axes.high, ...row.rigid), pressure: Math.max(axes.pressure, axesOf([row]).pressure), pull: Math.max(axes.pull, axesOf([row]).pull) }, above);
  if (column !== null && run?.id === sectionRun) pickAt(column);
}

/** Moves the cut by keys. */
function keyOnTop(event) {
  const by = { ArrowUp: -1, ArrowDown: 1, PageUp: -16, PageDown: 16 }[event.key];
  if (!by || !above) return;
  event.preventDefault();
  cutAt(section.y / above.size[0] + (by + 0.5) / above.shape[0]);
}

function beginTop() {
  const canvas = byId("top");
  canvas.addEventListener("pointermove", (event) => { pointAtTop(event); const place = event.buttons && above && placeOnTop(event); if (place) cutAt(place.shares[0]); });
  canvas.addEventListener("pointerleave", () => { byId("top-value").hidden = true; });
  canvas.addEventListener("click", (event) => { const place = above && placeOnTop(event); if (place) cutAt(place.shares[0], place.shares[1]); });
  canvas.addEventListener("keydown", keyOnTop);
  for (const name of MAPS) byId(`map-${name}`).addEventListener("click", () => chooseMap(name));
  for (const id of ["top", "solid"]) new ResizeObserver(drawTop).observe(byId(id));
}
