"use strict";
// The lessons: steps that ask first, and then show.

/** All lessons, as the server has them. */
let lessons = [];
let lesson = null;
/** The run that was pinned before the lesson, to be pinned again after it: a lesson compares with the step before. */
let suspended = null;

async function beginLessons() {
  lessons = await ask("lessons");
  byId("lesson").append(element("option", { value: "" }, say("lesson.none")), ...lessons.map(({ name, title }) => element("option", { value: name }, inLanguage(title))));
  byId("lesson").addEventListener("change", () => openLesson(byId("lesson").value));
  byId("lesson-back").addEventListener("click", () => step(-1));
  byId("lesson-next").addEventListener("click", () => step(1));
  byId("lesson-close").addEventListener("click", () => { byId("lesson").value = ""; openLesson(""); });
}

async function openLesson(name, at = 0) {
  if (!lesson) {
    suspended = pinned;
    await setPin(null);
  }
  const opened = lessons.find((it) => it.name === name);
  lesson = opened ? { ...opened, at, answered: new Set() } : null;
  byId("lesson-card").hidden = !lesson;
  dropGuess();
  if (lesson) showLesson(); else if (runOf(suspended)) setPin(suspended);
}

/** Asks what the step asks, or shows it at once. */
function showLesson() {
  const { steps, at, answered } = lesson;
  const isAsked = steps[at].ask && !answered.has(at);
  dropGuess();
  byId("lesson-place").textContent = `${at + 1} / ${steps.length}`;
  byId("lesson-back").disabled = at === 0;
  byId("lesson-next").disabled = isAsked || at + 1 === steps.length;
  document.body.dataset.lesson = at;
  document.body.dataset.asked = Boolean(isAsked);
  byId("lesson-ask").hidden = !isAsked;
  byId("lesson-text").hidden = isAsked;
  if (isAsked) { fault(""); pose(steps[at].ask, reveal); } else showStep();
  writeAddress();
}

/** Shows the step after a guess, with what became of the guess before the text. */
function reveal(verdict) {
  lesson.answered.add(lesson.at);
  byId("lesson-ask").hidden = true;
  byId("lesson-text").hidden = false;
  byId("lesson-next").disabled = lesson.at + 1 === lesson.steps.length;
  document.body.dataset.asked = false;
  showStep(verdict);
}

function showStep(verdict) {
  const { knobs: wanted, text, sweep: sweeps } = lesson.steps[lesson.at];
  knobs = structuredClone(wanted);
  takeTheme();
  show();
  const words = inLanguage(text);
  byId("lesson-text").replaceChildren(...(verdict ? [element("strong", { id: "lesson-verdict" }, verdict), ` ${words}`] : [words]));
  if (sweeps) sweep(); else changed();
}

function step(by) {
  lesson.at = Math.max(0, Math.min(lesson.steps.length - 1, lesson.at + by));
  showLesson();
}
