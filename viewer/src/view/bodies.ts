// Bodies as they are: one instanced mesh for each distinct surface, with p and P of each body as an instance.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  type Material,
  SRGBColorSpace,
} from "three";
import type { Frame } from "../data/frame";
import type { Recording, Surface } from "../data/recording";
import type { Rgb } from "../math/colors";
import { coarsened } from "./coarse";
import { shaded } from "./crease";
import { bodyMaterial } from "./material";

/** Bodies that share a surface. */
interface Shared {
  mesh: InstancedMesh;
  bodies: number[];
}

export class BodyLayer {
  readonly group = new Group();
  private readonly shared: Shared[] = [];

  /** `triangles`: how many may be drawn, all bodies together. */
  constructor(recording: Recording, triangles: number) {
    const material = bodyMaterial();
    for (const [bodies, geometry] of geometries(recording, triangles)) {
      const mesh = instances(geometry, material, bodies.length);
      mesh.castShadow = true;
      mesh.receiveShadow = true;
      this.shared.push({ mesh, bodies });
      this.group.add(mesh);
    }
  }

  /** Moves every body to its place. */
  place(frame: Frame): void {
    for (const { mesh, bodies } of this.shared) {
      const matrices = mesh.instanceMatrix.array as Float32Array;
      for (const [instance, body] of bodies.entries()) writePlacement(matrices, 16 * instance, frame, body);
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }

  /** Colours every body; the colours are as on the screen. */
  paint(colorOf: (body: number) => Rgb): void {
    const color = new Color();
    for (const { mesh, bodies } of this.shared) {
      bodies.forEach((body, instance) => {
        mesh.setColorAt(instance, color.setRGB(...colorOf(body), SRGBColorSpace));
      });
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  /** The body behind an instance that was hit. */
  bodyOf(mesh: unknown, instance: number | undefined): number | null {
    const shared = this.shared.find((one) => one.mesh === mesh);
    return shared && instance !== undefined ? (shared.bodies[instance] ?? null) : null;
  }

  dispose(): void {
    for (const { mesh } of this.shared) {
      mesh.geometry.dispose();
      (mesh.material as Material).dispose();
      mesh.dispose();
    }
  }
}

/** The bodies of each distinct surface that has come, with the surface ready to draw. */
export function* geometries(recording: Recording, triangles: number): Generator<[number[], BufferGeometry]> {
  const { bodies } = recording.header;
  const drawn = bodies.filter((body) => body.surface !== null).length;
  for (const [k, surface] of recording.surfaces.entries()) {
    const sharing = bodies.flatMap((body, index) => (body.surface === k ? [index] : []));
    if (surface && sharing.length > 0) yield [sharing, geometryOf(surface, triangles / Math.max(1, drawn))];
  }
}

function geometryOf(surface: Surface, most: number): BufferGeometry {
  const { points, triangles } = coarsened(surface.points, surface.triangles, most);
  const { position, normal, index } = shaded(points, triangles);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(position, 3));
  geometry.setAttribute("normal", new BufferAttribute(normal, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}

/** A mesh of so many instances that may be anywhere. */
export function instances(geometry: BufferGeometry, material: Material, count: number): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, count);
  mesh.instanceMatrix.setUsage(DynamicDrawUsage);
  mesh.frustumCulled = false;
  return mesh;
}

/** x = p + P X as a column-major 4×4 matrix. */
export function writePlacement(into: Float32Array, at: number, frame: Frame, body: number): void {
  const { position: p, gradient: P } = frame;
  for (let column = 0; column < 3; column++) {
    for (let row = 0; row < 3; row++) into[at + 4 * column + row] = P[9 * body + 3 * row + column];
    into[at + 4 * column + 3] = 0;
    into[at + 12 + column] = p[3 * body + column];
  }
  into[at + 15] = 1;
}
