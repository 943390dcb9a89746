"use strict";
// The lessons.

const HERTZ = { domain: "line", body: "round", roughness: 0, points: 4096, solver: { method: "multilevel" }, record: ["traces", "profile", "mesh", "fields", "mask"] };
const ROUGH = { ...HERTZ, body: "flat", roughness: 0.001, hurst: 0.8, rolloff: 8, cutoff: 128, seed: 1 };
const SLOW = { method: "gfmd", masses: "uniform", dynamics: "damped", "time-step": 0.5, damping: 1 };
const CRAWL = { ...ROUGH, points: 4096, cutoff: 64, load: 0.05, solver: SLOW, stop: { tolerance: 1e-8, "max-iterations": 20000 }, record: ["traces", "spectrum"] };

const LESSONS = {
  "Hertz against rough contact": [
    [{ ...HERTZ, load: 0.001 }, "A smooth cylinder. The pressure is Hertz's half ellipse; the exact one is the dashed green line over it, and the exact numbers stand in green below."],
    [{ ...HERTZ, load: 0.01 }, "Ten times the load. The contact is only about three times as wide, so κ = a_rel / p* falls to a third. The gradient in contact grew instead, and κ_r, which takes that one, stays: compare “this run” with “before”."],
    [{ ...ROUGH, load: 0.01 }, "Now a rough line under the small load. Contact breaks into many patches, each of them a little Hertz contact of its own."],
    [{ ...ROUGH, load: 0.1 }, "Ten times the load on the rough line. The area grows almost in proportion now, because new patches join. κ still falls by a third; κ_r stays within a few per cent."],
    [{ ...ROUGH, load: 0.1, sweep: true }, "A sweep from first touch to full contact draws it all: κ falls with the load, κ_r keeps its level until most of the surface touches. The gradient that matters is the one in contact, not that of the whole surface."],
  ],
  "Below the surface": [
    [{ ...HERTZ, load: 0.01, record: ["traces", "profile", "fields", "mask", "stress"] }, "A smooth cylinder, and under its profile the largest shear stress in the solid. It is not largest at the surface, where the pressure acts from all sides, but at a depth of 0.78 half-widths, 0.30 of the largest pressure: there a metal yields first, unseen."],
    [{ ...HERTZ, load: 0.01, record: ["traces", "profile", "fields", "mask", "fringes"] }, "The same as Hertz contacts are shown in teaching: a transparent model between crossed polarisers. It is dark wherever the difference of the principal stresses is a whole number of orders, so each line is a contour of the shear stress, and where lines crowd it changes fast."],
    [{ ...ROUGH, load: 0.05, record: ["traces", "profile", "fields", "mask", "fringes"] }, "A rough line. Each patch has its own small Hertz pattern just below it. Deeper, neighbours merge into ever larger ones: at a depth of a wavelength, waves shorter than that are hardly felt (Saint-Venant)."],
  ],
  "Why does my solver crawl": [
    [{ ...CRAWL }, "GFMD with the same mass for all waves. Long waves are thousands of times softer than short ones, so they move slowest. Press Play: the blue spectrum of the displacement settles on the right first and on the left last. Finer grids make it worse: four times the points take twice the steps."],
    [{ ...CRAWL, solver: { ...SLOW, damping: 0.1 } }, "A tenth of the friction. Less damping is not the cure: the slow waves ring, and it takes many times the steps. Look at the certificate."],
    [{ ...CRAWL, solver: { ...SLOW, masses: "stiffness" } }, "Masses in proportion to stiffness: every wave swings with the same period, so all of them relax together, on any grid in about as many steps. A step costs two transform pairs instead of one; the total still falls."],
    [{ ...CRAWL, solver: { method: "multilevel" } }, "The multilevel solver settles the long waves on coarse grids, where they are short, and needs few steps on the finest one: compare the transforms. That is why it does not crawl."],
  ],
};

let lesson = null;
/** The run that was pinned before the lesson, to be pinned again after it: a lesson compares with the step before. */
let suspended = null;

async function openLesson(name) {
  if (!lesson) {
    suspended = pinned;
    await setPin(null);
  }
  lesson = LESSONS[name] ? { steps: LESSONS[name], at: 0 } : null;
  byId("lesson-card").hidden = !lesson;
  if (lesson) showLesson(); else if (runOf(suspended)) setPin(suspended);
}

function showLesson() {
  const [state, text] = lesson.steps[lesson.at];
  const { sweep: sweeps, ...values } = state;
  Object.assign(knobs, structuredClone(values));
  show();
  byId("lesson-text").textContent = text;
  byId("lesson-place").textContent = `${lesson.at + 1} / ${lesson.steps.length}`;
  byId("lesson-back").disabled = lesson.at === 0;
  byId("lesson-next").disabled = lesson.at + 1 === lesson.steps.length;
  document.body.dataset.lesson = lesson.at;
  if (sweeps) sweep(); else changed();
}

function step(by) {
  lesson.at = Math.max(0, Math.min(lesson.steps.length - 1, lesson.at + by));
  showLesson();
}
