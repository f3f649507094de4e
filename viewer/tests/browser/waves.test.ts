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

/** Four balls of 1 kg in a row with free ends, on springs of 100 N/m; rows stand side by side without end. */
const RIBBON = `
title = "ribbon"
world = { gravity = [0, 0, 0] }
time = { end = 0.05, sample = 0.01 }
lattice = { cell = [[1, 0, 0], [0, 1, 0]], repeat = [2, 4, 1], periodic = [true, false] }
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 1
[[spring]]
between = ["ball", "ball"]
cell = [0, 1, 0]
stiffness = 100
rest_length = 1
`;

it("tells_at_which_edge_of_a_ribbon_a_wave_runs_and_draws_all_of_it", async () => {
  writeFileSync(join(folder, "ribbon.toml"), RIBBON);
  const server = await served("ribbon.toml");
  const { page, problems, close } = await opened(server.url);
  await page.getByRole("tab", { name: "Bands" }).click();
  const drawing = page.getByRole("img", { name: "bands" });
  await page.getByText("Click a point of a band").waitFor();
  const keys = page.locator(".bands .legend");
  expect(await keys.textContent()).toContain("translation");
  await page.getByRole("combobox", { name: "colours of bands" }).selectOption("the edges along vector 2");
  expect(await keys.textContent()).toBe("both edgesinside");
  // The highest branch: both ends move least, ω = 20 sin(3π/8), shares ½ cos²(3π/8) at each.
  await drawing.click({ position: { x: (await drawing.boundingBox())!.width * 0.5, y: 20 } });
  await page.getByRole("button", { name: "Back to the run" }).waitFor();
  expect(await page.locator(".bands [role=status]").textContent()).toMatch(
    /branch 23: ω = 18\.4776 rad\/s; translation has 100 % of the energy, inside has 85\.4 % of the energy\.$/,
  );
  expect(await page.locator(".toolbar").textContent()).toContain("32 bodies");
  await page.keyboard.press("Space");
  const period = await lastTime(page);
  const still = await pixelsAt(page, 0);
  expect(differing(still, await pixelsAt(page, period / 2))).toBeGreaterThan(100);
  expect(problems).toEqual([]);
  await close();
  await server.stop();
});
