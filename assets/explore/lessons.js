// The lessons: steps that ask first, and then show.

/** All lessons, as the server has them. */
let lessons = [];
let lesson = null;
/** What a lesson puts in the place of what was before, which is there again after it: the run that is pinned, as a lesson compares with the
 * step before, whether the stress below is shown, the map, and whether only the viewer was shown. */
let suspended = null;

async function beginLessons() {
  lessons = await ask("lessons");
  byId("lesson").append(element("option", { value: "" }, say("lesson.none")), ...lessons.map(({ name, title }) => element("option", { value: name }, inLanguage(title))));
  byId("lesson").addEventListener("change", () => openLesson(byId("lesson").value));
  byId("lesson-back").addEventListener("click", () => step(-1));
  byId("lesson-next").addEventListener("click", () => lesson.isOver ? openLesson(following().name) : step(1));
  byId("lesson-close").addEventListener("click", () => { openLesson(""); comeTo("lesson"); });
  byId("lesson").addEventListener("keydown", ({ key }) => { if (key === "Enter" && lesson) comeToLesson(); });
}

async function openLesson(name, at = 0) {
  if (name) endWelcome();
  if (!lesson) {
    suspended = { pinned, isDeep: isDeep(), map: shownMap, isInViewer: wantedView === "viewer" };
    if (suspended.isInViewer) putView("picture"); // lessons speak of the picture
    await setPin(null);
  }
  const opened = lessons.find((it) => it.name === name);
  byId("lesson").value = opened ? name : "";
  lesson = opened ? { ...opened, at, isOver: false, marks: new Map(), conducts: speaksOfConductance(opened) } : null;
  byId("lesson-card").hidden = !lesson;
  byId("fringes").checked = lesson ? lesson.stress : suspended.isDeep;
  dropGuess();
  dropWish();
  lightUp(null);
  if (lesson) showLesson(); else endLesson();
}

/** Leaves the page as a lesson left it; what was asked about and not shown yet is solved. */
function endLesson() {
  const wasAsked = document.body.dataset.asked === "true";
  document.body.dataset.asked = "false";
  uncover();
  if (runOf(suspended.pinned)) setPin(suspended.pinned);
  chooseMap(suspended.map);
  if (suspended.isInViewer) putView("viewer");
  if (wasAsked) changed(); else writeAddress();
}

/** Whether a person is at the card of the lesson: what they were at may go, and they come to what takes its place. */
const isAtCard = () => byId("lesson-card").contains(document.activeElement);
const comeTo = (id) => byId(id).focus({ preventScroll: true });
const comeToLesson = () => comeTo(byId("lesson-ask").hidden ? "lesson-text" : "lesson-ask");

/** Asks what the step asks, or shows it at once. */
function showLesson() {
  const isAt = isAtCard();
  const { steps, at, marks } = lesson;
  const isAsked = Boolean(steps[at].ask) && !marks.has(at);
  dropGuess();
  dropWish();
  lightUp(null);
  lesson.isOver = false;
  document.body.dataset.lesson = at;
  putAsked(isAsked);
  if (isAsked) { fault(""); poseStep(steps[at]); } else showStep();
  if (isAt) comeToLesson();
  writeAddress();
}

/** Shows the card with a question, or with a text. */
function putAsked(isAsked) {
  document.body.dataset.asked = isAsked;
  byId("lesson-ask").hidden = !isAsked;
  byId("lesson-text").hidden = isAsked;
  byId("lesson-back").disabled = lesson.at === 0;
  byId("lesson-next").disabled = isAsked;
  byId("lesson-next").textContent = lesson.at + 1 === lesson.steps.length ? say("lesson.finish") : say("lesson.next");
  markSteps();
}

/** What became of each step: answered rightly, or else; the one that is shown, and those to come. */
function markSteps() {
  const { steps, at, marks, title } = lesson;
  const glyph = (i) => i === at ? "●" : marks.has(i) ? (marks.get(i) ? "✓" : "✗") : "○";
  byId("lesson-place").textContent = `${at + 1} / ${steps.length}`;
  byId("lesson-marks").textContent = steps.map((_, i) => glyph(i)).join(" ");
  const isForeign = typeof title === "object" && !(language in title);
  byId("lesson-language").textContent = isForeign ? say("lesson.foreign", { language: LANGUAGES[language] }) : "";
}

/** Asks what a step asks, of a contact that is to be made, or of a surface that is not pressed yet. */
function poseStep(step) {
  const { ask: it, knobs: wanted } = step;
  if (it.kind === "act") { showMapOf(step); takeKnobs(wanted); changed(); } else showUnpressed(wanted);
  pose(step, reveal);
}

/** Shows the step after an answer, with what became of that before the text. A contact that a person has made stays. */
function reveal(verdict, isRight) {
  const { at, steps } = lesson;
  const { ask: it, solution, text } = steps[at];
  const isAt = isAtCard();
  lesson.marks.set(at, isRight);
  putAsked(false);
  if (it.kind === "act" && (isRight || !solution)) putText(text, verdict); else showStep(verdict);
  if (isAt) comeTo("lesson-text");
}

/** Whether a lesson speaks of the conductance, which is computed for such lessons alone. */
const speaksOfConductance = (its) => JSON.stringify(its).includes(CONDUCTANCE.name);

/** Gets the conductance of a run that has ended for a lesson that speaks of it. */
function findConductance(run) {
  if (!lesson?.conducts || !run.ended || !run.numbers || CONDUCTANCE.name in run.numbers) return;
  run.numbers[CONDUCTANCE.name] = null;
  facet(run, CONDUCTANCE.name).then((value) => {
    Object.assign(runOf(run.id)?.numbers ?? {}, { [CONDUCTANCE.name]: value });
    numbers();
  }).catch(() => {});
}

/** Sets a question aside whose contact a person has changed: what is solved now is not what was asked about. */
function setAside() {
  dropGuess();
  putAsked(false);
  uncover();
  const back = element("button", { type: "button", id: "lesson-again" }, say("lesson.again"));
  back.addEventListener("click", showLesson);
  byId("lesson-text").replaceChildren(say("lesson.aside"), " ", back);
}

/** The map that a step needs. */
function showMapOf({ show: map }) {
  if (map) chooseMap(map);
}

/** Puts the knobs to those that are wanted. A hand lets go of what it held. */
function takeKnobs(wanted) {
  grip = null;
  knobs = structuredClone(wanted);
  takeTheme();
  show();
}

function showStep(verdict) {
  const shown = lesson.steps[lesson.at];
  const { knobs: own, solution, text, sweep: sweeps } = shown;
  uncover();
  showMapOf(shown);
  takeKnobs(solution ?? own);
  putText(text, verdict);
  if (sweeps) sweep(); else changed();
}

function putText(text, verdict) {
  const words = pointing(inLanguage(text));
  byId("lesson-text").replaceChildren(...(verdict ? [element("strong", { id: "lesson-verdict" }, verdict), " ", ...words] : words));
}

function step(by) {
  const at = lesson.at + (lesson.isOver ? 0 : by);
  if (at === lesson.steps.length) { showEnd(); return; }
  lesson.at = Math.max(0, at);
  showLesson();
}

const following = () => lessons[lessons.findIndex(({ name }) => name === lesson.name) + 1];

/** What one has seen, something to do by oneself, and the lesson that follows. */
function showEnd() {
  const { end } = lesson;
  if (isAtCard()) comeTo("lesson-text");
  lesson.isOver = true;
  document.body.dataset.lesson = "end";
  const seenWords = pointing(end ? inLanguage(end.seen) : say("lesson.ended"));
  const task = end?.challenge;
  byId("lesson-text").replaceChildren(...seenWords, ...(task ? [" ", element("strong", { id: "lesson-challenge" }, ...pointing(say("lesson.challenge", { task: inLanguage(task.text) })))] : []));
  byId("lesson-back").disabled = false;
  byId("lesson-next").disabled = !following();
  byId("lesson-next").textContent = following() ? say("lesson.following", { title: inLanguage(following().title) }) : say("lesson.last");
  if (task) setWish(task.goal, () => { byId("lesson-challenge").replaceChildren(...pointing(say("lesson.challenged", { task: inLanguage(task.text) }))); });
}
