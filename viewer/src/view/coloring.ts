// Colour by a number of each body: greatest stretch, von Mises stress. Deformations are homogeneous, so that one
// colour a body is all there is to show. The range is that of the whole recording, so that colours keep their meaning.

import { classesOf } from "../data/classes";
import type { Frame } from "../data/frame";
import type { Recording } from "../data/recording";
import { mapped, NO_VALUE, type Rgb, rgb, seriesColor } from "../math/colors";
import { greatestStretch, vonMises } from "../math/mat3";

export type Coloring = "body" | "stretch" | "stress";

/** What the colour bar says. */
export interface Scale {
  title: string;
  units: string;
  low: number;
  high: number;
}

/** Bodies times samples that are looked at for a range. */
const LOOKED_AT = 60_000;

interface Measure {
  title: string;
  units: string;
  array: string;
  of: (numbers: Float32Array) => number;
}

const MEASURES: Record<Exclude<Coloring, "body">, Measure> = {
  stretch: { title: "Greatest stretch", units: "1", array: "placement_gradient", of: greatestStretch },
  stress: { title: "Von Mises stress", units: "Pa", array: "cauchy_stress", of: vonMises },
};

export class Colors {
  private scales = new Map<Coloring, { rows: number; scale: Scale }>();

  constructor(private readonly recording: Recording) {}

  /** Why a colouring is not to be had; `null` if it is. */
  absent(coloring: Coloring): string | null {
    const { bodies } = this.recording.header;
    if (coloring === "body") return null;
    if (bodies.every((body) => body.kind === "rigid")) return "Rigid bodies keep their shape.";
    if (this.recording.track(MEASURES[coloring].array)) return null;
    return coloring === "stress"
      ? "The recording has no stress."
      : "The recording has no placement gradient.";
  }

  /** The range of a colouring over the recording; `null` where colours are names. */
  scale(coloring: Coloring): Scale | null {
    if (coloring === "body" || this.absent(coloring)) return null;
    const known = this.scales.get(coloring);
    // While a run grows, a range is good until the recording is a tenth longer.
    if (known && this.recording.rows <= Math.max(1.1 * known.rows, known.rows + 5)) {
      if (this.recording.rows === known.rows || !this.recording.header.complete) return known.scale;
    }
    const scale = this.measured(MEASURES[coloring]);
    this.scales.set(coloring, { rows: this.recording.rows, scale });
    return scale;
  }

  /** The colour of each body at an instant. */
  at(coloring: Coloring, frame: Frame): (body: number) => Rgb {
    const scale = this.scale(coloring);
    if (coloring === "body" || !scale) {
      const hues = classesOf(this.recording.header).ofBody;
      return (body) => rgb(seriesColor(hues[body]));
    }
    const { low, high } = scale;
    return (body) => {
      const value = this.value(MEASURES[coloring], frame.row, body, frame);
      return Number.isFinite(value) ? mapped((value - low) / (high - low)) : NO_VALUE;
    };
  }

  private value(measure: Measure, row: number, body: number, frame: Frame | null): number {
    if (this.recording.header.bodies[body].kind === "rigid") return Number.NaN;
    if (frame && measure.array === "placement_gradient") {
      return measure.of(frame.gradient.subarray(9 * body, 9 * body + 9));
    }
    const track = this.recording.track(measure.array);
    if (!track) return Number.NaN;
    const at = row * track.stride + 9 * body;
    return measure.of(track.values.subarray(at, at + 9));
  }

  private measured(measure: Measure): Scale {
    const { rows, header } = this.recording;
    const every = Math.max(1, Math.ceil((rows * header.bodies.length) / LOOKED_AT));
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (let row = 0; row < rows; row += every) {
      for (let body = 0; body < header.bodies.length; body++) {
        const value = this.value(measure, row, body, null);
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (!(high >= low)) [low, high] = [0, 1];
    if (high - low < 1e-9 * Math.abs(high)) high = low + (Math.abs(low) || 1) * 1e-6;
    return { title: measure.title, units: measure.units, low, high };
  }
}
