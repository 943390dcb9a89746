// One chart: two axes, curves and dots.

const SVG = "http://www.w3.org/2000/svg";

function drawn(tag, attributes, text) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  return made;
}

/** Room around the axes of a chart: numbers on the left, title and legend above, numbers and the name of the axis below. */
const ROOM = { left: 40, right: 14, above: 36, below: 34 };
/** Room between two names of a legend, and between two marks of a logarithmic axis, in pixels: on a screen, and on a wall. */
const APART = 8;
const markRoom = () => "projector" in document.body.dataset ? 52 : 34;

/** A logarithmic axis over whole decades: the share of its length of a value, and back, and its marks.
 * @type {(values: number[], usual: [number, number], length: number) => any} */
function logAxis(values, usual, length) {
  const places = values.map(Math.log10).filter(Number.isFinite);
  const [least, most] = [Math.min(...places), Math.max(...places)];
  const [first, last] = places.length > 1 ? [Math.floor(least), Math.ceil(Math.max(most, least + 1))] : usual;
  const every = Math.max(1, Math.ceil((last - first) * markRoom() / length));
  const marks = [];
  for (let e = first; e <= last; e += every) marks.push([10 ** e, e === 0 ? "1" : `1e${e}`]);
  return { share: (value) => (Math.log10(value) - first) / (last - first || 1), value: (share) => 10 ** (first + share * (last - first)), marks };
}

/** A linear axis from one value to another, with marks at given values. */
const linearAxis = (first, last, marks) => ({ share: (value) => (value - first) / (last - first || 1), value: (share) => first + share * (last - first), marks });

/** A linear axis that holds values and zero, with round marks in a unit.
 * @type {(values: number[], size: number) => any} */
function roundAxis(values, size) {
  const all = [0, ...values.filter(Number.isFinite)].map((value) => value / size);
  const [least, most] = [Math.min(...all), Math.max(...all)];
  const third = (most - least || 1) / 3;
  const power = 10 ** Math.floor(Math.log10(third));
  const every = power * [1, 2, 5, 10].find((step) => step * power >= third * (1 - 1e-9));
  const [first, last] = [Math.floor(least / every * (1 + 1e-9)), Math.ceil(most / every * (1 - 1e-9))];
  const marks = [];
  for (let i = first; i <= Math.max(last, first + 1); i++) marks.push([i * every * size, marked(i * every)]);
  return linearAxis(marks[0][0], marks.at(-1)[0], marks);
}

/** What a chart has room for, in pixels. */
function roomOf(target) {
  const box = target.getBoundingClientRect();
  const [w, h] = [Math.max(160, box.width), Math.max(120, box.height)];
  return { box, w, h, wide: w - ROOM.left - ROOM.right, high: h - ROOM.above - ROOM.below };
}

/** Draws a chart: its title, the name of its horizontal axis, both axes, curves { name, points, style }, dots { style, at }, rings around the state that is shown, a note in its
 * middle, where on the horizontal axis the state is that is shown, and what a click on a place does. What is above the axes is left out, and is
 * said in the legend. */
function chart(target, { title, name, x: across, y: up, curves, dots, rings = [], note, isStale, now, pick }) {
  const { box, w, h, wide, high } = roomOf(target);
  const [x, y] = [(value) => ROOM.left + across.share(value) * wide, (value) => h - ROOM.below - up.share(value) * high];
  const svg = drawn("svg", { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": `${title}${note ? `: ${note}` : ""}`, class: isStale ? "stale" : "" });
  const frame = { x: ROOM.left, y: ROOM.above, width: wide, height: high };
  const inside = `inside-${target.id}`;
  const clip = drawn("clipPath", { id: inside });
  clip.append(drawn("rect", frame));
  svg.append(clip, drawn("rect", { class: "axis", ...frame }), drawn("text", { class: "title", x: ROOM.left, y: 13 }, title));
  for (const [value, text] of across.marks) svg.append(drawn("text", { x: x(value), y: h - 20, "text-anchor": "middle" }, text));
  for (const [value, text] of up.marks) svg.append(drawn("text", { x: ROOM.left - 4, y: y(value) + 4, "text-anchor": "end" }, text));
  if (up.share(0) > 1e-6 && up.share(0) < 1) svg.append(drawn("line", { class: "zero", x1: ROOM.left, x2: w - ROOM.right, y1: y(0), y2: y(0) }));
  svg.append(drawn("text", { x: ROOM.left + wide / 2, y: h - 5, "text-anchor": "middle" }, name));
  if (across.share(now) >= 0 && across.share(now) <= 1) svg.append(drawn("line", { class: "now", x1: x(now), x2: x(now), y1: ROOM.above, y2: h - ROOM.below }));
  const isInside = (value) => up.share(value) <= 1 + 1e-9;
  const placeOf = ({ clientX, clientY }) => [across.value((clientX - box.x - ROOM.left) / wide), up.value((h - ROOM.below - (clientY - box.y)) / high)];
  const isGuessed = guess?.target === target.id;
  target.toggleAttribute("data-drawn", isGuessed);
  target.onclick = isGuessed || !pick ? null : (event) => pick(...placeOf(event));
  target.onpointerdown = isGuessed ? (event) => { target.setPointerCapture(event.pointerId); drawGuess(...placeOf(event)); } : null;
  target.onpointermove = isGuessed ? (event) => { if (event.buttons) drawGuess(...placeOf(event)); } : null;
  const shown = curves.filter((curve) => curve.points.length || dots.some(({ style }) => style === curve.style));
  for (const curve of shown) {
    svg.append(drawn("polyline", { class: curve.style, "clip-path": `url(#${inside})`, points: curve.points.map(([a, b]) => `${x(a).toFixed(1)},${y(b).toFixed(1)}`).join(" ") }));
    const place = curve.now ?? curve.points.find(([a]) => a === now);
    if (place && isInside(place[1])) svg.append(drawn("circle", { class: `of-${curve.style}`, cx: x(place[0]), cy: y(place[1]), r: 5 }));
  }
  for (const { style, at: [a, b] } of dots) if (isInside(b)) svg.append(drawn("circle", { class: `of-${style}`, cx: x(a), cy: y(b), r: 3.5 }));
  for (const { style, at: [a, b] } of rings) if (isInside(b)) svg.append(drawn("circle", { class: `${style} ring`, cx: x(a), cy: y(b), r: 6 }));
  const said = note || (shown.length || dots.length ? "" : say("chart.sweep"));
  const isHigh = dots.some(({ at: [, value] }) => up.share(value) > 0.6);
  const top = dots.length ? (isHigh ? high - 8 : 14) : high / 2; // where there are no dots
  said.split(", ").filter(Boolean).forEach((line, i) => {
    svg.append(drawn("text", { class: "note", x: ROOM.left + wide / 2, y: ROOM.above + top + 16 * i, "text-anchor": "middle" }, line));
  });
  target.replaceChildren(svg);
  for (const text of svg.querySelectorAll(".note")) fit(text, wide + 2 * ROOM.right);
  const heading = /** @type {SVGTextElement} */ (svg.querySelector(".title"));
  fit(heading, w);
  heading.setAttribute("x", String(Math.max(0, Math.min(ROOM.left, w - heading.getComputedTextLength()))));
  legend(svg, up, shown, dots, w);
}

/** Makes the letters of a text smaller until it is not wider than it may be.
 * @param {any} text */
function fit(text, width) {
  const length = text.getComputedTextLength();
  if (length > width) text.style.fontSize = `${parseFloat(getComputedStyle(text).fontSize) * width / length}px`;
}

/** The names of the curves in one line above the axes, each as wide as it is drawn, and smaller where there is no room for all. */
function legend(svg, up, curves, dots, width) {
  const names = curves.filter(({ name }) => name).map(({ name, style, points }) => {
    const highest = Math.max(...points.map(([, value]) => value), ...dots.filter((dot) => dot.style === style).map(({ at }) => at[1]));
    return drawn("text", { class: `of-${style}`, y: 28 }, up.share(highest) > 1 ? `${name} ↑${figure(highest, 2)}` : name);
  });
  svg.append(...names);
  const widths = names.map((name) => name.getComputedTextLength() + APART);
  const whole = widths.reduce((sum, width) => sum + width, 0);
  const share = Math.min(1, width / whole);
  let place = Math.max(0, Math.min(ROOM.left, width - whole));
  names.forEach((name, i) => { fit(name, share * (widths[i] - APART)); name.setAttribute("x", place); place += share * widths[i]; });
}
