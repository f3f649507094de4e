import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { withoutUnused } from "../../shaders.ts";

const LIBRARY = readFileSync(
  join(import.meta.dirname, "../../node_modules/three/build/three.module.js"),
  "utf8",
);

/** The text of a shader, or of a part of one. */
function shader(library: string, name: string): string {
  const variable = library.match(new RegExp(`^\\t${name}: ([\\w$]+)`, "m"))![1]!;
  const start = `${variable} = `;
  const line = library.split("\n").find((line) => line.replace(/^(var|const) /, "").startsWith(start))!;
  return line.slice(line.indexOf('"'), line.lastIndexOf('"') + 1);
}

test("what a material of the page includes stays, and no more", () => {
  const kept = withoutUnused(LIBRARY, "new MeshBasicMaterial()");
  for (const name of ["meshbasic_frag", "meshbasic_vert", "common", "colorspace_fragment", "color_vertex"])
    expect(shader(kept, name)).toBe(shader(LIBRARY, name));
  for (const name of ["meshphysical_frag", "points_vert", "lights_physical_pars_fragment"]) {
    expect(shader(LIBRARY, name).length).toBeGreaterThan(100);
    expect(shader(kept, name)).toBe('""');
  }
  expect(LIBRARY.length - kept.length).toBeGreaterThan(80_000);
});

test("a material more brings its shaders, and a shader of the page what it includes", () => {
  const lit = withoutUnused(LIBRARY, "new MeshStandardMaterial()");
  const points = withoutUnused(LIBRARY, "new PointsMaterial()");
  expect(shader(points, "points_frag")).toBe(shader(LIBRARY, "points_frag"));
  expect(shader(points, "meshbasic_frag")).toBe('""');
  expect(shader(lit, "lights_physical_pars_fragment").length).toBeGreaterThan(10_000);
  expect(
    shader(withoutUnused(LIBRARY, "#include <shadowmap_vertex>"), "shadowmap_vertex").length,
  ).toBeGreaterThan(100);
});

test("a shader that the library lacks is an error", () => {
  expect(() => withoutUnused(LIBRARY, "#include <no_such_part>")).toThrow("no shader no_such_part");
  expect(() => withoutUnused("", "")).toThrow("const ShaderChunk");
});
