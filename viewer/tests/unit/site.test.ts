// The address of a run of the site, and the verdict on its hash.

import { describe, expect, it } from "vitest";
import { addressIn, searchOf } from "../../src/site/address";
import { agreement } from "../../src/site/verdict";

describe("the address of a run", () => {
  it("tells_scene_and_overrides_as_they_were_set", () => {
    const address = {
      scene: "dice",
      set: ["body.die.velocity=[1, 0, -2.5e+3]", 'title="ä & b = 100 % + c#"', "time.end=(1)"],
    };
    const search = searchOf(address);
    expect(addressIn(search)).toEqual(address);
    expect(search).toMatch(/^\?scene=dice(&set=[\w.=,%-]+){3}$/);
    expect(searchOf({ scene: "dice", set: ["time.end=1"] })).toBe("?scene=dice&set=time.end=1");
  });

  it("is_read_however_it_was_written", () => {
    expect(addressIn("?other=1&set=a%3D1e+5&scene=rock&scene=dice&set=")).toEqual({
      scene: "rock",
      set: ["a=1e+5"],
    });
    expect(addressIn("?scene=100%")).toEqual({ scene: "100%", set: [] });
    expect(addressIn("")).toEqual({ scene: null, set: [] });
    expect(addressIn("?scene")).toEqual({ scene: null, set: [] });
  });
});

describe("a hash", () => {
  it("is_equal_or_another_only_where_there_is_one_to_compare_with", () => {
    expect(agreement("0123456789abcdef", "0123456789abcdef")).toBe("equal");
    expect(agreement("0123456789abcdef", "0123456789abcde0")).toBe("other");
    expect(agreement("0123456789abcdef", undefined)).toBe("unknown");
  });
});
