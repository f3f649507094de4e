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
    await expect.poll(() => page.evaluate(() => window.gyration.rows), { timeout: 60_000 }).toBe(81);
    await expect
      .poll(() => page.evaluate(() => window.gyration.time), { timeout: 60_000 })
      .toBeGreaterThan(0.05);
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
    await expect.poll(() => page.evaluate(() => window.gyration.rows), { timeout: 60_000 }).toBe(61);
    expect(problems).toEqual([]);
    await close();
    await server.stop();
  });

  it("shows_the_programs_error_for_a_bad_number_and_keeps_the_run_before", async () => {
    const server = await served("dice", "--set", "time.end=0.2");
    const { page, problems, close } = await opened(server.url);
    await expect.poll(() => page.evaluate(() => window.gyration.rows), { timeout: 60_000 }).toBe(41);
    await page.getByRole("tab", { name: "Sliders" }).click();
    const entry = page.getByRole("textbox", { name: "body.die.density, exact" });
    await entry.fill("-5");
    await entry.press("Enter");
    const banner = page.locator(".banner.error");
    await banner.waitFor();
    expect(await banner.textContent()).toContain("body.die.density");
    expect(await page.evaluate(() => window.gyration.rows)).toBe(41);
    await entry.fill("2000");
    await entry.press("Enter");
    await banner.waitFor({ state: "detached" });
    expect(problems).toEqual([]);
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
    await page.waitForTimeout(300);
    const rows = await page.evaluate(() => window.gyration.rows);
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
    await expect.poll(() => page.evaluate(() => window.gyration.rows), { timeout: 60_000 }).toBe(41);
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
    await expect.poll(() => page.evaluate(() => window.gyration.rows), { timeout: 60_000 }).toBe(41);
    await cut();
    const banner = page.locator(".banner.lost");
    await banner.waitFor();
    await page.getByRole("button", { name: "Reconnect" }).click();
    await banner.waitFor({ state: "detached" });
    await expect.poll(() => page.evaluate(() => window.gyration.rows), { timeout: 60_000 }).toBe(41);
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
