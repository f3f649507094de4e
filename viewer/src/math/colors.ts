// Colours: a body's own, and a map from numbers that is perceptually uniform and told apart by the colour-blind.

/** Muted, distinct in hue and in lightness; after Okabe and Ito, calmed down. */
const BODIES = ["#4f86c6", "#e0a13c", "#4aa583", "#c8695a", "#8f7fc7", "#5fb3cf", "#b58a5f", "#d08ab5"];

/** Viridis by every ninth of its range; straight lines between them stay close enough to be uniform to the eye. */
const VIRIDIS = [
  "#440154",
  "#482878",
  "#3e4989",
  "#31688e",
  "#26828e",
  "#1f9e89",
  "#35b779",
  "#6ece58",
  "#b5de2b",
  "#fde725",
].map(rgb);

/** Of series in a plot; the same as the bodies'. */
export function seriesColor(index: number): string {
  return BODIES[index % BODIES.length];
}

export const bodyColor = seriesColor;

/** Red, green, blue from 0 to 1, as on the screen (sRGB). */
export type Rgb = [number, number, number];

export function rgb(hex: string): Rgb {
  const number = Number.parseInt(hex.slice(1), 16);
  return [((number >> 16) & 255) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
}

/** The colour of a number from 0 to 1; beyond, the end's. */
export function mapped(value: number): Rgb {
  const place = Math.min(1, Math.max(0, value)) * (VIRIDIS.length - 1);
  const low = Math.min(VIRIDIS.length - 2, Math.floor(place));
  const part = place - low;
  const [a, b] = [VIRIDIS[low], VIRIDIS[low + 1]];
  return [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])];
}

/** The map as a CSS gradient. */
export function mapGradient(direction: string): string {
  const stops = VIRIDIS.map(
    ([r, g, b]) => `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(" ")})`,
  );
  return `linear-gradient(${direction}, ${stops.join(", ")})`;
}

/** Where a body has no number. */
export const NO_VALUE: Rgb = [0.55, 0.57, 0.6];
