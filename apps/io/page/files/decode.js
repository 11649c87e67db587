// The diagram in the page: JSON, and arrays as base64 of zlib's format (apps/io/page/data.hpp describes them).

function bytesOfBase64(text) {
  const clean = text.trim();
  const padding = clean.endsWith("==") ? 2 : clean.endsWith("=") ? 1 : 0;
  const bytes = new Uint8Array((clean.length / 4) * 3 - padding);
  const step = 1 << 20; // characters at once, a multiple of four: the browser's decoder makes a string of them
  let at = 0;
  for (let begin = 0; begin < clean.length; begin += step) {
    const part = atob(clean.slice(begin, begin + step));
    for (let k = 0; k < part.length; ++k) bytes[at++] = part.charCodeAt(k);
  }
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/** Differences of successive integers, zigzag coded, seven bits to a byte with the low ones first. */
export function decodeIntegers(bytes, count) {
  const values = new Int32Array(count);
  let at = 0;
  let before = 0;
  for (let k = 0; k < count; ++k) {
    let code = 0;
    let factor = 1;
    for (;;) {
      const byte = bytes[at++];
      code += (byte & 127) * factor;
      if (byte < 128) break;
      factor *= 128;
    }
    before += code % 2 === 0 ? code / 2 : -(code + 1) / 2;
    values[k] = before;
  }
  if (at !== bytes.length) throw new Error("an array of the page is damaged");
  return values;
}

const TYPES = { float32: Float32Array, float64: Float64Array, uint8: Uint8Array, int8: Int8Array };

async function decodeArray(name, { type, count }) {
  const buffer = await inflate(bytesOfBase64(document.getElementById(`array-${name}`).textContent));
  if (type === "integers") return decodeIntegers(new Uint8Array(buffer), count);
  const values = new TYPES[type](buffer);
  if (values.length !== count) throw new Error(`the array ${name} of the page is damaged`);
  return values;
}

/** The object of the page's JSON, with its arrays decoded. */
export async function readDiagram() {
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser is too old for the page: it needs one of 2023 or later.");
  const diagram = JSON.parse(document.getElementById("diagram").textContent);
  const names = Object.keys(diagram.arrays);
  const decoded = await Promise.all(names.map((name) => decodeArray(name, diagram.arrays[name])));
  diagram.arrays = Object.fromEntries(names.map((name, k) => [name, decoded[k]]));
  return diagram;
}
