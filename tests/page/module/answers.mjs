// Runs the module in Node by the worker of the page, asks it what standard input holds, a list of [method, path, body], and prints the
// answers, a list of [status, text, latest news]. A body is a text or, for a file, { base64 }; files in answers are base64.

import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import vm from "node:vm";

const [, , modulePath, workerPath] = process.argv;
const bytes = readFileSync(modulePath);
const module = new WebAssembly.Module(modulePath.endsWith(".gz") ? gunzipSync(bytes) : bytes);

let heard = null;
const answers = new Map();
let told = null;
const listen = (kind, handler) => { heard = handler; };
const post = (message) => {
  if (message.broken) throw new Error(message.broken);
  if (message.news) { told = JSON.parse(message.news); return; }
  answers.get(message.number)(message);
};
class XMLHttpRequest { open() {} send() {} }
const names = { postMessage: post, addEventListener: listen, XMLHttpRequest, performance, WebAssembly, TextDecoder, TextEncoder, Uint8Array };
vm.runInContext(readFileSync(workerPath, "utf8"), vm.createContext(names));

let asked = 0;
function send(message) {
  const number = ++asked;
  const answered = new Promise((done) => answers.set(number, done));
  heard({ data: { ...message, number, sign: "" } });
  return answered;
}

await send({ begin: { module, after: 0 } });
const results = [];
for (const [method, path, body] of JSON.parse(readFileSync(0))) {
  const content = body?.base64 === undefined ? body : Uint8Array.from(Buffer.from(body.base64, "base64")).buffer;
  const { status, answer } = await send({ method, path, body: content ?? "" });
  results.push([status, typeof answer === "string" ? answer : Buffer.from(answer).toString("base64"), told]);
}
process.stdout.write(JSON.stringify(results));
