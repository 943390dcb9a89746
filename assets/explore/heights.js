"use strict";
// The file of heights: dropped on the page or opened, described, and prepared before it is pressed. It goes to the server on this machine only.

/** The largest file that the server takes, in bytes. */
const LARGEST = 2 ** 26;

/** The controls of the file, of which those with `step` set a step of its preparation. Texts are lengths, or lists of whole numbers. */
const HEIGHT_CONTROLS = [
  { id: "channel", label: "Channel", kind: "select", shown: (it) => it.channels.length > 1, options: (it) => it.channels.map((name) => [name, name]),
    tip: "Which of the fields in the file is pressed. The steps are chosen anew for it." },
  { id: "unit", label: "File unit", kind: "text", example: "1 um", shown: (it) => !it.is_in_metres,
    tip: "Length of 1 in the file, which does not say its units: heights and distances are multiplied by it. Without it they are taken as metres." },
  { id: "width", label: "Width", kind: "text", example: "10 um", shown: (it) => !it.has_spacing,
    tip: "Length along x of all that is in the file, which does not say it. Points are as far apart along y." },
  { id: "boundary", label: "Beyond it", kind: "select", options: () => [["periodic", "the cell again"], ["free", "nothing"]],
    tip: "Periodic: the heights repeat themselves, and a jump from one end to the other is pressed like all else. Free: nothing presses the solid beyond them (not with GFMD)." },
  { id: "auto", label: "Steps", kind: "select", options: () => [["true", "chosen for the heights"], ["false", "by hand"]],
    tip: "What is done to the heights before they are pressed: chosen for them, with the reasons below, or by hand. Turning one of the steps below takes over from the choice." },
  { id: "resample", step: true, label: "Resample", kind: "select", shown: (it) => it.knobs.prepare.resample || /not evenly spaced/.test(it.fault), options: () => [["", "no"], ["linear", "linearly"]],
    tip: "Brings heights at uneven positions to even ones." },
  { id: "crop", step: true, label: "Crop", kind: "text", list: true, example: "0,256,0,256",
    tip: "Part that is kept: first row and one beyond the last, then the same of the columns; of a profile two numbers." },
  { id: "fill", step: true, label: "Fill voids", kind: "select", options: () => [["", "no"], ["harmonic", "smoothly"]],
    tip: "Fills voids with the smoothest heights that fit those around them. Heights with voids cannot be solved." },
  { id: "detrend", step: true, label: "Take off", kind: "select", options: () => [["", "nothing"], ["mean", "the mean"], ["plane", "the plane"], ["curvature", "the curvature"]],
    tip: "Trend of least squares that is taken off: a tilt or a bend is that of the instrument, and jumps across the period." },
  { id: "low-pass", step: true, label: "Low-pass", kind: "text", example: "200 nm",
    tip: "Wavelength below which waves are filtered out (Gaussian filter of ISO 16610), such as those that cannot be told from noise." },
  { id: "mirror", step: true, label: "Mirror", kind: "select", options: () => [["", "no"], ["x", "along x"], ["y", "along y"], ["both", "along both"]],
    tip: "Mirrors the heights at their last row or column, so that they are periodic without a jump: twice the points along each axis." },
];

/** What the server told of the file last. */
let description = null;

const holder = ({ step }, heights) => step ? heights.prepare : heights;

function buildHeights() {
  const open = button("open-file", "Open a file…", "Heights of a line or a surface, as instruments write them (key O), or drop the file anywhere on the page. It stays on this machine, in memory.", openFile);
  const choose = element("input", { type: "file", id: "file", hidden: true });
  choose.addEventListener("change", () => { takeFile(choose.files[0]); choose.value = ""; });
  byId("group-surface").append(element("div", { class: "buttons" }, open, choose));
  const rows = HEIGHT_CONTROLS.map(heightRow);
  const group = element("fieldset", { id: "group-file", hidden: true }, element("legend", {}, "File"), ...rows,
    element("div", { id: "heights", role: "group", "aria-label": "What the file holds" }));
  byId("group-surface").after(group);
  for (const kind of ["dragenter", "dragover", "dragleave", "drop"]) window.addEventListener(kind, dragged, true);
}

function heightRow(control) {
  const id = `heights-${control.id}`;
  const input = control.kind === "select" ? element("select", { id })
    : element("input", { id, type: "text", placeholder: control.example, spellcheck: false });
  input.addEventListener("change", () => takeStep(control, input.value.trim()));
  const line = element("div", { class: "row wide", id: `row-${id}`, title: control.tip }, element("label", { for: id }, control.label), input);
  explain(line, control.tip);
  return line;
}

const openFile = () => byId("file").click();

/** A file that is dragged over the page is the page's, wherever it is dropped: the viewer gets none. */
function dragged(event) {
  event.preventDefault();
  event.stopImmediatePropagation();
  const isOver = event.type === "dragover" || event.type === "dragenter";
  document.body.toggleAttribute("data-drop", isOver);
  if (isOver) event.dataTransfer.dropEffect = "copy";
  if (event.type !== "drop") return;
  const files = event.dataTransfer.files;
  if (files.length === 1) takeFile(files[0]);
  else fault(`${files.length || "No"} files were dropped: drop one file of heights.`);
}

/** Gives a file to the server, and solves it as soon as it can be. */
async function takeFile(file) {
  if (!file) return;
  if (file.size > LARGEST) { fault(`${file.name} has ${Math.ceil(file.size / 1e6)} MB: give a file of at most ${Math.floor(LARGEST / 1e6)} MB.`); return; }
  await postFile(`heights?name=${encodeURIComponent(file.name)}`, file).then((told) => { knobs.body = "file"; takeDescription(told); }, (error) => fault(error.message));
}

/** Asks the server for a description of the file as the knobs take it, with a step or a setting changed. */
async function takeStep(control, value) {
  const heights = structuredClone(knobs.heights);
  const place = holder(control, heights);
  if (control.step) heights.auto = false;
  else if (control.id !== "auto") heights.auto = heights.auto || control.id === "channel";
  if (value === "") delete place[control.id];
  else place[control.id] = control.id === "auto" ? value === "true" : control.list ? value.split(/[ ,;]+/).map(Number) : value;
  await post("describe", heights).then(takeDescription, (error) => { fault(`${control.label} cannot be ${value}: ${error.message}`); showHeights(); });
}

/** Takes what the server tells of the file and how it is taken, and solves it if it can be. */
function takeDescription(told) {
  description = told;
  knobs.heights = told.knobs;
  knobs.domain = told.is_profile ? "line" : "surface";
  mend("body");
  show();
  document.body.dataset.file = told.name;
  if (told.fault) fault(told.fault); else changed();
}

/** Shows the file and its knobs where it is the body. */
function showHeights() {
  const isShown = knobs.body === "file" && description !== null;
  byId("group-file").hidden = !isShown;
  if (!isShown) return;
  for (const control of HEIGHT_CONTROLS) {
    const input = byId(`heights-${control.id}`);
    byId(`row-heights-${control.id}`).hidden = control.shown ? !control.shown(description) : false;
    if (control.options) input.replaceChildren(...control.options(description).map(([value, label]) => element("option", { value }, label)));
    const value = holder(control, knobs.heights)[control.id];
    input.value = String(value ?? (control.id === "channel" ? description.channel : ""));
  }
  showDescription();
}

/** The description in words: what the file holds, why the steps were chosen, and what they came to. */
function showDescription() {
  const rows = description.rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]);
  const run = latest();
  const steps = run && run.knobs.body === "file" ? run.prepared : [];
  byId("heights").replaceChildren(element("h3", {}, description.name), ...list("Why these steps", description.reasons), ...list("What they came to", steps), element("dl", {}, ...rows));
}

const list = (title, sentences) => sentences.length ? [element("h4", {}, title), element("ul", {}, ...sentences.map((it) => element("li", {}, it)))] : [];

/** Says why the numbers of a run may mean little. */
function warn(run) {
  byId("warnings").replaceChildren(...run.warnings.map((sentence) => element("p", {}, `Mind: ${sentence}.`)));
  byId("warnings").hidden = run.warnings.length === 0;
}
