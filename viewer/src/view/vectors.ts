// What acts and how bodies move: contact forces, velocities, principal axes of strain.
//
// The force of supports stands where the body is lowest, that of other bodies where it is pushed from. In an impact it is a thousand times the weight, at rest once, so that
// its arrow is asinh(f/mg) half sizes long: proportional below the weight, logarithmic above. Without gravity the
// unit is the largest force of the recording. A velocity is proportional, the fastest a third of the scene.

import { Group, Vector3 } from "three";
import type { Frame } from "../data/frame";
import type { Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { dot, leftCauchyGreen, norm, symmetricAxes, unit } from "../math/mat3";
import { Arrows, overlay } from "./arrows";
import { planeAt } from "./supports";

const FORCE = "#d2553f";
const VELOCITY = "#3f8f6b";
const EXTENDED = "#d98a1f";
const SHORTENED = "#3f74c9";

/** Forces below this fraction of the unit are not drawn. */
const LEAST_FORCE = 1e-3;
/** Points of a surface this close to the lowest one, in sizes, count as lowest too. */
const LOWEST_BAND = 0.02;
/** Radius of a shaft in sizes of the body. */
const SHAFT = 0.02;

export class VectorLayer {
  readonly group = new Group();
  private readonly force: Arrows;
  private readonly velocity: Arrows;
  private readonly extension: Arrows;
  private readonly shortening: Arrows;
  private readonly units: number[];
  /** Metres of arrow for one metre a second. */
  private perSpeed = 1;
  shown = { forces: false, velocity: false, axes: false };

  constructor(private readonly recording: Recording) {
    const bodies = recording.header.bodies;
    const count = bodies.length;
    this.force = new Arrows(2 * count, overlay(FORCE));
    this.velocity = new Arrows(count, overlay(VELOCITY));
    this.extension = new Arrows(6 * count, overlay(EXTENDED));
    this.shortening = new Arrows(6 * count, overlay(SHORTENED));
    for (const arrows of this.all()) this.group.add(arrows.group);
    const gravity = norm(recording.header.gravity);
    const largest = gravity > 0 ? 0 : largestOf(recording, "contact_force");
    this.units = bodies.map((body) => (gravity > 0 ? body.mass * gravity : largest));
  }

  /** The scene's radius [m], to which velocities are fitted. */
  fit(radius: number): void {
    const fastest = largestOf(this.recording, "velocity");
    this.perSpeed = fastest > 0 ? (0.35 * radius) / fastest : 1;
  }

  place(frame: Frame): void {
    for (const arrows of this.all()) arrows.clear();
    for (let body = 0; body < this.recording.header.bodies.length; body++) {
      if (this.shown.forces) this.addForces(frame, body);
      if (this.shown.velocity) this.addVelocity(frame, body);
      if (this.shown.axes) this.addAxes(frame, body);
    }
    for (const arrows of this.all()) arrows.finish();
  }

  dispose(): void {
    for (const arrows of this.all()) arrows.dispose();
  }

  private all(): Arrows[] {
    return [this.force, this.velocity, this.extension, this.shortening];
  }

  private addForces(frame: Frame, body: number): void {
    const whole = rowOf(this.recording, "contact_force", frame.row, body);
    if (!whole) return;
    const ofBodies = rowOf(this.recording, "pair_force", frame.row, body);
    if (ofBodies) {
      this.addForce(body, ofBodies, () => pushedPoint(this.recording, frame, body, ofBodies));
      const ofSupports = whole.map((value, axis) => value - ofBodies[axis]) as Vec3;
      // What is left of a difference of equal numbers is rounding.
      if (norm(ofSupports) > 1e-6 * norm(ofBodies)) {
        this.addForce(body, ofSupports, () => lowestPoint(this.recording, frame, body));
      }
    } else if (this.recording.header.supports.length > 0) {
      this.addForce(body, whole, () => lowestPoint(this.recording, frame, body));
    } else {
      this.addForce(body, whole, () => pushedPoint(this.recording, frame, body, whole));
    }
  }

  private addForce(body: number, force: Vec3, at: () => Vec3): void {
    const unit = this.units[body];
    if (!(unit > 0)) return;
    const weights = norm(force) / unit;
    if (!(weights > LEAST_FORCE)) return;
    const { size } = this.recording.header.bodies[body];
    const along = new Vector3(...force).setLength(0.5 * size * Math.asinh(weights));
    this.force.add(at(), along, SHAFT * size);
  }

  private addVelocity(frame: Frame, body: number): void {
    const velocity = rowOf(this.recording, "velocity", frame.row, body);
    if (!velocity || !(norm(velocity) > 0)) return;
    const { size } = this.recording.header.bodies[body];
    const along = new Vector3(...velocity).multiplyScalar(this.perSpeed);
    this.velocity.add(frame.position.subarray(3 * body, 3 * body + 3), along, SHAFT * size);
  }

  private addAxes(frame: Frame, body: number): void {
    const { kind, size } = this.recording.header.bodies[body];
    if (kind === "rigid") return;
    const strain = leftCauchyGreen(frame.gradient.subarray(9 * body, 9 * body + 9));
    const { values, vectors } = symmetricAxes(strain);
    const from = frame.position.subarray(3 * body, 3 * body + 3);
    for (let k = 0; k < 3; k++) {
      const stretch = Math.sqrt(Math.max(0, values[k]));
      const arrows = stretch >= 1 ? this.extension : this.shortening;
      for (const sign of [1, -1]) {
        arrows.add(
          from,
          new Vector3(...vectors[k]).multiplyScalar(0.6 * sign * size * stretch),
          0.8 * SHAFT * size,
        );
      }
    }
  }
}

function rowOf(recording: Recording, name: string, row: number, body: number): Vec3 | null {
  const track = recording.track(name);
  if (!track) return null;
  const at = row * track.stride + 3 * body;
  return [track.values[at], track.values[at + 1], track.values[at + 2]];
}

/** The largest length of a vector over bodies and samples; of long recordings a sample is enough. */
function largestOf(recording: Recording, name: string): number {
  const track = recording.track(name);
  if (!track) return 0;
  const vectors = (recording.rows * track.stride) / 3;
  const every = Math.max(1, Math.floor(vectors / 200_000));
  let largest = 0;
  for (let k = 0; k < vectors; k += every) {
    const length = norm(track.values.subarray(3 * k, 3 * k + 3));
    if (length > largest) largest = length;
  }
  return largest;
}

/** Where the body is nearest to a support: the middle of its lowest points; its centre if there is no support. */
function lowestPoint(recording: Recording, frame: Frame, body: number): Vec3 {
  const { header } = recording;
  const [x, y, z] = frame.position.subarray(3 * body, 3 * body + 3);
  const points = pointsOf(recording, body);
  const P = frame.gradient.subarray(9 * body, 9 * body + 9);
  let best: { gap: number; at: Vec3 } | null = null;
  for (const support of header.supports) {
    const { origin, normal: n } = planeAt(support, frame.time);
    const m: Vec3 = [0, 1, 2].map((k) => n[0] * P[k] + n[1] * P[3 + k] + n[2] * P[6 + k]) as Vec3;
    const [height, lowest] = lowestReference(points, m, LOWEST_BAND * header.bodies[body].size);
    const away: Vec3 = [x, y, z].map((value, k) => value - origin[k]) as Vec3;
    const gap = dot(away, n) + height;
    if (best && gap >= best.gap) continue;
    const [X, Y, Z] = lowest;
    const at = [0, 3, 6].map((row, k) => [x, y, z][k] + P[row] * X + P[row + 1] * Y + P[row + 2] * Z) as Vec3;
    best = { gap, at };
  }
  return best?.at ?? [x, y, z];
}

/** Where a force pushes a body from: the middle of the points that lie farthest against it. */
function pushedPoint(recording: Recording, frame: Frame, body: number, force: Vec3): Vec3 {
  const P = frame.gradient.subarray(9 * body, 9 * body + 9);
  const n = unit(force, [0, 0, 1]);
  const m = [0, 1, 2].map((k) => n[0] * P[k] + n[1] * P[3 + k] + n[2] * P[6 + k]) as Vec3;
  const { size } = recording.header.bodies[body];
  const [, [X, Y, Z]] = lowestReference(pointsOf(recording, body), m, LOWEST_BAND * size);
  const p = frame.position.subarray(3 * body, 3 * body + 3);
  return [0, 3, 6].map((row, k) => p[k] + P[row] * X + P[row + 1] * Y + P[row + 2] * Z) as Vec3;
}

/** The least m·X over points X, and the mean of the points within a band above it. */
function lowestReference(points: ArrayLike<number>, m: Vec3, band: number): [number, Vec3] {
  let least = Number.POSITIVE_INFINITY;
  for (let k = 0; k < points.length; k += 3) {
    least = Math.min(least, m[0] * points[k] + m[1] * points[k + 1] + m[2] * points[k + 2]);
  }
  const mean: Vec3 = [0, 0, 0];
  let count = 0;
  for (let k = 0; k < points.length; k += 3) {
    if (m[0] * points[k] + m[1] * points[k + 1] + m[2] * points[k + 2] > least + band) continue;
    count++;
    for (let axis = 0; axis < 3; axis++) mean[axis] += (points[k + axis] - mean[axis]) / count;
  }
  return [count > 0 ? least : 0, mean];
}

function pointsOf(recording: Recording, body: number): ArrayLike<number> {
  const { surface, outline } = recording.header.bodies[body];
  const shape = surface === null ? undefined : recording.surfaces[surface];
  return shape?.points ?? outline?.points.flat() ?? [];
}
