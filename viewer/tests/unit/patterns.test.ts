// Patterns: which shapes are painted, told in the box around their surface.

import { describe, expect, it } from "vitest";
import { extentOf, shapesIn } from "../../src/data/shapes";
import { patternOf } from "../../src/view/patterns";

/** The corners of a box about a middle. */
function corners([a, b, c]: number[], [x, y, z] = [0, 0, 0]): number[] {
  return Array.from({ length: 8 }, (_, k) => [
    x + (k & 1 ? a : -a),
    y + (k & 2 ? b : -b),
    z + (k & 4 ? c : -c),
  ]).flat();
}

describe("patterns", () => {
  it("are_pips_on_cubes_only", () => {
    expect(patternOf("box", corners([0.01, 0.01, 0.01])).paint).toBe("pips");
    expect(patternOf("box", Float32Array.from(corners([0.1, 0.1, 0.1], [0.3, 0, 0]))).paint).toBe("pips");
    expect(patternOf("box", corners([0.01, 0.01, 0.02])).paint).toBe("plain");
    expect(patternOf("mesh", corners([1, 1, 1])).paint).toBe("plain");
    expect(patternOf(null, []).paint).toBe("plain");
  });

  it("mark_what_is_round_and_lie_in_the_box_around_it", () => {
    const { paint, extent } = patternOf("ellipsoid", corners([3, 2, 1], [0, 0, 5]));
    expect(paint).toBe("poles");
    expect(extent).toEqual({ middle: [0, 0, 5], half: [3, 2, 1] });
    for (const shape of ["cylinder", "cone", "capsule", "torus"]) {
      expect(patternOf(shape, []).paint, shape).toBe("stripe");
    }
    expect(extentOf([])).toEqual({ middle: [0, 0, 0], half: [0, 0, 0] });
  });

  it("follow_the_shape_that_the_scene_gives_a_body_its_copies_or_a_support", () => {
    const shapeOf = shapesIn({
      resolved: {
        body: [{ name: "die", shape: { box: { size: [1, 1, 1] } } }, { name: "grain-5" }],
        support: [{ name: "peg", shape: { cylinder: { radius: 1, height: 1 } } }],
      },
    });
    expect(["die", "die-7", "peg", "grain-5", "nobody"].map(shapeOf)).toEqual([
      "box",
      "box",
      "cylinder",
      null,
      null,
    ]);
  });
});
