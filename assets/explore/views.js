// Which pictures the page shows: its own, that of the viewer, or both.

const VIEWS = ["picture", "viewer", "both"];
/** Screens on which both have room, as in the style sheet. On others the page shows its own picture where both are wanted, and does not load
 * the viewer until that is asked for. */
const ROOMY = askSystem("(min-width: 1401px) and (min-height: 860px)");

/** The view that the address asks for, or was chosen last. */
let wantedView = null;

/** Shows the view that is wanted. The viewer is loaded when it is first shown; while it is not shown it draws and reads nothing. */
function showView() {
  const view = wantedView === "both" && !ROOMY.matches ? "picture" : wantedView;
  document.body.dataset.view = view;
  for (const it of VIEWS) byId(`view-${it}`).setAttribute("aria-pressed", String(it === view));
  if (view === "picture") viewer = null; else beginViewer();
  drawSections();
  numbers();
}

function chooseView(view) {
  localStorage.setItem("view", view);
  putView(view);
}

function putView(view) {
  if (view === wantedView) return;
  wantedView = view;
  showView();
}

function beginViews() {
  for (const view of VIEWS) byId(`view-${view}`).addEventListener("click", () => chooseView(view));
  byId("more").addEventListener("click", () => {
    const isMore = document.body.toggleAttribute("data-more");
    byId("more").setAttribute("aria-expanded", String(isMore));
  });
  byId("projector").addEventListener("click", () => putProjector(!("projector" in document.body.dataset)));
  if (localStorage.getItem("projector")) putProjector(true);
  const wishes = [new URLSearchParams(location.search).get("view"), localStorage.getItem("view")];
  wantedView = wishes.find((wish) => VIEWS.includes(wish)) ?? "picture";
  const why = site?.recorded.length === 0 ? say("viewer.left-out") : location.protocol === "file:" ? say("viewer.disk") : "";
  if (why) {
    wantedView = "picture";
    for (const view of ["viewer", "both"]) Object.assign(byId(`view-${view}`), { disabled: true, title: why });
  }
  ROOMY.addEventListener("change", showView);
  showView();
}

/** Large letters and thick lines, for a class that looks at a wall, or those of a screen. */
function putProjector(isWanted) {
  document.body.toggleAttribute("data-projector", isWanted);
  byId("projector").setAttribute("aria-pressed", String(isWanted));
  if (isWanted) localStorage.setItem("projector", "true"); else localStorage.removeItem("projector");
  FONT = isWanted ? FONTS.wall : FONTS.screen;
  drawSections();
  drawTop();
  charts();
}
