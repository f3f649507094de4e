// A built site in Chromium: GYRATION_SITE is its folder, with the engine, the gallery and the hashes.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { GalleryScene } from "../../src/site/gallery";
import { differing, opened, pixelsAt } from "../browser/browser";
import { hosted } from "./server";

const SITE = process.env.GYRATION_SITE;

const rows = (page: Page) => page.evaluate(() => window.gyration.rows);
const verdict = (page: Page) => page.locator(".verdict").textContent();

describe.skipIf(!SITE)("the site", () => {
  const folder = SITE ?? "";
  let site = "";
  let hashes: Record<string, string> = {};

  beforeAll(async () => {
    site = await hosted(folder);
    hashes = JSON.parse(readFileSync(join(folder, "hashes.json"), "utf8"));
  });

  it("runs_a_scene_of_the_gallery_and_gets_the_numbers_of_the_build", async () => {
    const { page, problems, close } = await opened(`${site}?scene=bounce`);
    await expect.poll(() => rows(page)).toBeGreaterThan(60);
    await expect.poll(() => page.evaluate(() => window.gyration.time)).toBeGreaterThan(0.05);
    expect(differing(await pixelsAt(page, 0), await pixelsAt(page, 0.3))).toBeGreaterThan(50);
    await expect.poll(() => verdict(page)).toContain(`hash ${hashes.bounce}`);
    expect(await verdict(page)).toContain("bit for bit");
    expect(await page.getByRole("tab", { name: "Bands" }).count()).toBe(0);
    expect(problems).toEqual([]);
    await close();
  });

  it("runs_where_the_server_does_not_know_the_type_of_the_engine", async () => {
    const other = await hosted(folder, { ".wasm": "application/octet-stream" });
    const { page, problems, close } = await opened(`${other}?scene=bounce&set=time.end=0.2`);
    await expect.poll(() => rows(page)).toBe(21);
    // With another end there is nothing to compare with.
    await expect.poll(() => verdict(page)).toMatch(/^hash [0-9a-f]{16}$/);
    expect(problems).toEqual([]);
    await close();
  });

  it("starts_again_with_the_number_that_is_dragged_and_writes_it_into_the_address", async () => {
    const first = await opened(`${site}?scene=bounce&set=time.end=0.3`);
    await first.page.getByRole("tab", { name: "Sliders" }).click();
    await first.page.getByRole("searchbox").fill("velocity.x");
    await first.page.getByRole("slider", { name: "body.ball.velocity.x", exact: true }).fill("900");
    const address = "?scene=bounce&set=time.end=0.3&set=body.ball.velocity=%5B0.72,%200,%200%5D";
    await expect.poll(() => first.page.url()).toContain(address);
    await expect.poll(() => verdict(first.page)).toMatch(/^hash [0-9a-f]{16}$/);
    const found = await verdict(first.page);
    const second = await opened(first.page.url());
    await expect.poll(() => verdict(second.page)).toBe(found);
    expect([...first.problems, ...second.problems]).toEqual([]);
    await first.close();
    await second.close();
  });

  it("names_a_number_that_is_refused_and_goes_on", async () => {
    const { page, problems, close } = await opened(`${site}?scene=bounce&set=time.end=0.3`);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await page.getByRole("searchbox").fill("density");
    const density = page.getByRole("textbox", { name: "body.ball.density, exact" });
    await density.fill("-5");
    await density.press("Enter");
    await expect
      .poll(() => page.locator(".slider .reason").textContent())
      .toContain("must be greater than 0");
    expect(page.url()).not.toContain("density");
    expect(await rows(page)).toBeGreaterThan(0);
    expect(problems).toEqual([]);
    await close();
  });

  it("runs_an_edited_text_and_shows_an_error_with_its_caret", async () => {
    const { page, problems, close } = await opened(`${site}?scene=bounce`);
    await expect.poll(() => verdict(page)).toContain("bit for bit");
    await page.getByRole("tab", { name: "Scene" }).click();
    const editor = page.getByRole("textbox", { name: "Scene" });
    const text = await editor.inputValue();
    await editor.fill(text.replace("density = 1000", "density = -5"));
    await editor.press("Control+Enter");
    const refusal = page.locator("#scene-refusal pre");
    await expect.poll(() => refusal.textContent()).toMatch(/^ *\d+ \| density = -5\n.*\^/m);
    expect(await editor.getAttribute("aria-invalid")).toBe("true");
    expect(await verdict(page)).toContain("bit for bit");
    await editor.fill(text.replace("end = 6.0", "end = 0.1"));
    await page.getByRole("button", { name: "Run", exact: true }).click();
    await expect.poll(() => rows(page)).toBe(11);
    await expect.poll(() => verdict(page)).toMatch(/^hash [0-9a-f]{16}$/);
    expect(await refusal.count()).toBe(0);
    // The numbers of the edited text have sliders.
    await page.getByRole("tab", { name: "Sliders" }).click();
    await page.getByRole("searchbox").fill("time.end");
    expect(await page.getByRole("textbox", { name: "time.end, exact" }).inputValue()).toBe("0.1");
    await page.getByRole("tab", { name: "Scene" }).click();
    await page.getByRole("button", { name: "Back to the gallery's text" }).click();
    expect(await editor.inputValue()).toBe(text);
    expect(problems).toEqual([]);
    await close();
  });

  it("saves_the_run_as_a_table_and_as_an_animation_also_by_keys", async () => {
    const { page, problems, close } = await opened(`${site}?scene=bounce&set=time.end=0.1`);
    await expect.poll(() => verdict(page)).toMatch(/^hash [0-9a-f]{16}$/);
    const saved = async (name: RegExp) => {
      const coming = page.waitForEvent("download");
      await page.getByRole("group", { name: "save" }).getByRole("button", { name }).press("Enter");
      const file = await coming;
      return [file.suggestedFilename(), readFileSync(await file.path())] as const;
    };
    const [table, text] = await saved(/table/);
    expect(table).toBe("bounce.csv");
    // A line of names, and one each hundredth of a second.
    expect(text.toString().split("\n")).toHaveLength(1 + 11 + 1);
    const [motion, bytes] = await saved(/animation/);
    expect(motion).toBe("bounce.glb");
    expect(bytes.subarray(0, 4).toString()).toBe("glTF");
    await expect
      .poll(() => page.locator(".save [role=status]").textContent())
      .toMatch(/^bounce\.glb: .* MB$/);
    expect(problems).toEqual([]);
    await close();
  });

  it("runs_a_scene_and_its_mesh_that_are_dropped_on_the_page_or_chosen", async () => {
    const wedge = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const scenes: GalleryScene[] = JSON.parse(readFileSync(join(folder, "gallery.json"), "utf8"));
    const text = scenes
      .find(({ name }) => name === "bounce")!
      .text.replace(/shape = .*/, 'shape = { mesh = { file = "wedge.obj" } }')
      .replace("end = 6.0", "end = 0.1");
    const drop = async (page: Page, files: [string, string][]) => {
      const data = await page.evaluateHandle((given) => {
        const transfer = new DataTransfer();
        for (const [name, content] of given) transfer.items.add(new File([content], name));
        return transfer;
      }, files);
      await page.dispatchEvent("body", "drop", { dataTransfer: data });
    };
    const { page, problems, close } = await opened(`${site}?scene=bounce&set=time.end=0.2`);
    await expect.poll(() => rows(page)).toBe(21);
    await drop(page, [["mine.toml", text]]);
    const refusal = page.locator("#scene-refusal pre");
    await expect.poll(() => refusal.textContent()).toContain("drop the file on the page");
    await drop(page, [["wedge.obj", wedge]]);
    await expect.poll(() => rows(page)).toBe(11);
    expect(await refusal.count()).toBe(0);
    // From the gallery, by the button.
    await page.getByRole("link", { name: "Gallery" }).click();
    await page.locator("input[type=file]").setInputFiles([
      { name: "mine.toml", mimeType: "", buffer: Buffer.from(text) },
      { name: "wedge.obj", mimeType: "", buffer: Buffer.from(wedge) },
    ]);
    await page.waitForFunction(() => window.gyration?.rows === 11);
    expect(page.url()).not.toContain("scene=");
    expect(problems).toEqual([]);
    await close();
  });

  it("pauses_and_resumes", async () => {
    const { page, problems, close } = await opened(`${site}?scene=shaker&set=time.end=600`);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await page.getByRole("button", { name: "Pause the run" }).click();
    await page.getByRole("button", { name: "Resume the run" }).waitFor();
    const halted = await rows(page);
    await page.waitForTimeout(300);
    expect(await rows(page)).toBe(halted);
    await page.getByRole("button", { name: "Resume the run" }).click();
    await expect.poll(() => rows(page)).toBeGreaterThan(halted);
    expect(problems).toEqual([]);
    await close();
  });

  it("leads_to_the_gallery_and_back_also_from_a_scene_that_is_not_there", async () => {
    const { page, problems, close } = await opened(`${site}?scene=bounce&set=time.end=0.1`);
    await page.getByRole("link", { name: "Gallery" }).click();
    await page.getByRole("navigation", { name: "scenes" }).waitFor();
    const names = await page.getByRole("navigation", { name: "scenes" }).getByRole("link").allTextContents();
    const scenes = JSON.parse(readFileSync(join(folder, "gallery.json"), "utf8"));
    expect(names).toHaveLength(scenes.length);
    await page.goto(`${site}?scene=nothing`);
    expect(await page.getByRole("alert").textContent()).toContain('There is no scene "nothing"');
    await page.getByRole("link", { name: /^dice / }).click();
    await page.waitForFunction(() => window.gyration !== undefined);
    await page.evaluate(() => window.gyration.ready);
    expect(page.url()).toContain("?scene=dice");
    expect(problems).toEqual([]);
    await close();
  });
});
