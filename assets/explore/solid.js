// A contact of a surface in space, drawn by WebGL: the solid, cut where the section is, and the rigid surface above it, translucent. It is one
// shader and one matrix, so that a library of several hundred kilobytes would be more to load and to read than it saves.

/** Height of the picture over the longer side of the surface, and how far away the eye is from its middle. */
const SPACE = { height: 0.3, eye: 2.1, opening: 0.5, depth: 0.12 };
/** What is drawn by the shader. */
const PIECES = { solid: 0, wall: 1, rigid: 2, profile: 3, edge: 4 };

const VERTEX = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D fields;      // solid, rigid surface, pressure over the largest
uniform mat4 view;
uniform ivec2 shape;           // columns, rows
uniform vec2 sides;
uniform vec3 heights;          // lowest, factor, height of the base
uniform int piece, cut, stride;
uniform float reach;           // depth of what is shown below the cut; 0 for nothing
out float light;
out float pressure;
out vec2 below;
vec3 at(ivec2 node) {
  ivec2 inside = clamp(node, ivec2(0), shape - 1);
  vec4 field = texelFetch(fields, inside, 0);
  float z = piece == ${PIECES.rigid} || piece == ${PIECES.edge} ? field.y : field.x;
  return vec3((vec2(inside) + 0.5) / vec2(shape) * sides - 0.5 * sides, (z - heights.x) * heights.y);
}
void main() {
  bool isLine = piece == ${PIECES.profile} || piece == ${PIECES.edge};
  int id = gl_VertexID;
  ivec2 node = piece == ${PIECES.wall} ? ivec2(id / 2, cut) : isLine ? ivec2(id, cut) : ivec2(id % stride, id / stride);
  vec4 field = texelFetch(fields, node, 0);
  vec3 place = at(node);
  vec3 along = at(node + ivec2(1, 0)) - at(node - ivec2(1, 0));
  vec3 across = at(node + ivec2(0, 1)) - at(node - ivec2(0, 1));
  light = 0.45 + 0.55 * abs(dot(normalize(cross(along, across)), normalize(vec3(-0.6, -0.3, 0.75))));
  below = vec2((float(node.x) + 0.5) / float(shape.x), 0.0);
  if (piece == ${PIECES.wall} && id % 2 == 1) {
    below.y = (place.z - heights.z) / max(reach, 1e-9);
    place.z = heights.z;
  }
  pressure = field.z;
  gl_Position = view * vec4(place, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
uniform int piece;
uniform vec3 body, rigid, line, ramp[5];
uniform sampler2D zone;        // colours below the cut
uniform float reach;
in float light;
in float pressure;
in vec2 below;
out vec4 colour;
vec3 heat(float share) {
  float at = clamp(share, 0.0, 1.0) * 4.0;
  int part = min(3, int(at));
  return mix(ramp[part], ramp[part + 1], at - float(part));
}
void main() {
  if (piece == ${PIECES.profile} || piece == ${PIECES.edge}) colour = vec4(line, 1.0);
  else if (piece == ${PIECES.wall}) {
    vec4 cell = reach > 0.0 && below.y < 1.0 ? texture(zone, below) : vec4(0.0);
    colour = vec4(mix(body * 0.62, cell.rgb, cell.a), 1.0);
  }
  else if (piece == ${PIECES.rigid}) {
    if (pressure > 0.0) discard;
    colour = vec4(rigid * light, 0.34);
  } else colour = vec4((pressure > 0.0 ? heat(0.25 + 0.75 * pressure) : body) * light, 1.0);
}`;

/** What the graphics of the page hold, once they were asked for; null where there are none. */
let graphics;
/** From where the solid is seen: turned about the vertical, and from above. */
const eye = { turn: 0.4, rise: 0.62 };

/** The shader of a canvas, or null where the browser has no WebGL 2. */
function beginGraphics(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
  if (!gl) return null;
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  for (const unit of [gl.TEXTURE1, gl.TEXTURE0]) {
    gl.activeTexture(unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  }
  gl.uniform1i(gl.getUniformLocation(program, "zone"), 1);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.enable(gl.DEPTH_TEST);
  gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  return { gl, place: (name) => gl.getUniformLocation(program, name), its: null, shape: "", smooth: beginSmooth(gl) };
}

/** Numbers from a node to the one in the next row. Software keeps the last 64 vertices by the remainders of their numbers, which are to differ from
 * row to row. */
const strideOf = (columns) => columns + (96 - columns % 64) % 64;

/** Puts the fields of a map where the shader reads them, and the triangles of its shape, row by row. */
function loadFields(its) {
  const { gl } = graphics;
  const [rows, columns] = its.shape;
  const highest = its.highest_pressure || 1;
  const fields = new Float32Array(4 * rows * columns);
  its.rigid.forEach((z, i) => fields.set([z - its.gap[i], z, its.pressure[i] / highest, 0], 4 * i));
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, columns, rows, 0, gl.RGBA, gl.FLOAT, fields);
  graphics.its = its;
  graphics.ends = its.rigid.reduce(([low, high], z, i) => [Math.min(low, z - its.gap[i]), Math.max(high, z)], [Infinity, -Infinity]);
  if (graphics.shape === String(its.shape)) return;
  graphics.shape = String(its.shape);
  const triangles = new Uint32Array(6 * (rows - 1) * (columns - 1));
  const stride = strideOf(columns);
  let at = 0;
  for (let i = 0; i + 1 < rows; i++) for (let j = 0; j + 1 < columns; j++) {
    const node = i * stride + j;
    triangles.set([node, node + 1, node + stride, node + 1, node + stride + 1, node + stride], at);
    at += 6;
  }
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
}

/** Puts the colours of what has yielded below the cut where the shader reads them. */
function loadZone(zone, colour) {
  const { gl } = graphics;
  gl.activeTexture(gl.TEXTURE1);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, zone.columns, zone.strain.values.length / zone.columns, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(cellsOf(zone, colour).flat()));
  gl.activeTexture(gl.TEXTURE0);
}

/** The matrix, column by column, that puts places onto the screen: turned, seen from a distance, in perspective. */
function viewMatrix(aspect, middle) {
  const [ct, st, cr, sr] = [Math.cos(eye.turn), Math.sin(eye.turn), Math.cos(eye.rise), Math.sin(eye.rise)];
  // right, up and towards the eye; rows grow towards the eye
  const [right, up, back] = [[ct, st, 0], [st * sr, -ct * sr, cr], [-st * cr, ct * cr, sr]];
  const f = 1 / Math.tan(SPACE.opening / 2) / Math.max(1, 1 / aspect * 1.15);
  const [near, far] = [0.1, 10];
  const depth = (far + near) / (far - near);
  const away = SPACE.eye + back[2] * middle;
  const rows = [
    [...right.map((it) => it * f / aspect), 0],
    [...up.map((it) => it * f), -f * up[2] * middle],
    [...back.map((it) => -it * depth), away * depth - 2 * far * near / (far - near)],
    [...back.map((it) => -it), away],
  ];
  return new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
}

/** Samples of a pixel of a picture with smooth edges, and the milliseconds after which a picture is at rest: only then its edges are smooth, as that
 * takes too long for what moves where software draws. */
const SAMPLES = 4;
const STANDSTILL = 150;
let smoothing = null;

/** Makes room for a picture with smooth edges. */
function beginSmooth(gl) {
  const frame = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  const buffers = [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]].map(([format, attachment]) => {
    const buffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
    return { format, buffer };
  });
  return { frame, buffers };
}

/** Draws the contact in space, cut where its section is. */
function drawSolid() {
  graphics ??= beginGraphics(byId("solid"));
  byId("map-solid").disabled = !graphics;
  if (!graphics) { byId("map-solid").title = say("top.no-graphics"); shownMap = "pressure"; showTop(above); return; }
  clearTimeout(smoothing);
  smoothing = setTimeout(paintSmooth, STANDSTILL);
  graphics.gl.bindFramebuffer(graphics.gl.FRAMEBUFFER, null);
  paintSolid();
}

/** Draws it with smooth edges. */
function paintSmooth() {
  const { gl, smooth: { frame, buffers } } = graphics;
  const { width, height } = gl.canvas;
  for (const { format, buffer } of buffers) {
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorageMultisample(gl.RENDERBUFFER, SAMPLES, format, width, height);
  }
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  paintSolid();
  gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
  gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
}

/** Draws it where the graphics are to draw. */
function paintSolid() {
  const canvas = byId("solid");
  const box = canvas.getBoundingClientRect();
  if (!box.width || !above) return;
  if (graphics.its !== above) loadFields(above);
  const { gl, place, ends: [low, high] } = graphics;
  const [rows, columns] = above.shape;
  const scale = window.devicePixelRatio || 1;
  Object.assign(canvas, { width: Math.round(box.width * scale), height: Math.round(box.height * scale) });
  gl.viewport(0, 0, canvas.width, canvas.height);
  const colour = colours();
  const paint = (words) => rgb(words).map((part) => part / 255);
  gl.clearColor(...paint(colour.ground), 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const longest = Math.max(...above.size);
  const row = Math.min(rows - 1, Math.max(1, Math.floor(section.y / above.size[0] * rows + 0.5)));
  gl.uniformMatrix4fv(place("view"), false, viewMatrix(box.width / box.height, 0.4 * SPACE.height));
  gl.uniform2i(place("shape"), columns, rows);
  gl.uniform2f(place("sides"), above.size[1] / longest, above.size[0] / longest);
  gl.uniform3f(place("heights"), low, SPACE.height / (high - low || 1), -SPACE.depth);
  gl.uniform1i(place("cut"), row);
  if (section.zone) loadZone(section.zone, rgb(colour.warm));
  gl.uniform1f(place("reach"), section.zone ? section.zone.depth / longest : 0);
  gl.uniform1i(place("stride"), strideOf(columns));
  gl.uniform3fv(place("body"), paint(document.documentElement.dataset.theme === "light" ? colour.edge : colour.soft));
  gl.uniform3fv(place("rigid"), paint(colour.accent));
  gl.uniform3fv(place("line"), paint(colour.ink));
  gl.uniform3fv(place("ramp"), RAMPS.pressure.flat().map((part) => part / 255));
  const draw = (piece, mode, count) => {
    gl.uniform1i(place("piece"), PIECES[piece]);
    if (mode === gl.TRIANGLES) gl.drawElements(mode, count, gl.UNSIGNED_INT, 0); else gl.drawArrays(mode, 0, count);
  };
  const behind = 6 * row * (columns - 1);
  draw("solid", gl.TRIANGLES, behind);
  draw("wall", gl.TRIANGLE_STRIP, 2 * columns);
  draw("profile", gl.LINE_STRIP, columns);
  draw("edge", gl.LINE_STRIP, columns);
  gl.enable(gl.BLEND);
  gl.depthMask(false);
  draw("rigid", gl.TRIANGLES, behind);
  gl.depthMask(true);
  gl.disable(gl.BLEND);
  const times = figure(Number((SPACE.height * longest / (high - low || 1)).toPrecision(2)), 2);
  canvas.ariaLabel = say("solid.words", { times });
  byId("solid-scale").textContent = say("solid.scale", { times, length: withUnit(longest, "length") });
}

/** Turns the solid. */
function turnSolid(by, rise) {
  eye.turn = Math.min(1.3, Math.max(-1.3, eye.turn + by));
  eye.rise = Math.min(1.5, Math.max(0.12, eye.rise + rise));
  drawSolid();
}

function beginSolid() {
  const canvas = byId("solid");
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => { if (event.buttons) turnSolid(event.movementX / 150, event.movementY / 150); });
  canvas.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08] }[event.key];
    if (!by) return;
    event.preventDefault();
    turnSolid(...by);
  });
}
