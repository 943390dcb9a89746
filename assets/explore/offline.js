// The service worker of a site: it keeps the files of the site, so that the page works without a network from the second visit on.

const OWN = `asperity ${self.registration.scope} `;
const NAME = `${OWN}{mark}`;
const FILES = ["./", ...{files}];

self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(NAME).then((cache) => cache.addAll(FILES)).then(() => self.skipWaiting()));
});

self.addEventListener("activate", (event) => {
  const isOld = (name) => name.startsWith(OWN) && name !== NAME;
  event.waitUntil(caches.keys().then((names) => Promise.all(names.filter(isOld).map((name) => caches.delete(name)))));
});

/** The file as it is kept, or from the network, and then it is kept too. */
async function fileOf(request) {
  const cache = await caches.open(NAME);
  const kept = await cache.match(request, { ignoreSearch: true });
  if (kept) return kept;
  const file = await fetch(request).catch(() => Response.error());
  if (file.status === 200) await cache.put(request, file.clone());
  return file;
}

self.addEventListener("fetch", (event) => {
  if (event.request.method === "GET" && event.request.url.startsWith(self.registration.scope)) event.respondWith(fileOf(event.request));
});
