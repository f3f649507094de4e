// What a camera should see: the bodies over the whole run, as far as they reach, from millimetres to kilometres. Planes
// and supports do not count: they would make the bodies small.
//
//   reach(n) = max n·(p + P m) + |h Pᵀn| over bodies and samples,   m, h middle and half the sides of a body's box
//
// with the sum of absolute values as norm, or the length for what is round. The path of a body that flies off counts as
// far as the others reach.

import type { Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { type Extent, extentOf, shapesIn } from "../data/shapes";
import { straysOf } from "../data/strays";
import { dot, norm, unit } from "../math/mat3";

/** Instants looked at; a path has no room to hide between them. */
const INSTANTS = 300;
/** Paths this many times larger than the bodies are not shown whole: the bodies would be dots. */
const MOST_SIZES = 14;
/** A body that is followed has this many sizes of room around it. */
const ROOM_SIZES = 3;

/** How far what is to be seen goes along a vector n, the largest n·x [m] times the length of n. */
export type Reach = (n: Vec3) => number;

export interface Framing {
  reach: Reach;
  /** The middle of a box around it. */
  center: Vec3;
  /** Half the diagonal of the box [m]. */
  radius: number;
  /** The opposite of gravity; z without gravity. */
  up: Vec3;
  /** Whether it is looked at from below, since all supports are above. */
  fromBelow: boolean;
  /** Whether the ball goes with the bodies, since their whole path would make them dots. */
  travels: boolean;
}

/** The first framing of what has been recorded so far. */
export function framed(recording: Recording): Framing {
  const { header } = recording;
  const up = upward(recording);
  const { supports } = header;
  const fromBelow = supports.length > 0 && supports.every(({ normal }) => dot(normal, up) < -0.3);
  const size = Math.max(...header.bodies.map((body) => body.size), 1e-12);
  const whole = reachOf(recording);
  const { sides, ...around } = ball(whole);
  if (header.bodies.length > 1 || !(Math.max(...sides) > MOST_SIZES * size))
    return { reach: whole, ...around, up, fromBelow, travels: false };
  const [x, y, z] = recording.track("position")?.values ?? [0, 0, 0];
  const near: Reach = (n) => dot(n, [x, y, z]) + ROOM_SIZES * size * norm(n);
  const { center, radius } = ball(near);
  return { reach: near, center, radius, up, fromBelow, travels: true };
}

export function upward(recording: Recording): Vec3 {
  const [x, y, z] = recording.header.gravity;
  return unit([-x, -y, -z], [0, 0, 1]);
}

/** How far the bodies of a recording reach. */
function reachOf(recording: Recording): Reach {
  const { bodies } = recording.header;
  const last = recording.rows - 1;
  const positions = recording.track("position")?.values ?? new Float32Array(0);
  const gradients = recording.track("placement_gradient")?.values;
  const shapes = shapesOf(recording);
  const strays = straysOf(recording);
  const instants = Math.min(last, INSTANTS, Math.ceil(100_000 / Math.max(1, bodies.length)));
  const looked: { shape: ShapeReach; p: Vec3; P: ArrayLike<number> }[] = [];
  for (let k = 0; k <= instants; k++) {
    const row = instants > 0 ? Math.round((last * k) / instants) : 0;
    for (let body = 0; body < bodies.length; body++) {
      const at = row * bodies.length + body;
      const p = Array.from(positions.subarray(3 * at, 3 * at + 3)) as Vec3;
      const P = gradients ? gradients.slice(9 * at, 9 * at + 9) : UNTURNED;
      const away = norm(p.map((value, axis) => value - strays.middle[axis]));
      if (strays.bodies.has(body) && away > strays.radius) continue;
      if (p.length === 3 && p.every(Number.isFinite) && P.every(Number.isFinite))
        looked.push({ shape: shapes[body], p, P });
    }
  }
  return (n) => {
    let most = Number.NEGATIVE_INFINITY;
    for (const { shape, p, P } of looked) {
      const carried = [0, 1, 2].map((axis) => n[0] * P[axis] + n[1] * P[3 + axis] + n[2] * P[6 + axis]);
      most = Math.max(most, dot(n, p) + shape(carried as Vec3));
    }
    return most;
  };
}

const UNTURNED = Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);

/** How far a shape reaches along Pᵀn from its centre of mass. */
type ShapeReach = (n: Vec3) => number;

function shapesOf(recording: Recording): ShapeReach[] {
  const { header, surfaces } = recording;
  const kindOf = shapesIn(header);
  const known = new Map<number, Extent>();
  return header.bodies.map(({ name, surface, outline, size }): ShapeReach => {
    const points = (surface === null ? outline?.points.flat() : surfaces[surface]?.points) ?? [];
    if (points.length === 0) return (n) => 0.5 * size * norm(n);
    const { middle, half } = (surface !== null && known.get(surface)) || extentOf(points);
    if (surface !== null) known.set(surface, { middle, half });
    const isRound = ["sphere", "ellipsoid"].includes(kindOf(name) ?? "");
    return (n) => {
      const sides = half.map((side, axis) => Math.abs(side * n[axis]));
      return dot(n, middle) + (isRound ? norm(sides) : sides[0] + sides[1] + sides[2]);
    };
  });
}

/** The box around what reaches so far, and the ball around that. */
function ball(reach: Reach): { center: Vec3; radius: number; sides: Vec3 } {
  const along = (axis: number, sign: number) =>
    reach([0, 1, 2].map((other) => (other === axis ? sign : 0)) as Vec3);
  const high = [0, 1, 2].map((axis) => along(axis, 1));
  const low = [0, 1, 2].map((axis) => -along(axis, -1));
  const sides = high.map((value, axis) => value - low[axis]) as Vec3;
  const radius = 0.5 * norm(sides);
  if (!(radius > 0) || !Number.isFinite(radius)) return { center: [0, 0, 0], radius: 1, sides: [1, 1, 1] };
  return { center: low.map((value, axis) => 0.5 * (value + high[axis])) as Vec3, radius, sides };
}

/** Where a camera stands and what it looks at [m]. */
export interface Sight {
  position: Vec3;
  target: Vec3;
}

/** What is free of a picture at distance one from the camera: to the left and right, below and above its middle. */
export interface Window {
  across: [number, number];
  upright: [number, number];
}

/**
 * The nearest sight from a direction that has all in view: with r, a, b the unit vectors to the right, above and back,
 * l and w what is free to the left and right, x_r and D the camera's place along r and b,
 *
 *   x·r − x_r ≤ w (D − x·b)   ⇔   w D + x_r ≥ reach(w b + r) = A
 *   x_r − x·r ≤ l (D − x·b)   ⇔   l D − x_r ≥ reach(l b − r) = B
 *
 * so that (l + w) D ≥ A + B; the same for its height. What is left of the larger room lies on both sides.
 */
export function sightOf(
  { reach, center }: Pick<Framing, "reach" | "center">,
  [right, above, back]: [Vec3, Vec3, Vec3],
  { across, upright }: Window,
): Sight {
  const bound = (aside: Vec3, free: number, sign: number) =>
    reach(back.map((value, axis) => free * value + sign * aside[axis]) as Vec3);
  const sides = [
    { aside: right, free: across },
    { aside: above, free: upright },
  ].map(({ aside, free: [less, more] }) => {
    const [over, under] = [bound(aside, more, 1), bound(aside, less, -1)];
    const at = (far: number) => 0.5 * (over - more * far + less * far - under);
    return { aside, at, needs: (over + under) / (less + more) };
  });
  const distance = Math.max(...sides.map(({ needs }) => needs));
  if (!Number.isFinite(distance)) {
    return { target: center, position: center.map((value, axis) => value + 4 * back[axis]) as Vec3 };
  }
  const along = (far: number) =>
    [0, 1, 2].map(
      (axis) => far * back[axis] + sides.reduce((sum, { aside, at }) => sum + at(distance) * aside[axis], 0),
    ) as Vec3;
  return { position: along(distance), target: along(dot(center, back)) };
}
