// Joints and pins: found in the resolved scene, at bodies, supports and space.

import { InstancedMesh } from "three";
import { describe, expect, it } from "vitest";
import { Frame } from "../../src/data/frame";
import { jointsOf, pinsOf } from "../../src/data/joints";
import type { Recording } from "../../src/data/recording";
import { bondsOf, springsOf } from "../../src/data/springs";
import { matricesOf } from "../../src/view/instances";
import { JointLayer } from "../../src/view/joints";
import { placed, pointing } from "../../src/view/places";
import { bodyNamed, headerOf } from "./made";

const resolved = {
  body: [
    { name: "a", pin: [0, 0, 2], spring: [] },
    {
      name: "b",
      spring: [
        {
          anchor: [1, 0, 0],
          anchor_motion: { oscillate: { direction: [0, 3, 0], amplitude: 2, frequency: 1, phase: 0 } },
        },
      ],
    },
  ],
  bond: [{ between: ["a", "b"], points: [[0, 0, 1]], law: "l" }],
  joint: [
    { name: "elbow", kind: "hinge", between: ["b", "a"], points: [[1, 0, 0]], axis: [0, 1, 0] },
    { name: "door", kind: "ball", between: ["space", "a"], points: [[7, 8, 9], []] },
    { name: "wheel", kind: "hinge", between: ["drum", "b"], points: [[1, 0, 0], []], axis: [1, 0, 0] },
    { name: "wrong", kind: "ball", between: ["nobody", "b"], points: [] },
  ],
};
const header = headerOf({
  bodies: [bodyNamed("a"), bodyNamed("b")],
  solid_supports: [
    {
      name: "drum",
      surface: null,
      position: [0, 0, 5],
      // A quarter turn about z.
      gradient: [0, -1, 0, 1, 0, 0, 0, 0, 1],
      motion: { rotate: { axis: [1, 0, 0], point: [0, 0, 0], rate: Math.PI } },
    },
  ],
  resolved,
});

describe("marks", () => {
  it("are_where_they_are_however_often_they_are_placed", () => {
    // The rail of a slider lies between its points, of which one is of space.
    const rail = headerOf({
      bodies: [bodyNamed("a")],
      resolved: {
        joint: [
          { name: "way", kind: "slider", between: ["a", "space"], points: [[], [0, 0, 3]], axis: [0, 0, 1] },
        ],
      },
    });
    const frame = new Frame();
    frame.position = Float32Array.of(0, 0, 0);
    frame.gradient = Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);
    const layer = new JointLayer({ header: rail } as Recording);
    const seen = () =>
      layer.group.children.map((child) => child instanceof InstancedMesh && [...matricesOf(child)]);
    layer.place(frame);
    const once = seen();
    layer.place(frame);
    expect(seen()).toEqual(once);
    expect(jointsOf(rail)[0].ends[1].at).toEqual([0, 0, 3]);
  });
});

describe("joints", () => {
  const frame = new Frame();
  frame.time = 0.5;
  frame.position = Float32Array.of(0, 0, 0, 10, 20, 30);
  frame.gradient = Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -2, 0, 1, 0, 0, 0, 0, 1);

  it("are_those_whose_ends_are_there", () => {
    expect(jointsOf(header).map(({ name, kind }) => [name, kind])).toEqual([
      ["elbow", "hinge"],
      ["door", "ball"],
      ["wheel", "hinge"],
    ]);
    expect(jointsOf(headerOf({ solid_supports: null }))).toEqual([]);
  });

  it("hang_at_points_that_bodies_supports_and_space_carry", () => {
    const [elbow, door, wheel] = jointsOf(header);
    expect(placed(elbow.ends[0], frame)).toEqual([10, 21, 30]);
    expect(placed(door.ends[0], frame)).toEqual([7, 8, 9]);
    // (1, 0, 0) turned about z and put at (0, 0, 5) is (0, 1, 5), which a quarter turn about x brings to (0, −5, 1).
    const at = placed(wheel.ends[0], frame);
    [0, -5, 1].forEach((part, axis) => {
      expect(at[axis]).toBeCloseTo(part, 12);
    });
  });

  it("point_as_the_first_carries_their_axis_and_keep_its_length", () => {
    const [elbow, , wheel] = jointsOf(header);
    expect(pointing(elbow.ends[0], elbow.axis, frame)).toEqual([-1, 0, 0]);
    const along = pointing(wheel.ends[0], wheel.axis, frame);
    [0, 0, 1].forEach((part, axis) => {
      expect(along[axis]).toBeCloseTo(part, 12);
    });
  });

  it("have_pins_bonds_and_moving_anchors_beside_them", () => {
    expect(pinsOf(header).map(([pin]) => placed(pin, frame))).toEqual([[0, 0, 2]]);
    expect(bondsOf(header).map((ends) => ends.map((end) => placed(end, frame)))).toEqual([
      [
        [0, 0, 1],
        [10, 20, 30],
      ],
    ]);
    // A quarter of a period: the whole amplitude along the direction, whatever its length.
    frame.time = 0.25;
    const anchor = placed(springsOf(header)[0].ends[1], frame);
    [1, 2, 0].forEach((part, axis) => {
      expect(anchor[axis]).toBeCloseTo(part, 12);
    });
    frame.time = 0.5;
  });
});
