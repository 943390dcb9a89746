// The table of numbers: its rows, on the page and in a file.

/** Whether more than two digits of a number would say nothing: those of an error, and those of a time that was measured. */
const isRough = (name) => name === SECONDS.name || known.some(({ errors }) => errors.includes(name));

/** The relative error from which on a number stands with it. */
const COARSE = 0.05;
/** The error that stands in a row of its own. */
const ERROR_SHOWN = "kappa_r_error";
/** The name of the error of a number: the first one that the table of quantities has for it. */
const errorOf = (name) => name === ERROR_SHOWN ? name : known.find((row) => row.name === name)?.errors?.[0];

/** A number as the table has it: with its error, if that is large or not known, and the error itself with what to do. */
function valueOf(told, name) {
  const error = told?.[errorOf(name)];
  // with adhesion there are no such errors, and no certificate
  const isUnknown = error === null && told.relative_area > 0 && told.certificate !== null;
  if (!isUnknown && !(error >= COARSE)) return figure(cleared(told, name), isRough(name) ? 2 : 5);
  const percent = isUnknown ? "?" : `${figure(100 * error, 2)} %`;
  const remedy = knobs.body === "file" ? "file" : "points";
  const shown = name === ERROR_SHOWN ? say(`numbers.coarse.${remedy}`, { error: percent }) : `${figure(told[name], 3)} ± ${percent}`;
  const tip = isUnknown ? "numbers.coarse.unknown.tip" : `numbers.coarse.${remedy}.tip`;
  return [element("span", { class: "coarse", title: say(tip) }, shown)];
}

/** A row of the table: a number by its name, its values in both states, the exact one, and what the table shows for each.
 * @typedef {{ name: string, values: any[], exact?: any, shown: any[] }} NumberRow */

/** Rows of the numbers that all contacts have.
 * @returns {NumberRow[]} */
function rowsOfContact(run, both, exact) {
  const isTold = (name) => [...both, run.numbers].some((told) => Number.isFinite(told?.[name]));
  const names = observables.map(({ name }) => name).filter((name) => isTold(name) || !run.numbers);
  return names.map((name) => {
    const theory = exact?.[name];
    return { name, values: both.map((told) => cleared(told, name)), exact: theory, shown: [...both.map((told) => valueOf(told, name)), theory === undefined ? "" : figure(theory)] };
  });
}

/** Rows of the numbers that only the process of a run knows.
 * @returns {NumberRow[]} */
function rowsOfProcess(run, both) {
  const names = (run.process?.numbers ?? []).filter((name) => both.some((told) => Number.isFinite(told?.[name])));
  const shown = (its, name) => withUnit(cleared(its, name), kindOf(name), { digits: 4, modulus: modulusOf(its) });
  return names.map((name) => ({ name, values: both.map((told) => cleared(told, name)), shown: [...both.map((told) => shown(told, name)), ""] }));
}

/** Tabor's number from which on the pull-off is that of a short range of the attraction. */
const SHORT_RANGE = 5;

/** The pull-off of a short range, where theory says that it is that.
 * @param {any} run */
const exactPullOff = ({ pull_off: theory }) => theory?.tabor >= SHORT_RANGE * (1 - 1e-6) ? theory.jkr : undefined;

/** Rows of the numbers that were found for a run after its end, or for the one beside.
 * @returns {NumberRow[]} */
function rowsFoundLater(run, states) {
  const exact = { pull_off: exactPullOff(run) };
  const value = (it, name) => it?.found?.[name] ?? null;
  const all = new Set([...Object.keys(exact), ...states.flatMap((it) => Object.keys(it?.found ?? {}))]);
  const names = [...all].filter((name) => Number.isFinite(exact[name]) || states.some((it) => value(it, name) !== null));
  return names.map((name) => {
    const shown = (told, of) => Number.isFinite(told) ? withUnit(told, kindOf(name), { modulus: modulusOf(of?.numbers) }) : "";
    return { name, values: states.map((it) => value(it, name)), exact: exact[name], shown: [...states.map((it) => shown(value(it, name), it)), shown(exact[name], run)] };
  });
}

/** Rows of what theory says of the pull-off: its limits of a short and of a long range, where it is between them, and Tabor's number.
 * @returns {NumberRow[]} */
function rowsOfPullOff(run, before) {
  if (!run.pull_off) return [];
  const limits = exactPullOff(run) === undefined ? ["jkr", "dmt"].filter((name) => run.pull_off[name] !== null) : [];
  const rows = limits.map((name) => ({ name, values: [null, null], exact: run.pull_off[name], shown: ["", "", withUnit(run.pull_off[name], kindOf(name), { modulus: modulusOf(run.numbers) })] }));
  const tabors = [run, before].map((it) => it?.pull_off?.tabor ?? null);
  return [...rows, { name: "tabor", values: tabors, shown: [...tabors.map((it) => it === null ? "" : figure(it, 2)), ""] }];
}

/** A row as an element of the table. */
function rowElement({ name, shown }) {
  const cell = (text, named) => element("td", { "data-number": named }, ...[text].flat());
  return element("tr", { title: say(`number.${name}.tip`) }, element("th", { scope: "row" }, say(`number.${name}`)), cell(shown[0], name), cell(shown[1], ""), cell(shown[2], `exact ${name}`));
}

/** The row of the methods by which two runs were solved. */
function rowOfSolver(run, before) {
  const cell = (text, name) => element("td", { "data-number": name }, text);
  return element("tr", { title: tipOf(controlOf("solver")) }, element("th", { scope: "row" }, labelOf(controlOf("solver"))), cell(solverOf(run), "solver"), cell(before && !isOfStates(before) ? solverOf(before) : "", ""), cell("", ""));
}

/** The table that is shown: the titles of both states, their contact moduli, and the rows.
 * @type {{ titles: (string | null)[], moduli: number[], rows: NumberRow[] } | null} */
let shownTable = null;

/** Shows the numbers of a run, or of the moment in its place, with those of another state beside them, which is the surface beside it, or the
 * run before. */
function showTable(run, other, before) {
  const both = [moment || run, other].map((it) => it?.numbers);
  const exact = moment && "exact" in moment ? moment.exact : run.exact;
  const rows = [...rowsOfContact(run, both, exact), ...rowsOfProcess(run, both), ...rowsFoundLater(run, [moment ? null : run, run.beside ? null : before]), ...rowsOfPullOff(run, run.beside ? null : before)];
  // how a contact was solved is folded away
  const isOfSolving = ({ name }) => [...known, SECONDS].some((row) => row.name === name && row.page === "solving");
  byId("numbers").tBodies[0].replaceChildren(...rows.filter((row) => !isOfSolving(row)).map(rowElement));
  byId("solving").replaceChildren(...(isOfStates(run) ? [] : [rowOfSolver(run, run.beside ? null : before)]), ...rows.filter(isOfSolving).map(rowElement));
  shownTable = { titles: [moment?.title ?? titleOf(run), other ? titleOf(other) : null], moduli: both.map(modulusOf), rows };
}

/** Shows how the contact was solved, or folds it away. */
function foldSolving() {
  byId("solving").hidden = !byId("solving").hidden;
  byId("show-solving").ariaExpanded = String(!byId("solving").hidden);
}

/** Rows of a table as text with commas between them, and words with commas in quotes. Its mark tells spreadsheets that letters are not English only. */
function tableInText(rows) {
  const quoted = (it) => /[",\n]/.test(String(it)) ? `"${String(it).replaceAll('"', '""')}"` : String(it ?? "");
  return `\ufeff${rows.map((row) => `${row.map(quoted).join(",")}\n`).join("")}`;
}

/** The unit of a number in a file, and its values in that unit.
 * @type {(row: NumberRow, moduli: number[]) => { unit: string, written: any[] }} */
const inOneUnit = ({ name, values, exact }, moduli) => {
  const kind = kindOf(name);
  const all = [...values, exact];
  const first = all.find(Number.isFinite) ?? 0;
  const units = [...moduli, moduli[0]].map((modulus) => shownUnit(kind, first, modulus));
  const written = all.map((value, i) => Number.isFinite(value) ? Number((value / units[i].size).toPrecision(12)) : "");
  return { unit: name === SECONDS.name ? "s" : units[0].name, written };
};

/** The numbers that are shown as the rows of a file: name, symbol and unit of each, and its values in the columns of the table that are not
 * empty. */
function rowsOfNumbers() {
  const { titles, moduli, rows } = shownTable;
  const lines = rows.map((row) => {
    const { unit, written } = inOneUnit(row, moduli);
    return { words: [say(`number.${row.name}`), known.find(({ name }) => name === row.name)?.symbol ?? "", unit], written };
  });
  const names = [byId("this"), byId("rival")].map(({ textContent }, i) => `${textContent}: ${titles[i]}`).concat(say("numbers.exact"));
  const isFilled = (i) => lines.some(({ written }) => written[i] !== "");
  const columns = [0, 1, 2].filter(isFilled);
  return [[...["name", "symbol", "unit"].map((it) => say(`numbers.${it}`)), ...columns.map((i) => names[i])], ...lines.map(({ words, written }) => [...words, ...columns.map((i) => written[i])])];
}
