// How supports are carried along: translations add up, rotations follow one another, x = R x₀ + b.

import type { Motion, MotionPart, Vec3 } from "../data/header";

/** Where points of a support have come to: the rows of R, and b [m]. */
export interface Carriage {
  turn: [Vec3, Vec3, Vec3];
  shift: Vec3;
}

/** The parts of a motion; none of a support at rest. */
export function partsOf(motion: Motion): MotionPart[] {
  if (!motion) return [];
  return Array.isArray(motion) ? motion : [motion];
}

/** How a support is carried until a time [s]. */
export function carriage(motion: Motion, time: number): Carriage {
  let turn: Carriage["turn"] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  let shift: Vec3 = [0, 0, 0];
  let displacement: Vec3 = [0, 0, 0];
  for (const part of partsOf(motion)) {
    if ("velocity" in part) {
      displacement = plus(displacement, scaled(part.velocity, time));
    } else if ("oscillate" in part) {
      const { direction, amplitude, frequency, phase } = part.oscillate;
      displacement = plus(
        displacement,
        scaled(direction, amplitude * Math.sin(2 * Math.PI * frequency * time + phase)),
      );
    } else {
      const { axis, point, rate } = part.rotate;
      const by = rotation(axis, rate * time);
      shift = plus(point, applied(by, plus(shift, scaled(point, -1))));
      const columns = [0, 1, 2].map((k) => applied(by, turn.map((row) => row[k]) as Vec3));
      turn = [0, 1, 2].map((row) => columns.map((column) => column[row])) as Carriage["turn"];
    }
  }
  return { turn, shift: plus(shift, displacement) };
}

/** R v. */
export function applied(turn: Carriage["turn"], v: Vec3): Vec3 {
  return turn.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) as Vec3;
}

/** Where a point has come to [m]. */
export function placeOf({ turn, shift }: Carriage, point: Vec3): Vec3 {
  return plus(applied(turn, point), shift);
}

/** The rows of a rotation about a unit axis, of Rodrigues. */
function rotation([x, y, z]: Vec3, angle: number): Carriage["turn"] {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const rest = 1 - cos;
  return [
    [cos + x * x * rest, x * y * rest - z * sin, x * z * rest + y * sin],
    [y * x * rest + z * sin, cos + y * y * rest, y * z * rest - x * sin],
    [z * x * rest - y * sin, z * y * rest + x * sin, cos + z * z * rest],
  ];
}

function plus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

function scaled(v: Vec3, factor: number): Vec3 {
  return [factor * v[0], factor * v[1], factor * v[2]];
}
