// Springs as zigzags between the points that they join.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineBasicMaterial, LineSegments } from "three";
import type { Frame } from "../data/frame";
import type { Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { type Spring, type SpringEnd, springsOf } from "../data/springs";
import { norm } from "../math/mat3";

const COLOR = "#5f6773";
/** Teeth of a spring. */
const TEETH = 9;
/** The part of a spring at each end that is straight. */
const STRAIGHT = 0.12;
/** Half the width of a spring, in its length without force or in half a size of its body, if that is more. */
const WIDTH = 0.09;

export class SpringLayer {
  readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: COLOR }));
  private readonly springs: Spring[];
  private readonly position: BufferAttribute;
  /** Half the width of each [m]. */
  private readonly widths: number[];

  constructor(recording: Recording) {
    this.springs = springsOf(recording.header);
    const size = (body: number | null) => (body === null ? 0 : recording.header.bodies[body].size);
    this.widths = this.springs.map(({ ends, rest }) => WIDTH * Math.max(rest, 0.5 * size(ends[0].body)));
    const points = TEETH + 3;
    const count = this.springs.length * points;
    this.position = new BufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    const index = this.springs.flatMap((_, spring) =>
      Array.from({ length: points - 1 }, (_, k) => [spring * points + k, spring * points + k + 1]).flat(),
    );
    this.lines.geometry.setAttribute("position", this.position);
    this.lines.geometry.setIndex(index);
    this.lines.frustumCulled = false;
    this.lines.visible = count > 0;
  }

  place(frame: Frame): void {
    if (!this.lines.visible) return;
    this.springs.forEach(({ ends }, spring) => {
      const [from, to] = ends.map((end) => placed(end, frame));
      zigzag(from, to, this.widths[spring]).forEach(([x, y, z], k) => {
        this.position.setXYZ(spring * (TEETH + 3) + k, x, y, z);
      });
    });
    this.position.needsUpdate = true;
  }

  dispose(): void {
    this.lines.geometry.dispose();
    (this.lines.material as LineBasicMaterial).dispose();
  }
}

/** Where an end is: p = p₀ + P X, of an image R farther, or the point of space. */
export function placed(
  { body, at, shift = [0, 0, 0] }: SpringEnd,
  { position: p, gradient: P }: Frame,
): Vec3 {
  if (body === null) return at;
  return [0, 1, 2].map((axis) => {
    const row = 9 * body + 3 * axis;
    return shift[axis] + p[3 * body + axis] + P[row] * at[0] + P[row + 1] * at[1] + P[row + 2] * at[2];
  }) as Vec3;
}

/** The corners of a zigzag of a half width, both ends among them. */
export function zigzag(from: Vec3, to: Vec3, width: number): Vec3[] {
  const along = difference(to, from);
  const across = perpendicular(along);
  const point = (part: number, side: number) =>
    from.map((value, axis) => value + part * along[axis] + side * width * across[axis]) as Vec3;
  const teeth = Array.from({ length: TEETH + 1 }, (_, k) => {
    const side = k === 0 || k === TEETH ? 0 : k % 2 === 0 ? -1 : 1;
    return point(STRAIGHT + ((1 - 2 * STRAIGHT) * k) / TEETH, side);
  });
  return [from, ...teeth, to];
}

/** A unit vector across a vector; it turns with it as long as it does not pass the axis that is farthest from it. */
function perpendicular(along: Vec3): Vec3 {
  const length = norm(along);
  if (!(length > 0)) return [1, 0, 0];
  const sizes = along.map(Math.abs);
  const axis = sizes.indexOf(Math.min(...sizes));
  const [x, y, z] = along;
  const across = [
    [0, z, -y],
    [-z, 0, x],
    [y, -x, 0],
  ][axis] as Vec3;
  const size = norm(across);
  return across.map((value) => value / size) as Vec3;
}

function difference(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}
