// Springs as zigzags between the points that they join, bonds as straight lines.

import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
} from "three";
import type { Frame } from "../data/frame";
import type { Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { bondsOf, type Spring, springsOf } from "../data/springs";
import { norm } from "../math/mat3";
import { LinkLines, placed } from "./places";

/** Teeth of a spring. */
const TEETH = 9;
/** The part of a spring at each end that is straight. */
const STRAIGHT = 0.12;
/** Half the width of a spring, in its length without force or in half a size of its body, if that is more. */
const WIDTH = 0.09;

export class SpringLayer {
  readonly group = new Group();
  private readonly material = new LineBasicMaterial();
  private readonly lines = new LineSegments(new BufferGeometry(), this.material);
  private readonly bonds: LinkLines;
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
    this.bonds = new LinkLines(bondsOf(recording.header), this.material);
    this.group.add(this.lines, this.bonds.lines);
  }

  /** Springs and bonds. */
  get count(): number {
    return this.springs.length + this.bonds.count;
  }

  paint(color: string): void {
    this.material.color.set(color);
  }

  place(frame: Frame): void {
    if (!this.group.visible) return;
    this.bonds.place(frame);
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
    this.bonds.dispose();
    this.material.dispose();
  }
}

/** The corners of a zigzag of a half width, both ends among them. */
export function zigzag(from: Readonly<Vec3>, to: Readonly<Vec3>, width: number): Readonly<Vec3>[] {
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

function difference(a: Readonly<Vec3>, b: Readonly<Vec3>): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}
