// Many bodies: the classes by which they are coloured, and those that fly off.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { classesOf, classLabel } from "../../src/data/classes";
import type { Json } from "../../src/data/header";
import { Recording } from "../../src/data/recording";
import { straysOf } from "../../src/data/strays";
import { SERIES, seriesColor } from "../../src/math/colors";
import { counted } from "../../src/math/format";
import { charts } from "../../src/ui/quantities";
import { framed } from "../../src/view/framing";
import { bodyNamed, headerOf } from "./made";

/** Bodies of size one in a row, described by a function; the last ones fly off to a distance. */
function crowd(
  count: number,
  describe: (k: number) => { [key: string]: Json },
  flying = 0,
  distance = 0,
): Recording {
  const bodies = Array.from({ length: count }, (_, k) => bodyNamed(`b${k}`));
  const spec = (name: string, width: number) => ({
    name,
    units: "m",
    description: "",
    dims: [["body", count] as [string, number]],
    stride: width * count,
  });
  const body = bodies.map(({ name }, k) => ({ name, ...describe(k) }));
  const arrays = [spec("position", 3), spec("gap", 1)];
  const recording = new Recording(
    headerOf({ bodies, arrays, resolved: { body }, rows: 11, gravity: [0, 0, 0] }),
  );
  const times = Float64Array.from({ length: 11 }, (_, row) => row);
  const position = new Float32Array(3 * count * 11);
  for (let row = 0; row < 11; row++) {
    for (let k = 0; k < count; k++) {
      position[3 * (row * count + k)] = k;
      if (k >= count - flying) position[3 * (row * count + k) + 2] = (distance * row) / 10;
    }
  }
  recording.put(0, times, [position, new Float32Array(11 * count).fill(1)]);
  return recording;
}

describe("classes of bodies", () => {
  it("are_the_bodies_where_there_are_few", () => {
    expect(classesOf(crowd(7, () => ({ group: "grains" })).header).names).toHaveLength(7);
  });

  it("are_groups_where_there_are_many_else_sorts", () => {
    const grouped = classesOf(
      crowd(9, (k) => (k === 0 ? {} : { group: k % 2 ? ["steel", "grains"] : "grains" })).header,
    );
    expect(grouped.names).toEqual(["without a group", "steel", "grains"]);
    expect(classLabel(grouped, 1)).toBe("steel (4)");
    const sorted = classesOf(crowd(8, (k) => (k < 3 ? { shape: { sphere: {} } } : {})).header);
    expect(sorted.names).toEqual(["rigid, sphere", "rigid bodies"]);
  });

  it("are_all_named_in_the_legend_of_a_chart", () => {
    const recording = crowd(300, (k) => ({ group: k === 17 ? "steel" : "grains" }));
    const gap = charts(recording, null).find(({ id }) => id === "gap")!;
    expect(gap.keys!.map(({ label }) => label)).toEqual(["grains (299)", "steel (1)"]);
    expect(gap.keys!.flatMap(({ lines }) => lines)).toHaveLength(gap.lines.length);
    expect(gap.note).toBe(`lines of ${gap.lines.length} of 300 bodies`);
    // Of few bodies each has its own.
    expect(
      charts(
        crowd(7, () => ({})),
        null,
      ).find(({ id }) => id === "gap")!.keys,
    ).toBeUndefined();
  });
});

describe("colours", () => {
  it("are_those_of_plots_on_paper", () => {
    const paper = join(import.meta.dirname, "../../../crates/gyration-plot/src/draw/color.rs");
    const listed = /SERIES: \[Color; 7\] = \[([^\]]*)\]/.exec(readFileSync(paper, "utf8"))![1];
    const hex = [...listed.matchAll(/new\(0x(..), 0x(..), 0x(..)\)/g)].map(([, ...parts]) =>
      `#${parts.join("")}`.toLowerCase(),
    );
    expect(SERIES).toEqual(hex);
  });

  it("are_different_for_three_rounds", () => {
    const colors = Array.from({ length: 3 * SERIES.length }, (_, index) => seriesColor(index));
    expect(new Set(colors).size).toBe(colors.length);
    expect(seriesColor(0)).toBe(SERIES[0]);
  });
});

describe("a body that flies off", () => {
  it("is_a_stray_and_does_not_widen_the_view", () => {
    const flying = crowd(5, () => ({}), 1, 500);
    expect([...straysOf(flying).bodies]).toEqual([4]);
    expect(framed(flying).radius).toBeLessThan(10);
    expect(framed(crowd(5, () => ({}), 1, 6)).radius).toBeGreaterThan(3.5);
  });

  it("is_none_where_most_fly_nor_where_it_is_near_or_alone", () => {
    expect(straysOf(crowd(5, () => ({}), 3, 500)).bodies.size).toBe(0);
    expect(straysOf(crowd(5, () => ({}), 1, 6)).bodies.size).toBe(0);
    expect(straysOf(crowd(1, () => ({}), 1, 500)).bodies.size).toBe(0);
  });
});

describe("counted things", () => {
  it("have_a_plural_where_they_are_not_one", () => {
    const told = [
      counted(1, "body"),
      counted(2, "body"),
      counted(0, "sample"),
      counted(3, "closest approach"),
    ];
    expect(told).toEqual(["1 body", "2 bodies", "0 samples", "3 closest approaches"]);
    expect([counted(2, "apex"), counted(1, "step")]).toEqual(["2 apexes", "1 step"]);
  });
});
