// Where springs, bonds and joints hold: material points of bodies, points that supports carry, points of space.

import { unit } from "../math/mat3";
import type { Header, Json, Motion, MotionPart, SolidSupport, Support, Vec3 } from "./header";
import { list, table, vector } from "./json";
import { Cells } from "./lattice";

/** A material point of a body, from its centre of mass, or a point of space. */
export interface End {
  body: number | null;
  at: Vec3;
  /** How far the image of the body is that is meant, beyond the end of a periodic lattice [m]. */
  shift?: Vec3;
  /** How a point of space is carried along. */
  motion?: Motion;
}

/** Finds what the entries of a resolved scene name. */
export class Ends {
  readonly cells: Cells;
  private readonly bodies: Map<string, number>;
  private readonly solids: Map<string, SolidSupport>;
  private readonly planes: Map<string, Support>;

  constructor(header: Header) {
    const { bodies, supports, solid_supports } = header;
    this.cells = new Cells(header);
    this.bodies = new Map(bodies.map(({ name }, index) => [name, index]));
    this.solids = new Map((solid_supports ?? []).map((support) => [support.name, support]));
    this.planes = new Map(supports.map((support) => [support.name, support]));
  }

  /** The place of a body, or of its copy in a cell. */
  bodyIn(name: Json | undefined, cell: number): number | undefined {
    return this.bodies.get(this.cells.nameIn(String(name), cell));
  }

  /** Both ends of an entry with `between`, `cell` and `points` as it is in a cell; `null` where one is not there. */
  between(entry: Json, number: number): [End, End] | null {
    const { between, cell, points } = table(entry);
    const other = this.cells.beside(this.cells.at(number), list(cell).map(Number));
    if (!other) return null;
    const [here, there] = [0, 1].map((end) => vector(list(points)[end]));
    const one = this.endAt(list(between)[0], here, number);
    const two = this.endAt(list(between)[1], there, other.number);
    if (!one || !two) return null;
    const isImage = other.shift.some((part) => part !== 0);
    return [one, isImage ? { ...two, shift: other.shift } : two];
  }

  /** A point of what is named; of a plane and of space a place. */
  private endAt(name: Json | undefined, at: Vec3, cell: number): End | null {
    const body = this.bodyIn(name, cell);
    if (body !== undefined) return { body, at };
    if (name === "space") return { body: null, at };
    const plane = this.planes.get(String(name));
    if (plane) return { body: null, at, motion: plane.motion };
    const solid = this.solids.get(String(name));
    if (!solid) return null;
    const { position, gradient, motion } = solid;
    const turned = position.map(
      (part, k) => part + gradient[3 * k] * at[0] + gradient[3 * k + 1] * at[1] + gradient[3 * k + 2] * at[2],
    );
    return { body: null, at: turned as Vec3, motion };
  }

  /** The rows of the rotation that a support with a shape has before any motion; `null` of all else. */
  turnOf(name: Json | undefined): number[] | null {
    return this.solids.get(String(name))?.gradient ?? null;
  }
}

/** A motion as a scene writes it: directions may have any length. */
export function writtenMotion(written: Json | undefined): Motion {
  if (Array.isArray(written)) return written.map((part) => partOf(part));
  return written === undefined || written === null ? null : partOf(written);
}

function partOf(written: Json): MotionPart {
  const { velocity, oscillate, rotate } = table(written);
  if (velocity !== undefined) return { velocity: vector(velocity) };
  if (oscillate !== undefined) {
    const { direction, amplitude, frequency, phase } = table(oscillate);
    return {
      oscillate: {
        direction: unit(vector(direction), [0, 0, 0]),
        amplitude: Number(amplitude ?? 0),
        frequency: Number(frequency ?? 0),
        phase: Number(phase ?? 0),
      },
    };
  }
  const { axis, point, rate } = table(rotate);
  return { rotate: { axis: unit(vector(axis), [0, 0, 1]), point: vector(point), rate: Number(rate ?? 0) } };
}
