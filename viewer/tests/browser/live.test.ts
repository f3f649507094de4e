// A run that is watched: it streams, sliders start it again, errors are shown, a server that goes is missed and found.

import { describe, expect, it } from "vitest";
import { opened } from "./browser";
import { recorded, served } from "./program";

/** What Chromium's console says of a server that is gone is no error of the page. */
function ofThePage(problems: string[]): string[] {
  return problems.filter((problem) => !/WebSocket connection|ERR_CONNECTION_REFUSED/.test(problem));
}

describe("a live view", () => {
  it("streams_the_run_to_its_end_and_plays_it", async () => {
    const server = await served("dice", "--set", "time.end=0.4");
    const { page, problems, close } = await opened(server.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(81);
    await expect.poll(() => page.evaluate(() => window.gyration.time)).toBeGreaterThan(0.05);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await expect.poll(() => page.locator(".run-text").textContent()).toContain("reached its end");
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });

  it("starts_again_with_the_number_that_is_dragged", async () => {
    const server = await served("dice", "--set", "time.end=0.3");
    const { page, problems, close } = await opened(server.url);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await page.getByRole("searchbox").fill("velocity.x");
    const slider = page.getByRole("slider", { name: "body.die.velocity.x", exact: true });
    await slider.fill("900");
    await page.getByRole("tab", { name: "Scene" }).click();
    await expect
      .poll(() => page.locator("#panel-scene").textContent())
      .toContain("body.die.velocity=[1.2, 0, 0]");
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(61);
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });

  it("replays_from_the_start_when_a_number_changes_after_the_run_has_ended", async () => {
    const server = await served("dice", "--set", "time.end=0.1");
    const { page, problems, close } = await opened(server.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(21);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await expect.poll(() => page.locator(".run-text").textContent()).toContain("reached its end");
    // Played to its end, which is the end of the playback too.
    await page.keyboard.press("l");
    await page.getByRole("button", { name: "Play (space)" }).waitFor();
    expect(await page.evaluate(() => window.gyration.time)).toBeCloseTo(0.1, 9);
    const entry = page.getByRole("textbox", { name: "body.die.density, exact" });
    await entry.fill("2000");
    await entry.press("Enter");
    await page.getByRole("button", { name: "Pause (space)" }).waitFor();
    expect(await page.evaluate(() => window.gyration.time)).toBeLessThan(0.08);
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });

  it("marks_a_number_that_is_refused_and_goes_on_with_all_others", async () => {
    const server = await served("shaker", "--set", "time.end=600");
    const { page, problems, close } = await opened(server.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBeGreaterThan(5);
    await page.getByRole("tab", { name: "Sliders" }).click();
    const search = page.getByRole("searchbox");
    await search.fill("density");
    const density = page.getByRole("textbox", { name: /density, exact/ });
    const row = page.locator(".slider", { has: density });
    await density.fill("-5");
    await density.press("Enter");
    await row.locator(".reason").waitFor();
    expect(await row.locator(".reason").textContent()).toContain("must be greater than 0");
    expect(await density.getAttribute("aria-invalid")).toBe("true");
    // Nothing lies over the page, and the run goes on.
    expect(await page.locator(".banner.error").count()).toBe(0);
    const rows = await page.evaluate(() => window.gyration.rows);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBeGreaterThan(rows);
    // Another number starts it again without the refused one, which stays marked.
    await search.fill("time.end");
    const end = page.getByRole("textbox", { name: "time.end, exact" });
    await end.fill("0.1");
    await end.press("Enter");
    await expect.poll(() => page.locator(".run-text").textContent()).toContain("reached its end");
    await search.fill("density");
    expect(await row.locator(".reason").count()).toBe(1);
    await density.fill("2000");
    await density.press("Enter");
    await row.locator(".reason").waitFor({ state: "detached" });
    // What is no number is marked as well.
    await density.fill("heavy");
    await density.press("Enter");
    expect(await row.locator(".reason").textContent()).toContain("is not a number");
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });

  it("takes_home_and_end_on_a_slider_for_the_slider", async () => {
    const server = await served("dice", "--set", "time.end=0.1");
    const { page, close } = await opened(server.url);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await page.getByRole("searchbox").fill("density");
    const slider = page.getByRole("slider", { name: "body.die.density", exact: true });
    await slider.focus();
    const time = await page.evaluate(() => window.gyration.time);
    for (const [key, value] of [
      ["End", "1000"],
      ["Home", "0"],
    ]) {
      await page.keyboard.press(key);
      expect(await slider.inputValue(), key).toBe(value);
    }
    expect(await page.evaluate(() => window.gyration.time)).toBeLessThanOrEqual(Math.max(time, 0.1));
    await close();
    await server.stop();
  });

  it("slows_a_short_motion_down_and_loops_it", async () => {
    const server = await served("dice", "--set", "time.end=1e-4", "--set", "time.sample=1e-5");
    const { page, close } = await opened(server.url);
    const speed = Number(await page.getByRole("combobox", { name: "speed" }).inputValue());
    expect(1e-4 / speed).toBeGreaterThanOrEqual(3);
    const loop = page.getByRole("button", { name: "Loop (L)" });
    expect(await loop.getAttribute("aria-pressed")).toBe("true");
    await close();
    await server.stop();
  });

  it("fits_the_speed_to_how_long_a_run_that_rests_early_lasts", async () => {
    const server = await served("dice", "--set", "time.end=1000");
    const { page, close } = await opened(server.url);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await expect.poll(() => page.locator(".run-text").textContent()).toMatch(/came to rest/i);
    const speed = Number(await page.getByRole("combobox", { name: "speed" }).inputValue());
    const { lasts } = await page.evaluate(() => ({
      lasts: Number(document.querySelector<HTMLInputElement>(".scrubber")!.max),
    }));
    expect(lasts / speed).toBeGreaterThanOrEqual(3);
    expect(lasts / speed).toBeLessThanOrEqual(20);
    await close();
    await server.stop();
  });

  it("pauses_and_resumes_the_run", async () => {
    // Long enough to be caught while it runs.
    const server = await served("shaker", "--set", "time.end=600");
    const { page, close } = await opened(server.url);
    await page.getByRole("tab", { name: "Sliders" }).click();
    await page.getByRole("button", { name: "Pause the run" }).click();
    await page.getByRole("button", { name: "Resume the run" }).waitFor();
    expect(await page.locator(".run-text").textContent()).toContain("Paused");
    // What was on its way comes in, however much; then nothing does.
    let rows = -1;
    const last = async () => {
      const before = rows;
      rows = await page.evaluate(() => window.gyration.rows);
      return rows - before;
    };
    await expect.poll(last, { interval: 300 }).toBe(0);
    await page.waitForTimeout(500);
    expect(await page.evaluate(() => window.gyration.rows)).toBe(rows);
    await page.getByRole("button", { name: "Resume the run" }).click();
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBeGreaterThan(rows);
    await close();
    await server.stop();
  });

  it("misses_a_server_that_is_gone_and_takes_no_other_in_its_place", async () => {
    const first = await served("dice", "--set", "time.end=0.2");
    const { page, problems, close } = await opened(first.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(41);
    await first.stop();
    const banner = page.locator(".banner.lost");
    await banner.waitFor();
    expect(await banner.textContent()).toContain("open the address that it printed");
    // What has come can still be looked at.
    await page.keyboard.press("End");
    expect(await page.evaluate(() => window.gyration.time)).toBeCloseTo(0.2, 9);
    // On the same port, but with a token of its own.
    const second = await served("dice", "--set", "time.end=0.3", "--port", String(first.port));
    const refused = page.waitForEvent("websocket").then((socket) => socket.waitForEvent("socketerror"));
    await page.getByRole("button", { name: "Reconnect" }).click();
    expect(await refused).toContain("403");
    await banner.waitFor();
    expect(await page.evaluate(() => window.gyration.rows)).toBe(41);
    expect(ofThePage(problems)).toEqual([]);
    await close();
    await second.stop();
  });

  it("reconnects_to_a_server_that_is_still_there", async () => {
    const server = await served("dice", "--set", "time.end=0.2");
    let cut = async () => {};
    const { page, problems, close } = await opened(server.url, undefined, {
      before: (page) =>
        page.routeWebSocket(/api\/live$/, (socket) => {
          socket.connectToServer();
          cut = () => socket.close();
        }),
    });
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(41);
    await cut();
    const banner = page.locator(".banner.lost");
    await banner.waitFor();
    await page.getByRole("button", { name: "Reconnect" }).click();
    await banner.waitFor({ state: "detached" });
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(41);
    expect(ofThePage(problems)).toEqual([]);
    await close();
    await server.stop();
  });
});

describe("a recording from disk", () => {
  it("is_shown_whole", async () => {
    const server = await served(recorded("elastic-bounce", "time.end=0.3"));
    const { page, problems, close } = await opened(server.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows)).toBe(151);
    expect(await page.locator(".mode").textContent()).toBe("recording");
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });
});
