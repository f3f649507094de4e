// Onion skins: the bodies at equal times of the whole recording, clear enough to be seen through.

import { Color, Group, type InstancedMesh, type MeshLambertMaterial, SRGBColorSpace } from "three";
import { Frame } from "../data/frame";
import type { Recording } from "../data/recording";
import { bodyColor, rgb } from "../math/colors";
import { geometries, instances, writePlacement } from "./bodies";
import { ghostMaterial } from "./material";

/** Skins of each body, if that is not too many altogether. */
const SKINS = 9;
const MOST = 600;

export class GhostLayer {
  readonly group = new Group();
  private meshes: InstancedMesh[] = [];
  private rows = 0;

  constructor(
    private readonly recording: Recording,
    private readonly triangles: number,
  ) {
    this.group.visible = false;
  }

  /** Builds the skins where they are shown and the recording has grown. */
  place(): void {
    if (!this.group.visible || this.rows === this.recording.rows) return;
    this.rows = this.recording.rows;
    this.dispose();
    const times = this.times();
    const frames = times.map((time) => {
      const frame = new Frame();
      frame.take(this.recording, time, false);
      return frame;
    });
    for (const [bodies, geometry] of geometries(this.recording, this.triangles / frames.length)) {
      const mesh = instances(geometry, ghostMaterial(), bodies.length * frames.length);
      mesh.renderOrder = 2;
      const matrices = mesh.instanceMatrix.array as Float32Array;
      let instance = 0;
      for (const frame of frames) {
        for (const body of bodies) {
          writePlacement(matrices, 16 * instance, frame, body);
          mesh.setColorAt(instance++, new Color().setRGB(...rgb(bodyColor(body)), SRGBColorSpace));
        }
      }
      this.meshes.push(mesh);
      this.group.add(mesh);
    }
  }

  dispose(): void {
    for (const mesh of this.meshes) {
      mesh.removeFromParent();
      mesh.geometry.dispose();
      (mesh.material as MeshLambertMaterial).dispose();
      mesh.dispose();
    }
    this.meshes = [];
  }

  private times(): number[] {
    const { header, lastTime } = this.recording;
    const count = Math.max(2, Math.min(SKINS, Math.floor(MOST / Math.max(1, header.bodies.length))));
    return Array.from({ length: count }, (_, k) => (lastTime * k) / (count - 1));
  }
}
