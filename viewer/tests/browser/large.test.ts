// Large recordings: a thousand bodies, a hundred thousand samples. What a step of the scrubber takes is printed.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { colors, lastTime, opened, pixelsAt } from "./browser";
import { folder, recorded, reported, served } from "./program";

const STEPS = 15;

/** A step of the scrubber with the frame drawn to its last pixel: median and fastest [ms]. */
async function stepTimes(page: Page): Promise<[number, number]> {
  const end = await lastTime(page);
  const times = await page.evaluate(
    ([last, steps]) => {
      const canvas = document.querySelector<HTMLCanvasElement>(".picture canvas")!;
      const gl = canvas.getContext("webgl2")!;
      const pixel = new Uint8Array(4 * 64 * 64);
      return Array.from({ length: steps }, (_, k) => {
        const began = performance.now();
        window.gyration.seek((last * (k + 1)) / steps);
        window.gyration.renderNow();
        gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return performance.now() - began;
      });
    },
    [end, STEPS],
  );
  times.sort((a, b) => a - b);
  return [times[STEPS >> 1], times[0]];
}

/** Balls and boxes in a lattice above a table. */
function crowd(side: number, layers: number): string {
  const bodies: string[] = [];
  for (let k = 0; k < side * side * layers; k++) {
    const [i, j, layer] = [k % side, Math.floor(k / side) % side, Math.floor(k / (side * side))];
    const shape = k % 2 ? "sphere = { radius = 0.02 }" : "box = { size = [0.03, 0.03, 0.03] }";
    const at = [0.06 * i, 0.06 * j, 0.05 + 0.06 * layer].map((value) => value.toFixed(3)).join(", ");
    bodies.push(`[[body]]
name = "b${k}"
shape = { ${shape} }
density = 1000
position = [${at}]
angular_velocity = [${k % 7}, ${k % 5}, ${k % 3}]`);
  }
  return `title = "A crowd"
[time]
end = 0.05
sample = 0.005
[[support]]
name = "table"
plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
[[contact]]
support = "table"
repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
${bodies.join("\n")}
`;
}

describe("large recordings", () => {
  it("a_thousand_bodies_are_drawn", async () => {
    const scene = join(folder, "crowd.toml");
    writeFileSync(scene, crowd(10, 10));
    const file = reported(recorded(scene));
    const { page, problems, close } = await opened(file);
    // A blank page has a handful.
    expect(colors(await pixelsAt(page, 0.02))).toBeGreaterThan(20);
    const [median, fastest] = await stepTimes(page);
    console.log(`1000 bodies: a step takes ${median.toFixed(0)} ms, at best ${fastest.toFixed(0)} ms`);
    await page.keyboard.press("c");
    await page.getByRole("combobox", { name: "body" }).selectOption({ label: "b500" });
    await page.keyboard.press("f");
    await page.evaluate(() => window.gyration.renderNow());
    expect(problems).toEqual([]);
    await close();
  });

  // Ten thousand bodies that are written one by one have as many lines.
  it("a_scene_of_a_hundred_thousand_lines_is_opened_whole", async () => {
    const scene = join(folder, "long.toml");
    const text = `${"# a line\n".repeat(100_000)}${crowd(1, 1)}`;
    writeFileSync(scene, text);
    const { page, problems, close } = await opened(reported(recorded(scene)));
    await page.getByRole("tab", { name: "Scene" }).click();
    expect(await page.locator("pre.code").textContent()).toBe(text);
    expect(problems).toEqual([]);
    await close();
  });

  it("a_hundred_thousand_samples_are_scrubbed_and_plotted", async () => {
    const server = await served(recorded("bounce", "time.end=1", "time.sample=1e-5"));
    const { page, problems, close } = await opened(server.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(100_001);
    await page.waitForSelector(".time-cursor");
    const [median, fastest] = await stepTimes(page);
    console.log(`100 000 samples: a step takes ${median.toFixed(0)} ms, at best ${fastest.toFixed(0)} ms`);
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });
});
