// Springs: found in the resolved scene, drawn between the points that they join.

import { describe, expect, it } from "vitest";
import { Frame } from "../../src/data/frame";
import { springsOf } from "../../src/data/springs";
import { placed } from "../../src/view/places";
import { zigzag } from "../../src/view/springs";
import { bodyNamed, headerOf } from "./made";

const resolved = {
  body: [
    { name: "a", spring: [{ point: [0, 0, 1], anchor: [1, 2, 3], stiffness: 1, rest_length: 0.3 }] },
    { name: "b", spring: [] },
  ],
  spring: [
    {
      between: ["b", "a"],
      points: [
        [0, 1, 0],
        [2, 0, 0],
      ],
      stiffness: 1,
    },
    { between: ["b", "nobody"], points: [], stiffness: 1 },
  ],
};

describe("springs", () => {
  const header = headerOf({ bodies: [bodyNamed("a"), bodyNamed("b")], resolved });

  it("are_those_to_anchors_and_those_between_bodies", () => {
    expect(springsOf(header).map(({ ends }) => ends)).toEqual([
      [
        { body: 0, at: [0, 0, 1] },
        { body: null, at: [1, 2, 3] },
      ],
      [
        { body: 1, at: [0, 1, 0] },
        { body: 0, at: [2, 0, 0] },
      ],
    ]);
    expect(springsOf(header).map(({ rest }) => rest)).toEqual([0.3, 0]);
    expect(springsOf(headerOf())).toEqual([]);
  });

  it("hang_at_material_points", () => {
    const frame = new Frame();
    frame.position = Float32Array.of(0, 0, 0, 10, 20, 30);
    frame.gradient = Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 1, 0, 0, 0, 0, 2);
    expect(placed({ body: 1, at: [1, 2, 3] }, frame)).toEqual([8, 21, 36]);
    expect(placed({ body: null, at: [1, 2, 3] }, frame)).toEqual([1, 2, 3]);
  });

  it("go_from_one_end_to_the_other_and_stay_within_their_width", () => {
    for (const to of [
      [3, 0, 0],
      [0, 0, -2],
      [1, 1, 1],
    ] as [number, number, number][]) {
      const corners = zigzag([0, 0, 0], to, 0.1);
      expect(corners[0]).toEqual([0, 0, 0]);
      expect(corners.at(-1)).toEqual(to);
      const length = Math.hypot(...to);
      const off = corners.map((p) => {
        const along = p.reduce((sum, value, axis) => sum + (value * to[axis]) / length, 0);
        return Math.sqrt(Math.max(0, Math.hypot(...p) ** 2 - along ** 2));
      });
      expect(Math.max(...off)).toBeCloseTo(0.1, 10);
    }
  });
});
