// Presets: contacts to begin with, each with a small picture of it.

/** What all presets set; solver and recording stay as they are. */
const PLAIN = { ...defaultsOf("load", "solid", "surface"), bumps: [] };
const ROUGH_LINE = "M0 12 3 14 5 11 8 18 11 13 13 20 16 14 19 9 22 16 25 22 28 15 31 10 34 17 37 13 40 19 43 12 48 12";

/** Each with the knobs that differ, and its picture: a surface over a solid, 48 by 32.
 * @type {any[]} */
const PRESETS = [
  { id: "hertz", knobs: { body: "round", roughness: 0, load: 0.01 }, rigid: "M0 6Q24 38 48 6", solid: "M0 22H48" },
  { id: "rough", knobs: {}, rigid: ROUGH_LINE, solid: "M0 20Q13 24 25 22T48 20" },
  { id: "coating", knobs: { layer: 0.02 }, rigid: ROUGH_LINE, solid: "M0 20Q13 24 25 22T48 20M0 27H48" },
  { id: "map", rigid: "M4 4H20V14H4ZM28 8H44V20H28ZM10 20H24V28H10Z", solid: "M1 1H47V31H1Z" },
];

function beginPresets() {
  const buttons = PRESETS.map((preset) => {
    const made = button(`preset-${preset.id}`, "", say(`preset.${preset.id}.tip`), () => takePreset(preset));
    const picture = drawn("svg", { viewBox: "0 0 48 32", "aria-hidden": "true" });
    picture.append(drawn("path", { class: "second", d: preset.rigid }), drawn("path", { class: "computed", d: preset.solid }));
    made.append(picture, element("span", {}, say(`preset.${preset.id}`)));
    return made;
  });
  byId("controls").prepend(element("div", { id: "presets", role: "group", "aria-label": say("presets") }, ...buttons));
}

/** Solves a preset; that of a measured map asks for the file. */
function takePreset({ knobs: its }) {
  if (!its) { openFile(); return; }
  const { beside: _, scene: __, ...kept } = knobs;
  knobs = structuredClone({ ...kept, ...PLAIN, ...its });
  show();
  changed();
}
