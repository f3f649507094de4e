// The gallery, one scene of each thing that is drawn: its report opens, draws, moves, and asks for nothing from anywhere.

import { statSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { browser, colors, differing, lastTime, opened, pixelsAt } from "./browser";
import { gallery, recorded, reported, text } from "./program";

/** A small window: without a graphics card the time goes with the number of its points. */
const WINDOW = { viewport: { width: 640, height: 400 } };

/** Scenes that begin slowly: the force of this one grows until nine sixteenths of its time. */
const SLOW = new Set(["wave-gap"]);

/** Bodies of one shape each, soft, pinned, self-driven, in a fluid; supports that turn; joints, springs, lattices. */
const DRAWN = [
  "dice",
  "rattleback",
  "tippe-top",
  "euler-disk",
  "top",
  "shaker",
  "soft-collision",
  "spin-flatten",
  "crawl",
  "breathe",
  "jeffery",
  "swimmer",
  "bricks",
  "drum",
  "turntable",
  "stair",
  "linkage",
  "gripper",
  "adhesive-cluster",
  "kagome",
  "gyroscopes",
  "wave-gap",
];

/** Joints, springs, bonds and pins in the file of a scene. */
const JOINED = /^(\[\[(joint|spring|bond)\]\]|(pin|spring) =)/m;

/** A tenth of a scene is enough to see it move. */
function beginning(scene: string, end: number): number {
  return SLOW.has(scene) ? 0.6 * end : Math.min(end, Math.max(0.3, 0.1 * end));
}

const scenes = gallery().filter(([scene]) => DRAWN.includes(scene));

describe("the report of a gallery scene", () => {
  it("is_tried_for_each_thing_that_is_drawn", () => expect(scenes.length).toBe(DRAWN.length));

  it.each(scenes)("%s_renders_and_moves", async (scene, end) => {
    const file = reported(recorded(scene, `time.end=${beginning(scene, end)}`));
    expect(statSync(file).size).toBeLessThan(3e6);
    // The start of the browser itself does not count.
    await browser();
    const began = performance.now();
    const { page, problems, close } = await opened(file, WINDOW);
    const took = performance.now() - began;
    const last = await lastTime(page);
    const seen = await pixelsAt(page, 0, 2, 2);
    // Background and shades of a body: a scene without planes has no more, and points have fewer.
    expect(colors(seen), "colours of the picture").toBeGreaterThan(2);

    // Without planes and with a camera that stands, whatever changes is a body.
    await page.keyboard.press("g");
    const follows = page.getByRole("button", { name: "Follow the body" });
    if ((await follows.getAttribute("aria-pressed")) === "true") await page.keyboard.press("f");
    const bodies: Uint8Array[] = [];
    for (const part of [0, 0.37, 0.71, 1]) bodies.push(await pixelsAt(page, part * last, 2, 2));
    const changed = bodies.slice(1).map((pixels) => differing(bodies[0], pixels));
    expect(Math.max(...changed), "pixels that change").toBeGreaterThan(8);
    // Background, and two shades of a point.
    expect(colors(bodies[0]), "colours of the bodies").toBeGreaterThan(2);
    // What joins bodies is seen, and can be hidden.
    const joined = page.getByRole("button", { name: "Joints, springs, bonds, pins" });
    expect(await joined.isEnabled(), "something joins bodies").toBe(JOINED.test(text(scene)));
    if (await joined.isEnabled()) {
      await page.keyboard.press("j");
      expect(differing(bodies[3], await pixelsAt(page, last, 2, 2)), "pixels of joints").toBeGreaterThan(0);
    }
    expect(problems).toEqual([]);
    console.log(
      `${scene}: first frame after ${took.toFixed(0)} ms, ${(statSync(file).size / 1e6).toFixed(2)} MB`,
    );
    await close();
  });
});
