// Colours by a number of each body: which there are, over which range.

import { describe, expect, it } from "vitest";
import { Frame } from "../../src/data/frame";
import { Recording } from "../../src/data/recording";
import { mapped } from "../../src/math/colors";
import { Colors } from "../../src/view/coloring";
import { bodyNamed, headerOf } from "./made";

const COUNT = 200;

/** Bodies in one row: body k has the speed 3 k, and a force of k, the last one a million times that. */
function crowd(names: string[]): Recording {
  const arrays = ["position", ...names].map((name) => ({
    name,
    units: "1",
    description: "",
    dims: [
      ["body", COUNT],
      ["axis", 3],
    ] as [string, number][],
    stride: 3 * COUNT,
  }));
  const bodies = Array.from({ length: COUNT }, (_, k) => bodyNamed(`b${k}`));
  const recording = new Recording(headerOf({ bodies, arrays, rows: 1 }));
  const along = (size: (k: number) => number) =>
    Float32Array.from({ length: 3 * COUNT }, (_, at) => (at % 3 === 1 ? -size(Math.floor(at / 3)) : 0));
  const of: Record<string, Float32Array> = {
    velocity: along((k) => 3 * k),
    contact_force: along((k) => (k === COUNT - 1 ? 1e6 * k : k)),
  };
  recording.put(0, Float64Array.of(0), [along(() => 0), ...names.map((name) => of[name])]);
  return recording;
}

describe("colours by a number", () => {
  it("speed_goes_from_the_least_to_the_largest", () => {
    const recording = crowd(["velocity"]);
    const colors = new Colors(recording);
    expect(colors.scale("speed")).toEqual({ title: "Speed", units: "m/s", low: 0, high: 3 * (COUNT - 1) });
    const frame = new Frame();
    frame.take(recording, 0, false);
    const at = colors.at("speed", frame);
    expect(at(0)).toEqual(mapped(0));
    expect(at(COUNT - 1)).toEqual(mapped(1));
  });

  it("one_impact_does_not_set_the_range_of_forces", () => {
    const scale = new Colors(crowd(["contact_force"])).scale("force")!;
    expect(scale.low).toBe(0);
    expect(scale.high).toBeLessThan(COUNT);
    expect(scale.high).toBeGreaterThan(0.97 * COUNT);
  });

  it("what_is_not_recorded_or_cannot_be_is_told", () => {
    const colors = new Colors(crowd(["velocity"]));
    expect(colors.absent("body")).toBeNull();
    expect(colors.absent("speed")).toBeNull();
    expect(colors.absent("force")).toBe("The recording has no contact force.");
    expect(colors.absent("stretch")).toBe("Rigid bodies keep their shape.");
  });
});
