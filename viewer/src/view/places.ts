// Where the ends of springs, bonds and joints are at an instant, and which way directions of a body point.

import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  type LineBasicMaterial,
  LineSegments,
} from "three";
import type { End } from "../data/ends";
import type { Frame } from "../data/frame";
import type { Vec3 } from "../data/header";
import { applied, carriage, placeOf } from "../math/carriage";
import { unit } from "../math/mat3";

/** Where an end is: p = p₀ + P X, of an image R farther, or where a support has carried its point of space. */
export function placed({ body, at, shift = [0, 0, 0], motion = null }: End, frame: Frame): Readonly<Vec3> {
  if (body === null) return motion ? placeOf(carriage(motion, frame.time), at) : at;
  const { position: p, gradient: P } = frame;
  return [0, 1, 2].map((axis) => {
    const row = 9 * body + 3 * axis;
    return shift[axis] + p[3 * body + axis] + P[row] * at[0] + P[row + 1] * at[1] + P[row + 2] * at[2];
  }) as Vec3;
}

/** The unit vector along P a, or along what a support has made of a. */
export function pointing({ body, motion = null }: End, a: Vec3, frame: Frame): Vec3 {
  if (body === null) return unit(motion ? applied(carriage(motion, frame.time).turn, a) : a, [0, 0, 1]);
  const row = (k: number) => frame.gradient.subarray(9 * body + 3 * k, 9 * body + 3 * k + 3);
  const along = [0, 1, 2].map((k) => row(k)[0] * a[0] + row(k)[1] * a[1] + row(k)[2] * a[2]);
  return unit(along as Vec3, [0, 0, 1]);
}

/** Straight lines between pairs of ends. */
export class LinkLines {
  readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly position: BufferAttribute;

  private readonly ends: End[];

  constructor(links: [End, End][], material: LineBasicMaterial) {
    this.ends = links.flat();
    this.position = new BufferAttribute(new Float32Array(6 * links.length), 3).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.position);
    this.lines = new LineSegments(geometry, material);
    this.lines.frustumCulled = false;
    this.lines.visible = links.length > 0;
  }

  get count(): number {
    return this.ends.length / 2;
  }

  place(frame: Frame): void {
    if (!this.lines.visible) return;
    this.ends.forEach((end, index) => {
      this.position.setXYZ(index, ...placed(end, frame));
    });
    this.position.needsUpdate = true;
  }

  dispose(): void {
    this.lines.geometry.dispose();
  }
}
