// Questions of lessons: guesses before something is shown, and contacts to be made.

/** Loads at which a curve is guessed, and the upper ends of the axes of the charts. */
const GUESSED_LOADS = [1e-3, 1e-2, 0.1, 0.3, 1];
const CURVES = { area: ["a_rel", 1, "chart-area"], kappa: ["κ", 10, "chart-kappa"], "kappa-r": ["κ_r", 10, "chart-kappa"] };
/** How near a number has to be to count as right, and the error from which it is shown as a multiple. */
const NEAR = 0.1;
const MULTIPLE = 2;
/** Numbers of the work of a solver, which nobody knows before it is done. */
const WORK = ["iterations", "transforms", "seconds"];

/** The guess that is held against what is shown: a curve in a chart, or a number. */
let guess = null;
/** The numbers that a step will have, while it is asked about; none where they are not known. */
let expected = null;
/** A contact that is to be made: the limits of its numbers, and what follows when it is made. */
let wish = null;

function dropGuess() {
  guess = null;
  expected = null;
  byId("lesson-why").textContent = "";
  charts();
}

/** Puts a question on the page, and calls with what there is to say of the answer and whether it is right. */
function pose({ ask: it, solution }, done) {
  byId("lesson-question").replaceChildren(...pointing(inLanguage(it.question)));
  const answers = { choose, number: askNumber, draw: askCurve, act: askContact }[it.kind](it, done, Boolean(solution));
  byId("lesson-answers").replaceChildren(...answers);
}

function answerButton(number, text, action) {
  const made = element("button", { type: "button", class: "answer", id: `answer-${number}` }, text);
  made.addEventListener("click", () => action(made));
  return made;
}

const tellWhy = (sentence) => byId("lesson-why").replaceChildren(...pointing(sentence));

/** Goes on without an answer: to what is asked for, or where nobody says that, to the text. */
function skipButton(number, isTold, done) {
  return answerButton(number, say(isTold ? "guess.tell" : "guess.skip"), () => { fault(""); done(say(isTold ? "guess.told-you" : "guess.skipped"), false); });
}

/** With three or more choices, a wrong choice is explained, and there is a second try. */
function choose({ choices, right }, done) {
  const its = choices.map(({ text, because }) => ({ choice: inLanguage(text), because: because ? inLanguage(because) : "" }));
  let isSecond = choices.length < 3;
  return its.map(({ choice, because }, i) => answerButton(i + 1, choice, (made) => {
    if (i + 1 === right) { done(say("guess.yes", { choice }), true); return; }
    if (isSecond) { done(say("guess.no", { choice, because: withoutPoints(because), answer: its[right - 1].choice }), false); return; }
    isSecond = true;
    if (made === document.activeElement) comeTo("lesson-ask");
    made.disabled = true;
    tellWhy(say("guess.again", { choice, because }));
  }));
}

/** For a number with a large error, the page shows whether it is too large, and there is a second try. */
function askNumber({ of }, done) {
  const symbol = nameOf(of);
  const isShare = SHARES.test(of);
  const limits = [0, of.startsWith("relative_area") ? 1 : Infinity];
  let isSecond = false;
  const field = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": symbol, id: "guess-number" });
  const made = answerButton(1, say("guess.answer"), () => {
    const value = isShare ? shareFrom(field.value) : numberFrom(field.value);
    const sentence = isShare && Number.isNaN(value) ? say("fault.share") : faultOf(symbol, field.value, value, limits);
    if (sentence) { fault(sentence); field.focus(); return; }
    fault("");
    const truth = WORK.includes(of) ? null : expected?.[of];
    if (!isSecond && truth && !isNear(value, truth)) {
      isSecond = true;
      tellWhy(say(`guess.${value > truth ? "large" : "small"}`, { value: field.value }));
      field.focus();
      return;
    }
    guess = { of, value, said: say("guess.number", { symbol, value: field.value }) };
    done(guess.said, Boolean(truth) && isNear(value, truth));
  });
  field.addEventListener("keydown", ({ key }) => { if (key === "Enter") made.click(); });
  return [element("label", { for: "guess-number" }, `${symbol} = `), field, made, skipButton(2, true, done)];
}

/** Numbers that are shares of a whole, and may be given in percent. */
const SHARES = /^relative_area|_error$|^friction$|_share$/;

/** The number in a text, as a share or in percent; not a number for any other text. */
function shareFrom(text) {
  const [, number, percent] = /^\s*(.*?)\s*(%?)\s*$/.exec(text);
  return numberFrom(number) / (percent ? 100 : 1);
}

const isNear = (value, truth) => Math.abs(value - truth) <= NEAR * Math.abs(truth);

/** The name of a number: that of its row in the table, or else its symbol. */
function nameOf(of) {
  return knows(`number.${of}`) ? say(`number.${of}`) : known.find(({ name }) => name === of)?.symbol ?? of;
}

/** Says what a number that was guessed is, and how far off the guess was, once the run of the step has ended. */
function judge(run) {
  if (!guess?.of || !run.ended || !byId("lesson-verdict") || words(run.knobs) !== words(knobs)) return;
  const truth = run.numbers?.[guess.of];
  if (typeof truth !== "number") return; // not there yet
  byId("lesson-verdict").textContent = `${guess.said} ${say("guess.told", { value: figure(truth) })} ${howFar(guess.value, truth)}`;
  lesson.marks.set(lesson.at, isNear(guess.value, truth));
}

/** How far a guess is from the truth, in a sentence. */
function howFar(value, truth) {
  if (value === truth) return say("guess.exact");
  const side = value > truth ? "above" : "below";
  const ratio = value > truth ? value / truth : truth / value;
  if (ratio < MULTIPLE) return say(`guess.${side}`, { percent: figure(100 * Math.abs(value / truth - 1), 2) });
  return Number.isFinite(ratio) ? say(`guess.${side}.times`, { times: figure(ratio, 2) }) : "";
}

/** A curve is drawn in its chart, or by a slider for each load. */
function askCurve({ curve }, done) {
  const [name, top, target] = CURVES[curve];
  guess = { target, top, points: GUESSED_LOADS.map((load) => [load, top / 2]) };
  guess.sliders = GUESSED_LOADS.map((load, i) => {
    const slider = element("input", { type: "range", min: "0", max: `${top}`, step: `${top / 100}`, value: `${top / 2}`, class: "guess", "aria-label": say("guess.at", { name, load: inLocale(String(load)) }) });
    slider.addEventListener("input", () => { guess.points[i][1] = slider.valueAsNumber; charts(); });
    return slider;
  });
  tellWhy(say("guess.draw"));
  charts();
  const rows = guess.sliders.map((slider, i) => element("label", {}, slider, ` p* = ${inLocale(String(GUESSED_LOADS[i]))}`));
  return [...rows, answerButton(1, say("guess.show"), () => done(say("guess.curve"), true))];
}

/** Moves the guessed curve of a chart to a place in it, at the load that is nearest. */
function drawGuess(load, value) {
  const away = ([at]) => Math.abs(Math.log(at / load));
  const nearest = guess.points.reduce((best, point, i) => away(point) < away(guess.points[best]) ? i : best, 0);
  guess.points[nearest][1] = Math.min(guess.top, Math.max(0, value));
  guess.sliders[nearest].value = guess.points[nearest][1];
  charts();
}

/** The guessed curve of a chart, if there is one. */
function guessOf(target) {
  return guess && guess.target === target ? [{ name: say("guess.yours"), style: "guess", points: guess.points }] : [];
}

/** A contact is made by the hand or the controls, and is seen when it is there; who cannot make it is shown it. */
function askContact({ goal }, done, isTold) {
  setWish(goal, () => done(say("guess.made"), true));
  return [skipButton(1, isTold, (verdict) => { dropWish(); done(verdict, false); })];
}

function setWish(goal, done) {
  wish = { goal, done };
  numbers();
}

function dropWish() {
  wish = null;
}

/** Whether the contact that is shown is the one that is to be made: it is of the knobs, and ended, or was let go by the hand, which passes through
 * others. */
function watchWish(run) {
  if (grip) return;
  const isShown = moment ? moment.isStuck || moment.numbers.reduced_pressure > 0 : run.ended && words(run.knobs) === words(knobs);
  const told = (moment ?? run).numbers;
  const isMade = ([of, [least, most]]) => typeof told[of] === "number" && told[of] >= least && told[of] <= most;
  if (!wish || !isShown || !Object.entries(wish.goal).every(isMade)) return;
  const { done } = wish;
  dropWish();
  done();
}

/** Shows the surface of a state before it is pressed, and no numbers; what it will have is known to the question alone. */
function showUnpressed(wanted) {
  const { at, name } = lesson;
  takeKnobs(wanted);
  choosePatch(null);
  const asked = { name: say("moment.asked"), title: say("title.asked"), numbers: {}, exact: null, isClear: true, isAsked: true, knobs: structuredClone(knobs) };
  setMoment(asked);
  charts();
  if (viewer) noteViewer(say("viewer.asked"));
  const show = ({ section: its, numbers: told }) => {
    if (lesson?.name !== name || lesson.at !== at || document.body.dataset.asked !== "true") return;
    expected = HAS.yielding(knobs) ? {} : told;
    setPictured(moment);
    showSection(liftedClear(its, UNPRESSED * its.highest), null);
    document.body.dataset.unpressed = at;
  };
  const order = { knobs: { ...knobs, sideways: 0, "yield-stress": 0 }, "mean-gap": null, "is-deep": false }; // what has a history cannot be held
  hold(() => order, show);
}
