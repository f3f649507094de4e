// Fields of many bodies at the samples of a recording, where a source can tell them: maps over a layer through the
// bodies, each a few scalars on a grid.

import { unpacked } from "./feed";
import type { Vec3 } from "./header";

/** The fields there are, by the keys by which the server tells them, and what each is called. */
export const FIELD_NAMES = {
  density: "density",
  speed: "speed",
  pressure: "pressure",
  shear: "shear stress",
  power: "power of pairs",
} as const;

const FIELDS = Object.keys(FIELD_NAMES);

export interface FieldName {
  key: string;
  name: string;
  units: string;
}

interface MapHead {
  /** Of the sample [s]. */
  time: number;
  /** The width with which bodies are seen, and the one that is taken where none is asked for [m]. */
  width: number;
  usual: number;
  /** Points along both sides. */
  counts: [number, number];
  /** The first point, and the ways from it to the last along each side [m]. */
  origin: Vec3;
  across: Vec3;
  up: Vec3;
  fields: FieldName[];
}

export interface FieldMap extends MapHead {
  /** The numbers of each field, across fastest; NaN where there is none. */
  values: Float32Array[];
}

/** The units of a field as they are written. */
export function unitsOf({ units }: FieldName): string {
  return units.replace("^3", "\u00b3");
}

/** A map as the server sends it. */
export function mapIn(message: ArrayBuffer): FieldMap {
  const { announced, payload } = unpacked<MapHead>(message);
  const size = announced.counts[0] * announced.counts[1];
  const values = announced.fields.map((_, k) => new Float32Array(payload, 4 * k * size, size));
  return { ...announced, values };
}

/** The smallest and the largest number of some; `null` where all are zero or none. */
export function rangeOf(values: Float32Array): [number, number] | null {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low < 0 || high > 0 ? [low, high] : null;
}

/** Numbers that are kept of what can be asked for again: 80 MB. */
const MOST_KEPT = 20_000_000;

/** Brings the map of a sample, with a width [m] or the usual one, unless it is given up. */
type LoadMap = (row: number, width: number | null, signal: AbortSignal) => Promise<FieldMap>;

/** What of the fields is looked at, and the maps that are known. */
export class Fields {
  /** Whether they are shown, and whether that was ever chosen. */
  shown = false;
  touched = false;
  /** Which of them. */
  key = "density";
  /** Called when something else is to be shown, or told. */
  readonly changed = new Set<() => void>();
  /** Why there are none. */
  problem: string | null = null;
  /** The width asked for [m]; the usual one with `null`. */
  private asked: number | null = null;
  private readonly maps = new Map<number, FieldMap>();
  private readonly ranges = new Map<string, [number, number]>();
  private kept = 0;
  private wanted: number | null = null;
  /** The map that is on its way, until nobody wants it any longer. */
  private loading: AbortController | null = null;

  constructor(private readonly load: LoadMap) {}

  get width(): number | null {
    return this.asked;
  }

  /** Another width: what is known is of the one before. */
  set width(width: number | null) {
    if (width === this.asked) return;
    this.asked = width;
    this.again();
  }

  /** Shows a field of its name with a width, or none. */
  look(field: string | null, width: number | null): void {
    this.shown = field !== null && FIELDS.includes(field);
    if (this.shown && field !== null) {
      this.touched = true;
      this.key = field;
      this.width = width;
    } else {
      this.wanted = null;
      this.loading?.abort();
    }
    this.tell();
  }

  /** Forgets what is known, and asks anew. */
  again(): void {
    this.maps.clear();
    this.ranges.clear();
    this.kept = 0;
    this.problem = null;
    this.loading?.abort();
    this.tell();
  }

  tell(): void {
    for (const told of this.changed) told();
  }

  /** The map of a sample; `null` where it is not there (yet). */
  at(row: number): FieldMap | null {
    const known = this.maps.get(row) ?? null;
    this.wanted = known || this.problem !== null ? null : row;
    if (this.wanted !== null) void this.fetch();
    return known;
  }

  /** The map of a sample, if it is there; nothing is asked for. */
  known(row: number): FieldMap | null {
    return this.maps.get(row) ?? null;
  }

  /** Whether a map is on its way. */
  get isLoading(): boolean {
    return this.loading !== null;
  }

  /** The smallest and the largest number of a field in all maps that are known; `null` where all are zero. */
  range(key: string): [number, number] | null {
    return this.ranges.get(key) ?? null;
  }

  /** Asks for what is wanted, one map after the other: while it is played or dragged, only the last wish counts. */
  private async fetch(): Promise<void> {
    if (this.loading) return;
    while (this.wanted !== null) {
      const row = this.wanted;
      this.loading = new AbortController();
      const { signal } = this.loading;
      try {
        const map = await this.load(row, this.asked, signal);
        // What was given up is of another width.
        if (!signal.aborted) this.put(row, map);
      } catch (error) {
        if (!signal.aborted) this.problem = error instanceof Error ? error.message : String(error);
      }
      if (!signal.aborted && (this.wanted === row || this.problem !== null)) this.wanted = null;
      // Before the last is told: whoever draws it may want another.
      const isLast = this.wanted === null;
      if (isLast) this.loading = null;
      this.tell();
      if (isLast) return;
    }
  }

  private put(row: number, map: FieldMap): void {
    const size = map.values.length * map.counts[0] * map.counts[1];
    if (this.kept + size > MOST_KEPT) {
      this.maps.clear();
      this.kept = 0;
    }
    this.kept += size;
    this.maps.set(row, map);
    map.fields.forEach(({ key }, k) => {
      const found = rangeOf(map.values[k]);
      const known = this.ranges.get(key) ?? found;
      if (found && known) this.ranges.set(key, [Math.min(known[0], found[0]), Math.max(known[1], found[1])]);
    });
  }
}
