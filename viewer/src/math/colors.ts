// Colours: those of bodies and series, and a map from numbers that is perceptually uniform and told apart by the colour-blind.

/** The palette of Okabe and Ito without its yellow and its black: that of plots on paper. */
export const SERIES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6239"];
/** Of further rounds through the palette: the part of the colour in white or in black. */
const ROUNDS = [
  { share: 1, rest: 0 },
  { share: 0.55, rest: 255 },
  { share: 0.6, rest: 0 },
];

/** Below zero, zero, above zero: as on paper. */
export const TWO_SIDED = ["#003c6e", "#56a0d4", "#f7f7f7", "#ee934f", "#8a3500"].map(rgb);

/** Viridis by every ninth of its range; straight lines between them stay close enough to be uniform to the eye. */
export const VIRIDIS = [
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

/** Of series in a plot, and of classes of bodies. */
export function seriesColor(index: number): string {
  const { share, rest } = ROUNDS[Math.floor(index / SERIES.length) % ROUNDS.length];
  const parts = rgb(SERIES[index % SERIES.length]).map((part) =>
    Math.round(share * 255 * part + (1 - share) * rest),
  );
  return `#${parts.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
}

/** Red, green, blue from 0 to 1, as on the screen (sRGB). */
export type Rgb = [number, number, number];

export function rgb(hex: string): Rgb {
  const number = Number.parseInt(hex.slice(1), 16);
  return [((number >> 16) & 255) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
}

/** The colour of a number from 0 to 1; beyond, the end's. */
export function mapped(value: number): Rgb {
  return between(VIRIDIS, value);
}

/** The same on straight lines between colours at equal distances. */
export function between(colors: Rgb[], value: number): Rgb {
  const place = Math.min(1, Math.max(0, value)) * (colors.length - 1);
  const low = Math.min(colors.length - 2, Math.floor(place));
  const part = place - low;
  const [a, b] = [colors[low], colors[low + 1]];
  return [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])];
}

/** The map as a CSS gradient, or another one. */
export function mapGradient(direction: string, colors = VIRIDIS): string {
  const stops = colors.map(
    ([r, g, b]) => `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(" ")})`,
  );
  return `linear-gradient(${direction}, ${stops.join(", ")})`;
}

/** Where a body has no number. */
export const NO_VALUE: Rgb = [0.55, 0.57, 0.6];
