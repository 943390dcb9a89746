"use strict";
// Guesses: what a lesson asks before it shows.

/** Loads at which a curve is guessed, and the upper ends of the axes of the charts. */
const GUESSED_LOADS = [1e-3, 1e-2, 0.1, 0.3, 1];
const CURVES = { area: ["a_rel", 1, "chart-area"], kappa: ["κ", 10, "chart-kappa"], "kappa-r": ["κ_r", 10, "chart-kappa"] };

/** The guess that is held against what is shown: a curve in a chart, or a number. */
let guess = null;

function dropGuess() {
  guess = null;
  charts();
}

/** Puts a question on the page, and calls with what there is to say of the answer. */
function pose(it, done) {
  byId("lesson-question").textContent = inLanguage(it.question);
  const answers = { choose, number: askNumber, draw: askCurve }[it.kind](it, done);
  byId("lesson-answers").replaceChildren(...answers);
}

function choose({ choices, right }, done) {
  const texts = choices.map(inLanguage);
  return texts.map((choice, i) => {
    const made = element("button", { type: "button", class: "answer", id: `answer-${i + 1}` }, choice);
    made.addEventListener("click", () => done(i + 1 === right ? say("guess.yes", { choice }) : say("guess.no", { choice, answer: texts[right - 1] })));
    return made;
  });
}

function askNumber({ of }, done) {
  const symbol = nameOf(of);
  const limits = [0, of.startsWith("relative_area") ? 1 : Infinity];
  const field = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": symbol, id: "guess-number" });
  const made = element("button", { type: "button", class: "answer", id: "answer-1" }, say("guess.show"));
  made.addEventListener("click", () => {
    const sentence = faultOf(symbol, field.value, numberFrom(field.value), limits);
    if (sentence) { fault(sentence); field.focus(); return; }
    guess = { of, said: say("guess.number", { symbol, value: field.value }) };
    done(guess.said);
  });
  return [element("label", { for: "guess-number" }, `${symbol} = `), field, made];
}

/** The name of a number: that of its row in the table, or else its symbol. */
function nameOf(of) {
  return observables.some(({ name }) => name === of) ? say(`number.${of}`) : known.find(({ name }) => name === of)?.symbol ?? of;
}

/** Says what a number that was guessed is, once the run of the step has ended. */
function judge(run) {
  if (!guess?.of || !run.ended || !byId("lesson-verdict") || words(run.knobs) !== words(knobs)) return;
  byId("lesson-verdict").textContent = `${guess.said} ${say("guess.told", { value: figure(run.numbers?.[guess.of]) })}`;
}

/** A slider for each load, which together are the curve; it is drawn in its chart while they are moved. */
function askCurve({ curve }, done) {
  const [name, top, target] = CURVES[curve];
  const values = GUESSED_LOADS.map(() => top / 2);
  guess = { target, top, points: GUESSED_LOADS.map((load, i) => [load, values[i]]) };
  const sliders = GUESSED_LOADS.map((load, i) => {
    const slider = element("input", { type: "range", min: "0", max: `${top}`, step: `${top / 100}`, value: `${values[i]}`, class: "guess", "aria-label": say("guess.at", { name, load: inLocale(String(load)) }) });
    slider.addEventListener("input", () => { guess.points[i][1] = slider.valueAsNumber; charts(); });
    return element("label", {}, slider, ` p* = ${inLocale(String(load))}`);
  });
  const made = element("button", { type: "button", class: "answer", id: "answer-1" }, say("guess.show"));
  made.addEventListener("click", () => done(say("guess.curve")));
  charts();
  return [...sliders, made];
}

/** The guessed curve of a chart, if there is one. */
function guessOf(target) {
  return guess && guess.target === target ? [{ name: say("guess.yours"), style: "guess", points: guess.points }] : [];
}
