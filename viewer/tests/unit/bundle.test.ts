// The built page: one file, small enough, that asks for nothing.

import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";

const PAGE = join(import.meta.dirname, "../../dist/index.html");

describe.skipIf(!existsSync(PAGE))("the built page", () => {
  const html = existsSync(PAGE) ? readFileSync(PAGE, "utf8") : "";

  it("is_smaller_than_a_megabyte", () => {
    expect(html.length).toBeLessThan(1e6);
  });

  it("has_the_place_for_data_once_and_before_the_script", () => {
    expect(html.split("<!--gyration-data-->")).toHaveLength(2);
    expect(html.indexOf("<!--gyration-data-->")).toBeLessThan(html.indexOf('<script type="module"'));
  });

  it("loads_nothing_from_anywhere", () => {
    expect(html).not.toMatch(/<(script|link|img)[^>]+(src|href)="(?!data:)/);
  });
});
