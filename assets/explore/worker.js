// The module in a Web Worker: it takes requests, and sends answers, and news while it solves.

/** Milliseconds between two looks at whether the order is wanted. */
const PACE = 40;

let module = null;
/** The address that can be read as long as the order is wanted; whether it can, and when that was seen. */
let sign = "";
let isWanted = true;
let seen = 0;
/** Whether this browser lets a worker read such an address. If not, an order ends when it is solved. */
let canLook = false;
/** Whether the page hears of what is solved. */
let isHeard = false;

function isThere(address) {
  try {
    const request = new XMLHttpRequest();
    request.open("GET", address, false);
    request.send();
    return true;
  } catch {
    return false;
  }
}

const page = {
  now: () => performance.now(),
  news: (start, length) => { if (isHeard) postMessage({ news: textAt(start, length) }); },
  goes_on: () => {
    const now = performance.now();
    if (canLook && isWanted && now - seen > PACE) {
      seen = now;
      isWanted = isThere(sign);
    }
    return Number(isWanted);
  },
};

const bytesAt = (start, length) => new Uint8Array(module.memory.buffer, start, length);
const textAt = (start, length) => new TextDecoder().decode(bytesAt(start, length));

/** Begins the session, and solves its first state unheard, as the page knows it. */
async function begin({ module: compiled, after, first }) {
  module = (await WebAssembly.instantiate(compiled, { page })).exports;
  canLook = isThere(sign);
  module.begin(after);
  if (first) {
    request("POST", "/api/solve", first);
    module.work();
  }
  isHeard = true;
}

/** Writes a request into the memory of the module, and returns the status of its answer. */
function request(method, path, body = "") {
  const encoder = new TextEncoder();
  const head = encoder.encode(`${method} ${path}\n`);
  const rest = typeof body === "string" ? encoder.encode(body) : new Uint8Array(body);
  const start = module.room(head.length + rest.length);
  bytesAt(start, head.length).set(head);
  bytesAt(start + head.length, rest.length).set(rest);
  return module.ask();
}

/** Answers a request, and then solves what it ordered. */
function answer({ number, method, path, body }) {
  isWanted = true;
  seen = performance.now();
  const isFile = path.startsWith("save/");
  const status = request(method, isFile ? `/${path}` : `/api/${path}`, body);
  const [start, length] = [module.answer(), module.answer_length()];
  const isPlain = !isFile || status !== 200;
  postMessage({ number, status, answer: isPlain ? textAt(start, length) : bytesAt(start, length).slice() });
  module.work();
}

async function heard(message) {
  ({ sign } = message);
  if (!message.begin) { answer(message); return; }
  await begin(message.begin);
  postMessage({ number: message.number, status: 200, answer: { canLook } });
}

addEventListener("message", ({ data }) => heard(data).catch((error) => postMessage({ broken: String(error.message ?? error) })));
