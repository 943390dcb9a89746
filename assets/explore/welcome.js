// The first half minute: what the page is for, and three ways to begin.

/** Offers them to who comes for the first time, by an address that asks for nothing. */
function beginWelcome() {
  byId("welcome").hidden = Boolean(location.hash || localStorage.getItem("welcomed"));
  const begins = { "welcome-lesson": startLessons, "welcome-try": () => byId("control-load").focus(), "welcome-file": openFile };
  for (const [id, action] of Object.entries(begins)) byId(id).addEventListener("click", () => { endWelcome(); action(); });
}

function endWelcome() {
  localStorage.setItem("welcomed", "true");
  byId("welcome").hidden = true;
}

async function startLessons() {
  await openLesson(lessons[0].name);
  comeToLesson();
}
