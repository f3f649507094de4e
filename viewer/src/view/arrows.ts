// Arrows in crowds: shafts and heads as two instanced meshes, drawn over everything, since what they show begins at or
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
import { instances } from "./bodies";

const UP = new Vector3(0, 1, 0);

/** Length of a head, and of its base, in radii of the shaft. */
const HEAD_LENGTH = 7;
const HEAD_RADIUS = 2.6;

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
    this.shafts = instances(lifted(new CylinderGeometry(1, 1, 1, 10)), material, most);
    this.heads = instances(lifted(new ConeGeometry(HEAD_RADIUS, HEAD_LENGTH, 14)), material, most);
    for (const mesh of [this.shafts, this.heads]) {
      mesh.renderOrder = 5;
      this.group.add(mesh);
    }
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
    this.shafts.setMatrixAt(
      this.used,
      matrix.compose(start, turn, new Vector3(thick, shaft || 1e-9 * length, thick)),
    );
    start.addScaledVector(to, shaft);
    this.heads.setMatrixAt(this.used, matrix.compose(start, turn, new Vector3(thick, thick, thick)));
    this.used++;
  }

  /** Shows what has been added. */
  finish(): void {
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = this.used;
      mesh.visible = this.used > 0;
      mesh.instanceMatrix.needsUpdate = true;
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
