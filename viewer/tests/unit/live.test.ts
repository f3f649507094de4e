// Numbers of a scene: how they are found, addressed, dragged and sent.

import { describe, expect, it } from "vitest";
import { groupOf, leaves, override, valueAt } from "../../src/live/leaves";
import { rangeFor, tidy } from "../../src/live/range";
import { fittingSpeed, SPEEDS } from "../../src/player";

const SCENE = {
  world: { gravity: [0, 0, -9.81] },
  contact: [{ support: "table", friction: { beta: 3e4, nu: 3 } }],
  body: [
    {
      name: "die",
      density: 1250,
      velocity: [0.5, 0, 0],
      gradient: [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
      spring: [],
    },
    { name: "not a name", density: 1 },
  ],
};

describe("numbers of a scene", () => {
  it("are_addressed_by_name_where_tables_have_names_else_by_index", () => {
    const keys = leaves(SCENE).map(({ key, path }) => `${key} ${path.join("")}`);
    expect(keys).toContain("body.die.density ");
    expect(keys).toContain("body.die.velocity 2");
    expect(keys).toContain("body.die.gradient 21");
    expect(keys).toContain("body.1.density ");
    expect(keys).toContain("contact.0.friction.beta ");
    expect(keys).toHaveLength(3 + 2 + 1 + 3 + 9 + 1);
  });

  it("are_found_again_by_their_keys", () => {
    for (const { key, path, value } of leaves(SCENE)) {
      const found = path.reduce(
        (list: unknown, index) => (list as unknown[])[index],
        valueAt(SCENE, key) as unknown,
      );
      expect(found).toBe(value);
    }
  });

  it("are_sent_as_whole_lists", () => {
    expect(override(SCENE, "body.die.velocity", [{ path: [2], value: 1.5 }])).toBe(
      "body.die.velocity=[0.5, 0, 1.5]",
    );
    expect(
      override(SCENE, "body.die.gradient", [
        { path: [0, 1], value: 0.25 },
        { path: [2, 2], value: 2 },
      ]),
    ).toBe("body.die.gradient=[[1, 0.25, 0], [0, 1, 0], [0, 0, 2]]");
    expect(override(SCENE, "body.die.density", [{ path: [], value: 1e-7 }])).toBe("body.die.density=1e-7");
  });

  it("stand_in_groups_by_their_table", () => {
    expect(groupOf("body.die.velocity")).toBe("body.die");
    expect(groupOf("contact.0.friction.beta")).toBe("contact.0");
    expect(groupOf("time.end")).toBe("time");
  });
});

describe("the range of a slider", () => {
  it("goes_by_factors_around_what_is_positive", () => {
    const range = rangeFor("contact.0.friction.beta", 3e4, 1);
    expect(range.at(0.5)).toBeCloseTo(3e4, 6);
    expect(range.at(1)).toBeCloseTo(3e5, 4);
    expect(range.place(range.at(0.3))).toBeCloseTo(0.3, 12);
  });

  it("is_symmetric_where_there_is_a_sign", () => {
    const range = rangeFor("body.die.velocity", 0, 0.5);
    expect(range.at(0)).toBe(-1.5);
    expect(range.at(1)).toBe(1.5);
    expect(range.at(0.505)).toBe(0);
    expect(range.place(-0.75)).toBe(0.25);
  });

  it("keeps_numbers_short", () => {
    expect(tidy(0.123456789)).toBe(0.1235);
  });
});

describe("speed", () => {
  it("lets_the_whole_take_three_to_twenty_seconds_where_it_can", () => {
    expect(fittingSpeed(5)).toBe(1);
    for (const duration of [0.05, 0.5, 1.5, 30, 150]) {
      const lasts = duration / fittingSpeed(duration);
      expect(lasts).toBeGreaterThanOrEqual(3);
      expect(lasts).toBeLessThanOrEqual(20);
    }
    expect(fittingSpeed(1e-4)).toBe(SPEEDS[0]);
    expect(fittingSpeed(1e4)).toBe(10);
  });
});
