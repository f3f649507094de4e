// Many copies of one geometry, each in its own affine place and colour.

import { type BufferGeometry, DynamicDrawUsage, InstancedMesh, type Material } from "three";

/** A mesh of so many instances that may be anywhere. */
export function instancesOf(geometry: BufferGeometry, material: Material, count: number): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, count);
  mesh.instanceMatrix.setUsage(DynamicDrawUsage);
  mesh.frustumCulled = false;
  return mesh;
}

/** The column-major 4×4 matrices of the instances, to be followed by `moved`. */
export function matricesOf(mesh: InstancedMesh): Float32Array {
  return mesh.instanceMatrix.array as Float32Array;
}

/** After a change of the matrices. */
export function moved(mesh: InstancedMesh): void {
  mesh.instanceMatrix.needsUpdate = true;
  mesh.boundingSphere = null;
}

/** The same instances in another material. */
export function again(mesh: InstancedMesh, material: Material): InstancedMesh {
  const other = new InstancedMesh(mesh.geometry, material, mesh.count);
  other.instanceMatrix = mesh.instanceMatrix;
  other.frustumCulled = false;
  return other;
}
