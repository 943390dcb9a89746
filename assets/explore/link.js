// What is picked in the viewer: a step in an image over steps is the step of everything, a patch in a picture is shown beside its twin.

/** Images whose columns are steps, their width on the canvas, and their columns at the most: beyond that, columns hold two, four and so
 * on. */
const OVER_STEPS = /\/(raster(_row|_column)?|error_(pressure|displacement)|energy|lanes)\/image$/;
const IMAGE = { width: 1000, columns: 1024 };

/** Handles the events of the viewer. The reaction waits until the event is over, since the viewer takes no calls before. */
function heardViewer(event) {
  const told = JSON.parse(event);
  if (told.type === "selection_change") setTimeout(heardSelection, 0, told);
  if (told.type === "time_update" && !isView) setTimeout(showMoment, 0);
}

function heardSelection({ recording_id: recording, items }) {
  const step = items.find((item) => item.position && OVER_STEPS.test(item.entity_path ?? ""));
  if (step) goToPlace(recording, step.position[0] / IMAGE.width);
  else if (!isView) heardPick(recording, items);
}

/** Goes to the step at a share of the width of the images. */
function goToPlace(recording, share) {
  const range = viewer && viewer.get_timeline_time_range(recording, "step");
  if (!range) return;
  const step = Math.floor(share * stepsShown(range.max + 1));
  goTo(recording, "step", Math.min(step, range.max));
  document.body.dataset.picked = String(step);
}

/** The steps of all columns of an image, the last of which may not be full. */
function stepsShown(steps) {
  let each = 1;
  while (Math.ceil(steps / each) > IMAGE.columns) each *= 2;
  return Math.ceil(steps / each) * each;
}
