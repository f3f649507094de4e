// Supports with a shape, filled, at their true size, where their motion has carried them.

import { Color, Group, type InstancedMesh, type Material } from "three";
import type { SolidSupport } from "../data/header";
import type { Recording } from "../data/recording";
import { shapesIn } from "../data/shapes";
import { carriage, placeOf } from "../math/carriage";
import { geometryOf } from "./bodies";
import { instancesOf, matricesOf, moved } from "./instances";
import { bodyMaterial } from "./material";
import { patternOf } from "./patterns";
import type { Quality } from "./quality";

/** Supports are grey. */
const COLOR = "#9aa3ad";

interface Drawn {
  support: SolidSupport;
  mesh: InstancedMesh;
}

export class SolidLayer {
  readonly group = new Group();
  private readonly drawn: Drawn[] = [];

  constructor(recording: Recording, { triangles }: Quality) {
    const shapeOf = shapesIn(recording.header);
    const supports = recording.header.solid_supports ?? [];
    for (const support of supports) {
      const surface = support.surface === null ? undefined : recording.surfaces[support.surface];
      if (!surface) continue;
      const shape = shapeOf(support.name);
      // A support is no die.
      const pattern = patternOf(shape === "box" ? null : shape, surface.points);
      const geometry = geometryOf(surface, triangles / supports.length);
      const mesh = instancesOf(geometry, bodyMaterial(false, pattern), 1);
      mesh.setColorAt(0, new Color(COLOR));
      this.drawn.push({ support, mesh });
      this.group.add(mesh);
    }
  }

  /** Puts every support where it is at a time [s]. */
  place(time: number): void {
    for (const { support, mesh } of this.drawn) {
      const into = matricesOf(mesh);
      const { gradient, motion, position } = support;
      const carried = carriage(motion, time);
      const at = placeOf(carried, position);
      for (let column = 0; column < 3; column++) {
        for (let row = 0; row < 3; row++) {
          const own = carried.turn[row];
          into[4 * column + row] =
            own[0] * gradient[column] + own[1] * gradient[3 + column] + own[2] * gradient[6 + column];
        }
        into[4 * column + 3] = 0;
        into[12 + column] = at[column];
      }
      into[15] = 1;
      moved(mesh);
    }
  }

  dispose(): void {
    for (const { mesh } of this.drawn) {
      mesh.geometry.dispose();
      (mesh.material as Material).dispose();
      mesh.dispose();
    }
  }
}
