// The engine of a built site in Node: GYRATION_SITE is its folder. Hashes must be those of the native program.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import type { Asked } from "../../src/engine/messages";
import { Engine, type Exports } from "../../src/engine/module";
import type { GalleryScene } from "../../src/site/gallery";

const SITE = process.env.GYRATION_SITE;

interface Told {
  type: string;
  hash?: string;
  message?: string;
}

describe.skipIf(!SITE)("the engine", () => {
  const read = (name: string) => readFileSync(join(SITE ?? "", name));
  const module = new WebAssembly.Module(
    SITE ? read("engine.wasm") : Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0),
  );
  const scenes: GalleryScene[] = SITE ? JSON.parse(read("gallery.json").toString()) : [];
  const hashes: Record<string, string> = SITE ? JSON.parse(read("hashes.json").toString()) : {};
  const engine = () => new Engine(new WebAssembly.Instance(module, {}).exports as unknown as Exports);
  const text = (name: string) => scenes.find((scene) => scene.name === name)?.text ?? "";

  /** Runs a scene; the last text that is told. */
  function told(asked: Asked): Told {
    const running = engine();
    let last: Told = { type: "" };
    const listen = () => {
      for (const frame of running.frames()) if (typeof frame === "string") last = JSON.parse(frame);
    };
    if (running.open(asked)) while (running.advance(5000)) listen();
    listen();
    return last;
  }

  it("has_no_imports", () => {
    expect(WebAssembly.Module.imports(module)).toEqual([]);
  });

  for (const { name } of scenes)
    it(`gets_every_number_of_${name}`, { timeout: 300_000 }, () => {
      expect(told({ name, scene: text(name), set: [] }).hash).toBe(hashes[name]);
    });

  it("does_what_asks_for_threads_on_one", () => {
    const [one, four] = [1, 4].map((threads) => ["time.end=0.05", `solver.threads=${threads}`]);
    const scene = text("dice-pair");
    const hash = told({ name: "dice-pair", scene, set: four }).hash;
    expect(hash).toMatch(/^[0-9a-f]{16}$/);
    expect(told({ name: "dice-pair", scene, set: one }).hash).toBe(hash);
  });

  it("finds_the_resistance_of_a_box", { timeout: 120_000 }, () => {
    const scene = `
      world = { gravity = [0, 0, 0] }
      time = { end = 0.1, sample = 0.1 }
      fluid = { viscosity = 1 }
      [[body]]
      name = "box"
      shape = { box = { size = [0.1, 0.2, 0.3] } }
      density = 1000
      velocity = [1, 0, 0]`;
    expect(told({ name: "box", scene, set: [] })).toMatchObject({ type: "done" });
  });

  it("says_in_words_that_there_are_no_files", () => {
    const scene = text("bounce").replace(/shape = .*/, 'shape = { mesh = { file = "rock.stl" } }');
    const { type, message } = told({ name: "bounce", scene, set: [] });
    expect(type).toBe("error");
    expect(message).toContain("rock.stl");
  });
});
