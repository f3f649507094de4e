// What a reader does with a report: scrub, click, press keys, look into panels, switch to dark, hold a phone.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { browser, DESK, differing, lastTime, type Opened, opened, PHONE, pixelsAt } from "./browser";
import { folder, interrupted, recorded, reported } from "./program";

let dice = "";
let ball = "";
/** The report of the dice, opened once for all that leave it as they found it. */
let shared: Opened;

beforeAll(async () => {
  dice = reported(recorded("dice", "time.end=0.5"));
  ball = reported(recorded("elastic-bounce", "time.end=0.3"));
  shared = await opened(dice);
});
afterAll(async () => {
  expect(shared.problems).toEqual([]);
  await shared.close();
});

/** Where the line for the time stands in the first chart [px]. */
const CURSOR = () => {
  const line = document.querySelector<HTMLElement>(".time-cursor")!;
  return line.getBoundingClientRect().left;
};

describe("a report", () => {
  it("runs_no_script_but_its_own", async () => {
    const path = join(folder, "foreign.html");
    const foreign = "<script>document.title = 'foreign'</script>";
    writeFileSync(
      path,
      readFileSync(dice, "utf8").replace("</head>", () => `${foreign}</head>`),
    );
    const { page, problems, close } = await opened(path);
    expect(await page.title()).not.toBe("foreign");
    expect(problems).toHaveLength(1);
    expect(problems[0]).toContain("Content Security Policy");
    await close();
  });

  it("tells_an_open_ledger_in_its_head_and_beside_the_outcome", async () => {
    const path = join(folder, "open.html");
    writeFileSync(path, readFileSync(dice, "utf8").replace('"ledger":"closed"', '"ledger":"open"'));
    const told = await opened(path);
    for (const { page } of [told, shared]) {
      const isOpen = page === told.page;
      await page.getByRole("tab", { name: "Summary" }).click();
      expect((await page.locator(".chip").textContent()) === "energy ledger open").toBe(isOpen);
      expect(
        (await page.locator("#panel-summary").textContent())!.includes("Energy ledger open: residual "),
      ).toBe(isOpen);
    }
    await shared.page.getByRole("tab", { name: "Plots" }).click();
    expect(told.problems).toEqual([]);
    await told.close();
  });

  it("of_a_run_that_was_stopped_says_interrupted", async () => {
    const file = reported(await interrupted("shaker", "time.end=600"));
    const { page, problems, close } = await opened(file);
    expect(await page.locator(".chip").textContent()).toBe("interrupted");
    await page.getByRole("tab", { name: "Summary" }).click();
    const told = (await page.locator("#panel-summary .outcome").textContent())!;
    expect(told).toContain("Interrupted at t = ");
    expect(told).not.toContain("Running");
    expect(problems).toEqual([]);
    await close();
  });

  it("counts_one_body_as_one", async () => {
    const { page } = shared;
    const words = await page.evaluate(() => document.body.textContent ?? "");
    expect(words).not.toMatch(/\b1 (bodies|samples|steps)\b/);
  });

  it("moves_the_cursor_of_the_plots_with_the_scrubber", async () => {
    const { page } = shared;
    await page.waitForSelector(".time-cursor");
    const places: number[] = [];
    for (const part of ["0.1", "0.25", "0.4"]) {
      await page.getByRole("slider", { name: "time" }).fill(part);
      places.push(await page.evaluate(CURSOR));
      expect(await page.evaluate(() => window.gyration.time)).toBeCloseTo(Number(part), 6);
    }
    // Equal steps of the scrubber are equal steps of the cursor.
    expect(places[1] - places[0]).toBeGreaterThan(20);
    expect(Math.abs(places[2] - places[1] - (places[1] - places[0]))).toBeLessThan(2);
  });

  it("goes_to_the_time_that_is_clicked_in_a_plot", async () => {
    const { page } = shared;
    const over = page.locator(".u-over").first();
    await over.waitFor();
    const { width, height } = (await over.boundingBox())!;
    await over.click({ position: { x: 0.6 * width, y: 0.5 * height } });
    const time = await page.evaluate(() => window.gyration.time);
    // A sample is 5 ms apart from the next.
    expect(Math.abs(time - 0.6 * (await lastTime(page)))).toBeLessThan(0.006);
  });

  it("zooms_all_plots_by_a_drag_and_back_by_a_double_click", async () => {
    const { page } = shared;
    const over = page.locator(".u-over").first();
    await over.waitFor();
    const { x, y, width, height } = (await over.boundingBox())!;
    const places = () =>
      page.evaluate(() =>
        [...document.querySelectorAll<HTMLElement>(".time-cursor")].map((line) => line.style.display),
      );
    await page.evaluate(() => window.gyration.seek(0));
    await page.mouse.move(x + 0.4 * width, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + 0.8 * width, y + height / 2, { steps: 5 });
    await page.mouse.up();
    expect(new Set(await places())).toEqual(new Set(["none"]));
    await over.dblclick();
    await expect.poll(async () => new Set(await places())).toEqual(new Set([""]));
  });

  it("obeys_keys", async () => {
    const { page } = shared;
    const time = () => page.evaluate(() => window.gyration.time);
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    expect(await time()).toBeCloseTo(0.01, 9);
    await page.keyboard.press("ArrowLeft");
    expect(await time()).toBeCloseTo(0.005, 9);
    await page.keyboard.press("End");
    expect(await time()).toBe(await lastTime(page));
    await page.keyboard.press("Home");
    expect(await time()).toBe(0);
    await page.keyboard.press("Space");
    await expect.poll(time).toBeGreaterThan(0.02);
    await page.keyboard.press("Space");
    const stopped = await time();
    const frames = await page.evaluate(async () => {
      const before = window.gyration.frame;
      for (let k = 0; k < 20; k++) await new Promise(requestAnimationFrame);
      return window.gyration.frame - before;
    });
    expect(await time()).toBe(stopped);
    expect(frames, "frames drawn while nothing changes").toBeLessThanOrEqual(1);
    await page.keyboard.press("?");
    await page.getByRole("dialog", { name: "help" }).waitFor();
    await page.keyboard.press("Escape");
  });

  it("tells_outcome_ledger_bodies_solver_scene_and_provenance", async () => {
    const { page } = shared;
    await page.getByRole("tab", { name: "Summary" }).click();
    const words = (await page.locator("#panel-summary").textContent()) ?? "";
    for (const part of [
      "reached its end",
      "energy in play",
      "die",
      "Euler tensor",
      "explicit steps",
      "gyration 0.",
    ]) {
      expect(words).toContain(part);
    }
    await page.getByRole("tab", { name: "Scene" }).click();
    const scene = page.locator("#panel-scene .code");
    expect(await scene.textContent()).toContain('title = "A die thrown on a table"');
    await page.getByRole("button", { name: "Resolved" }).click();
    expect(await scene.textContent()).toContain('"nu": 6');
    await page.getByRole("tab", { name: "Plots" }).click();
  });

  it("colours_by_stretch_and_says_why_it_cannot", async () => {
    const choice = shared.page.getByRole("combobox", { name: "colouring" });
    const stretch = choice.locator("option[value=stretch]");
    expect(await stretch.isDisabled()).toBe(true);
    expect(await stretch.textContent()).toContain("Rigid bodies");

    const { page, problems, close } = await opened(ball);
    const end = await lastTime(page);
    const before = await pixelsAt(page, 0.9 * end);
    await page.getByRole("combobox", { name: "colouring" }).selectOption("stretch");
    expect(differing(before, await pixelsAt(page, 0.9 * end))).toBeGreaterThan(50);
    await page.getByRole("img", { name: "colour bar" }).waitFor();
    expect(await page.getByRole("img", { name: "colour bar" }).textContent()).toContain("Greatest stretch");
    expect(problems).toEqual([]);
    await close();
  });

  it("draws_arrows_axes_trails_and_skins_when_asked", async () => {
    const { page, problems, close } = await opened(ball);
    const at = 0.5 * (await lastTime(page));
    for (const key of ["v", "a", "t", "o"]) {
      // Every column: a trail is one pixel wide, and falls along one.
      const without = await pixelsAt(page, at, 1, 8);
      await page.keyboard.press(key);
      expect(differing(without, await pixelsAt(page, at, 1, 8)), `key ${key}`).toBeGreaterThan(0);
      await page.keyboard.press(key);
    }
    expect(problems).toEqual([]);
    await close();
  });

  it("is_dark_or_light_as_the_system_is_and_can_be_switched", async () => {
    const background = () => getComputedStyle(document.body).backgroundColor;
    const light = shared;
    const dark = await opened(dice, { ...DESK, colorScheme: "dark" });
    expect(await light.page.evaluate(background)).not.toBe(await dark.page.evaluate(background));
    expect(differing(await pixelsAt(light.page, 0), await pixelsAt(dark.page, 0))).toBeGreaterThan(1000);
    await dark.page.keyboard.press("d");
    expect(await dark.page.evaluate(background)).toBe(await light.page.evaluate(background));
    await dark.close();
  });

  it("fits_a_phone_without_scrolling_sideways", async () => {
    const { page, problems, close } = await opened(dice, PHONE);
    for (const tab of ["Plots", "Summary", "Scene"]) {
      await page.getByRole("tab", { name: tab }).click();
      const over = await page.evaluate(
        () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
      );
      expect(over, tab).toBeLessThanOrEqual(0);
      const out = await page.evaluate(() =>
        [...document.querySelectorAll("button, select, input, h1")]
          .filter((element) => element.getClientRects().length > 0)
          .filter((element) => element.getBoundingClientRect().right > innerWidth + 1)
          .map((element) => element.outerHTML.slice(0, 80)),
      );
      expect(out, `controls beyond the edge, ${tab}`).toEqual([]);
    }
    expect(problems).toEqual([]);
    await close();
  });

  it("gives_every_control_a_name", async () => {
    const { page } = shared;
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll("button, select, input")]
        .filter((element) => !element.getAttribute("aria-label") && !element.textContent?.trim())
        .map((element) => element.outerHTML.slice(0, 80)),
    );
    expect(nameless).toEqual([]);
  });

  it("is_gone_through_by_keys_alone", async () => {
    const { page } = shared;
    await page.getByRole("tab", { name: "Plots" }).focus();
    const focused = () =>
      page.evaluate(() => {
        const { outlineStyle } = getComputedStyle(document.activeElement!);
        return [document.activeElement!.textContent, outlineStyle === "none" ? "unseen" : "seen"];
      });
    await page.keyboard.press("ArrowRight");
    expect(await focused()).toEqual(["Summary", "seen"]);
    expect(await page.locator("#panel-summary").isVisible()).toBe(true);
    await page.keyboard.press("Home");
    expect(await focused()).toEqual(["Plots", "seen"]);
    // Arrows in the bar of panels are not those of the clock.
    await page.evaluate(() => window.gyration.seek(0.1));
    await page.keyboard.press("End");
    await page.keyboard.press("Home");
    expect(await page.evaluate(() => window.gyration.time)).toBeCloseTo(0.1, 9);
    const before = await pixelsAt(page, 0.1);
    await page.keyboard.press("Shift+ArrowRight");
    expect(differing(before, await pixelsAt(page, 0.1))).toBeGreaterThan(100);
    await page.keyboard.press("Shift+ArrowLeft");
    expect(differing(before, await pixelsAt(page, 0.1))).toBeLessThan(20);
  });

  it("is_found_again_by_its_address", async () => {
    const { page } = shared;
    for (const key of ["c", "g", "f", "Shift+ArrowUp", "+"]) await page.keyboard.press(key);
    await page.getByRole("tab", { name: "Summary" }).click();
    const seen = await pixelsAt(page, 0.2);
    await expect
      .poll(() => page.evaluate(() => location.hash))
      .toMatch(/^#t=0\.2\d*&show=forces,joints&follow=0&camera=[-\d.,e]+&panel=Summary$/);
    const link = await page.evaluate(() => location.hash);
    const again = await opened(`${dice}${link}`);
    expect(await again.page.evaluate(() => window.gyration.time)).toBeCloseTo(0.2, 9);
    expect(await again.page.locator("#panel-summary").isVisible()).toBe(true);
    // What it writes itself, once anything has changed, is the same.
    await again.page.evaluate(() => history.replaceState(null, "", `${location.hash}&of=others`));
    for (const _ of "to") await again.page.keyboard.press("v");
    await expect.poll(() => again.page.evaluate(() => location.hash)).toBe(link.replace("#", "#of=others&"));
    expect(differing(seen, await pixelsAt(again.page, 0.2))).toBeLessThan(20);
    // Without it all is as it begins.
    await again.page.evaluate(() => {
      location.hash = "";
    });
    await expect.poll(() => again.page.evaluate(() => window.gyration.time)).toBe(0);
    const follows = again.page.getByRole("button", { name: "Follow the body" });
    expect(await follows.getAttribute("aria-pressed")).toBe("true");
    expect(again.problems).toEqual([]);
    await again.close();
    await page.evaluate(() => {
      location.hash = "";
    });
    await expect.poll(() => page.evaluate(() => window.gyration.time)).toBe(0);
  });

  it("shows_plots_without_webgl_and_says_so", async () => {
    const blind = browser(["--disable-3d-apis"]);
    const { page, close } = await opened(dice, DESK, { on: blind });
    expect(await page.locator(".no-webgl").textContent()).toContain("no WebGL");
    await page.waitForSelector(".time-cursor");
    await page.keyboard.press("End");
    expect(await page.evaluate(() => window.gyration.time)).toBe(await lastTime(page));
    await close();
    await (await blind).close();
  });

  it("that_was_cut_short_says_so_in_words", async () => {
    const text = readFileSync(dice, "utf8").replace(/(data-blob="position">.{40})[^<]*/, "$1");
    const cut = join(folder, "cut.html");
    writeFileSync(cut, text);
    const { page, close } = await opened(cut, DESK, { ready: false });
    await page.locator(".banner.error").waitFor();
    expect(await page.locator(".banner.error").textContent()).toContain('"position"');
    await close();
  });
});
