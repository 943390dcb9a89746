// Letters that hold bytes: files beside the page are scripts, since a page that is opened from a folder may load nothing else, and a script is text.

/** The first of 32768 letters, each of which is 15 bits. */
const FIRST_LETTER = 0x3400;

/** The bytes in a text of such letters, the highest bits first: the first `length` of them, or all of them. */
function bytesFrom(text, length = Math.floor(text.length * 15 / 8)) {
  const bytes = new Uint8Array(length);
  for (let i = 0, bits = 0, count = 0, at = 0; i < text.length; i++) {
    bits = (bits & 0xff) << 15 | text.charCodeAt(i) - FIRST_LETTER;
    for (count += 15; count >= 8; count -= 8) bytes[at++] = bits >> count - 8;
  }
  return bytes;
}

/** The JSON in such letters, which hold it compressed (RFC 1950) in some bytes. The browser unpacks it. */
async function jsonFrom({ bytes, letters }) {
  const stream = new Blob([bytesFrom(letters, bytes)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).json();
}
