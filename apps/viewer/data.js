// What the page carries: JSON with arrays in base64, little-endian as on every machine that has
// a browser.
const kArrays = {u16: Uint16Array, u32: Uint32Array, f32: Float32Array};

function decode({type, data}) {
  const text = atob(data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new kArrays[type](bytes.buffer);
}

function readData() {
  const data = JSON.parse(document.getElementById("data").textContent);
  const {shape} = data;
  for (const key of ["positions", "triangles", "branches"]) shape[key] = decode(shape[key]);
  for (const lines of data.lines)
    for (const key of ["positions", "radii", "edges", "branches"]) lines[key] = decode(lines[key]);
  return data;
}

/// Numbers of edges at every node.
function degreesOf({radii, edges}) {
  const degrees = new Uint32Array(radii.length);
  for (const node of edges) ++degrees[node];
  return degrees;
}

/// [least, greatest], with some room where they are the same.
function rangeOf(numbers) {
  let low = Infinity, high = -Infinity;
  for (const n of numbers) low = Math.min(low, n), high = Math.max(high, n);
  return high > low ? [low, high] : [low * 0.99, low * 1.01 || 1];
}

function colourOf(text) {
  const value = parseInt(text.slice(1), 16);
  return [value >> 16, value >> 8 & 255, value & 255];
}

/// A colour between those of a list, t from 0 to 1.
function along(colours, t) {
  const place = Math.min(Math.max(t, 0), 1) * (colours.length - 1);
  const i = Math.min(Math.floor(place), colours.length - 2), f = place - i;
  return colours[i].map((c, k) => c * (1 - f) + colours[i + 1][k] * f);
}
