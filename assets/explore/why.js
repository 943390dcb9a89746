// Why a run took as long as it did: what held it up, in sentences, and three pictures over its steps.

/** Digits that the picture of the errors spans. */
const DIGITS = 8;
/** Pixels of a lane with its name and its bar, and of the numbers of steps below all of them. */
const LANE = { high: 30, bar: 10, foot: 18 };
/** The names of what solvers decide, in the order of their lanes. */
const DECISIONS = ["start", "conjugate", "exchange", "descend", "whole-set", "single-precision", "split-compliance", "guarded", "damped", "coast", "accelerate", "halt"];

function beginWhy() {
  byId("why").addEventListener("click", openWhy);
}

/** Solves the shown run again, and shows why it was slow. */
async function openWhy() {
  const run = shownOrLatest();
  if (!run?.ended) { fault(say("why.early")); return; }
  byId("why-title").textContent = say("why.title", { title: `${titleOf(run)}${methodOf(run)}` });
  byId("why-causes").replaceChildren(element("li", {}, say("why.waiting")));
  byId("why-pictures").hidden = true;
  document.body.dataset.why = "asked";
  byId("why-dialog").showModal();
  const its = await Promise.all(["why", "motion"].map((name) => facet(run, name))).catch((error) => { byId("why-causes").textContent = error.message; });
  if (its && run.process) byId("why-causes").replaceChildren(element("li", {}, say(`why.${run.process.kind}`)));
  if (!its?.[0]) return;
  const [why, motion] = its;
  const standing = why.standing && say("why.standing", { area: why.standing.relative_area, kappa: why.standing.kappa_r, steps: why.standing.steps });
  const causes = why.causes.map((found) => [`${causeInWords(found)} `, cureButton(found, run)]);
  const lines = [...(causes.length ? causes : [[say("why.nothing")]]), [standing]];
  byId("why-causes").replaceChildren(...lines.map((line) => line.filter(Boolean)).filter(({ length }) => length).map((line) => element("li", {}, ...line)));
  byId("why-pictures").hidden = false;
  drawWhy(why, motion);
  document.body.dataset.why = run.id;
}

/** What held a run up, in a sentence or two with what would help. */
function causeInWords({ cause, ...numbers }) {
  const places = Object.fromEntries(Object.entries(numbers).filter(([, value]) => typeof value === "number").map(([name, value]) => [name, figure(value, 3)]));
  if (cause === "damping") return say(`why.damping.${numbers.damping > 1 ? "strong" : "weak"}`, places);
  if (cause === "slow_band") Object.assign(places, { long: lengthOf(numbers.wavelengths[0]), short: lengthOf(numbers.wavelengths[1]), share: figure(100 * numbers.share, 2) });
  if (cause === "condition") places.steps = figure(Math.sqrt(numbers.condition) * Math.LN10 / 4, 2);
  if (cause === "flips") places.place = lengthOf(numbers.position[1]);
  if (cause === "plateau") Object.assign(places, { from: numbers.steps[0], to: numbers.steps[1] });
  return say(`why.${cause}`, places);
}

/** The three pictures, whose steps stand alike: early ones, in which most happens, wide. */
function drawWhy({ errors, decisions, length }, motion) {
  const last = Math.max(1, ...decisions.stretches.map(({ steps }) => steps[1]), ...errors.steps, ...motion.steps);
  const x = (step) => Math.log1p(step) / Math.log1p(last);
  const colour = colours();
  drawCells(byId("why-contact"), motion.steps.map(x), motion.sections.map(({ pressure }) => pressure), (p) => p > 0 ? [colour.warm, 1] : null);
  drawCells(byId("why-errors"), errors.steps.map(x), errors.rows, (error) => error > 0 ? [colour.accent, Math.min(1, Math.max(0, 1 + Math.log10(error) / DIGITS))] : null);
  byId("why-contact-axis").textContent = say("why.contact.axis", { length: lengthOf(length) });
  const { wavelengths } = errors;
  byId("why-errors-axis").textContent = wavelengths.length ? say("why.errors.axis", { long: lengthOf(wavelengths[0][0]), short: lengthOf(wavelengths.at(-1)[1]) }) : "";
  const shown = DECISIONS.filter((name) => decisions.stretches.some((it) => it.name === name));
  drawLanes(byId("why-decisions"), decisions.stretches, shown, (step) => x(step), colour);
  byId("why-lanes").replaceChildren(...shown.map((name) => element("li", {}, say(`decision.${name}`))));
  byId("why-steps").textContent = say("why.steps", { last });
}

/** The pen of a canvas that is as fine as the screen, and its size. */
function penOf(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const scale = window.devicePixelRatio || 1;
  Object.assign(canvas, { width: Math.round(width * scale), height: Math.round(height * scale) });
  const pen = canvas.getContext("2d");
  pen.scale(scale, scale);
  return { pen, width, height };
}

/** A column for each step, from its place to that of the next one, with a cell for each value from the top down. */
function drawCells(canvas, places, columns, paintOf) {
  const { pen, width, height } = penOf(canvas);
  columns.forEach((values, i) => {
    const [left, right] = [places[i], places[i + 1] ?? 1].map((place) => Math.round(place * width));
    values.forEach((value, j) => {
      const paint = paintOf(value);
      if (!paint) return;
      [pen.fillStyle, pen.globalAlpha] = paint;
      const [top, bottom] = [j, j + 1].map((row) => Math.round(row / values.length * height));
      pen.fillRect(left, top, Math.max(1, right - left), Math.max(1, bottom - top));
    });
  });
}

/** A lane for each decision, with a bar for each stretch of steps; bars of coarser grids are paler. */
function drawLanes(canvas, stretches, names, x, colour) {
  canvas.style.height = `${names.length * LANE.high + LANE.foot}px`;
  const { pen, width, height } = penOf(canvas);
  pen.fillStyle = colour.green;
  for (const { name, level, steps: [from, to] } of stretches) {
    pen.globalAlpha = 1 / (1 + level / 2);
    pen.fillRect(x(from) * width, (names.indexOf(name) + 1) * LANE.high - LANE.bar, Math.max(1, (x(to + 1) - x(from)) * width), LANE.bar);
  }
  Object.assign(pen, { globalAlpha: 1, fillStyle: colour.soft, font: FONT, textBaseline: "bottom", textAlign: "center" });
  for (let step = 1; x(step) < 1; step *= 10) {
    pen.fillRect(x(step) * width, height - LANE.foot, 1, 4);
    if (x(step) > 0.02 && x(step) < 0.98) pen.fillText(String(step), x(step) * width, height);
  }
}
