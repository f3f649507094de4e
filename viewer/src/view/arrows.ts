// Arrows in crowds: shafts and heads as copies of two meshes, drawn over everything, since what they show begins at or
// inside of a body.

import {
  type BufferGeometry,
  ConeGeometry,
  CylinderGeometry,
  Group,
  type InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  Vector3,
} from "three";
import { instancesOf, matricesOf, moved } from "./instances";

const UP = new Vector3(0, 1, 0);

/** Length of a head, and of its base, in radii of the shaft. */
const HEAD_LENGTH = 7;
const HEAD_RADIUS = 2.6;

/** Arrows of which there are more are drawn with fewer corners. */
const CROWD = 100;

export class Arrows {
  readonly group = new Group();
  private readonly shafts: InstancedMesh;
  private readonly heads: InstancedMesh;
  private used = 0;
  private readonly scratch = { matrix: new Matrix4(), turn: new Quaternion(), to: new Vector3() };

  constructor(
    readonly most: number,
    readonly material: MeshBasicMaterial,
  ) {
    const sides = most > CROWD ? 4 : 12;
    this.shafts = instancesOf(lifted(new CylinderGeometry(1, 1, 1, sides, 1, true)), material, most);
    this.heads = instancesOf(lifted(new ConeGeometry(HEAD_RADIUS, HEAD_LENGTH, sides)), material, most);
    for (const mesh of [this.shafts, this.heads]) {
      mesh.renderOrder = 5;
      this.group.add(mesh);
    }
    this.finish();
  }

  clear(): void {
    this.used = 0;
  }

  /** An arrow from a point along a vector [m] with a shaft of this radius [m]; a short one is all head. */
  add(from: ArrayLike<number>, along: Vector3, radius: number): void {
    const length = along.length();
    if (this.used >= this.most || !(length > 0)) return;
    const { matrix, turn, to } = this.scratch;
    const thick = Math.min(radius, length / HEAD_LENGTH);
    const shaft = Math.max(0, length - HEAD_LENGTH * thick);
    turn.setFromUnitVectors(UP, to.copy(along).divideScalar(length));
    const start = new Vector3(from[0], from[1], from[2]);
    matrix
      .compose(start, turn, new Vector3(thick, shaft || 1e-9 * length, thick))
      .toArray(matricesOf(this.shafts), 16 * this.used);
    start.addScaledVector(to, shaft);
    matrix
      .compose(start, turn, new Vector3(thick, thick, thick))
      .toArray(matricesOf(this.heads), 16 * this.used);
    this.used++;
  }

  /** Shows what has been added. */
  finish(): void {
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = this.used;
      mesh.visible = this.used > 0;
      moved(mesh);
    }
  }

  dispose(): void {
    for (const mesh of [this.shafts, this.heads]) {
      mesh.geometry.dispose();
      mesh.dispose();
    }
    this.material.dispose();
  }
}

/** Of a colour, seen through whatever stands before it. */
export function overlay(color: string): MeshBasicMaterial {
  return new MeshBasicMaterial({ color, depthTest: false, transparent: true, opacity: 0.92 });
}

/** Standing on the origin instead of around it. */
function lifted(geometry: CylinderGeometry | ConeGeometry): BufferGeometry {
  return geometry.translate(0, geometry.parameters.height / 2, 0);
}
