"use strict";
// A step that is picked in an image over steps is the step of everything.

/** Images whose columns are steps, their width on the canvas, and their columns at the most: beyond that, columns hold two, four and so
 * on. */
const OVER_STEPS = /\/(raster(_row|_column)?|error_(pressure|displacement)|energy|lanes)\/image$/;
const IMAGE = { width: 1000, columns: 1024 };

/** Takes the viewer to the step that was picked, once it is done with telling of it: until then it takes no calls. */
function linkStep(event) {
  const { type, recording_id: recording, items } = JSON.parse(event);
  if (type !== "selection_change") return;
  const picked = items.find((item) => item.position && OVER_STEPS.test(item.entity_path ?? ""));
  if (picked) setTimeout(goToPlace, 0, recording, picked.position[0] / IMAGE.width);
}

/** Goes to the step at a share of the width of the images. */
function goToPlace(recording, share) {
  const range = viewer && viewer.get_timeline_time_range(recording, "step");
  if (!range) return;
  const step = Math.floor(share * stepsShown(range.max + 1));
  viewer.set_playing(recording, false);
  viewer.set_active_timeline(recording, "step");
  viewer.set_time_for_timeline(recording, "step", Math.min(step, range.max));
  document.body.dataset.picked = step;
  wake();
}

/** The steps of all columns of an image, the last of which may not be full. */
function stepsShown(steps) {
  let each = 1;
  while (Math.ceil(steps / each) > IMAGE.columns) each *= 2;
  return Math.ceil(steps / each) * each;
}
