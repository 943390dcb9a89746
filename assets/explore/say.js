// The language of the page, and its sentences, in `texts`, and those that the server reports in English. The texts of each language are a script of
// their own, of which the page has the English one from the beginning.

/** What the system says of the screen: the page answers for it where the viewer asks. */
const askSystem = window.matchMedia.bind(window);

/** The language that the address asks for, or was chosen before, or is the first of the browser's that there is. */
function wantedLanguage() {
  const wishes = [new URLSearchParams(location.search).get("language"), localStorage.getItem("language"), ...navigator.languages];
  return wishes.map((wish) => String(wish).slice(0, 2).toLowerCase()).find((wish) => Object.hasOwn(LANGUAGES, wish)) || "en";
}

const language = wantedLanguage();

/** The texts of the page in its language.
 * @type {Record<string, string>} */
let texts = {};

/** The text of a key in the language of the page, with values in its places such as {name}. */
function say(key, places = {}) {
  const text = texts[key] ?? key;
  return text.replace(/\{(\w+)\}/g, (place, name) => Object.hasOwn(places, name) ? places[name] : place);
}

/** Whether there is a text of a key, and a name as a part of a key. */
const knows = (key) => Object.hasOwn(texts, key);
const slug = (name) => name.toLowerCase().replaceAll(" ", "-");

/** A number in words, with the decimal mark of the language. */
const inLocale = (text) => language === "de" ? text.replace(".", ",") : text;

/** The number in a text, with a comma or a point as its decimal mark; not a number for any other text. */
function numberFrom(text) {
  const plain = text.trim().replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}

/** What the server tells in English, and the same in the language of the page: words, and sentences with places such as {name}.
 * @type {Record<string, string>} */
let told = {};

/** Takes the texts of a language. */
async function takeTexts(script) {
  const its = await unpacked(script).json();
  texts = its.texts;
  told = its.told;
}

/** Loads the texts of the language of the page. It stays English where they cannot be had. */
async function loadTexts() {
  await takeTexts(ENGLISH);
  if (language !== "en") await loadScript(`${language}.js`).then(() => takeTexts(FOREIGN));
}

/** A sentence of the server.
 * @typedef {string | { template: string, places: Record<string, Sentence | { length: number }> }} Sentence */

/** What stands in a place of a sentence: a length, which is one in metres, or a sentence.
 * @type {(place: Sentence | { length: number }) => string} */
const placeInWords = (place) => typeof place === "object" && "length" in place ? lengthOf(place.length, 4) : translated(place);

/** Own words for words of the server; none where there are none. */
const ownWords = (english) => Object.hasOwn(told, english) ? told[english] : undefined;

/** A sentence of the server in the language of the page, and all that stands in its places; in English where the language has no words for it.
 * @type {(sentence: Sentence) => string} */
function translated(sentence) {
  if (typeof sentence === "object") {
    const { template, places } = sentence;
    return (ownWords(template) ?? template).replace(/\{(\w+)\}/g, (all, name) => Object.hasOwn(places, name) ? placeInWords(places[name]) : all);
  }
  return ownWords(sentence) ?? (/^-?\d+\.\d+(e-?\d+)?( \S{1,2})?$/.test(sentence) ? inLocale(sentence) : sentence);
}

/** A sentence that begins with a capital letter, unless it begins with a symbol such as κ_r. */
const capital = (sentence) => sentence.split(" ")[0].includes("_") ? sentence : sentence.slice(0, 1).toUpperCase() + sentence.slice(1);

/** A refusal of the session in the words of the page, where it has some, or else in those of the session. */
function refusalInWords({ key, places, sentence }) {
  if (!knows(`refused.${key}`)) return translated(sentence);
  return say(`refused.${key}`, Object.fromEntries(Object.entries(places).map(([name, place]) => [name, placeInWords(place)])));
}

/** What a lesson says in the language of the page, else in English, else in any. */
function inLanguage(words) {
  return typeof words === "string" ? words : words[language] ?? words.en ?? Object.values(words)[0];
}

/** All elements of the page that a selector finds.
 * @type {(selector: string) => NodeListOf<HTMLElement>} */
const allOf = (selector) => document.querySelectorAll(selector);

/** Gives the elements of the page their texts: `data-text` is their text, `data-tip` the tip at the pointer, `data-name` what a
 * screen reader is. */
function sayAll() {
  document.documentElement.lang = language;
  for (const it of allOf("[data-text]")) it.textContent = say(it.dataset.text);
  for (const it of allOf("[data-tip]")) it.title = say(it.dataset.tip);
  for (const it of allOf("[data-name]")) it.ariaLabel = say(it.dataset.name);
}

/** A page in another language is the same page opened anew: its address holds what one sees. */
function changeLanguage(wish) {
  localStorage.setItem("language", wish);
  const address = new URL(location.href);
  address.searchParams.delete("language");
  history.replaceState(null, "", address);
  location.reload();
}

function offerLanguages() {
  const list = /** @type {HTMLSelectElement} */ (document.getElementById("language"));
  list.replaceChildren(...Object.entries(LANGUAGES).map(([it, name]) => new Option(name, it, false, it === language)));
  list.addEventListener("change", () => changeLanguage(list.value));
}

/** Gives the page its texts. */
async function beginTexts() {
  await loadTexts().catch((error) => console.error(error));
  sayAll();
  offerLanguages();
}
