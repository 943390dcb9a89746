// Packed values: files beside the page are scripts, since a page that is opened from a folder may load nothing else, and a script is text.

/** What a stream holds packed by gzip. The browser unpacks it. */
const unpackedStream = (stream) => new Response(stream.pipeThrough(new DecompressionStream("gzip")));

/** What a text in base64 holds packed by gzip. */
const unpacked = (base64) => unpackedStream(new Blob([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))]).stream());
