// The look of the page as an address: what is written is read again, what makes no sense is left out.

import { describe, expect, it } from "vitest";
import { groupsOf } from "../../src/data/described";
import { hashOf, type Look, lookIn } from "../../src/link";
import { bodyNamed, headerOf } from "./made";

describe("a link", () => {
  it("tells_all_that_it_was_made_of", () => {
    const look: Look = {
      time: 0.1 + 0.2,
      show: ["forces", "joints"],
      color: "stretch",
      group: "red, & blue + #1",
      follow: true,
      camera: { position: [1, -2.5, 1e-3], target: [0, 0, 3] },
      panel: "Summary",
      field: "pressure",
      width: 0.05,
    };
    expect(lookIn(hashOf(look, ""))).toEqual(look);
    expect(lookIn(hashOf({ body: "die", follow: false, show: [] }, ""))).toEqual({
      body: "die",
      follow: false,
      show: [],
    });
  });

  it("is_short_where_little_is_told_and_keeps_what_others_wrote", () => {
    expect(hashOf({}, "")).toBe("");
    expect(hashOf({ time: 0.25 }, "")).toBe("#t=0.25");
    expect(hashOf({ time: 0.5 }, "#quality=full&t=0.25&color=stress")).toBe("#quality=full&t=0.5");
    // However others have written what is ours.
    expect(hashOf({ time: 5 }, "#%74=4&t=3")).toBe("#t=5");
  });

  it("does_without_what_makes_no_sense", () => {
    for (const hash of [
      "",
      "#",
      "#t=soon",
      "#t=",
      "#color=pink",
      "#camera=1,2,3",
      "#camera=1,2,3,1,2,3",
      "#camera=1,2,3,4,5,",
      "#camera=a,b,c,d,e,f",
      "#camera= ,1,2,3,4,5",
      "#camera=1e308,-1e308,0,-1e308,1e308,0",
      "#t=0x10",
      "#width=-1",
      "#width=wide",
    ]) {
      expect(lookIn(hash), hash).toEqual({});
    }
    expect(() => lookIn("#body=%E0%A4%A&%zz")).not.toThrow();
    expect(lookIn("#show=forces,fireworks")).toEqual({ show: ["forces"] });
  });
});

describe("groups of bodies", () => {
  it("are_those_that_have_several_copies_among_them", () => {
    const resolved = {
      body: [
        { name: "a", group: ["all", "one"] },
        { name: "b", group: "all" },
        { name: "c", shape: {} },
        { name: "d", copies: { grid: {} } },
      ],
    };
    const bodies = ["a", "b-0", "b-1", "c", "d-0", "d-1"].map((name) => bodyNamed(name));
    expect([...groupsOf(headerOf({ bodies, resolved }))]).toEqual([
      ["all", [0, 1, 2]],
      ["d", [4, 5]],
    ]);
  });
});
