// The first sight: as near as it can be with all bodies in view.

import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../src/data/header";
import { Recording } from "../../src/data/recording";
import { framed, sightOf } from "../../src/view/framing";
import { bodyNamed, headerOf } from "./made";

/** A slab of 2 × 4 × 6 m that goes from one place to another, the second time turned by a quarter about z. */
function moving(places: [Vec3, Vec3], supports = headerOf().supports): Recording {
  const arrays = [
    { name: "position", units: "m", description: "", dims: [["body", 1]] as [string, number][], stride: 3 },
    {
      name: "placement_gradient",
      units: "1",
      description: "",
      dims: [["body", 1]] as [string, number][],
      stride: 9,
    },
  ];
  const points: Vec3[] = [
    [1, 2, 3],
    [-1, -2, -3],
  ];
  const slab = bodyNamed("slab", { size: 6, outline: { points, polylines: [] } });
  const recording = new Recording(headerOf({ bodies: [slab], arrays, supports, rows: 2 }));
  const turned = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 1, 0, 0, 0, 0, 1];
  recording.put(0, Float64Array.of(0, 1), [Float32Array.from(places.flat()), Float32Array.from(turned)]);
  return recording;
}

const AXES: [Vec3, Vec3, Vec3] = [
  [1, 0, 0],
  [0, 0, 1],
  [0, -1, 0],
];

describe("the first sight", () => {
  it("reaches_as_far_as_the_bodies_as_they_are_turned", () => {
    const { reach } = framed(
      moving([
        [0, 0, 0],
        [10, 0, 0],
      ]),
    );
    expect([reach([1, 0, 0]), reach([-1, 0, 0]), reach([0, 1, 0]), reach([0, 0, 2])]).toEqual([12, 1, 2, 6]);
  });

  it("does_not_look_at_planes", () => {
    const places: [Vec3, Vec3] = [
      [0, 0, 8],
      [10, 0, 8],
    ];
    const table = [{ name: "table", origin: [0, 0, 0] as Vec3, normal: [0, 0, 1] as Vec3, motion: null }];
    const [bare, over] = [framed(moving(places)), framed(moving(places, table))];
    expect([over.center, over.radius]).toEqual([bare.center, bare.radius]);
  });

  it("touches_the_edges_of_the_picture_and_has_nothing_beyond", () => {
    const framing = framed(
      moving([
        [0, 0, 0],
        [10, 0, 0],
      ]),
    );
    const { position, target } = sightOf(framing, AXES, { across: [0.5, 0.4], upright: [0.4, 0.3] });
    // Seen from −y: slabs from x = −1 to 12, their front faces at y = −2 and −1, z from −3 to 3.
    const aside = (x: number, y: number) => (x - position[0]) / (y - position[1]);
    expect(aside(-1, -2)).toBeCloseTo(-0.5, 6);
    expect(aside(12, -1)).toBeCloseTo(0.4, 6);
    const upright = (z: number) => (z - position[2]) / (-2 - position[1]);
    expect(upright(3)).toBeLessThan(0.3);
    expect(upright(-3)).toBeGreaterThan(-0.4);
    // What is not needed of the height lies above and below.
    expect(0.3 - upright(3)).toBeCloseTo(0.4 + upright(-3), 6);
    expect([target[0], target[2]]).toEqual([position[0], position[2]]);
  });
});
