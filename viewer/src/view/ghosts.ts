// Onion skins: the bodies at equal times of the whole recording, clear enough to be seen through.

import { Color, Group, type InstancedMesh, SRGBColorSpace } from "three";
import { classesOf } from "../data/classes";
import { Frame } from "../data/frame";
import type { Recording } from "../data/recording";
import { rgb, seriesColor } from "../math/colors";
import { geometries, writePlacement } from "./bodies";
import { instancesOf, matricesOf, moved } from "./instances";
import { ghostMaterial } from "./material";
import type { Quality } from "./quality";

/** Skins of each body, if that is not too many altogether. */
const SKINS = 9;
const MOST = 600;

export class GhostLayer {
  readonly group = new Group();
  private skins: InstancedMesh[] = [];
  private readonly material = ghostMaterial();
  private rows = 0;

  constructor(
    private readonly recording: Recording,
    private readonly quality: Quality,
  ) {
    this.group.visible = false;
  }

  /** Builds the skins where they are shown and the recording has grown. */
  place(): void {
    if (!this.group.visible || this.rows === this.recording.rows) return;
    this.rows = this.recording.rows;
    this.clear();
    const frames = this.times().map((time) => {
      const frame = new Frame();
      frame.take(this.recording, time, false);
      return frame;
    });
    const { triangles } = this.quality;
    const color = new Color();
    const hues = classesOf(this.recording.header).ofBody;
    for (const [bodies, geometry] of geometries(this.recording, triangles / frames.length)) {
      const skins = instancesOf(geometry, this.material, bodies.length * frames.length);
      for (const [f, frame] of frames.entries()) {
        for (const [b, body] of bodies.entries()) {
          const copy = f * bodies.length + b;
          writePlacement(matricesOf(skins), 16 * copy, frame, body);
          skins.setColorAt(copy, color.setRGB(...rgb(seriesColor(hues[body])), SRGBColorSpace));
        }
      }
      moved(skins);
      skins.renderOrder = 2;
      this.skins.push(skins);
      this.group.add(skins);
    }
  }

  dispose(): void {
    this.clear();
    this.material.dispose();
  }

  private clear(): void {
    this.group.clear();
    for (const skins of this.skins) {
      skins.geometry.dispose();
      skins.dispose();
    }
    this.skins = [];
  }

  private times(): number[] {
    const { header, lastTime } = this.recording;
    const count = Math.max(2, Math.min(SKINS, Math.floor(MOST / Math.max(1, header.bodies.length))));
    return Array.from({ length: count }, (_, k) => (lastTime * k) / (count - 1));
  }
}
