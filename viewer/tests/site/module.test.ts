// The engine of a built site in Node: GYRATION_SITE is its folder. Hashes must be those of the native program,
// GYRATION_BIN.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { type Asked, FORMATS } from "../../src/engine/messages";
import { Engine, type Exports } from "../../src/engine/module";
import type { GalleryScene } from "../../src/site/gallery";

const SITE = process.env.GYRATION_SITE;
const PROGRAM = process.env.GYRATION_BIN;

/** A corner of a cube, cut off. */
const WEDGE = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

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
  function told(asked: Asked, files: Record<string, string> = {}): Told {
    const running = engine();
    for (const [name, content] of Object.entries(files))
      running.give(name, new TextEncoder().encode(content).buffer);
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

  it.skipIf(!PROGRAM)("saves_the_bytes_that_the_program_exports", { timeout: 120_000 }, () => {
    const folder = mkdtempSync(join(tmpdir(), "gyration-saved-"));
    for (const [name, end] of [
      ["dice", "time.end=0.3"],
      ["soft-collision", "time.end=0.1"],
    ]) {
      const running = engine();
      expect(running.open({ name, scene: text(name), set: [end] })).toBe(true);
      while (running.advance(5000)) running.frames();
      const recording = join(folder, name);
      const native = (...words: string[]) => execFileSync(PROGRAM ?? "", words, { stdio: "ignore" });
      native("run", name, "--set", end, "--quiet", "-o", recording);
      for (const format of FORMATS) {
        const file = `${recording}.${format}`;
        native("export", recording, "-o", file);
        const saved = Buffer.concat(running.save(format).map((part) => Buffer.from(part)));
        expect(saved.equals(readFileSync(file)), `${name}.${format}`).toBe(true);
      }
    }
    rmSync(folder, { recursive: true });
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

  it("asks_for_a_mesh_by_name_and_runs_with_its_bytes", () => {
    const scene = text("bounce").replace(/shape = .*/, 'shape = { mesh = { file = "parts/wedge.obj" } }');
    const asked = { name: "bounce", scene, set: ["time.end=0.1"] };
    const { type, message } = told(asked);
    expect(type).toBe("error");
    expect(message).toMatch(/parts\/wedge\.obj[\s\S]*drop the file on the page/);
    expect(told(asked, { "wedge.obj": WEDGE }).type).toBe("done");
  });
});
