// The hand: it presses the rigid surface onto the solid, and drags points of its profile.

/** The least gap that a hand leaves, over the highest peak, as at none everything touches, and the largest, which is well clear; with
 * adhesion a larger one, as the solid is drawn after the surface, and some ranges of the attraction more. */
const GAPS = { least: 0.02, most: 1.3, stretched: 3, ranges: 5 };
/** The mean gap, over the highest peak, of a surface that is not pressed yet. */
const UNPRESSED = 1.15;
/** Standard deviation of a bump over the length of the cell, and in spacings at least, and how near to the profile a hand takes it, in
 * pixels. */
const BUMP = { width: 0.015, spacings: 2, near: 14 };
/** Pixels beyond which a press is no click. */
const STILL = 4;

/** What the hand holds: where it began, the state then, and the gap or the bump since. */
let grip = null;
let holding = false;
let upcoming = null;
/** Whether a hand held something before: then it needs no hint. */
let isTouched = false;
/** How many contacts were solved under the hand. */
let heldCount = 0;

/** Asks for a contact that is solved at once, and calls with it; while one request is under way, only the latest wish waits. The next contact is
 * solved while this one is drawn. An order is made when it is sent. */
async function hold(order, done) {
  upcoming = { order, done };
  if (holding) return;
  holding = true;
  for (let show = null; upcoming || show;) {
    markState();
    const wish = upcoming;
    upcoming = null;
    const contact = wish && post("hold", wish.order());
    show?.();
    show = await contact?.then((it) => () => wish.done(it), (error) => () => fault(error.message));
  }
  holding = false;
  markState();
  if (grip?.isLeft) drop();
}

/** Asks for what the hand holds: the gap, or the load of the knobs. It is not shown after a newer order, or once the hand has let go. With
 * adhesion it goes on from the contact that this hand got before. */
function holdGrip() {
  const [its, before, mine, gap] = [structuredClone(knobs), orders, grip, grip.gap];
  const order = () => {
    const goesOn = Boolean(moment?.isStuck || mine.isFollowed);
    mine.isFollowed = true;
    return { knobs: its, "mean-gap": gap, "is-deep": isDeep(), "goes-on": goesOn };
  };
  hold(order, (contact) => { if (orders === before && grip === mine) showHeld(contact, its); });
}

/** The section that a hand got, and the one beside, with the stress below each. */
const deepened = ({ section, shear, beside, shear_beside: shearBeside }) => [{ ...section, shear }, beside && { ...beside, shear: shearBeside }];

/** Shows a contact with the stress below and its map, on axes that hold it, or on some that hold it and what was before. */
function showContact(contact, before = null) {
  const { top = null } = contact;
  const [own, shownBeside] = deepened(contact);
  const shown = sectionOfCut(own, top);
  const its = axesOf([shown, shownBeside].filter(Boolean));
  const most = Math.max(its.pressure, top && !own.fields?.attraction ? top.highest_pressure : 0);
  showSection(shown, shownBeside, before ? { ...before, pressure: Math.max(before.pressure, most), pull: Math.max(before.pull, its.pull), shear: Math.max(before.shear, its.shear) } : { ...its, pressure: most }, top);
}

/** A name of numbers, with how their solve ended where it did not converge. */
const named = (name, { status }) => ["converged", undefined].includes(status) ? name : `${name}: ${statusOf({ numbers: { status } })}`;

/** Shows what the hand holds, whose knobs get the load that it needs; surfaces that attract each other have others under the same load. */
function showHeld(contact, its) {
  document.body.dataset.held = String(++heldCount);
  keepSeen(its, contact.numbers);
  fault("");
  if (isClear(grip.gap)) return;
  const { numbers: told } = contact;
  const isStuck = grip.gap !== null && adheres();
  if (grip.gap !== null && !isStuck) {
    const [least, most] = controlOf("load").range;
    knobs.load = its.load = Number(Math.min(most, Math.max(least, contact.load)).toPrecision(4));
  }
  const title = say("title.hand", { load: figure(told.reduced_pressure, 4) });
  setMoment({ name: named(say("moment.hand"), told), title, numbers: told, exact: null, isStuck, knobs: its, load: isStuck ? told.reduced_pressure : undefined });
  show();
  if (grip.kind === "bend") followRigid(contact.section);
  setPictured(moment);
  showContact(contact, axes);
}

/** Moves the axes with the rigid surface, of which only the held point is to move on the screen: under a given load a new bump lifts all the
 * rest. Heights are known up to a constant. */
function followRigid({ rigid }) {
  const by = rigid[grip.far] - grip.rigid;
  axes = { ...axes, low: grip.axes.low + by, high: grip.axes.high + by };
}

/** Whether the stress below is shown in the picture. */
const isDeep = () => byId("fringes").checked;

/** Whether points of the profile can be dragged: those of lines that the knobs make. */
const canBend = () => !isAsked() && !isAging() && knobs.domain === "line" && isMade(knobs);

/** Whether the rigid surface can be pressed: not where the boundary is free, and not in the course of time. */
const canPress = () => section.is_pressed_by_gap && !isAging() && !isAsked();

/** Whether the contact is one of many, on a solid that creeps or yields below its surface, or under a tangential load: then a hand moves nothing,
 * as each of them takes the ones before. */
const isAging = () => HAS.resting(knobs) && knobs.time > 0 || HAS.rubbing(knobs) && knobs.sideways > 0 || HAS.yielding(knobs) || processOf(latest()) === "plastic";

/** Whether the surfaces attract each other. Then a contact under the hand goes on from the one before, and no load has it alone. */
const adheres = () => HAS.adhering(knobs) || (knobs.body === "scene" && processOf(latest()) === "adhesion");

/** Whether a question is open whose answer the hand would show. */
const isAsked = () => document.body.dataset.asked === "true" && lesson?.steps[lesson.at].ask.kind !== "act";

function takeGrip(kind, event) {
  if (!section) return;
  const at = frame(byId("section"));
  grip = { kind, y: event?.clientY ?? 0, gap: null, begun: section.mean_gap, load: knobs.load, moved: 0, perHeight: at.perHeight };
  isTouched = true;
  stopPlaying();
}

/** Moves the rigid surface, or the point that is held, by pixels upwards from where it was taken. */
function moveGrip(up) {
  grip.moved = Math.max(grip.moved, Math.abs(up));
  if (grip.kind === "look") return;
  const by = up / grip.perHeight;
  if (grip.kind === "press") press(grip.begun + by); else bend(grip.bump, grip.height + by / section.length);
}

/** Presses to a mean gap. Where nothing touches there is nothing to solve. */
function press(gap) {
  const most = adheres() ? GAPS.stretched * section.highest + GAPS.ranges * knobs.range * section.length : GAPS.most * section.highest;
  grip.gap = Math.min(most, Math.max(GAPS.least * section.highest, gap));
  if (isClear(grip.gap)) lift(grip.gap); else holdGrip();
}

/** Whether nothing touches at a mean gap, if one is held; surfaces that attract each other may touch at any. */
const isClear = (gap) => gap !== null && !adheres() && gap >= section.highest * (1 - 1e-6);

/** The numbers of a surface that touches nothing. */
const CLEAR = { relative_area: 0, relative_area_counted: 0, patches: 0, reduced_pressure: 0 };

/** Shows the rigid surface above a solid that it does not touch, and that is flat. */
function lift(gap) {
  upcoming = null;
  knobs.load = grip.load;
  setMoment({ name: say("moment.hand"), title: say("title.clear"), numbers: CLEAR, exact: null, isClear: true, knobs: structuredClone(knobs), load: 0 });
  show();
  setPictured(moment);
  showSection(liftedClear(section, gap), null, axes);
}

/** A section whose rigid surface is lifted to a mean gap at which nothing touches. */
function liftedClear(its, gap) {
  const flat = its.solid.map(() => 0);
  const rigid = its.rigid.map((height) => height + gap - its.mean_gap);
  return { ...its, rigid, solid: flat, pressure: flat, highest_pressure: 0, fields: {}, exact: null, mean_gap: gap, shear: null, zone: null };
}

/** Gives a bump its height, over the length of the cell; the rigid surface points down. */
function bend(bump, height) {
  if (knobs.bumps[bump]) knobs.bumps[bump][1] = Number((-height).toPrecision(4));
  holdGrip();
}

/** The bump at a share of the length: the nearest one, or a new one. */
function bumpAt(share) {
  const near = knobs.bumps.findIndex(([x]) => Math.abs(x - share) < BUMP.width);
  if (near >= 0) return near;
  if (knobs.bumps.length >= LIMITS.bumps) return knobs.bumps.length - 1;
  return knobs.bumps.push([Number(share.toPrecision(4)), 0, Math.max(BUMP.width, BUMP.spacings / knobs.points)]) - 1;
}

function takePoint(share, event) {
  takeGrip("bend", event);
  const far = Math.floor((share + 0.5) % 1 * section.rigid.length);
  const bump = bumpAt(share);
  Object.assign(grip, { bump, height: -knobs.bumps[bump][1], far, rigid: section.rigid[far], axes });
}

/** Lets go, as soon as the last wish of the hand is solved. */
function letGo() {
  if (!grip) return;
  if (grip.kind === "look") { grip = null; numbers(); return; }
  if (holding) grip.isLeft = true; else drop();
}

/** What the hand found is solved as a run, and recorded; until that begins it is shown. What is lifted clear stays where it is, as does a
 * contact with adhesion, which no load has alone: the load is the one before. */
function drop() {
  grip = null;
  knobs.bumps = knobs.bumps.filter(([, height]) => height !== 0);
  if (moment?.isClear || moment?.isStuck) numbers(); else changed();
}

/** Takes off all bumps. */
function unbend() {
  knobs.bumps = [];
  changed();
}

/** The share of the length, and the height of the profile in pixels, below a pointer. */
function under(event) {
  const canvas = byId("section");
  const box = canvas.getBoundingClientRect();
  const share = Math.min(1 - 1e-9, Math.max(0, (event.clientX - box.x) / box.width));
  const profile = frame(canvas).y(section.rigid[Math.floor(share * section.rigid.length)]);
  return { share, y: event.clientY - box.y, profile };
}

/** A finger on the picture moves the page: it takes the handles only. */
function pointerDown(event) {
  if (!section || event.button) return;
  event.preventDefault();
  byId("section").setPointerCapture(event.pointerId);
  const { share, y, profile } = under(event);
  const isFinger = event.pointerType === "touch";
  if (!isFinger && canBend() && Math.abs(y - profile) < BUMP.near) takePoint(share, event);
  else takeGrip(!isFinger && canPress() ? "press" : "look", event);
}

function pointerMove(event) {
  if (!section) return;
  if (grip) { if (Math.abs(event.clientY - grip.y) > STILL || grip.moved > STILL) moveGrip(grip.y - event.clientY); return; }
  const { y, profile } = under(event);
  byId("section").style.cursor = canBend() && Math.abs(y - profile) < BUMP.near ? "grab" : "ns-resize";
}

/** A press without a movement picks the patch below it. */
function pointerUp(event) {
  const isClick = grip && grip.moved <= STILL;
  if (isClick) {
    grip = null;
    knobs.bumps = knobs.bumps.filter(([, height]) => height !== 0);
    placeHandles();
    numbers();
    pickAt(under(event).share);
  } else letGo();
}

/** The keys of the two handles, in steps over the height of the picture. */
const STEPS = { ArrowUp: 0.02, ArrowDown: -0.02, PageUp: 0.1, PageDown: -0.1 };

function handleKey(event, kind) {
  const sideways = { ArrowLeft: -0.01, ArrowRight: 0.01 }[event.key];
  if (kind === "bend" && sideways) { moveHandle(handle + sideways); event.preventDefault(); return; }
  const by = STEPS[event.key];
  if (!by || !section) return;
  event.preventDefault();
  event.stopPropagation();
  if (!grip) { if (kind === "bend") takePoint(handle); else takeGrip("press"); grip.steps = 0; }
  grip.steps += by;
  moveGrip(grip.steps * byId("section").getBoundingClientRect().height * bands().relief);
}

/** Where the handle of the profile stands, as a share of the length: for fingers, for which it is large, beside the middle, where a round body
 * touches. */
let handle = askSystem("(pointer: coarse)").matches ? 0.25 : 0.5;

function moveHandle(share) {
  handle = Math.min(1, Math.max(0, Number(share.toFixed(3))));
  placeHandles();
}

/** Puts the handles to where rigid surface and profile stand. */
function placeHandles() {
  if (!section) return;
  const at = frame(byId("section"));
  const profile = section.rigid[Math.min(section.rigid.length - 1, Math.floor(handle * section.rigid.length))];
  const clip = (y) => `${Math.min(at.h, Math.max(at.top, y))}px`;
  for (const id of ["press", "label-drag"]) byId(id).style.top = clip(at.y(section.mean_gap));
  Object.assign(byId("bend").style, { left: `${100 * handle}%`, top: clip(at.y(profile)) });
  byId("press").hidden = !canPress();
  byId("bend").hidden = !canBend();
  byId("unbend").hidden = !canBend() || knobs.bumps.every(([, height]) => height === 0);
  const gap = withoutRounding(section.mean_gap / section.highest);
  byId("press").setAttribute("aria-valuenow", Number(gap.toPrecision(3)));
  byId("press").setAttribute("aria-valuetext", say("press.value", { gap: figure(gap, 3), load: figure(knobs.load, 4) }));
  byId("bend").setAttribute("aria-valuenow", handle);
  byId("bend").setAttribute("aria-valuetext", say("bend.value", { place: figure(handle, 3) }));
}

/** Shows what is shown once more, with the stress below or without it. */
function showAgain() {
  const { sweep, numbers: point } = moment ?? {};
  if (moment && !sweep) { drawSections(); return; }
  asking = null;
  moment = null;
  setPictured(null);
  if (sweep) momentOfLoad(sweep, point); else showSectionOf(shownOrLatest());
}

function beginHand() {
  const canvas = byId("section");
  canvas.addEventListener("pointerdown", pointerDown);
  canvas.addEventListener("pointermove", pointerMove);
  canvas.addEventListener("pointerup", pointerUp);
  canvas.addEventListener("pointercancel", letGo);
  for (const kind of ["press", "bend"]) {
    const made = byId(kind);
    made.addEventListener("keydown", (event) => handleKey(event, kind));
    made.addEventListener("keyup", (event) => { if (STEPS[event.key]) letGo(); });
    made.addEventListener("blur", letGo);
    made.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      made.setPointerCapture(event.pointerId);
      made.focus();
      if (kind === "bend") takePoint(handle, event); else takeGrip("press", event);
    });
    made.addEventListener("pointermove", (event) => { if (grip) moveGrip(grip.y - event.clientY); });
    made.addEventListener("pointerup", letGo);
    made.addEventListener("pointercancel", letGo);
  }
  byId("unbend").addEventListener("click", unbend);
  byId("fringes").addEventListener("change", showAgain);
  new ResizeObserver(() => { drawSections(); placeHandles(); drawPatch(); }).observe(canvas);
}
