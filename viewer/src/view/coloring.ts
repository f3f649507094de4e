// Colour by a number of each body: speed, contact force, greatest stretch, von Mises stress. Deformations are
// homogeneous, so that one colour a body is all there is to show. The range is that of the whole recording, so that
// colours keep their meaning. An impact takes a thousand weights: forces end at the value that one in a hundred exceeds.

import { classesOf } from "../data/classes";
import type { Frame } from "../data/frame";
import type { Recording } from "../data/recording";
import { mapped, NO_VALUE, type Rgb, rgb, seriesColor } from "../math/colors";
import { greatestStretch, norm, vonMises } from "../math/mat3";

export const COLORINGS = ["body", "speed", "force", "stretch", "stress"] as const;

export type Coloring = (typeof COLORINGS)[number];

/** What the colour bar says. */
export interface Scale {
  title: string;
  units: string;
  low: number;
  high: number;
}

/** Bodies times samples that are looked at for a range. */
const LOOKED_AT = 60_000;

/** The part of the forces above the range. */
const BEYOND = 0.01;

interface Measure {
  title: string;
  units: string;
  array: string;
  /** Numbers a body: nine are of bodies that deform. */
  width: 3 | 9;
  of: (numbers: Float32Array) => number;
}

const MEASURES: Record<Exclude<Coloring, "body">, Measure> = {
  speed: { title: "Speed", units: "m/s", array: "velocity", width: 3, of: norm },
  force: { title: "Contact force", units: "N", array: "contact_force", width: 3, of: norm },
  stretch: {
    title: "Greatest stretch",
    units: "1",
    array: "placement_gradient",
    width: 9,
    of: greatestStretch,
  },
  stress: { title: "Von Mises stress", units: "Pa", array: "cauchy_stress", width: 9, of: vonMises },
};

export class Colors {
  private scales = new Map<Coloring, { rows: number; scale: Scale }>();

  constructor(private readonly recording: Recording) {}

  /** Why a colouring is not to be had; `null` if it is. */
  absent(coloring: Coloring): string | null {
    const { bodies } = this.recording.header;
    if (coloring === "body") return null;
    const { array, width } = MEASURES[coloring];
    if (width === 9 && bodies.every((body) => body.kind === "rigid")) return "Rigid bodies keep their shape.";
    if (this.recording.track(array)) return null;
    return `The recording has no ${coloring === "stress" ? coloring : array.replaceAll("_", " ")}.`;
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
    const { width } = measure;
    if (width === 9 && this.recording.header.bodies[body].kind === "rigid") return Number.NaN;
    if (frame && measure.array === "placement_gradient") {
      return measure.of(frame.gradient.subarray(9 * body, 9 * body + 9));
    }
    const track = this.recording.track(measure.array);
    if (!track) return Number.NaN;
    const at = row * track.stride + width * body;
    return measure.of(track.values.subarray(at, at + width));
  }

  private measured(measure: Measure): Scale {
    const { rows, header } = this.recording;
    const every = Math.max(1, Math.ceil((rows * header.bodies.length) / LOOKED_AT));
    const values: number[] = [];
    for (let row = 0; row < rows; row += every) {
      for (let body = 0; body < header.bodies.length; body++)
        values.push(this.value(measure, row, body, null));
    }
    const known = Float64Array.from(values.filter(Number.isFinite)).sort();
    const beyond = measure === MEASURES.force ? BEYOND : 0;
    let [low, high] = [known[0], known[Math.ceil((1 - beyond) * known.length) - 1]];
    if (!(high >= low)) [low, high] = [0, 1];
    if (high - low < 1e-9 * Math.abs(high)) high = low + (Math.abs(low) || 1) * 1e-6;
    return { title: measure.title, units: measure.units, low, high };
  }
}
