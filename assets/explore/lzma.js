// The decoder of LZMA, in which the module comes, as that is a quarter smaller than what browsers can unpack themselves. Formats and names are those
// of the LZMA specification (Igor Pavlov, 2015); the worker reads this before its own text.

/** Probabilities of bits: how many bits they have, and how fast they follow what was read. */
const PROBABILITY = { bits: 11, pace: 5 };
/** States after which a literal follows a match, and states of the last bytes, for each place. */
const AFTER_MATCH = 7;
const STATES = 12;
const PLACES = 16;
/** The shortest match; slots of distances below which they are exact, and below which all bits have probabilities. */
const SHORTEST = 2;
const SLOTS = { count: 64, bits: 6, exact: 4, modelled: 14, align: 4 };

const probabilities = (count) => new Uint16Array(count).fill(1 << PROBABILITY.bits - 1);

/** Reads bits from an address on, each with a probability of its own that follows them, and numbers made of such bits. Range and code are 32 bits
 * without a sign, which are compared with the highest bit turned. */
function bitReader(packed, from) {
  let range = -1;
  let code = new DataView(packed.buffer, packed.byteOffset).getInt32(from + 1);
  let at = from + 5;
  const isBelow = (bound) => (code ^ 0x80000000) < (bound ^ 0x80000000);
  const refill = () => {
    if (range >>> 24) return;
    range <<= 8;
    code = code << 8 | packed[at++];
  };
  const bit = (own, i) => {
    const bound = Math.imul(range >>> PROBABILITY.bits, own[i]);
    const isZero = isBelow(bound);
    if (isZero) {
      range = bound;
      own[i] += (1 << PROBABILITY.bits) - own[i] >> PROBABILITY.pace;
    } else {
      range = range - bound | 0;
      code = code - bound | 0;
      own[i] -= own[i] >> PROBABILITY.pace;
    }
    refill();
    return isZero ? 0 : 1;
  };
  /** A number whose bits are as often zero as one. */
  const even = (count) => {
    let value = 0;
    for (let i = 0; i < count; i++) {
      range >>>= 1;
      const isOne = !isBelow(range);
      if (isOne) code = code - range | 0;
      value = value << 1 | Number(isOne);
      refill();
    }
    return value;
  };
  /** A number with its highest bit first, and one with its lowest bit first. */
  const tree = (own, count, start = 0) => {
    let node = 1;
    for (let i = 0; i < count; i++) node = node << 1 | bit(own, start + node);
    return node - (1 << count);
  };
  const reversed = (own, count, start = 0) => {
    let [node, value] = [1, 0];
    for (let i = 0; i < count; i++) {
      const next = bit(own, start + node);
      node = node << 1 | next;
      value |= next << i;
    }
    return value;
  };
  return { bit, even, tree, reversed };
}

/** Reads lengths of matches less the shortest one: of 3, 3 or 8 bits. */
function lengthReader({ bit, tree }) {
  const [choice, low, middle, high] = [2, 8 * PLACES, 8 * PLACES, 256].map(probabilities);
  return (place) => {
    if (!bit(choice, 0)) return tree(low, 3, 8 * place);
    return bit(choice, 1) ? 16 + tree(high, 8) : 8 + tree(middle, 3, 8 * place);
  };
}

/** Reads distances of matches less one. */
function distanceReader({ even, tree, reversed }) {
  const [slots, modelled, aligned] = [4 * SLOTS.count, 115, 1 << SLOTS.align].map(probabilities);
  return (length) => {
    const slot = tree(slots, SLOTS.bits, SLOTS.count * Math.min(length, 3));
    if (slot < SLOTS.exact) return slot;
    const count = (slot >> 1) - 1;
    const base = (2 | slot & 1) << count;
    if (slot < SLOTS.modelled) return base + reversed(modelled, count, base - slot);
    return base + (even(count - SLOTS.align) << SLOTS.align) + reversed(aligned, SLOTS.align);
  };
}

/** Reads a byte after the one before; after a match it is compared with the byte at the distance of that. */
function literalReader({ bit }, afterBits, placeBits) {
  const own = probabilities(0x300 << afterBits + placeBits);
  return (at, before, matched) => {
    const start = 0x300 * (((at & (1 << placeBits) - 1) << afterBits) + (before >> 8 - afterBits));
    let symbol = 1;
    for (let rest = matched << 1; matched >= 0 && symbol < 0x100; rest <<= 1) {
      const next = bit(own, start + 0x100 + (rest & 0x100) + symbol);
      symbol = symbol << 1 | next;
      if ((rest >> 8 & 1) !== next) break;
    }
    while (symbol < 0x100) symbol = symbol << 1 | bit(own, start + symbol);
    return symbol & 0xff;
  };
}

/** The bytes that a file of LZMA holds, whose head has their number. */
function unpacked(packed) {
  const plain = new Uint8Array(new DataView(packed.buffer, packed.byteOffset).getUint32(5, true));
  const [afterBits, placeBits, statePlaces] = [packed[0] % 9, Math.floor(packed[0] / 9) % 5, 1 << Math.floor(packed[0] / 45)];
  const reader = bitReader(packed, 13);
  const { bit } = reader;
  const [literal, distance] = [literalReader(reader, afterBits, placeBits), distanceReader(reader)];
  const [lengthOfMatch, lengthOfRepeat] = [lengthReader(reader), lengthReader(reader)];
  const [isMatch, isLong, isRepeat, isOlder, isThird, isFourth] = [STATES * PLACES, STATES * PLACES, STATES, STATES, STATES, STATES].map(probabilities);
  let state = 0;
  let distances = [0, 0, 0, 0];
  /** Takes a distance that was used before to the front, and whether one byte alone is repeated. */
  const repeat = (place) => {
    if (!bit(isOlder, state)) return !bit(isLong, PLACES * state + place);
    const which = !bit(isThird, state) ? 1 : !bit(isFourth, state) ? 2 : 3;
    distances = [distances[which], ...distances.filter((_, i) => i !== which)];
    return false;
  };
  for (let at = 0; at < plain.length;) {
    const place = at & statePlaces - 1;
    if (!bit(isMatch, PLACES * state + place)) {
      plain[at] = literal(at, at && plain[at - 1], state < AFTER_MATCH ? -1 : plain[at - distances[0] - 1]);
      at++;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    const isOld = bit(isRepeat, state);
    const isShort = isOld && repeat(place);
    const length = isShort ? 1 : SHORTEST + (isOld ? lengthOfRepeat : lengthOfMatch)(place);
    if (!isOld) distances = [distance(length - SHORTEST), ...distances.slice(0, 3)];
    state = (state < AFTER_MATCH ? AFTER_MATCH : AFTER_MATCH + 3) + (isShort && state < AFTER_MATCH ? 2 : isOld ? 1 : 0);
    for (const end = at + length; at < end; at++) plain[at] = plain[at - distances[0] - 1];
  }
  return plain;
}
