// Fields of a recording: a map in the picture that follows the time, and what is told where there is none.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";
import { differing, opened, PHONE, pixelsAt } from "./browser";
import { folder, recorded, served } from "./program";

/** Four balls in a row on springs; the first flies at the others. */
const BALLS = `
title = "balls"
world = { gravity = [0, 0, 0] }
time = { end = 0.2, sample = 0.1 }
${[0, 1, 2, 3]
  .map(
    (k) => `
[[body]]
name = "b${k}"
shape = { sphere = { radius = 0.05 } }
mass = 1
position = [${0.2 * k}, 0, 0]
velocity = [${k === 0 ? 1 : 0}, 0, 0]`,
  )
  .join("")}
${[0, 1, 2]
  .map(
    (k) => `
[[spring]]
between = ["b${k}", "b${k + 1}"]
stiffness = 50
rest_length = 0.2`,
  )
  .join("")}
`;
const MEETING = `${BALLS}
[[contact]]
between = ["b0", "b1"]
repulsion = { alpha = 1e-9, nu = 6 }
`;

it("are_a_map_in_the_picture_that_follows_the_time_and_stands_in_the_address", async () => {
  writeFileSync(join(folder, "balls.toml"), BALLS);
  const server = await served(recorded("balls.toml"));
  const { page, problems, close } = await opened(server.url);
  const without = await pixelsAt(page, 0.1);
  await page.getByRole("tab", { name: "Fields" }).click();
  const said = page.locator(".fields [role=status]");
  await expect.poll(() => said.textContent()).toMatch(/^At t = 100 ms, seen with b = 40\d* mm, the density/);
  expect(differing(without, await pixelsAt(page, 0.1))).toBeGreaterThan(1000);
  const bar = page.getByRole("img", { name: "colours of fields" });
  await expect.poll(() => bar.textContent()).toContain("Density [kg/m³]");

  await page.getByRole("combobox", { name: "field" }).selectOption("pressure");
  await expect.poll(() => bar.textContent()).toContain("Pressure −tr σ/3 [mPa]");
  const early = await said.textContent();
  const pressed = await pixelsAt(page, 0.1);
  await page.evaluate(() => window.gyration.seek(0.2));
  await expect.poll(() => said.textContent()).toMatch(/^At t = 200 ms/);
  expect(await said.textContent()).not.toBe(early);
  expect(differing(pressed, await pixelsAt(page, 0.2))).toBeGreaterThan(100);

  const width = page.getByRole("textbox", { name: "width in metres" });
  await width.fill("wide");
  await width.press("Enter");
  await expect.poll(() => said.textContent()).toContain("“wide” is no width");
  await width.fill("0.1");
  await width.press("Enter");
  await expect.poll(() => said.textContent()).toMatch(/^At t = 200 ms, seen with b = 100 mm/);
  await expect.poll(() => page.url()).toMatch(/panel=Fields&field=pressure&width=0\.1$/);

  const again = await opened(page.url(), PHONE);
  const told = again.page.locator(".fields [role=status]");
  await expect.poll(() => told.textContent()).toBe(await said.textContent());
  expect([...problems, ...again.problems]).toEqual([]);
  await again.close();

  const shown = await pixelsAt(page, 0.2);
  await page.getByRole("checkbox", { name: "show in the picture" }).uncheck();
  expect(differing(shown, await pixelsAt(page, 0.2))).toBeGreaterThan(1000);
  await expect.poll(() => bar.isHidden()).toBe(true);
  await close();
  await server.stop();
});

it("say_what_the_scene_must_record_where_there_are_none", async () => {
  writeFileSync(join(folder, "meeting.toml"), MEETING);
  const server = await served(recorded("meeting.toml"));
  const { page, close } = await opened(server.url);
  await page.getByRole("tab", { name: "Fields" }).click();
  await expect
    .poll(() => page.locator(".fields [role=status]").textContent())
    .toMatch(/^Bodies meet.* write record = \{ pairs = true \} in the scene, and run it anew\.$/);
  await close();
  await server.stop();
  const live = await served("meeting.toml");
  const watched = await opened(live.url);
  expect(await watched.page.getByRole("tab", { name: "Fields" }).count()).toBe(0);
  await watched.close();
  await live.stop();
});
