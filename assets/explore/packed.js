// Packed values: files beside the page are scripts, since a page that is opened from a folder may load nothing else, and a script is text.

/** The bytes that a text in base64 holds. */
const blobOf = (base64) => new Blob([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))]);

/** What some bytes hold packed by gzip. The browser unpacks it. */
const unpackedBlob = (blob) => new Response(blob.stream().pipeThrough(new DecompressionStream("gzip")));

/** What a text in base64 holds packed by gzip. */
const unpacked = (base64) => unpackedBlob(blobOf(base64));
