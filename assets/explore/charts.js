// The charts of the sweep against the load.

const SVG = "http://www.w3.org/2000/svg";

function drawn(tag, attributes, text) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  return made;
}

/** Room around the axes of a chart: numbers on the left, title and legend above, numbers and the name of the axis below. */
const ROOM = { left: 30, right: 14, above: 36, below: 34 };
/** Room between two names of a legend. */
const APART = 8;

/** The numbers of contacts that a person has seen, by what is pressed, each load once, and how many of them are kept. */
const visitedContacts = new Map();
const MOST_SEEN = 200;

/** Keeps the numbers of a contact that has converged for the charts. */
function keepSeen(its, numbers) {
  const { status, reduced_pressure: load, relative_area: area, kappa, kappa_r } = numbers ?? {};
  if (status !== "converged" || !(load > 0)) return;
  const key = pressedOf(its);
  if (!visitedContacts.has(key)) visitedContacts.set(key, new Map());
  const contacts = visitedContacts.get(key);
  contacts.set(load.toPrecision(4), { load, area, kappa, kappa_r });
  for (const old of [...contacts.keys()].slice(0, -MOST_SEEN)) contacts.delete(old);
}

/** The dots of a chart: contacts that a person has seen. */
const dotsOf = (style, of) => [...(visitedContacts.get(pressedOf(knobs))?.values() ?? [])].map((it) => ({ style, at: [it.load, it[of]] })).filter(({ at }) => Number.isFinite(at[1]));

/** A chart against log10 p*: curves are { name, points: [[p*, y]], style }, dots { style, at: [p*, y] }. What is higher than `top` leaves the
 * axes, and is said. */
function chart(target, title, top, curves, dots, note) {
  const box = target.getBoundingClientRect();
  const [w, h] = [Math.max(160, box.width), Math.max(120, box.height)];
  const [wide, high] = [w - ROOM.left - ROOM.right, h - ROOM.above - ROOM.below];
  const xs = [...curves.flatMap((curve) => curve.points), ...dots.map(({ at }) => at)].map(([x]) => Math.log10(x));
  const [first, last] = xs.length > 1 ? [Math.floor(Math.min(...xs)), Math.ceil(Math.max(...xs, Math.min(...xs) + 1))] : [-4, 1];
  const x = (v) => ROOM.left + (Math.log10(v) - first) / (last - first || 1) * wide;
  const y = (v) => h - ROOM.below - v / top * high;
  const svg = drawn("svg", { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": `${title}${note ? `: ${note}` : ""}`, class: note ? "stale" : "" });
  const frame = { x: ROOM.left, y: ROOM.above, width: wide, height: high };
  const inside = `inside-${target.id}`;
  const clip = drawn("clipPath", { id: inside });
  clip.append(drawn("rect", frame));
  svg.append(clip, drawn("rect", { class: "axis", ...frame }), drawn("text", { class: "title", x: ROOM.left, y: 13 }, title));
  const every = Math.max(1, Math.ceil((last - first) * 34 / wide));
  for (let e = first; e <= last; e += every) svg.append(drawn("text", { x: x(10 ** e), y: h - 20, "text-anchor": "middle" }, e === 0 ? "1" : `1e${e}`));
  svg.append(drawn("text", { x: ROOM.left + wide / 2, y: h - 5, "text-anchor": "middle" }, "p*"));
  for (let i = 0; i <= 2; i++) svg.append(drawn("text", { x: ROOM.left - 4, y: y(i * top / 2) + 4, "text-anchor": "end" }, inLocale(String(i * top / 2))));
  const load = moment?.numbers.reduced_pressure ?? knobs?.load;
  if (load >= 10 ** first && load <= 10 ** last) svg.append(drawn("line", { class: "now", x1: x(load), x2: x(load), y1: ROOM.above, y2: h - ROOM.below }));
  const placeOf = ({ clientX, clientY }) => [10 ** (first + (clientX - box.x - ROOM.left) / wide * (last - first)), (h - ROOM.below - (clientY - box.y)) / high * top];
  const isDrawn = guess?.target === target.id;
  target.toggleAttribute("data-drawn", isDrawn);
  target.onclick = isDrawn ? null : (event) => pickLoad(placeOf(event)[0]);
  target.onpointerdown = isDrawn ? (event) => { target.setPointerCapture(event.pointerId); drawGuess(...placeOf(event)); } : null;
  target.onpointermove = isDrawn ? (event) => { if (event.buttons) drawGuess(...placeOf(event)); } : null;
  const shown = curves.filter((curve) => curve.points.length || dots.some(({ style }) => style === curve.style));
  for (const curve of shown) {
    svg.append(drawn("polyline", { class: curve.style, "clip-path": `url(#${inside})`, points: curve.points.map(([a, b]) => `${x(a).toFixed(1)},${y(b).toFixed(1)}`).join(" ") }));
    const now = curve.points.find(([a]) => a === moment?.numbers.reduced_pressure);
    if (now && now[1] <= top) svg.append(drawn("circle", { class: `of-${curve.style}`, cx: x(now[0]), cy: y(now[1]), r: 5 }));
  }
  for (const { style, at: [a, b] } of dots) if (b <= top) svg.append(drawn("circle", { class: `of-${style}`, cx: x(a), cy: y(b), r: 3.5 }));
  const said = note || (shown.length || dots.length ? "" : say("chart.sweep"));
  said.split(", ").filter(Boolean).forEach((line, i) => {
    svg.append(drawn("text", { class: "note", x: ROOM.left + wide / 2, y: ROOM.above + high / 2 + 16 * i, "text-anchor": "middle" }, line));
  });
  target.replaceChildren(svg);
  legend(svg, top, shown, w);
}

/** The names of the curves in one line above the axes, each as wide as it is drawn. */
function legend(svg, top, curves, width) {
  const names = curves.map(({ name, style, points }) => {
    const highest = Math.max(...points.map(([, value]) => value));
    return drawn("text", { class: `of-${style}`, y: 28 }, highest > top ? `${name} ↑${figure(highest, 2)}` : name);
  });
  svg.append(...names);
  const widths = names.map((name) => name.getComputedTextLength() + APART);
  const whole = widths.reduce((sum, width) => sum + width, 0);
  let place = Math.max(0, Math.min(ROOM.left, width - whole));
  names.forEach((name, i) => { name.setAttribute("x", place); place += widths[i]; });
}

/** The knobs that make surface and solid of a sweep. */
function pressedOf({ domain, body, exponent, roughness, hurst, rolloff, cutoff, "rolloff-form": form, peklenik, "lay-angle": angle, skewness, kurtosis, seed, points, heights, scene, bumps, hardness, layer, creep, speed, time, adhesion, range }) {
  if (body === "scene") return scene;
  const memory = creep > 0 && [creep, speed, speed === 0 && time];
  const attraction = adhesion > 0 && [adhesion, range];
  if (body === "file") return JSON.stringify([heights, hardness, layer, memory, attraction]);
  return JSON.stringify([hardness, layer, memory, attraction, domain, body, body === "power-law" && exponent, points, bumps, roughness, roughness > 0 && [hurst, rolloff, cutoff, form, domain === "surface" && [peklenik, angle], skewness, kurtosis, seed]]);
}

/** Upper ends of the axis of kappa: the lowest that holds all curves and dots, and the guess while one is asked for, or the last one. */
const TOPS = [4, 10];

function topOf(curves, dots = []) {
  const highest = Math.max(0, guess?.top ?? 0, ...curves.flatMap(({ points }) => points.map(([, value]) => value)), ...dots.map(({ at }) => at[1]));
  return TOPS.find((top) => top >= highest) ?? TOPS.at(-1);
}

/** Draws the sweep; one of another surface than that of the knobs is grey, and says so. */
function charts() {
  const { sweep: shown } = report;
  const points = shown ? shown.points : [];
  const isStale = points.length > 0 && pressedOf(shown.knobs) !== pressedOf(knobs);
  const note = isStale ? say("chart.stale") : "";
  const curve = (name, style, of) => ({ name, style, points: points.map((p) => [p.reduced_pressure, of(p)]).filter(([, v]) => Number.isFinite(v)) });
  chart(byId("chart-area"), say("chart.area"), 1, [
    curve("Persson", "persson", (p) => p.persson ?? NaN), curve("a_rel", "computed", (p) => p.relative_area),
    curve(say("chart.exact"), "exact", (p) => p.exact?.relative_area), ...guessOf("chart-area")], dotsOf("computed", "area"), note);
  const kappas = [
    curve("Persson", "persson", (p) => (p.persson ?? NaN) / p.reduced_pressure), curve("κ", "computed", (p) => p.kappa),
    curve("κ_r", "second", (p) => p.kappa_r), curve(say("chart.exact"), "exact", (p) => p.exact?.kappa_r), ...guessOf("chart-kappa")];
  const dots = [...dotsOf("computed", "kappa"), ...dotsOf("second", "kappa_r")];
  chart(byId("chart-kappa"), say("chart.kappa"), topOf(kappas, dots), kappas, dots, note);
  for (const target of [byId("chart-area"), byId("chart-kappa")]) {
    target.tabIndex = points.length ? 0 : -1;
    target.ariaValueMin = 0;
    target.ariaValueMax = Math.max(1, points.length - 1);
    target.ariaValueNow = Math.max(0, points.findLastIndex((point) => point.reduced_pressure <= (moment?.numbers.reduced_pressure ?? knobs.load)));
    target.setAttribute("aria-valuetext", moment ? moment.name : say("moment.load", { load: figure(knobs.load, 4) }));
  }
  Object.assign(document.body.dataset, { sweep: shown ? (shown.ended ? "ended" : points.length) : "none", stale: isStale });
}

/** Shows the load of the sweep that is nearest to one, in the viewer, the table and the picture. */
function pickLoad(load) {
  const points = report.sweep?.points ?? [];
  const away = ({ reduced_pressure: p }) => Math.abs(Math.log(p / load));
  if (points.length) showLoad(points.reduce((best, point) => away(point) < away(best) ? point : best));
}

/** Goes from one load of the sweep to its neighbours by keys. */
function stepLoad(event) {
  const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
  const points = report.sweep?.points ?? [];
  if (!by || !points.length) return;
  event.preventDefault();
  const load = moment?.numbers.reduced_pressure ?? knobs.load;
  const now = points.findLastIndex((point) => point.reduced_pressure <= load * (1 + 1e-9));
  showLoad(points[Math.min(points.length - 1, Math.max(0, now + by))]);
}

function showLoad(point) {
  const { id } = report.sweep;
  if (shownRun !== id && runOf(id)) showRun(id);
  const run = runOf(id);
  if (run && isInViewer(run) && rangeOf(run)) goTo(recordingName(run), "load", point.number);
  momentOfLoad(point);
}
