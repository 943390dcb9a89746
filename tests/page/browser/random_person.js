// A person who does anything: actions by chance, and after each rest a look at whether the page shows one state. To be evaluated in the page;
// gives what was found wrong, the actions before it, and how much was done.

(async (seed, count) => {
  const page = window.asperity;
  const byId = (id) => document.getElementById(id);
  let state = seed;
  const chance = () => { state = (state * 1664525 + 1013904223) % 4294967296; return state / 4294967296; };
  const oneOf = (list) => list[Math.floor(chance() * list.length)];
  const pause = (time) => new Promise((done) => setTimeout(done, time));
  const tell = (target, kind, more = {}) => target.dispatchEvent(new Event(kind, { bubbles: true, ...more }));
  const key = (target, kind, name) => target.dispatchEvent(new KeyboardEvent(kind, { key: name, bubbles: true, cancelable: true }));
  const isThere = (it) => it && !it.disabled && !it.closest("[hidden]");

  const wrong = [];
  const done = [];
  const errors = [];
  const note = (error) => errors.push(String(error?.stack ?? error));
  addEventListener("error", ({ error, message }) => note(error ?? message));
  addEventListener("unhandledrejection", ({ reason }) => note(reason));

  /** Whether the knobs were ordered and then given up. */
  let isGivenUp = false;
  const click = (id) => { if (isThere(byId(id))) byId(id).click(); return id; };
  const type = (id, value) => {
    const field = byId(`control-${id}-value`) ?? byId(`control-${id}`);
    if (!isThere(field)) return "nothing";
    field.value = value;
    tell(field, "change");
    return `${id} = ${value}`;
  };
  const choose = (id, value) => {
    const list = byId(id);
    if (!isThere(list)) return "nothing";
    list.value = value ?? oneOf([...list.options].filter((it) => !it.hidden)).value;
    tell(list, "input");
    tell(list, "change");
    return `${id} = ${list.value}`;
  };
  const slide = () => {
    const slider = oneOf([...document.querySelectorAll("#controls input[type=range]")].filter((it) => isThere(it) && it.id !== "control-points"));
    slider.value = String(Number(slider.min) + chance() * (slider.max - slider.min));
    tell(slider, "input");
    return `${slider.id} = ${slider.value}`;
  };
  const hold = async () => {
    const handle = byId(oneOf(["press", "press", "bend"]));
    if (!isThere(handle)) return "nothing";
    handle.focus();
    const name = oneOf(["ArrowUp", "ArrowDown", "PageUp", "PageDown"]);
    const times = 1 + Math.floor(3 * chance());
    for (let i = 0; i < times; i++) { key(handle, "keydown", name); await pause(30 * chance()); }
    key(handle, "keyup", name);
    return `${handle.id} ${name} ${times} times`;
  };
  const pickLoad = () => {
    const target = byId(oneOf(["chart-area", "chart-kappa"]));
    const { x, y, width, height } = target.getBoundingClientRect();
    target.dispatchEvent(new MouseEvent("click", { clientX: x + chance() * width, clientY: y + height / 2, bubbles: true }));
    return "a click on a chart";
  };
  const scrub = () => {
    byId("scrub").value = String(Math.floor(1000 * chance()));
    tell(byId("scrub"), "input");
    return `scrub ${byId("scrub").value}`;
  };
  const surface = () => { choose("control-domain", "surface"); return type("points", "32"); };
  const small = () => { choose("control-domain", "line"); return type("points", oneOf(["128", "256"])); };

  /** Choices that take a file, or a surface that is not small. */
  const NO_CHOICES = ["choice-file", "choice-leaking"];
  /** What may be done, and how often. */
  const actions = [
    [20, () => type("load", oneOf(["0.01", "0,05", "0.2", "1", "3", "abc", "-1", "1e9", "0.0173"]))],
    [20, slide], [6, () => type(oneOf(["roughness", "hurst", "cutoff", "seed", "skewness", "kurtosis"]), oneOf(["0", "0.5", "0.8", "3", "12", "-0.5", "99999"]))],
    [8, () => choose(oneOf(["control-body", "control-solver", "control-masses", "control-dynamics"]))], [1, surface], [12, small],
    [6, () => click("sweep")], [8, () => { isGivenUp = true; return click("cancel"); }], [8, () => click("undo")], [10, pickLoad],
    [6, () => click("play")], [10, scrub], [3, () => choose("lesson")], [5, () => click(oneOf(["answer-1", "answer-2", "lesson-next", "lesson-back"]))], [5, () => click("lesson-close")],
    [8, () => click(oneOf([...document.querySelectorAll(".choices button")].map(({ id }) => id).filter((id) => !NO_CHOICES.includes(id))))], [2, () => click(oneOf(["more-surface", "more-solid", "more-load"]))], [12, hold], [3, () => click("theme")], [6, () => choose("runs")], [6, () => click("swap")],
    [2, () => click("pin")], [2, () => click("beside")], [4, () => click("dice")], [2, () => click("fringes")], [2, () => click("unbend")],
  ];
  const all = actions.reduce((sum, [weight]) => sum + weight, 0);
  const any = () => { let at = chance() * all; return actions.find(([weight]) => (at -= weight) < 0)[1]; };

  /** Waits until nothing is under way, or for some seconds; whether it is so. */
  const rest = async (patience) => {
    const isIdle = () => !page.report.busy && !page.posting && !page.holding && !page.grip && !page.playing;
    const end = performance.now() + patience;
    for (let calm = 0; performance.now() < end;) {
      const { revision } = page.report;
      await pause(10);
      calm = isIdle() && revision === page.report.revision ? calm + 1 : 0;
      if (calm >= 4) return true;
    }
    return false;
  };

  const isGrey = () => document.body.hasAttribute("data-unsolved");
  /** Whether what is shown may be grey: the knobs were given up or refused, or it is a run that was given up before it had a state. */
  const isExcused = () => isGivenUp || page.knobs.body === "file" || !byId("fault").hidden || page.shownOrLatest()?.ended === false;
  const near = (a, b, by) => Math.abs(a - b) <= by * Math.max(Math.abs(a), Math.abs(b)) + 1e-12;
  const read = (text) => Number(text.replace(",", ".").split(" ")[0]);
  /** What is wrong with what is shown. */
  const look = () => {
    const { moment, knobs, section } = page;
    const run = page.shownOrLatest();
    const told = (moment ?? run)?.numbers;
    if (isGrey()) return isExcused() ? [] : [`what is shown is grey, and nobody says why (${document.body.dataset.run}, ${run?.ended}, ${byId("title").textContent})`];
    if (!run || !told) return ["nothing is shown"];
    const faults = [];
    const { load: _, ...its } = moment?.knobs ?? run.knobs;
    const { load, ...asked } = knobs;
    if (page.words(its) !== page.words(asked)) faults.push("the knobs are not those of what is shown");
    if (moment?.isAsked) return faults;
    const isByHand = byId("row-load").hasAttribute("data-hand");
    // a list of load steps that was given up ends below its load
    const isPartOfSteps = knobs["yield-stress"] > 0 && told.status !== "converged";
    const isFree = isByHand || knobs.adhesion > 0 || knobs.creep > 0 || knobs.release || isPartOfSteps || moment?.isClear;
    if (!isFree && !near(told.reduced_pressure, load, moment || told.status !== "converged" ? 0.05 : 1e-3) && moment?.step === undefined) faults.push(`p* is ${told.reduced_pressure} under a load of ${load}`);
    const field = read(byId("control-load-value").value);
    if (!near(field, isByHand ? told.reduced_pressure : load, 6e-3)) faults.push(`the field of the load has ${field}`);
    const area = document.querySelector("#numbers td[data-number=relative_area]")?.innerText ?? "";
    if (Number.isFinite(told.relative_area) && !near(read(area), told.relative_area, 0.02)) faults.push(`the table has an area of ${area}, it is ${told.relative_area}`);
    const titleHas = (symbol) => new RegExp(`${symbol} = ([-+.e\\d]+)`).exec(byId("title").textContent)?.[1];
    const titled = titleHas("p\\*");
    // surfaces that are pulled apart over gaps have the deepest of them in the title
    const isByGap = knobs.depth > 0 && titleHas("δ/g₀") !== undefined;
    const pressed = told.load ?? (moment && moment.step === undefined ? told.reduced_pressure : load);
    if (!(moment?.isClear || isByGap || near(Number(titled), pressed, 2e-3))) faults.push(`the title is ${byId("title").textContent} under ${pressed}`);
    if (isByGap && !near(Number(titleHas("δ/g₀")), knobs.depth, 2e-3)) faults.push(`the title is ${byId("title").textContent} at ${knobs.depth}`);
    if (document.body.dataset.run !== run.id) faults.push(`the page tells of ${document.body.dataset.run}`);
    const isDrawn = knobs.domain === "line" && knobs.body !== "scene" && section.pressure.length === knobs.points && !(knobs.adhesion > 0) && !(knobs.hardness > 0);
    const share = section.pressure.filter((p) => p > 0).length / section.pressure.length;
    const counted = told.relative_area_counted;
    if (isDrawn && moment?.step === undefined && Number.isFinite(counted) && !near(share, counted, 1e-6)) faults.push(`the picture shows ${share} in contact, it is ${counted}`);
    return faults;
  };

  let looks = 0;
  small();
  for (let i = 0; i < count; i++) {
    const before = page.words(page.knobs);
    const what = await any()();
    done.push(what);
    if (page.words(page.knobs) !== before) isGivenUp = what === "cancel";
    await pause(12 * chance());
    if (chance() < 0.25 && await rest(250)) {
      looks += 1;
      for (let waited = 0; isGrey() && !isExcused() && waited < 250; waited++) await pause(20);
      const faults = [...look(), ...errors.splice(0)];
      if (faults.length) wrong.push({ at: i, faults, done: done.slice(-8) });
    }
  }
  // what takes long at the end is given up, also where it begins only then
  for (let tries = 0; tries < 20 && !await rest(2000); tries++) {
    if (page.playing) click("play");
    done.push(click("cancel"));
    isGivenUp = true;
  }
  if (await rest(60000)) wrong.push(...look().map((fault) => ({ at: count, faults: [fault], done: done.slice(-8) })));
  else wrong.push({ at: count, faults: ["it never comes to rest"], done: done.slice(-8) });
  return { wrong, looks };
})
