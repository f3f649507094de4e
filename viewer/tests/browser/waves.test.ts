// A lattice that is watched: its bands, and a wave of them in the picture.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";
import { differing, lastTime, opened, pixelsAt } from "./browser";
import { folder, served } from "./program";

const CHAIN = `
title = "bars"
world = { gravity = [0, 0, 0] }
time = { end = 0.05, sample = 0.01 }
lattice = { cell = [[0.3, 0, 0]] }
[[body]]
name = "bar"
shape = { box = { size = [0.2, 0.2, 0.1] } }
density = 250
${[0.1, -0.1]
  .map(
    (side) => `
[[spring]]
between = ["bar", "bar"]
cell = [1, 0, 0]
points = [[0.1, ${side}, 0], [-0.1, ${side}, 0]]
stiffness = 50
rest_length = 0.1`,
  )
  .join("")}
`;

it("moves_some_cells_as_the_wave_of_the_band_that_is_clicked", async () => {
  writeFileSync(join(folder, "chain.toml"), CHAIN);
  const server = await served("chain.toml");
  const { page, problems, close } = await opened(server.url);
  await page.getByRole("tab", { name: "Bands" }).click();
  const drawing = page.getByRole("img", { name: "bands" });
  await page.getByText("Click a point of a band").waitFor();
  expect(await drawing.locator("polyline").count()).toBeGreaterThanOrEqual(6);
  // The right end of the highest branch: turns, ω = 2b √(2k/I) with b 10 cm, k 50 N/m, I 1/150 kg m².
  await drawing.click({ position: { x: (await drawing.boundingBox())!.width * 0.97, y: 20 } });
  await page.getByRole("button", { name: "Back to the run" }).waitFor();
  expect(await page.locator(".bands [role=status]").textContent()).toMatch(
    /κ = \(0\.5, 0, 0\), branch 5: ω = 24\.4949 rad\/s; rotation has 100 %/,
  );
  expect(await page.locator(".mode").textContent()).toBe("wave");
  expect(await page.evaluate(() => window.gyration.rows)).toBe(49);
  await page.keyboard.press("Space");
  const period = await lastTime(page);
  expect(period).toBeCloseTo((2 * Math.PI) / 24.4949, 6);
  const still = await pixelsAt(page, 0);
  // At opposite phases bars are turned to opposite sides, a period later as they were.
  expect(differing(still, await pixelsAt(page, period / 2))).toBeGreaterThan(100);
  expect(differing(still, await pixelsAt(page, period))).toBe(0);
  await page.getByRole("button", { name: "Back to the run" }).click();
  await expect.poll(() => page.locator(".mode").textContent()).toBe("live");
  expect(await page.evaluate(() => window.gyration.rows)).toBe(6);
  expect(problems).toEqual([]);
  await close();
  await server.stop();
});
