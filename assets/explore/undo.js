// Undo: earlier states of the knobs, to go back to.

/** The most states that are kept, and how long the knobs must rest for their state to be one. */
const MOST_STATES = 50;
const REST = 400;

/** States from the oldest on, the present one last. */
let states = [];
let resting = null;

/** Keeps the state of the knobs once they rest: a slider that is drawn makes one state. */
function keepState() {
  clearTimeout(resting);
  resting = setTimeout(() => {
    if (states.length && words(states.at(-1)) === words(knobs)) return;
    states.push(structuredClone(knobs));
    if (states.length > MOST_STATES) states.shift();
    offerUndo();
  }, REST);
}

const offerUndo = () => { byId("undo").disabled = states.length < 2; };

/** Goes back to the state before the present one. */
function undo() {
  if (states.length < 2) return;
  states.pop();
  knobs = painted(structuredClone(states.at(-1)));
  show();
  offerUndo();
  changed();
}
