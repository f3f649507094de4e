// Numbers as people read them: three or four digits, prefixes of units, round steps.

const PREFIXES: [number, string][] = [
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
  [1e-9, "n"],
  [1e-12, "p"],
];

/** Below the last prefix a power of ten reads better. */
const LEAST = 1e-12;

/** Units that take a prefix; others stand as they are. */
const PREFIXED = new Set(["m", "s", "Pa", "J", "N", "W", "g"]);

/** Digits after which a number is cut, without a tail of zeros; an exponent only where that is shorter. */
export function plain(value: number, digits = 4): string {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return minus(exponential(value, digits));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = value.toFixed(Math.min(decimals, 20));
  return minus(text.includes(".") ? text.replace(/\.?0+$/, "") : text);
}

function exponential(value: number, digits: number): string {
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const short = mantissa.includes(".") ? mantissa.replace(/\.?0+$/, "") : mantissa;
  return `${short}e${power.replace("+", "")}`;
}

/** A real minus sign instead of a hyphen. */
function minus(text: string): string {
  return text.replaceAll("-", "−");
}

/** A number with its unit, with a prefix where the unit takes one: `3.2 mm`. */
export function withUnit(value: number, unit: string, digits = 4): string {
  if (unit === "1" || unit === "") return plain(value, digits);
  const bare = !PREFIXED.has(unit) || !(Math.abs(value) >= LEAST) || !Number.isFinite(value);
  if (bare) return `${plain(value, digits)} ${unit}`;
  const [factor, prefix] = prefixFor(value);
  return `${plain(value / factor, digits)} ${prefix}${unit}`;
}

/** The prefix under which a number reads best, and its factor. */
export function prefixFor(value: number): [number, string] {
  const size = Math.abs(value) * (1 + 1e-12);
  return PREFIXES.find(([factor]) => size >= factor) ?? PREFIXES[PREFIXES.length - 1];
}

/** The prefix for an axis that reaches up to `most` of some unit; none where the unit takes none. */
export function scaleFor(most: number, unit: string): [number, string] {
  if (!PREFIXED.has(unit) || !(most >= LEAST) || !Number.isFinite(most)) return [1, unit];
  const [factor, prefix] = prefixFor(most);
  return [factor, prefix + unit];
}

/** The largest of 1, 2, 5 × 10^k that is not above a positive number. */
export function roundBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-12);
  const lead = value / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

/** A time for the clock: as many decimals as the spacing of the samples needs. */
export function clock(time: number, spacing: number): string {
  const decimals = spacing > 0 ? Math.min(9, Math.max(0, Math.ceil(-Math.log10(spacing) - 1e-9))) : 3;
  return minus(time.toFixed(decimals));
}

/** `energy_kinetic` → `kinetic`, `closest_approach` → `closest approach`. */
export function words(name: string): string {
  return name.replaceAll("_", " ");
}

/** A number of things: `1 body`, `2 bodies`. */
export function counted(count: number, noun: string): string {
  return `${plain(count, 12)} ${count === 1 ? noun : plural(noun)}`;
}

function plural(noun: string): string {
  if (/[^aeiou]y$/.test(noun)) return `${noun.slice(0, -1)}ies`;
  return /(s|x|ch|sh)$/.test(noun) ? `${noun}es` : `${noun}s`;
}
