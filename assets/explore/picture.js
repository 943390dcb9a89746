"use strict";
// The page's own picture of a contact: pressure, the rigid surface on the solid, and the shear stress below.

/** Shares of the picture's height: the pressure above, the surfaces in the middle, the stress below. */
const BANDS = { pressure: 0.24, relief: 0.42 };
/** Room above the highest pressure and about the surfaces, over the height of their bands. */
const SPARE = 0.08;
/** Fringe orders up to the largest shear stress. */
const ORDERS = 8;

/** The section that is drawn, its run, and the limits of its axes, which stay as they are while a hand holds it. */
let section = null;
let axes = null;

/** Axes that hold a section: the lowest and the highest place, the largest pressure, the largest shear stress. */
function axesOf({ rigid, solid, pressure, shear }) {
  const low = Math.min(...solid);
  const high = Math.max(...rigid);
  return { low, high, pressure: Math.max(...pressure) || 1, shear: shear ? Math.max(...shear.values) || 1 : 1 };
}

/** Shows a section, with axes of its own unless a hand holds it. */
function showSection(shown, isHeld = false) {
  section = shown;
  if (!section) return;
  const own = axesOf(section);
  axes = isHeld && axes ? { ...axes, pressure: Math.max(axes.pressure, own.pressure), shear: Math.max(axes.shear, own.shear) } : own;
  drawSection();
  placeHandles();
}

/** Places of the picture in pixels: x of a share of the length, y of a height and of a pressure, and back. */
function frame(canvas) {
  const { width: w, height: h } = canvas.getBoundingClientRect();
  const top = h * BANDS.pressure;
  const high = h * BANDS.relief;
  const perHeight = high * (1 - 2 * SPARE) / (axes.high - axes.low || 1);
  return {
    w, h, top, ground: top + high, perHeight,
    x: (share) => share * w,
    y: (height) => top + high * SPARE + (axes.high - height) * perHeight,
    pressure: (p) => top * (1 - (1 - SPARE) * p / axes.pressure),
  };
}

function drawSection() {
  const canvas = byId("section");
  const box = canvas.getBoundingClientRect();
  if (!section || !box.width) return;
  const scale = window.devicePixelRatio || 1;
  canvas.width = Math.round(box.width * scale);
  canvas.height = Math.round(box.height * scale);
  const to = canvas.getContext("2d");
  to.scale(scale, scale);
  paintSection(to, frame(canvas), section);
  canvas.setAttribute("aria-label", sectionInWords());
}

/** The colours of the style sheet. */
function colours() {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(["ground", "panel", "edge", "ink", "soft", "accent", "warm", "green"].map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

function paintSection(to, at, { rigid, solid, pressure, shear }) {
  const colour = colours();
  const place = (i, n) => at.x((i + 0.5) / n);
  const line = (values, y) => {
    const path = new Path2D();
    values.forEach((value, i) => path[i ? "lineTo" : "moveTo"](place(i, values.length), y(value)));
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
  if (shear) paintShear(to, at, solid, shear);
  if (chosen) paintChosen(to, at, colour);
  to.save();
  to.beginPath();
  to.rect(0, at.top, at.w, at.h - at.top);
  to.clip();
  to.fillStyle = colour.edge;
  to.fill(filled(rigid, at.y, at.top));
  to.lineWidth = 1.5;
  to.strokeStyle = colour.soft;
  to.stroke(line(rigid, at.y));
  to.strokeStyle = colour.accent;
  to.stroke(line(solid, at.y));
  to.restore();
  to.fillStyle = colour.warm;
  to.fill(filled(pressure, at.pressure, at.top));
  to.fillStyle = colour.soft;
  to.font = "12px system-ui, sans-serif";
  to.fillText(`p ≤ ${figure(axes.pressure, 3)} E*`, 6, 14);
}

/** The stress below each place of the surface, to scale, as the fringes that crossed polarisers show. */
function paintShear(to, at, solid, { depth, columns, values }) {
  const rows = values.length / columns;
  const image = new ImageData(columns, rows);
  values.forEach((value, i) => {
    const light = Math.sin(Math.PI * ORDERS * value / axes.shear) ** 2;
    image.data.set([86, 180, 233, 215 * light], 4 * i);
  });
  const source = element("canvas", { width: columns, height: rows });
  source.getContext("2d").putImageData(image, 0, 0);
  const high = depth / section.length * at.w;
  for (let i = 0; i < columns; i++) {
    const y = at.y(solid[Math.floor((i + 0.5) / columns * solid.length)]);
    to.drawImage(source, i, 0, 1, rows, at.w * i / columns, y, at.w / columns + 0.5, high);
  }
}

/** The picture in words, for those who do not see it. */
function sectionInWords() {
  const touching = section.pressure.filter((p) => p > 0).length / section.pressure.length;
  return `Profile of the rigid surface on the solid: ${figure(100 * touching, 3)} % of it touches, largest pressure ${figure(Math.max(...section.pressure), 3)} E*`;
}
