// The page of `asperity explore` and `asperity view`: keys, theme and beginning. No framework.

const isView = document.body.dataset.mode === "view";

/** The viewer follows the theme of the system and no other: here the page answers for the system.
 * @type {Map<string, any>} */
const THEMES = new Map(["dark", "light"].map((theme) => [`(prefers-color-scheme: ${theme})`, new EventTarget()]));
window.matchMedia = (query) => THEMES.get(query) || askSystem(query);

function paint(theme) {
  for (const [media, answer] of THEMES) {
    answer.matches = media.includes(theme);
    answer.dispatchEvent(new MediaQueryListEvent("change", { media, matches: answer.matches }));
  }
  document.documentElement.dataset.theme = theme;
  byId("theme").textContent = theme === "dark" ? say("theme.light") : say("theme.dark");
  localStorage.setItem("theme", theme);
  drawSections();
  wake();
}

const KEYS = isView ? { t: toggleTheme } : { " ": play, s: sweep, d: dice, o: openFile, b: swap, p: pin, u: undo, t: toggleTheme, Escape: cancel };

/** The keys of the page, of which the viewer gets none: it would keep all of them. Tab goes on, and Esc back to the page. */
function key(event) {
  const inside = inViewer(event.target);
  if (inside && ["Tab", "Escape"].includes(event.key)) {
    event.stopImmediatePropagation();
    if (event.key === "Escape") leaveViewer();
  }
  const action = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action || isTyping(event) || document.querySelector("dialog[open], [popover]:popover-open") || event.ctrlKey || event.metaKey || event.altKey) return;
  event.stopImmediatePropagation();
  event.preventDefault();
  action();
}

/** Whether a key belongs to what has the focus: letters to fields and lists, the space bar to buttons and boxes too. */
function isTyping({ target, key }) {
  if (key === "Escape") return false;
  if (inViewer(target)) return isView;
  return target.tagName === "SELECT" || target.type === "text" || (key === " " && (target.tagName === "BUTTON" || target.type === "checkbox"));
}

function leaveViewer() {
  /** @type {HTMLElement} */ (document.activeElement).blur();
  (isView ? byId("theme") : byId("play")).focus();
}

/** Paints the page, and solves again for the pictures of the viewer, which are recorded on one ground. A sweep that is drawn stays; while a
 * lesson asks, nothing is solved that would answer for the person. */
function toggleTheme() {
  paint(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  if (!knobs) return;
  const it = current();
  takeTheme();
  if (!viewer || isAsked()) return;
  if (it && isSweep(it)) { sweep(); repainted = report.sweep; } else changed();
}

function takeTheme() {
  knobs.theme = document.documentElement.dataset.theme;
}

/** Paper is light whatever the screen is: the picture is drawn for it, and as before after it. */
function printed() {
  const { dataset } = document.documentElement;
  const screen = dataset.theme;
  const draw = (theme, isPaper) => {
    dataset.theme = theme;
    document.body.toggleAttribute("data-paper", isPaper);
    drawSections();
  };
  draw("light", true);
  window.addEventListener("afterprint", () => draw(screen, false), { once: true });
}

async function begin() {
  await beginTexts();
  const wished = new URLSearchParams(location.search).get("theme") || localStorage.getItem("theme");
  paint(wished === "light" || wished === "dark" ? wished : askSystem("(prefers-color-scheme: light)").matches ? "light" : "dark");
  byId("theme").addEventListener("click", toggleTheme);
  window.addEventListener("keydown", key, true);
  if (isView) { byId("title").textContent = say("title.recording"); beginViewer(); return; }
  nameSolver();
  beginViews();
  await joinSession();
  await tellWindow();
  const before = await ask("state");
  known = await ask("observables");
  observables = [...known.filter((row) => row.page && !row.is_known_by_process), SECONDS, CONDUCTANCE];
  const start = await ask("start");
  if (!isOwn(start)) sceneStart = start;
  knobs = before.run ? before.run.knobs : before.sweep ? before.sweep.knobs : structuredClone(start);
  const isPainted = site || knobs.theme === document.documentElement.dataset.theme; // a site has recordings on both grounds
  takeTheme();
  remember(await ask("runs"));
  build();
  beginUnits();
  beginHint();
  beginState();
  description = await ask("heights");
  show();
  charts();
  beginHand();
  beginTop();
  beginSolid();
  beginWhy();
  beginShare();
  beginRace();
  keepState();
  for (const id of ["chart-area", "chart-kappa"]) byId(id).addEventListener("keydown", stepChart);
  byId("show-solving").addEventListener("click", foldSolving);
  byId("beside").addEventListener("click", putBeside);
  byId("patch-close").addEventListener("click", () => choosePatch(null));
  byId("words").addEventListener("click", () => byId("glossary").showModal());
  byId("runs").addEventListener("change", () => showRun(byId("runs").value));
  byId("play").addEventListener("click", play);
  byId("swap").addEventListener("click", swap);
  byId("pin").addEventListener("click", pin);
  byId("scrub").addEventListener("input", () => { stopPlaying(); seek(Number(byId("scrub").value) / 1000); });
  byId("duration").addEventListener("input", showDuration);
  showDuration();
  window.addEventListener("resize", charts);
  window.addEventListener("beforeprint", printed);
  if (before.run || before.sweep) heard(before);
  listen();
  await beginLessons().catch((error) => fault(error.message));
  beginWelcome();
  window.addEventListener("hashchange", () => openAddress(async () => {}));
  await openAddress(async () => {
    if (!before.run && description) { knobs.body = "file"; takeDescription(description); }
    else if (!before.run || !isPainted) await changed();
  });
}

begin();
