// Numbers of a scene: how they are found, addressed, dragged and sent.

import { describe, expect, it } from "vitest";
import { groupOf, leaves, override, valueAt } from "../../src/live/leaves";
import { rangeFor, tidy } from "../../src/live/range";
import { culprits, reasonFor } from "../../src/live/refusals";
import { fittingSpeed, loops, speedsFor } from "../../src/player";

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

describe("a refused number", () => {
  const asked = leaves(SCENE)
    .filter(({ key }) => key === "body.die.density" || key === "contact.0.friction.nu")
    .map((leaf) => ({ leaf, value: -5 }));
  const message = `--set:1:18: body.die.density: must be greater than 0 kg/m^3, found -5 kg/m^3
  1 | body.die.density=-5
    |                  ^^
  fix: write a number that is greater than 0 kg/m^3`;

  it("is_the_one_that_the_message_names", () => {
    expect(culprits(asked, message).map(({ leaf }) => leaf.key)).toEqual(["body.die.density"]);
    expect(reasonFor("body.die.density", message)).toBe("must be greater than 0 kg/m^3, found -5 kg/m^3");
  });

  it("is_any_of_those_asked_for_where_the_message_names_none", () => {
    const words = "a and b overlap at the start by 1 mm\n  fix: move b";
    expect(culprits(asked, words)).toHaveLength(2);
    expect(reasonFor("body.die.density", words)).toBe("a and b overlap at the start by 1 mm");
    // A message about a part of what stands at a key is about the key.
    expect(reasonFor("body.die", message)).toBe("must be greater than 0 kg/m^3, found -5 kg/m^3");
    expect(culprits(asked, "body.die.density_of_water: unknown")).toHaveLength(2);
  });
});

describe("speed", () => {
  it("lets_the_whole_take_three_to_twenty_seconds", () => {
    expect(fittingSpeed(5)).toBe(1);
    for (const duration of [1e-6, 1e-4, 0.05, 0.5, 1.5, 30, 150, 1e4, 3e6]) {
      const lasts = duration / fittingSpeed(duration);
      expect(lasts).toBeGreaterThanOrEqual(3);
      expect(lasts).toBeLessThanOrEqual(20);
      expect(speedsFor(duration)).toContain(fittingSpeed(duration));
    }
    expect(speedsFor(5)).toEqual([0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10]);
    expect(fittingSpeed(0)).toBe(1);
  });

  it("goes_in_a_loop_where_the_whole_is_short_to_look_at", () => {
    expect([1e-4, 0.05, 1.5, 5].map(loops)).toEqual([true, true, true, true]);
    expect([15, 0].map(loops)).toEqual([false, false]);
  });
});
