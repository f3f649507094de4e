// Trails: the paths of the centres of mass up to the instant shown.
//
// Segments stand in the order of time, all bodies of one instant together, so that "up to now" is a number of vertices.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  LineBasicMaterial,
  LineSegments,
  SRGBColorSpace,
} from "three";
import { classesOf } from "../data/classes";
import type { Recording } from "../data/recording";
import { rgb, seriesColor } from "../math/colors";

/** Segments of all bodies together. */
const MOST_SEGMENTS = 200_000;
/** Instants beyond which a path gets no smoother to the eye. */
const MOST_INSTANTS = 4000;

export class TrailLayer {
  readonly lines = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.85 }),
  );
  private every = 1;
  private rows = 0;

  constructor(private readonly recording: Recording) {
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
  }

  /** Shows the path up to a row; builds it anew where the recording has grown. */
  place(row: number): void {
    if (!this.lines.visible) return;
    if (this.rows !== this.recording.rows) this.build();
    const drawn = Math.floor(row / this.every);
    this.lines.geometry.setDrawRange(0, 2 * this.recording.header.bodies.length * drawn);
  }

  dispose(): void {
    this.lines.geometry.dispose();
    (this.lines.material as LineBasicMaterial).dispose();
  }

  private build(): void {
    const { rows, header } = this.recording;
    const bodies = header.bodies.length;
    const instants = Math.max(2, Math.min(MOST_INSTANTS, Math.floor(MOST_SEGMENTS / Math.max(1, bodies))));
    this.rows = rows;
    this.every = Math.max(1, Math.ceil(rows / instants));
    const centers = this.recording.track("position")?.values ?? new Float32Array(0);
    const steps = Math.max(0, Math.floor((rows - 1) / this.every));
    const position = new Float32Array(6 * bodies * steps);
    const color = new Float32Array(6 * bodies * steps);
    const hues = classesOf(header).ofBody;
    const colors = header.bodies.map((_, body) => {
      const { r, g, b } = new Color().setRGB(...rgb(seriesColor(hues[body])), SRGBColorSpace);
      return [r, g, b, r, g, b];
    });
    for (let step = 0; step < steps; step++) {
      for (let body = 0; body < bodies; body++) {
        const at = 6 * (step * bodies + body);
        for (const end of [0, 1]) {
          const from = 3 * (bodies * (step + end) * this.every + body);
          position.set(centers.subarray(from, from + 3), at + 3 * end);
        }
        color.set(colors[body], at);
      }
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", new BufferAttribute(position, 3));
    this.lines.geometry.setAttribute("color", new BufferAttribute(color, 3));
  }
}
