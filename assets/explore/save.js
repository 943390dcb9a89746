// What is saved: the run that is shown, its numbers, and the curves of the charts. File names come from the run.

/** Why nothing of a run can be saved, in a sentence; empty where it can. */
const whyNotOfRun = (it) => !it?.ended ? say("why.early") : isKept(it) ? "" : say("save.gone");
const whyNotOfSweep = (it) => it && isSweep(it) ? say("save.sweep") : "";

/** The run or the sweep whose curves the charts show; none where they show dots alone. */
const drawnInCharts = () => runOfProcess() ?? (report.sweep?.points.length ? report.sweep : null);

/** Offers what there is to save: of the run or the sweep that the viewer shows, of the table, and of what the charts show. Below each group of buttons
 * stands why some of them cannot be pressed. */
function offerSaves() {
  const it = current();
  const curves = drawnInCharts();
  const ofCurves = curves?.process ? whyNotOfRun(curves) : curves ? "" : say("save.curve.none");
  offerGroup("run", {
    "save-rrd": whyNotOfRun(it) || (recordingName(it) ? "" : say("viewer.unrecorded")), "save-npz": whyNotOfSweep(it) || whyNotOfRun(it),
    "save-setup": it ? whyNotOfSweep(it) : say("why.early"), "save-picture": it && (viewer || section) ? "" : say("why.early"),
  });
  offerGroup("curve", { "save-curve": ofCurves, "save-charts": ofCurves });
  offerGroup("copy", { "copy-command": it ? whyNotOfSweep(it) : say("why.early") });
  byId("save-numbers").disabled = !shownTable;
}

/** Offers the buttons of a group for which there is no reason against it, and says the reasons against others. */
function offerGroup(group, reasons) {
  for (const [id, why] of Object.entries(reasons)) byId(id).disabled = Boolean(why);
  const told = [...new Set(Object.values(reasons))].filter(Boolean);
  byId(`save-${group}-why`).textContent = told.join(" ");
  byId(`save-${group}-why`).hidden = told.length === 0;
}

/** Room between the menu and its button, and the edge of the window. */
const MENU_ROOM = 6;

/** Puts the menu below its button when it opens, and closes it when something of it is chosen. */
function beginShare() {
  const menu = byId("saves");
  menu.addEventListener("toggle", (event) => {
    const isOpen = /** @type {ToggleEvent} */ (event).newState === "open";
    byId("share").ariaExpanded = String(isOpen);
    if (!isOpen) return;
    const { left, bottom } = byId("share").getBoundingClientRect();
    const most = innerWidth - menu.getBoundingClientRect().width - MENU_ROOM;
    Object.assign(menu.style, { left: `${Math.max(MENU_ROOM, Math.min(left, most))}px`, top: `${bottom + MENU_ROOM}px` });
  });
  menu.addEventListener("click", ({ target }) => { if (target instanceof HTMLButtonElement) menu.hidePopover(); });
  const saves = { "save-rrd": saveRecording, "save-npz": saveArrays, "save-setup": saveSetup, "save-picture": savePicture, "save-numbers": saveNumbers, "save-curve": saveCurve, "save-charts": saveCharts, "copy-command": copyCommand, "copy-link": copyLink };
  Object.entries(saves).forEach(([id, action]) => byId(id).addEventListener("click", action));
}

function save(address, name = "") {
  element("a", { href: address, download: name }).click();
}

function saveText(text, type, name) {
  saveBlob(new Blob([text], { type }), name);
}

function saveBlob(blob, name) {
  const address = URL.createObjectURL(blob);
  save(address, name);
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

const savingAddress = (run, ending) => nextTo(below(`save/${run.id}.${ending}`, run.session));
const saveRecording = () => site ? save(recordingAddress(current()), `${current().file_stem}.rrd`) : save(savingAddress(current(), "rrd"));

async function saveArrays() {
  const run = current();
  if (!site) { save(savingAddress(run, "npz")); return; }
  await arraysOf(run).then((bytes) => saveBlob(new Blob([bytes]), `${run.file_stem}.npz`), (error) => fault(error.message));
}

const saveSetup = () => saveText(current().setup, "application/toml", `${current().file_stem}.toml`);

/** The curves as a table: all observables of each load of a sweep, and what theories say, or of each state of a run. */
async function saveCurve() {
  const its = drawnInCharts();
  const columns = its.process && await facet(its, "steps").catch((error) => fault(error.message));
  const rows = its.process ? columns.step.map((_, at) => rowOf(columns, at))
    : its.points.map(({ exact, ...numbers }) => ({ ...numbers, exact_relative_area: exact?.relative_area, exact_kappa_r: exact?.kappa_r }));
  const names = Object.keys(rows[0]);
  const lines = [names, ...rows.map((row) => names.map((name) => row[name] ?? ""))];
  saveText(lines.map((line) => `${line.join(",")}\n`).join(""), "text/csv", `${its.file_stem}${its.process ? "_states" : ""}.csv`);
}

/** The table of numbers as it is shown. */
const saveNumbers = () => saveText(tableInText(rowsOfNumbers()), "text/csv", `${shownOrLatest().file_stem}_numbers.csv`);

/** Properties of the style sheet that a picture takes along. */
const STYLES = ["fill", "stroke", "stroke-width", "stroke-dasharray", "paint-order", "font-family", "font-size", "font-weight", "text-anchor"];

/** Both charts side by side in one picture, on the ground of the page. */
function saveCharts() {
  const figures = [...document.querySelectorAll("#results figure svg")];
  const boxes = figures.map((figure) => figure.getBoundingClientRect());
  const width = boxes.reduce((sum, box) => sum + box.width, 0);
  const height = Math.max(...boxes.map((box) => box.height));
  const sheet = drawn("svg", { xmlns: SVG, width, height, viewBox: `0 0 ${width} ${height}` });
  sheet.append(drawn("rect", { width, height, fill: getComputedStyle(document.body).backgroundColor }));
  let x = 0;
  figures.forEach((figure, i) => {
    const copy = styled(figure);
    for (const [name, value] of Object.entries({ x, y: 0, width: boxes[i].width, height: boxes[i].height })) copy.setAttribute(name, value);
    sheet.append(copy);
    x += boxes[i].width;
  });
  saveText(new XMLSerializer().serializeToString(sheet), "image/svg+xml", `${drawnInCharts().file_stem}.svg`);
}

/** A copy that looks the same without the style sheet. */
function styled(original) {
  const copy = original.cloneNode(true);
  const copies = [copy, ...copy.querySelectorAll("*")];
  [original, ...original.querySelectorAll("*")].forEach((it, i) => {
    const style = getComputedStyle(it);
    for (const name of STYLES) copies[i].setAttribute(name, style.getPropertyValue(name));
    copies[i].removeAttribute("class");
  });
  return copy;
}

/** Frames after which the viewer is given up to draw. */
const PATIENCE = 120;

const savePicture = () => viewer ? saveViewer() : saveSection();

/** The page's own picture with its labels. */
function saveSection() {
  const canvas = byId("section");
  const box = canvas.getBoundingClientRect();
  const picture = element("canvas", { width: canvas.width, height: canvas.height });
  const to = picture.getContext("2d");
  const colour = colours();
  to.fillStyle = colour.ground;
  to.fillRect(0, 0, picture.width, picture.height);
  to.drawImage(canvas, 0, 0);
  to.scale(canvas.width / box.width, canvas.height / box.height);
  to.fillStyle = colour.ink;
  to.font = FONT;
  for (const label of document.querySelectorAll(".label:not(#label-drag)")) {
    const { x, bottom } = label.getBoundingClientRect();
    to.fillText(label.textContent, x - box.x, bottom - box.y - 4);
  }
  picture.toBlob((blob) => saveBlob(blob, `${current().file_stem}.png`));
}

/** What the viewer shows, as it is drawn next: its canvas is empty between two frames. */
function saveViewer() {
  const { file_stem } = current();
  const picture = element("canvas", { width: byId("canvas").width, height: byId("canvas").height });
  const look = (frames) => setTimeout(() => requestAnimationFrame(() => {
    wake();
    const pixels = picture.getContext("2d");
    pixels.drawImage(byId("canvas"), 0, 0);
    if (pixels.getImageData(0, 0, 1, 1).data[3]) picture.toBlob((blob) => saveBlob(blob, `${file_stem}.png`));
    else if (frames) look(frames - 1);
    else fault(say("fault.picture"));
  }));
  look(PATIENCE);
}

async function copyCommand() {
  const { command } = current();
  try {
    await navigator.clipboard.writeText(command);
    hint(say("command.copied", { command }));
  } catch {
    hint(command);
  }
}
