// The file of heights: dropped on the page or opened, described, and prepared before it is pressed. It goes to the solver on this machine
// only: to the server, or to the module in the browser.

/** The controls of the file. Those that set a step of its preparation stand in `prepare`. */
const HEIGHT_CONTROLS = ALL_KNOBS.filter(({ group }) => group === "file");
const isStep = ({ path }) => path.includes("prepare");

/** Whether a file has a knob, from its description by the server. */
const FILE_HAS = {
  heights: () => true, channels: (it) => it.channels.length > 1, unitless: (it) => !it.is_in_metres, unspaced: (it) => !it.has_spacing,
  uneven: (it) => it.knobs.prepare.resample || it.known_fault?.key === "uneven",
};

/** The last description of the file by the server. */
let description = null;

function buildHeights() {
  const open = button("open-file", say("heights.open"), say("heights.open.tip"), openFile);
  const choose = element("input", { type: "file", id: "file", hidden: true });
  choose.addEventListener("change", () => { takeFile(choose.files[0]); choose.value = ""; });
  const rowsOf = (isWanted) => HEIGHT_CONTROLS.filter(isWanted).map(heightRow);
  const steps = foldable("steps", false, ...rowsOf(isStep));
  const group = foldable("file", true, element("div", { class: "buttons" }, open), ...rowsOf((control) => !isStep(control)), steps, element("p", { id: "heights-place" }, say(site ? "heights.place.browser" : "heights.place.server")), element("div", { id: "heights", role: "group", "aria-label": say("heights.holds") }));
  group.hidden = true;
  byId("choices-surface").after(choose, group);
  for (const kind of ["dragenter", "dragover", "dragleave", "drop"]) window.addEventListener(kind, dragged, true);
}

const heightLabel = ({ id }) => say(`heights.${id}`);

/** Values and names of the options of a list: the channels are those of the file. */
function heightOptions(control) {
  if (control.id === "channel") return description.channels.map((name) => [name, name]);
  return optionsOf(control).map((value) => [value, say(`heights.${control.id}.${value || "no"}`)]);
}

function heightRow(control) {
  const id = `heights-${control.id}`;
  const tip = say(`heights.${control.id}.tip`);
  const input = isList(control) ? element("select", { id })
    : element("input", { id, type: "text", placeholder: control.example, spellcheck: false });
  input.addEventListener("input", () => { input.dataset.typed = "true"; });
  for (const end of ["change", "blur"]) input.addEventListener(end, () => delete input.dataset.typed);
  input.addEventListener("change", () => takeStep(control, input.value.trim()));
  const line = element("div", { class: "row wide", id: `row-${id}`, title: tip }, element("label", { for: id, class: "name" }, heightLabel(control)), input);
  explain(line, tip);
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
  else fault(say("fault.files", { count: files.length }));
}

/** What a new file is pressed with: a load under which about a tenth of it touches, on an elastic half-space, whatever was pressed before. */
const FRESH = { ...defaultsOf("load", "solid"), body: "file" };

/** Gives a file to the server, and solves it as soon as it can be. */
async function takeFile(file) {
  if (!file) return;
  if (file.size === 0) { fault(say("fault.empty", { name: file.name })); return; }
  if (file.size > LIMITS.bytes) { fault(say("fault.large", { name: file.name, size: Math.ceil(file.size / 1e6), most: Math.floor(LIMITS.bytes / 1e6) })); return; }
  await postFile(`heights?name=${encodeURIComponent(file.name)}`, file).then((told) => {
    delete knobs.beside;
    Object.assign(knobs, FRESH);
    takeDescription(told);
  }, (error) => fault(error.message));
}

/** Asks the server for a description of the file as the knobs take it, with a step or a setting changed. */
async function takeStep(control, value) {
  const state = structuredClone(knobs);
  const { heights } = state;
  const [holder, name] = place(control, state);
  if (isStep(control)) heights.auto = false;
  else if (control.id !== "auto") heights.auto = heights.auto || control.id === "channel";
  if (value === "") delete holder[name];
  else holder[name] = heightFrom(control, value);
  await post("describe", heights).then(takeDescription, (error) => { fault(say("fault.step", { label: heightLabel(control), value, reason: error.message })); showHeights(); });
}

/** The setting that a person has written. */
function heightFrom(control, value) {
  if (isList(control)) return chosenOf(control, value);
  return control.kind === "nodes" ? value.split(/[ ,;]+/).map(Number) : value.replace(/^(\d+),(\d)/, "$1.$2");
}

/** Takes the server's description of the file, and solves it if possible. */
function takeDescription(told) {
  description = told;
  knobs.heights = told.knobs;
  knobs.domain = told.is_profile ? "line" : "surface";
  mend("body");
  show();
  document.body.dataset.file = told.name;
  markField(told.known_fault?.key);
  if (told.fault) { fault(inWordsOfPage(told)); markState(); } else changed();
}

/** The fields that a person has to fill in, by what the file lacks. */
const MISSING = { "no-size": "heights-width" };

/** Marks the field without which a file cannot be pressed, and goes there. */
function markField(lack) {
  for (const [key, id] of Object.entries(MISSING)) {
    byId(id).ariaInvalid = String(key === lack);
    if (key !== lack) continue;
    unfold(byId(id));
    byId(id).focus();
  }
}

/** Shows the file and its knobs where it is the body, but for a field that is being typed into. */
function showHeights() {
  const isShown = knobs.body === "file" && description !== null;
  byId("group-file").hidden = !isShown;
  if (!isShown) return;
  for (const control of HEIGHT_CONTROLS) {
    const input = byId(`heights-${control.id}`);
    byId(`row-heights-${control.id}`).hidden = !FILE_HAS[control.scenes](description);
    if (isList(control)) input.replaceChildren(...heightOptions(control).map(([value, label]) => element("option", { value }, label)));
    if (!input.dataset.typed) input.value = heightInWords(control, knobOf(control, knobs));
  }
  showDescription();
}

/** The setting of a control as a person writes it. */
function heightInWords({ id, kind }, value) {
  if (value === undefined) return id === "channel" ? description.channel : "";
  return kind === "length" ? lengthOf(value, 6) : String(value);
}

/** The description in words: what the file holds, why the steps were chosen, and what they came to. */
function showDescription() {
  const table = (rows, word) => rows.flatMap(([name, value]) => [element("dt", {}, word(name)), element("dd", {}, word(value))]);
  const header = description.header.length ? [element("h4", {}, say("heights.header")), element("dl", { translate: false, lang: "" }, ...table(description.header, String))] : [];
  const run = latest();
  const steps = run && run.knobs.body === "file" ? run.prepared : [];
  byId("heights").replaceChildren(element("h3", {}, description.name), ...list(say("heights.reasons"), description.reasons), ...list(say("heights.came"), steps), element("dl", {}, ...table(description.rows, translated)), ...header);
}

const list = (title, sentences) => sentences.length ? [element("h4", {}, title), element("ul", {}, ...sentences.map((it) => element("li", {}, translated(it))))] : [];

/** The controls that do what a warning advises, by the keys of a setup. */
const REMEDIES = { "surface.prepare.mirror": "mirror", "surface.prepare.steps": "auto", "surface.prepare.low-pass": "low-pass", "grid.boundary": "boundary" };

/** A setting that helps, in the words of its control; none where the page has no such control. */
function remedyInWords({ key, value }) {
  const control = HEIGHT_CONTROLS.find(({ id }) => id === REMEDIES[key]);
  if (!control) return "";
  if (value === null) return heightLabel(control);
  const option = { auto: "true" }[value] ?? value;
  return `${heightLabel(control)}: ${control.kind === "length" ? lengthOf(Number(value)) : say(`heights.${control.id}.${option}`)}`;
}

/** A warning in sentences: what may be wrong, what to do, and the controls that do it. */
function warningInWords({ is_beside: isBeside, statement, advice, remedies }) {
  const controls = knobs.body === "file" ? remedies.map(remedyInWords).filter(Boolean).join(say("warning.or")) : "";
  const places = { statement: capital(translated(statement)), advice: translated(advice), controls };
  const sentence = controls ? say("warning.controls", places) : say("warning", places);
  return isBeside ? say("warning.beside", { sentence }) : sentence;
}

/** Says why the numbers of a run may mean little. */
function warn(run) {
  byId("warnings").replaceChildren(...run.warnings.map((it) => element("p", {}, warningInWords(it))));
  byId("warnings").hidden = run.warnings.length === 0;
}
