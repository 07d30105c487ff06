// The page's data: JSON, with bulk numbers as base64: `{"f32": ...}` points of the drawing, `{"f64": ...}` values of charts,
// which are the very numbers of the result. NaN: a gap.

function bytes(base64) {
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out.buffer;
}

function decoded(value) {
  if (typeof value !== 'object' || value === null) return value;
  if (typeof value.f32 === 'string') return new Float32Array(bytes(value.f32));
  if (typeof value.f64 === 'string') return new Float64Array(bytes(value.f64));
  if (typeof value[0] === 'number') return value;  // a long list of plain numbers
  for (const key of Object.keys(value)) value[key] = decoded(value[key]);
  return value;
}

export const readData = () => decoded(JSON.parse(document.getElementById('data').textContent));
