// The Rerun viewer inside the page, and playing what it shows.

/** The viewer while it is shown, and whether or not it is. */
let viewer = null;
let started = null;

/** How long the viewer draws on after a change, in milliseconds and at least in frames: its axes glide to their curves, and stop
 * when it stops. */
const GLIDE = { time: 500, frames: 12 };
const awake = { until: 0, frames: 0, seen: "", isDrawing: false };

/** Runs that the viewer has read to the end: it reads on only while it draws. */
const wholeRuns = new Set();

/** Has the viewer draw for a while, after data, layout or size have changed. */
function wake() {
  stayAwake();
  if (!awake.isDrawing) draw();
}

const stayAwake = () => Object.assign(awake, { until: performance.now() + GLIDE.time, frames: GLIDE.frames });

const isAwake = () => awake.frames > 0 || performance.now() < awake.until;

/** Closing a channel that never was makes the viewer draw. As long as it gets further in what it reads, it is kept awake. */
function draw() {
  awake.isDrawing = false;
  if (!viewer || viewer.has_panicked()) { Object.assign(awake, { until: 0, frames: 0 }); return; }
  viewer.close_channel("wake");
  keepShown();
  awake.frames -= 1;
  const seen = read();
  if (seen !== awake.seen) { awake.seen = seen; stayAwake(); }
  if (!isAwake() && !isReading()) return;
  awake.isDrawing = true;
  requestAnimationFrame(draw);
}

/** The viewer turns to every recording that it begins to read: back to the one that is shown, if another one was begun before. */
function keepShown() {
  const run = runOf(shownRun);
  const isThere = run?.followed && rangeOf(run);
  if (isThere && viewer.get_active_recording_id() !== recordingName(run)) viewer.set_active_recording_id(recordingName(run));
}

/** Whether the run that is shown has ended and the viewer has not read all of it. */
function isReading() {
  const run = runOf(shownRun);
  return Boolean(run && run.ended && recordingName(run) && !wholeRuns.has(recordingName(run)));
}

/** How far the viewer has read what it shows, and where it stands in it. */
function read() {
  const run = runOf(shownRun);
  const range = run && isInViewer(run) && rangeOf(run);
  return range ? `${run.id} ${range.max} ${viewer.get_time_for_timeline(recordingName(run), timeline(run))}` : "";
}

/** Shows the viewer, which is loaded when it is first shown. */
function beginViewer() {
  if (started) { resumeViewer(); return; }
  if (document.body.dataset.viewer !== "unused") return;
  document.body.dataset.viewer = "loading";
  loadScript("re_viewer.js").then(startViewer, () => {
    document.body.dataset.viewer = "unused"; // it is loaded when it is shown the next time
    noteViewer(say("viewer.unloaded"));
  }).catch((error) => {
    document.body.dataset.viewer = "failed";
    noteViewer(say("viewer.unstarted", { reason: error.message ?? error }));
  });
}

/** Has the viewer that was not shown for a while go on with what the page shows: while a lesson asks, that is no run. */
function resumeViewer() {
  if (viewer || started.has_panicked()) return;
  viewer = started;
  const run = current();
  if (isAsked()) noteViewer(say("viewer.asked"));
  else if (run) showInViewer(run.id);
  offerSaves();
}

async function startViewer() {
  const query = new URLSearchParams(location.search);
  await wasm_bindgen({ module_or_path: "re_viewer_bg.wasm" });
  const canvas = element("canvas", { id: "canvas" });
  byId("viewer").append(canvas);
  const focused = document.activeElement;
  const handle = new wasm_bindgen.WebHandle({
    url: isView ? [nextTo(document.body.dataset.recording)] : null, hide_welcome_screen: true, enable_history: false, notebook: !isView,
    render_backend: query.get("renderer"), on_viewer_event: heardViewer,
    panel_state_overrides: isView ? {} : { top: "Hidden", blueprint: "Hidden", selection: "Hidden", time: "Hidden" },
  });
  await handle.start(canvas);
  giveBack(focused);
  if (isView) byId("viewer-note").hidden = true; else noteViewer(say("viewer.waiting"));
  started = handle;
  document.body.dataset.viewer = "started";
  if (document.body.dataset.view !== "picture") {
    viewer = started;
    runs.slice(-1).forEach(follow);
  }
  for (const touch of ["pointerdown", "keydown"]) canvas.addEventListener(touch, () => { visited = shownRun; }, true);
  new ResizeObserver(() => { wake(); tellWindow(); }).observe(canvas);
  new PerformanceObserver((loaded) => loaded.getEntries().forEach(noteWhole)).observe({ type: "resource" });
  setInterval(guardViewer, 1000);
}

/** The last reported size of the viewer. */
let toldWindow = "";

/** Tells the session how large the viewer is: the pictures of the next recordings fill its panes. */
async function tellWindow() {
  const { clientWidth, clientHeight } = byId("viewer");
  const size = `${clientWidth} ${clientHeight}`;
  if (document.body.dataset.view === "picture" || isView || site || !session || !clientWidth || !clientHeight || size === toldWindow) return;
  toldWindow = size;
  await post("window", [clientWidth, clientHeight]).catch(() => { toldWindow = ""; });
}

/** Has the viewer draw when it has read a recording to its end, and notes which. */
function noteWhole({ name }) {
  const run = runs.find((run) => recordingName(run) && recordingAddress(run) === name);
  if (!run) return;
  document.body.dataset.whole = run.id;
  wholeRuns.add(recordingName(run));
  wake();
}

/** The viewer takes the focus when it starts, and has a field for typed text that no key leads to: the focus stays with the page. */
function giveBack(focused) {
  byId("viewer").querySelectorAll("input").forEach((field) => { field.tabIndex = -1; field.ariaHidden = "true"; });
  if (!inViewer(document.activeElement)) return;
  /** @type {HTMLElement} */ (document.activeElement).blur();
  document.body.tabIndex = -1;
  focused.focus(); // where the next Tab goes on from
  document.body.removeAttribute("tabindex");
}

const inViewer = (target) => target instanceof Element && byId("viewer").contains(target);

function guardViewer() {
  if (!started?.has_panicked()) return;
  document.body.dataset.viewer = "failed";
  noteViewer(say("viewer.failed"));
  viewer = null;
  started = null;
}

function noteViewer(sentence) {
  byId("viewer-note").textContent = sentence;
  byId("viewer-note").hidden = false;
}

let playing = null;

/** Whether the viewer shows a run, or will show it: it is there, and there is a recording. */
const isInViewer = (run) => Boolean(viewer && recordingName(run));

/** The latest run that a recording of the viewer is of. */
const runWith = (recording) => runs.findLast((run) => recordingName(run) === recording);

/** Says where there is no recording of a run, and returns whether there is one. */
function offerRecording(run) {
  const isThere = recordingName(run) !== null;
  if (!isThere) noteViewer(say("viewer.unrecorded"));
  return isThere;
}

/** First and last step of a run, or load of a sweep, that the viewer has; without a viewer those that have numbers. */
function rangeOf(run) {
  if (isInViewer(run)) return viewer.get_timeline_time_range(recordingName(run), timeline(run));
  const known = isSweep(run) ? run.points.map(({ number }) => number) : run.steps;
  return known?.length ? { min: known[0], max: known.at(-1) } : null;
}

/** The step at a share of the run: early steps, in which most happens, take most of the time. Loads and states take as long each. */
function stepAt(run, share) {
  const range = run && rangeOf(run);
  if (!range) return null;
  const length = range.max - range.min;
  return Math.round(range.min + (isSweep(run) || run.process ? share * length : Math.expm1(share * Math.log1p(length))));
}

function seek(share) {
  const run = runOf(shownRun);
  const step = stepAt(run, share);
  if (step === null || isHidden()) return false;
  if (isInViewer(run)) goTo(recordingName(run), timeline(run), step);
  else if (isSweep(run)) momentOfLoad(run, run.points.findLast(({ number }) => number <= step));
  else momentOfStep(run, step);
  byId("scrub").value = 1000 * share;
  byId("scrub-step").value = say(`timeline.${timeline(run)}`, { value: step });
  return true;
}

/** Goes to a step of the run that is shown, or to the nearest one that it has. */
function seekStep(step) {
  const run = shownOrLatest();
  if (!run?.steps?.length) return;
  stopPlaying();
  shownRun = run.id;
  const at = Math.min(run.steps.at(-1), Math.max(run.steps[0], step));
  if (isInViewer(run) && rangeOf(run)) goTo(recordingName(run), timeline(run), at);
  momentOfStep(run, at);
}

/** The recording in which a person went to a step or a load: all others move on by themselves as they are read. */
let visited = null;

/** Has the viewer stand at a step or a load of a recording, which is of no run where the viewer is alone. */
function goTo(recording, line, at) {
  visited = runWith(recording)?.id ?? null;
  viewer.set_playing(recording, false);
  viewer.set_active_timeline(recording, line);
  viewer.set_time_for_timeline(recording, line, at);
  wake();
}

/** Seconds that the whole relaxation takes. */
const duration = () => 2 ** Number(byId("duration").value);

function showDuration() {
  const seconds = `${figure(duration(), 2)} s`;
  byId("duration-value").value = seconds;
  byId("duration").setAttribute("aria-valuetext", seconds);
}

/** Number of still pictures that play a run where the system asks for reduced motion. */
const CALM = { wish: askSystem("(prefers-reduced-motion: reduce)"), pictures: 12 };

const calmed = (share) => CALM.wish.matches ? Math.floor(share * CALM.pictures) / CALM.pictures : share;

function play() {
  if (playing) { stopPlaying(); return; }
  const begun = performance.now();
  const frame = (now) => {
    const share = Math.min(1, (now - begun) / 1000 / duration());
    if (!seek(calmed(Math.max(0, share))) || share >= 1) { stopPlaying(); return; }
    playing = requestAnimationFrame(frame);
  };
  playing = requestAnimationFrame(frame);
  byId("play").textContent = say("play.pause");
}

function stopPlaying() {
  if (playing) cancelAnimationFrame(playing);
  playing = null;
  byId("play").textContent = say("play");
}
