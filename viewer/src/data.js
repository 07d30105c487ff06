// The page's data: JSON, with bulk numbers as base64: `{"f32": ...}` points of the drawing, `{"f64": ...}` values of charts,
// which are the very numbers of the result. NaN: a gap.

function bytes(base64) {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)).buffer;
}

export function readData() {
  const text = document.getElementById('data').textContent;
  return JSON.parse(text, (key, value) => {
    if (typeof value?.f32 === 'string') return new Float32Array(bytes(value.f32));
    if (typeof value?.f64 === 'string') return new Float64Array(bytes(value.f64));
    return value;
  });
}
