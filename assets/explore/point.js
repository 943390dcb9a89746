// Words of lessons that point: they light up the thing on the page that they mean.

/** Words, and behind them the name of the thing that they mean, as in [κ_r 1.81](number.kappa_r). */
const POINTING = /\[([^\]]+)\]\(([\w.-]+)\)/;
/** Things with names of their own, and kinds of things, by what finds them on the page. */
const THINGS = { section: () => byId("section"), top: () => byId("top-box"), play: () => byId("play"), why: () => byId("why") };
const KINDS = {
  number: (name) => document.querySelector(`#numbers td[data-number="${name}"]`)?.parentElement,
  control: (name) => byId(`row-${name}`),
  chart: (name) => byId(`chart-${name}`),
  map: () => byId("top-box"),
};
/** Parts of the picture in its pixels: left, top, right, lower edge. */
const PARTS = {
  pressure: ({ x, top }) => [x(0), 0, x(1), top],
  peak: ({ x, pressure }) => around(x((highestNode() + 0.5) / section.pressure.length), pressure(section.pressure[highestNode()])),
  contact: ({ x, y }) => {
    const [first, last] = patchOf(highestNode());
    const [left, right] = [first, last + 1].map((edge) => x(edge / section.pressure.length));
    const height = y(section.solid[highestNode()]);
    return [Math.min(left, right - PEAK), height - PEAK, Math.max(right, left + PEAK), height + PEAK];
  },
  stress: ({ x, y, h }) => [x(0), y(Math.min(...section.solid)), x(1), h],
};
/** Half of the size of a place that is a point, in pixels. */
const PEAK = 14;
const around = (x, y) => [x - PEAK, y - PEAK, x + PEAK, y + PEAK];

const highestNode = () => section.pressure.indexOf(Math.max(...section.pressure));

/** First and last node of the patch around a node. */
function patchOf(node) {
  const touches = (i) => section.pressure[i] > 0;
  let [first, last] = [node, node];
  while (touches(first - 1)) first -= 1;
  while (touches(last + 1)) last += 1;
  return [first, last];
}

/** The thing that is lit up; none at other times. */
let lit = null;

/** A text with a button for the words that point; the mark behind it is on the same line. */
function pointing(text) {
  const parts = text.split(POINTING);
  const marks = parts.map((part, i) => i && i % 3 === 0 ? /^[,.;:!?)”“]*/.exec(part)[0] : "");
  const kept = (i) => element("span", { class: "kept" }, pointer(parts[i], parts[i + 1]), marks[i + 2]);
  return parts.map((part, i) => i % 3 === 0 ? part.slice(marks[i].length) : i % 3 === 1 ? kept(i) : "");
}

/** The same text, where no button can stand. */
const withoutPoints = (text) => text.split(POINTING).filter((_, i) => i % 3 < 2).join("");

/** A button that lights up a thing while the pointer or the focus is on it, and goes there when it is pressed. */
function pointer(words, name) {
  const made = element("button", { type: "button", class: "point", title: say("point.tip"), "data-point": name }, words);
  for (const come of ["pointerenter", "focus"]) made.addEventListener(come, () => lightUp(name));
  for (const go of ["pointerleave", "blur"]) made.addEventListener(go, () => lightUp(null));
  made.addEventListener("click", () => { goToThing(name); lightUp(name); });
  return made;
}

/** The element of a thing, seen or not. */
function thingOf(name) {
  const [kind, rest] = [name.split(".")[0], name.slice(name.indexOf(".") + 1)];
  return (KINDS[kind] ? KINDS[kind](rest) : THINGS[kind]?.()) ?? null;
}

/** The element of a thing, or of that which unfolds it. */
function elementOf(name) {
  const found = thingOf(name);
  return !found || found.checkVisibility() ? found : folderOf(found);
}

/** Brings a thing on the screen: a control that is folded away, a map that is not shown, what is further down. */
function goToThing(name) {
  const [kind, rest] = name.split(".");
  if (kind === "map" && above) chooseMap(rest);
  const found = thingOf(name);
  if (found && !found.checkVisibility()) unfold(found);
  const isCalm = askSystem("(prefers-reduced-motion: reduce)").matches;
  elementOf(name)?.scrollIntoView({ block: "nearest", behavior: isCalm ? "auto" : "smooth" });
}

/** Lights up a thing, or none. */
function lightUp(name) {
  const wasLit = Boolean(lit);
  lit = name;
  if (lit && !wasLit) followLit(); else if (!lit) byId("light").hidden = true;
}

/** Keeps the light on the thing, which may move as the page is scrolled or drawn. */
function followLit() {
  if (!lit) return;
  const box = seenBoxOf(lit);
  byId("light").hidden = !box;
  if (box) {
    const [left, top, right, foot] = box.map(Math.round);
    Object.assign(byId("light").style, { left: `${left}px`, top: `${top}px`, width: `${right - left}px`, height: `${foot - top}px` });
  }
  requestAnimationFrame(followLit);
}

const edgesOf = (its) => { const { left, top, right, bottom } = its.getBoundingClientRect(); return [left, top, right, bottom]; };

/** Where a thing is on the screen: left, top, right, lower edge; none where it is not seen. */
function seenBoxOf(name) {
  const found = elementOf(name);
  if (!found) return null;
  let box = edgesOf(found);
  const part = name.startsWith("section.") && section ? PARTS[name.split(".")[1]](frame(found)) : null;
  if (part) box = part.map((edge, i) => edge + box[i % 2]);
  for (const pane of [found.closest("#stage, #controls"), document.documentElement].filter((it) => it?.checkVisibility())) {
    const [left, top, right, foot] = pane === document.documentElement ? [0, 0, innerWidth, innerHeight] : edgesOf(pane);
    box = [Math.max(box[0], left), Math.max(box[1], top), Math.min(box[2], right), Math.min(box[3], foot)];
  }
  return box[2] > box[0] && box[3] > box[1] ? box : null;
}
