// The address of what one sees: knobs, or a lesson and its step, and the run that is pinned, to be opened on another machine.

/** The longest address that is read. */
const LONGEST = 16384;

/** What one sees. */
function seen() {
  if (lesson) return { lesson: lesson.name, step: lesson.at + 1 };
  const kept = pinned && runOf(pinned);
  return kept && !isSweep(kept) ? { knobs, pinned: kept.knobs } : { knobs };
}

/** Writes what one sees into the address. */
function writeAddress() {
  if (isOpened) history.replaceState(null, "", `#${encodeURIComponent(JSON.stringify(seen()))}`);
}

/** Whether the address that the page was opened with has been carried out: it is not written over before. */
let isOpened = false;

/** The address without what is the reader's own, such as the language. */
function linked() {
  const link = new URL(location.href);
  link.search = "";
  return link.href;
}

async function copyLink() {
  writeAddress();
  await navigator.clipboard.writeText(linked()).then(() => hint(say("link.copied")), () => hint(say("link.failed")));
}

/** What the address says to show; none for an address without it. */
function wished() {
  const text = location.hash.slice(1);
  if (!text) return null;
  if (text.length > LONGEST) throw new Error(say("address.long", { most: LONGEST }));
  const wish = JSON.parse(decodeURIComponent(text));
  if (wish === null || typeof wish !== "object") throw new Error(say("address.empty"));
  return wish;
}

/** Whether the address is of a file of heights, which a page that is loaded anew no longer has. */
function wantsFile() {
  try { return wished()?.knobs?.body === "file"; } catch { return false; }
}

/** Carries out what the address says, and returns whether there was anything; the server refuses knobs that stand for nothing. What is
 * shown instead of an address that is refused takes its sentence off, so that is said after it. */
async function openAddress(instead) {
  try {
    const wish = wished();
    if (wish && (words(wish) !== words(seen()) || !latest())) await carryOut(wish);
    if (wish === null) await instead();
  } catch (error) {
    await instead();
    const isFileGone = wantsFile() && !description;
    fault(isFileGone ? say("fault.file-gone") : say("fault.address", { reason: error.inWords ?? error.message }));
  } finally {
    isOpened = true;
  }
}

/** Shows the state of an address: a lesson and its step, or knobs and what is pinned.
 * @param {any} wish */
async function carryOut({ lesson: name, step: place, knobs: wanted, pinned: kept }) {
  if (name !== undefined) return openLessonAt(name, place);
  if (kept) {
    const { revision } = await post("solve", painted(kept));
    await ended(revision);
    await setPin(report.run.id);
  }
  await post("solve", painted(wanted)).catch((error) => { throw Object.assign(error, { inWords: faultOfKnobs(wanted) || undefined }); });
  knobs = painted(wanted);
  show();
  const run = runOfKnobs(knobs);
  if (run && !isOfKnobs()) showRun(run.id); // it has begun before the answer to the order was there
}

/** A state as words that do not depend on the order of its keys, nor on the colours. */
function words(state) {
  const sorted = (key, value) => key === "theme" ? undefined
    : value && typeof value === "object" && !Array.isArray(value) ? Object.fromEntries(Object.entries(value).sort()) : value;
  return JSON.stringify(state, sorted);
}

/** Knobs in the colours of this page, with those of the solid that earlier pages did not have. */
const painted = (wanted) => ({ ...defaultsOf("solid"), ...wanted, theme: document.documentElement.dataset.theme });

/** Waits until the order of a revision is carried out. */
async function ended(revision) {
  while (report.revision < revision || report.busy || !report.run?.ended) await new Promise((done) => setTimeout(done, 50));
}

/** Opens a lesson at one of its steps, without asking what was asked before it. */
async function openLessonAt(name, place) {
  const opened = lessons.find((it) => it.name === name);
  if (!opened) throw new Error(say("address.lesson", { name: JSON.stringify(name) }));
  if (!Number.isInteger(place) || place < 1 || place > opened.steps.length) throw new Error(say("address.step", { place: JSON.stringify(place) }));
  await openLesson(name, place - 1);
}
