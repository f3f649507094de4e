// Bodies without a surface, such as sets of points: their outline as lines and their points as dots.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Points,
  PointsMaterial,
  SRGBColorSpace,
} from "three";
import type { Frame } from "../data/frame";
import type { Recording } from "../data/recording";
import type { Rgb } from "../math/colors";

interface Vertex {
  body: number;
  at: [number, number, number];
}

export class OutlineLayer {
  readonly group = new Group();
  private readonly vertices: Vertex[] = [];
  private readonly position: BufferAttribute;
  private readonly color: BufferAttribute;

  constructor(recording: Recording) {
    const lines: number[] = [];
    recording.header.bodies.forEach((body, index) => {
      if (body.surface !== null || !body.outline) return;
      const first = this.vertices.length;
      for (const at of body.outline.points) this.vertices.push({ body: index, at });
      for (const polyline of body.outline.polylines) {
        for (let k = 1; k < polyline.length; k++) lines.push(first + polyline[k - 1], first + polyline[k]);
      }
    });
    const count = this.vertices.length;
    this.position = new BufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    this.color = new BufferAttribute(new Float32Array(3 * count), 3);
    if (count === 0) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("color", this.color);
    const dots = new Points(geometry, roundDots());
    const outlined = new BufferGeometry();
    outlined.setAttribute("position", this.position);
    outlined.setAttribute("color", this.color);
    outlined.setIndex(lines);
    const segments = new LineSegments(outlined, new LineBasicMaterial({ vertexColors: true }));
    for (const object of [dots, segments]) object.frustumCulled = false;
    this.group.add(dots, segments);
  }

  place(frame: Frame): void {
    const { position: p, gradient: P } = frame;
    this.vertices.forEach(({ body, at }, index) => {
      const [x, y, z] = [0, 3, 6].map((row, k) => {
        const place = 9 * body + row;
        return p[3 * body + k] + P[place] * at[0] + P[place + 1] * at[1] + P[place + 2] * at[2];
      });
      this.position.setXYZ(index, x, y, z);
    });
    this.position.needsUpdate = true;
  }

  paint(colorOf: (body: number) => Rgb): void {
    const color = new Color();
    this.vertices.forEach(({ body }, index) => {
      color.setRGB(...colorOf(body), SRGBColorSpace);
      this.color.setXYZ(index, color.r, color.g, color.b);
    });
    this.color.needsUpdate = true;
  }
}

/** Discs of some pixels. */
function roundDots(): PointsMaterial {
  const material = new PointsMaterial({ size: 10, sizeAttenuation: false, vertexColors: true });
  material.onBeforeCompile = (shader) => {
    const round = "void main() {\n\tif ( length( gl_PointCoord - 0.5 ) > 0.5 ) discard;";
    shader.fragmentShader = shader.fragmentShader.replace("void main() {", round);
  };
  return material;
}
