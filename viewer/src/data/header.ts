// What the program tells of a recording before its numbers: the header of protocol 1.
//
// The page knows recordings only: named arrays with units, and attributes. Unknown attributes are kept and ignored.

/** Numbers of three components. */
export type Vec3 = [number, number, number];

/** A named array that grows by one row of `stride` numbers a sample. */
export interface ArraySpec {
  name: string;
  units: string;
  description: string;
  /** Dimensions of a row, without time: `[["body", 2], ["row", 3]]`. */
  dims: [string, number][];
  stride: number;
}

export interface Outline {
  points: Vec3[];
  polylines: number[][];
}

export interface Body {
  name: string;
  kind: "rigid" | "affine" | "contractile";
  mass: number;
  center: Vec3;
  /** J = ∫ρ X⊗X dV about the centre of mass [kg m²], nine numbers. */
  euler_tensor: number[];
  /** Largest extent along the axes of the body [m]. */
  size: number;
  outline?: Outline;
  surface: number | null;
  volume?: number;
}

export interface Oscillation {
  direction: Vec3;
  amplitude: number;
  frequency: number;
  phase: number;
}

export interface Rotation {
  axis: Vec3;
  point: Vec3;
  rate: number;
}

export type MotionPart = { velocity: Vec3 } | { oscillate: Oscillation } | { rotate: Rotation };

/** Nothing, a motion, or several that add up. */
export type Motion = null | MotionPart | MotionPart[];

export interface Support {
  name: string;
  origin: Vec3;
  normal: Vec3;
  motion: Motion;
}

/** A support with a shape, before any motion. */
export interface SolidSupport {
  name: string;
  surface: number | null;
  position: Vec3;
  /** The rows of its rotation. */
  gradient: number[];
  motion: Motion;
}

/** How a run ended, as the recording tells it. */
export type Outcome = "completed" | { at_rest: { time: number } } | { stopped: Stop };

export interface Stop {
  time: number;
  reason: string;
  body: string | null;
  what: string;
  advice: string;
}

/** What a finished recording holds besides: counters, residual, events. */
export interface Summary {
  outcome_in_words?: string;
  statistics?: Record<string, number>;
  /** Whether the energy balance closes. */
  ledger?: "closed" | "open";
  largest_residual?: number;
  energy_in_play?: number;
  least_dissipation?: Record<string, number>;
  events?: Record<string, number>;
  /** What the run leaves out, or cannot mean. */
  warnings?: string[];
  [other: string]: unknown;
}

export type Mode = "report" | "recording" | "live";

export interface Header {
  protocol: number;
  mode: Mode;
  run: number;
  version?: string;
  commit?: string | null;
  title?: string | null;
  scene_name?: string;
  scene?: string;
  overrides?: string[];
  resolved?: Json;
  gravity: Vec3;
  tolerances?: { rtol: number; atol: number };
  bodies: Body[];
  supports: Support[];
  solid_supports?: SolidSupport[] | null;
  surfaces: { points: number; triangles: number }[];
  arrays: ArraySpec[];
  /** CSV name, array, place in its row. */
  columns: [string, string, number][];
  event_kinds: string[];
  rows: number;
  /** Whether the source tells the forces between bodies. */
  network?: boolean;
  end: number;
  complete: boolean;
  outcome: Outcome | null;
  summary?: Summary;
  thinned: null | { kept: number; of: number };
  notes: string[];
}

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

/** The protocol that this page speaks. */
export const PROTOCOL = 1;

/** The header as given by the program, or an error in words. */
export function checkedHeader(value: unknown): Header {
  const header = value as Header;
  if (typeof header !== "object" || header === null || typeof header.protocol !== "number") {
    throw new Error("What came is not the header of a recording.");
  }
  if (header.protocol !== PROTOCOL) {
    throw new Error(
      `The program speaks protocol ${header.protocol}, this page ${PROTOCOL}: they are of different versions.`,
    );
  }
  return header;
}
