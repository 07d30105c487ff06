// Colours of values: from blue over green and amber to red.
const stops = [[0x25, 0x63, 0xeb], [0x06, 0xb6, 0xd4], [0x22, 0xc5, 0x5e], [0xf5, 0x9e, 0x0b], [0xdc, 0x26, 0x26]];

export const cssOf = (color) => `#${color.toString(16).padStart(6, '0')}`;

/** 0 to 1 as a colour. */
export function valueColor(t) {
  const place = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(place));
  const mix = (k) => Math.round(stops[i][k] + (place - i) * (stops[i + 1][k] - stops[i][k]));
  return (mix(0) << 16) | (mix(1) << 8) | mix(2);
}

export const gradient = `linear-gradient(90deg, ${stops.map((s) => `rgb(${s.join(',')})`).join(', ')})`;

/** Least and greatest of the values that there are. */
export function rangeOf(...lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) for (const v of list) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  return low <= high ? [low, high] : [0, 1];
}
