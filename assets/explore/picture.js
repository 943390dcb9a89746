// The page's own picture of a contact: pressure, the rigid surface on the solid, and the shear stress below.

/** Shares of the picture's height: the pressure above, the surfaces in the middle, and where it is shown the stress below; the axis is at the
 * foot. */
const BANDS = { pressure: 0.24, relief: 0.64 };
const DEEP_BANDS = { pressure: 0.24, relief: 0.42 };
const ZONE_BANDS = { pressure: 0.2, relief: 0.32 };
const bands = () => section?.zone ? ZONE_BANDS : isDeep() ? DEEP_BANDS : BANDS;
/** Room below the surfaces, over the height of their band, and in pixels above the highest pressure and above the surfaces, for their
 * names. */
const SPARE = 0.08;
const NAME = 24;
/** The fewest columns of a section that may stand for several nodes each, and are drawn in their middles. The nodes of a coarser periodic grid are
 * drawn where they are, from one end of the cell to the other. */
const COLUMNS = 256;
/** Room at the foot of a section for what stands there: names of places are left out there, and the scale of heights is above them. */
const AXIS = { left: 168, right: 24, above: 24 };
/** Letters of pictures on a screen, and on a wall. */
const FONTS = { screen: "12px system-ui, sans-serif", wall: "17px system-ui, sans-serif" };
let FONT = FONTS.screen;
/** Width of the lines on a screen, and on a wall. */
const lineWidth = () => "projector" in document.body.dataset ? 4 : 1.5;
/** How much the colour of a place covers where it hardly yields, and where it yields most. */
const ZONE = { least: 0.3, most: 0.95 };
/** Heights of a section that nothing presses any more, over those of its imprint. */
const IMPRINT = 4;
/** The colour of stresses below the surface. */
const BLUE = [86, 180, 233];
/** Fringe orders up to the largest shear stress. */
const ORDERS = 8;

/** The section that is drawn, that of the surface beside, and the limits of their axes, which stay while a hand holds them. */
let section = null;
let beside = null;
let axes = null;

/** The pressure over the contact modulus up to which surfaces that attract each other from afar are drawn as ones that are apart. */
const NOTHING = 1e-9;
const isNothing = (share) => Math.abs(share) <= NOTHING;

/** The pressure along a section, less the attraction where there is one. */
function netOf({ pressure, fields }) {
  if (!fields?.attraction) return pressure;
  const net = pressure.map((p, i) => p - fields.attraction[i]);
  return net.every(isNothing) ? net.map(() => 0) : net;
}

/** The highest place to be seen: that of the rigid surfaces, or little above an imprint that nothing presses any more. */
function topOfSections(sections) {
  const heights = sections.flatMap(({ solid }) => solid);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const isLeft = sections.every(({ zone, highest_pressure: p }) => zone?.strain.highest > 0 && p === 0);
  return isLeft ? high + (IMPRINT - 1) * (high - low) : Math.max(...sections.flatMap(({ rigid }) => rigid));
}

/** Axes that hold all sections: the lowest and the highest place, the largest pressure, the largest pull, the largest shear stress, the largest
 * plastic strain and the largest stress where the solid yields. */
function axesOf(sections) {
  const most = (of) => Math.max(...sections.flatMap(of));
  const lowest = most((it) => [0, ...netOf(it).map((p) => -p), ...(it.fields?.traction ?? []).map((p) => -p)]);
  return { low: -most(({ solid }) => solid.map((z) => -z)), high: topOfSections(sections), pressure: most((it) => it.fields?.attraction ? netOf(it) : [it.highest_pressure]), pull: lowest,
    shear: most(({ shear }) => [shear?.highest ?? 0]) || 1, strain: most(({ zone }) => [zone?.strain.highest ?? 0]) || 1, stress: most(({ zone }) => [zone?.stress.highest ?? 0]) || 1 };
}

/** Shows a section, and the one beside if there is one, on axes that hold both, or on those that are given, and the map of the contact if
 * there is one. */
function showSection(shown, shownBeside, given = null, its = null) {
  section = shown;
  beside = shownBeside;
  axes = given ?? axesOf([section, beside].filter(Boolean));
  byId("section-beside-box").hidden = !beside;
  showTop(its);
  drawSections();
  placeHandles();
  offerSaves();
}

function drawSections() {
  drawSection(byId("section"), section);
  drawSection(byId("section-beside"), beside);
  placeLabels();
}

/** Puts the names of what is drawn beside it, once there is a picture. */
function placeLabels() {
  for (const label of allOf("#section ~ .label")) label.hidden = !section;
  if (!section) return;
  const at = frame(byId("section"));
  byId("label-pressure").textContent = ownInWords(shownOrLatest());
  byId("label-pressure").hidden = !(axes.pressure > 0 || section.fields?.attraction);
  byId("label-rigid").textContent = section.slides ? say("label.rigid.slides") : say("label.rigid");
  byId("label-solid").textContent = section.zone ? zoneInWords(section.zone) : HAS.creeping(knobs) ? say("label.solid.creeps") : say("label.solid");
  byId("label-rigid").style.top = `${at.top + 2}px`;
  const isMoving = grip && grip.kind !== "look";
  byId("label-drag").hidden = !canPress() || (isTouched && !isMoving);
  if (beside) byId("label-beside").textContent = besideInWords(shownOrLatest());
  byId("label-drag").textContent = isMoving ? heldInWords() : say("label.drag");
}

/** What a section shows; where another one is beside it, with the surface and the load of the run, or of the moment in its place. */
function ownInWords(run) {
  if (!beside || !run) return scaleInWords(section);
  const [name] = titleOf(run).split(", ");
  return say("label.own", { title: inTitle(name, (moment ?? run).numbers?.reduced_pressure), scale: scaleInWords(section) });
}

/** A surface and its load, where that is known. */
const inTitle = (name, load) => Number.isFinite(load) ? `${name}, p* = ${figure(isNothing(load) ? 0 : load, 3)}` : name;

/** What is pressed beside a run, and how: the mean pressure is the same, and so p* goes with that of the run, but where gaps are given, and where the surfaces
 * of the run have parted. */
function besideInWords(run) {
  const told = run?.beside;
  if (!told) return scaleInWords(beside);
  const isOther = isAtGaps(run.knobs) || isParted(run.numbers);
  const ratio = !moment ? 1 : isOther ? NaN : moment.numbers?.reduced_pressure / run.numbers?.reduced_pressure;
  const its = { title: inTitle(titleOf(told), told.numbers?.reduced_pressure * ratio), scale: scaleInWords(beside) };
  return isOther ? say("label.own", its) : say("label.beside", its);
}

/** Load and area of what the hand holds. */
function heldInWords() {
  const { reduced_pressure: load, relative_area: area } = (moment ?? shownOrLatest())?.numbers ?? {};
  return say("label.held", { load: figure(load, 3), area: figure(100 * area, 3) });
}

/** What stands above a section, and how large it is: the axes may reach further. */
function scaleInWords(shown) {
  const { fields, highest_pressure: highest } = shown;
  const net = netOf(shown);
  const places = fields?.attraction ? { pressure: pressureOf(Math.max(0, ...net)), pull: pressureOf(Math.max(0, ...net.map((p) => -p))) } : { pressure: pressureOf(highest) };
  if (fields?.attraction) return net.some((p) => p !== 0) ? say("section.scale.attraction", places) : say("section.scale.apart");
  if (fields?.traction) return say("section.scale.traction", places);
  return shown.exact ? say("section.scale.exact", places) : say("section.scale", places);
}

/** What is drawn below a section whose solid yields there. */
function zoneInWords({ strain, stress }) {
  const yielded = strain.highest > 0 ? say("zone.yielded", { strain: figure(strain.highest, 3) }) : say("zone.none");
  return isDeep() ? say("zone.stress", { yielded, stress: pressureOf(stress.highest) }) : yielded;
}

/** Places of the picture in pixels: x of a share of the length, y of a height and of a pressure, and back. */
function frame(canvas, its = axes) {
  const { width: w, height: h } = canvas.getBoundingClientRect();
  const top = h * bands().pressure;
  const high = h * bands().relief;
  const perHeight = (high * (1 - SPARE) - NAME) / (its.high - its.low || 1);
  return {
    w, h, top, perHeight,
    x: (share) => share * w,
    y: (height) => top + NAME + (its.high - height) * perHeight,
    pressure: (p) => top - (top - NAME) * (p + its.pull) / (its.pressure + its.pull || 1),
  };
}

function drawSection(canvas, shown) {
  const box = canvas.getBoundingClientRect();
  if (!shown || !box.width) return;
  const scale = window.devicePixelRatio || 1;
  canvas.width = Math.round(box.width * scale);
  canvas.height = Math.round(box.height * scale);
  const to = canvas.getContext("2d", { willReadFrequently: true });
  to.scale(scale, scale);
  paintSection(to, frame(canvas), shown);
  canvas.ariaLabel = inWords(shown);
}

/** The colours of the style sheet. */
function colours() {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(["ground", "panel", "edge", "ink", "soft", "accent", "warm", "green"].map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** Whether the columns of a section are nodes, the first one at its left edge. */
const isOfNodes = (shown) => shown.rigid.length < COLUMNS && shown.is_pressed_by_gap;

function paintSection(to, at, shown) {
  const { rigid, solid, pressure, exact, shear, zone, fields } = shown;
  const colour = colours();
  const place = (i, n) => at.x((i + (isOfNodes(shown) ? 0 : 0.5)) / n);
  const line = (values, y) => {
    const path = new Path2D();
    path.moveTo(0, y(values[0]));
    values.forEach((value, i) => path.lineTo(place(i, values.length), y(value)));
    path.lineTo(at.w, y(isOfNodes(shown) ? values[0] : values.at(-1)));
    return path;
  };
  const filled = (values, y, end) => {
    const path = line(values, y);
    path.lineTo(at.w, end);
    path.lineTo(0, end);
    path.closePath();
    return path;
  };
  to.clearRect(0, 0, at.w, at.h);
  to.fillStyle = colour.panel;
  to.fill(filled(solid, at.y, at.h));
  if (shear) paintShear(to, at, shown);
  if (zone) paintZone(to, at, shown, rgb(colour.warm));
  if (chosen && shown === section) paintChosen(to, at, colour);
  if (shown === section) paintMirror(to, at, colour);
  to.save();
  to.beginPath();
  to.rect(0, at.top, at.w, at.h - at.top);
  to.clip();
  to.fillStyle = colour.edge;
  to.fill(filled(rigid, at.y, at.top));
  to.lineWidth = lineWidth();
  to.strokeStyle = colour.soft;
  to.stroke(line(rigid, at.y));
  to.strokeStyle = colour.accent;
  to.stroke(line(solid, at.y));
  to.restore();
  to.fillStyle = colour.warm;
  to.fill(filled(netOf(shown), at.pressure, at.pressure(0)));
  if (fields?.traction) {
    const path = new Path2D();
    fields.traction.forEach((value, i) => {
      const [x, y] = [place(i, fields.traction.length), at.pressure(value)];
      if (pressure[i] > 0 && pressure[i - 1] > 0) path.lineTo(x, y); else path.moveTo(x, y);
    });
    for (const wider of [2, 0]) {
      Object.assign(to, { strokeStyle: wider ? colour.ground : colour.green, lineWidth: lineWidth() + wider });
      to.stroke(path);
    }
  }
  if (exact) {
    to.setLineDash([6, 4]);
    to.strokeStyle = colour.green;
    to.stroke(line(exact, at.pressure));
    to.setLineDash([]);
  }
  paintAxes(to, at, shown, colour);
  if (isDeep() && !zone && Math.max(...pressure) > 0) to.fillText(stressInWords(shear), 6, at.h - 58);
}

/** What the fringes are, or why there are none. */
function stressInWords(shear) {
  if (shear) return say("fringes.scale", { stress: pressureOf(axes.shear / ORDERS, 2) });
  return moment?.step === undefined ? say("fringes.unknown") : say("fringes.step");
}

/** A unit in which a length has one to three digits before its mark, its size, and a round distance of marks, of which four or five fit. */
function scaleOf(length) {
  const { name: unit, size } = shownUnit("length", length);
  const fifth = length / size / 5;
  const power = 10 ** Math.floor(Math.log10(fifth));
  return { unit, size, every: size * power * [1, 2, 5, 10].find((step) => step * power >= fifth * (1 - 1e-9)) };
}

/** The number of a mark of an axis. */
const marked = (value) => inLocale(String(Number(value.toPrecision(3))));

/** Places along the section, and how many times heights are drawn as large as lengths. */
function paintAxes(to, at, { length }, colour) {
  Object.assign(to, { font: FONT, fillStyle: colour.soft, strokeStyle: colour.soft, lineWidth: 1, textAlign: "center", textBaseline: "bottom" });
  const { unit, size, every } = scaleOf(length);
  for (let x = every; x < length * (1 - 1e-9); x += every) {
    const place = at.x(x / length);
    to.fillRect(place - 0.5, at.h - 5, 1, 5);
    if (place > AXIS.left * (FONT === FONTS.wall ? 1.4 : 1) && place < at.w - AXIS.right) to.fillText(`${marked(x / size)} ${unit}`, place, at.h - 6);
  }
  to.textAlign = "right";
  const times = at.perHeight * length / at.w;
  to.fillText(say("section.heights", { times: figure(Number(times.toPrecision(2)), 2) }), at.w - 6, at.h - AXIS.above);
  Object.assign(to, { textAlign: "left", textBaseline: "alphabetic" });
}

/** Where a measured profile was mirrored along the section: its own half, outlined, and the image of it. */
function paintMirror(to, at, colour) {
  const { body, heights } = knobs;
  const isMirrored = body === "file" && ["x", "both"].includes(heights.prepare.mirror);
  document.body.toggleAttribute("data-mirrored", isMirrored);
  if (!isMirrored) return;
  to.strokeStyle = colour.green;
  to.lineWidth = lineWidth();
  to.setLineDash([4, 4]);
  to.strokeRect(1, at.top + 1, at.w / 2 - 1, at.h - at.top - 2);
  to.setLineDash([]);
  to.fillStyle = colour.ink;
  to.font = FONT;
  to.fillText(say("mirror.measured"), 8, at.h - 34);
  to.fillText(say("mirror.image"), at.w / 2 + 8, at.h - 34);
}

/** The stress below each place of the surface, to scale, as the fringes that crossed polarisers show. */
function paintShear(to, at, shown) {
  const { depth, columns, highest, values } = shown.shear;
  paintBelow(to, at, shown, { depth, columns, cells: values.map((value) => [...BLUE, 215 * Math.sin(Math.PI * ORDERS * value / 255 * highest / axes.shear) ** 2]) });
}

/** What has yielded below each place of the surface, to scale. */
function paintZone(to, at, shown, colour) {
  const { depth, columns } = shown.zone;
  paintBelow(to, at, shown, { depth, columns, cells: cellsOf(shown.zone, colour) });
}

/** The colours of the places of a zone: what has yielded, the more the darker, and the von Mises stress, if the stress below is shown. */
function cellsOf({ strain, stress }, colour) {
  const cover = (value) => 255 * (ZONE.least + (ZONE.most - ZONE.least) * value / 255 * strain.highest / axes.strain);
  const light = (value) => isDeep() ? 215 * value / 255 * stress.highest / axes.stress : 0;
  return strain.values.map((value, i) => value > 0 ? [...colour, cover(value)] : [...BLUE, light(stress.values[i])]);
}

/** Colours of places below each place of the surface, row by row, to scale. */
function paintBelow(to, at, shown, { depth, columns, cells }) {
  const { solid, length } = shown;
  const half = isOfNodes(shown) ? 0.5 / solid.length : 0;
  const rows = cells.length / columns;
  const image = new ImageData(columns, rows);
  cells.forEach((cell, i) => image.data.set(cell, 4 * i));
  const source = element("canvas", { width: columns, height: rows });
  source.getContext("2d", { willReadFrequently: true }).putImageData(image, 0, 0);
  const high = depth / length * at.w;
  // the first column begins half a node before the left edge, so that its other half is at the right one
  for (let i = 0; i < columns + (half ? 1 : 0); i++) {
    const y = at.y(solid[Math.floor((i % columns + 0.5) / columns * solid.length)]);
    const [left, right] = [i, i + 1].map((edge) => Math.round(at.w * (edge / columns - half)));
    to.drawImage(source, i % columns, 0, 1, rows, left, y, right - left, high);
  }
}

/** A section in words, for those who do not see it. */
function inWords({ pressure, highest_pressure, slides }) {
  const share = pressure.filter((p) => p > 0).length / pressure.length;
  const told = say("section.words", { share: figure(100 * share, 3), pressure: pressureOf(highest_pressure) });
  return slides ? `${told}. ${say("section.slides")}` : told;
}
