// Bodies as they are: one instanced mesh for each distinct surface, with p and P of each body as an instance.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  type InstancedMesh,
  type Material,
  type Raycaster,
  SRGBColorSpace,
} from "three";
import type { Frame } from "../data/frame";
import type { Recording, Surface } from "../data/recording";
import { shapesIn } from "../data/shapes";
import type { Rgb } from "../math/colors";
import { coarsened } from "./coarse";
import { COARSE_CREASE, CREASE, shaded } from "./crease";
import { instancesOf, matricesOf, moved } from "./instances";
import { bodyMaterial } from "./material";
import { patternOf } from "./patterns";
import type { Quality } from "./quality";

/** Bodies that share a surface. */
interface Shared {
  mesh: InstancedMesh;
  bodies: number[];
}

export class BodyLayer {
  readonly group = new Group();
  private readonly shared: Shared[] = [];

  constructor(recording: Recording, { triangles, crowd }: Quality) {
    const { header } = recording;
    const shapeOf = shapesIn(header);
    for (const [bodies, geometry] of geometries(recording, triangles)) {
      const { name, surface } = header.bodies[bodies[0]];
      const points = (surface !== null && recording.surfaces[surface]?.points) || [];
      const material = bodyMaterial(header.bodies.length > crowd, patternOf(shapeOf(name), points));
      const mesh = instancesOf(geometry, material, bodies.length);
      this.shared.push({ mesh, bodies });
      this.group.add(mesh);
    }
  }

  /** Moves every body to its place. */
  place(frame: Frame): void {
    for (const { mesh, bodies } of this.shared) {
      for (const [k, body] of bodies.entries()) writePlacement(matricesOf(mesh), 16 * k, frame, body);
      moved(mesh);
    }
  }

  /** Colours every body; the colours are as on the screen. */
  paint(colorOf: (body: number) => Rgb): void {
    const color = new Color();
    for (const { mesh, bodies } of this.shared) {
      for (const [k, body] of bodies.entries()) {
        mesh.setColorAt(k, color.setRGB(...colorOf(body), SRGBColorSpace));
      }
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  /** What casts shadows. */
  get casters(): InstancedMesh[] {
    return this.shared.map(({ mesh }) => mesh);
  }

  /** Triangles of all bodies together. */
  get triangles(): number {
    return this.shared.reduce(
      (sum, { mesh }) => sum + (mesh.count * (mesh.geometry.index?.count ?? 0)) / 3,
      0,
    );
  }

  /** The nearest body on a ray. */
  hitBy(ray: Raycaster): number | null {
    const [hit] = ray.intersectObjects(this.group.children, false);
    const shared = hit && this.shared.find(({ mesh }) => mesh === hit.object);
    return shared && hit.instanceId !== undefined ? shared.bodies[hit.instanceId] : null;
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

export function geometryOf(surface: Surface, most: number): BufferGeometry {
  const { points, triangles } = coarsened(surface.points, surface.triangles, most);
  // What was made coarse has edges that the body has not.
  const crease = triangles === surface.triangles ? CREASE : COARSE_CREASE;
  const { position, normal, index } = shaded(points, triangles, crease);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(position, 3));
  geometry.setAttribute("normal", new BufferAttribute(normal, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
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
