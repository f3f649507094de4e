// The engine in its worker: its messages, its slices, what is heard between two of them.

import { describe, expect, it } from "vitest";
import type { Frame, FromWorker, ToWorker } from "../../src/engine/messages";
import { type Exports, framesIn } from "../../src/engine/module";
import { Runner } from "../../src/engine/runner";
import { SLICE_MS, Slice } from "../../src/engine/slice";
import { headerOf } from "./made";

/** Frames as they stand in the memory of the engine. */
function written(...frames: (string | number[])[]): Uint8Array<ArrayBuffer> {
  const parts = frames.map((frame) => {
    const text = typeof frame === "string";
    const content = text ? new TextEncoder().encode(frame) : Uint8Array.from(frame);
    const bytes = new Uint8Array(8 + 8 * Math.ceil(content.length / 8));
    const view = new DataView(bytes.buffer);
    view.setUint32(0, text ? 0 : 1, true);
    view.setUint32(4, content.length, true);
    bytes.set(content, 8);
    return [...bytes];
  });
  return Uint8Array.from(parts.flat());
}

describe("frames of the engine", () => {
  it("are_texts_and_bytes_of_any_length_anywhere_in_memory", () => {
    const bytes = written("Ä", [1, 2, 3, 4, 5, 6, 7, 8], "", [9]);
    const memory = new Uint8Array(bytes.length + 12);
    memory.set(bytes, 12);
    const [text, eight, empty, one] = framesIn(memory.subarray(12));
    expect([text, empty]).toEqual(["Ä", ""]);
    expect([...new Uint8Array(eight as ArrayBuffer)]).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
    expect((one as ArrayBuffer).byteLength).toBe(1);
    expect(framesIn(new Uint8Array(0))).toEqual([]);
  });

  it("that_are_cut_short_are_none", () => {
    const bytes = written([1, 2, 3]);
    bytes[4] = 200;
    expect(() => framesIn(bytes)).toThrow("cut short");
  });
});

describe("a slice", () => {
  it("comes_to_take_as_long_as_it_should_whatever_an_evaluation_takes", () => {
    for (const each of [1e-4, 0.02, 3]) {
      const slice = new Slice();
      for (let k = 0; k < 40; k++) slice.took(each * slice.evaluations);
      const most = Math.max(SLICE_MS, each);
      expect(each * slice.evaluations).toBeGreaterThan(0.5 * SLICE_MS);
      expect(each * slice.evaluations).toBeLessThanOrEqual(1.3 * most);
    }
  });

  it("grows_where_the_clock_is_too_coarse_and_is_never_empty", () => {
    const slice = new Slice();
    for (let k = 0; k < 100; k++) slice.took(0);
    expect(slice.evaluations).toBe(2 ** 30);
    for (let k = 0; k < 100; k++) slice.took(1e9);
    expect(slice.evaluations).toBe(1);
  });
});

const PROGRESS = { type: "progress", time: 0, end: 1, steps: 0, step: 0, paused: false, limited_by: "" };

/** An engine that runs for five slices, refuses "bad" and traps at "trap" and in a run of "late trap". */
class FakeEngine {
  readonly memory = { buffer: new ArrayBuffer(4096) };
  private scene = "";
  private slices = 0;
  private out: Uint8Array = new Uint8Array(0);
  private kept: Uint8Array = new Uint8Array(0);
  given: string[] = [];
  input = () => 64;
  open = (length: number) => {
    const asked = JSON.parse(new TextDecoder().decode(new Uint8Array(this.memory.buffer, 64, length)));
    if (asked.scene === "trap") throw new Error("unreachable");
    if (asked.scene === "bad") {
      this.out = written(JSON.stringify({ type: "error", message: "no scene", set: asked.set }));
      return 1;
    }
    [this.scene, this.slices] = [asked.scene, 0];
    this.out = written(JSON.stringify({ type: "header", header: headerOf() }));
    return 0;
  };
  file = (name: number, content: number) => {
    const read = (at: number, length: number) =>
      new TextDecoder().decode(new Uint8Array(this.memory.buffer, at, length));
    this.given.push(`${read(64, name)}: ${read(64 + name, content)}`);
  };
  advance = () => {
    if (this.scene === "late trap") throw new Error("unreachable");
    this.out = written(JSON.stringify({ ...PROGRESS, time: ++this.slices }));
    return this.slices < 5 ? 0 : 1;
  };
  output = () => {
    new Uint8Array(this.memory.buffer, 2048, this.out.length).set(this.out);
    return 2048;
  };
  output_len = () => {
    const { length } = this.out;
    this.out = new Uint8Array(0);
    return length;
  };
  /** Two parts of a table; no other format. */
  save = (format: number, part: number) => {
    if (this.scene === "late trap") throw new Error("unreachable");
    this.kept = new TextEncoder().encode(format === 0 ? ["t,", "x"][part] : "no such format");
    return format > 0 ? 2 : part < 2 ? 1 : 0;
  };
  saved = () => {
    new Uint8Array(this.memory.buffer, 3072, this.kept.length).set(this.kept);
    return 3072;
  };
  saved_len = () => this.kept.length;
  message = () => {
    new Uint8Array(this.memory.buffer, 1024, 5).set(new TextEncoder().encode("oh no"));
    return 1024;
  };
  message_len = () => 5;
}

/** A runner whose messages are kept, and whose slices run when told. */
function running() {
  const told: FromWorker[] = [];
  const slices: (() => void)[] = [];
  const engines: FakeEngine[] = [];
  const runner = new Runner({
    tell: (message) => told.push(message),
    later: (work) => slices.push(work),
    now: () => 100 * told.length,
    compile: async () => ({}) as WebAssembly.Module,
    instantiate: () => {
      engines.push(new FakeEngine());
      return engines.at(-1) as Exports;
    },
  });
  const hear = async (message: ToWorker) => {
    runner.hear(message);
    await new Promise((resolve) => setImmediate(resolve));
  };
  const open = (id: number, scene: string) =>
    hear({ type: "open", id, asked: { name: "", scene, set: ["a=1"] } });
  const slice = () => slices.shift()?.();
  return { told, slices, hear, open, slice, engines, instances: () => engines.length };
}

describe("the runner", () => {
  it("hears_a_pause_between_slices_and_a_refusal_leaves_the_run", async () => {
    const { told, slices, hear, open, slice } = running();
    await hear({ type: "load", engine: "engine.wasm" });
    await open(1, "good");
    expect(told.map(({ type }) => type)).toEqual(["loaded", "heard", "opened"]);
    slice();
    await hear({ type: "pause" });
    slice();
    expect(slices).toHaveLength(0);
    expect(told.at(-1)).toEqual({ type: "paused", paused: true });
    await open(2, "bad");
    expect(told.at(-1)).toMatchObject({ type: "opened", id: 2, accepted: false });
    expect(slices).toHaveLength(0);
    await hear({ type: "resume" });
    for (let k = 0; k < 10; k++) slice();
    expect(slices).toHaveLength(0);
    const frames = told.flatMap((message) => (message.type === "frames" ? message.frames : []));
    expect(JSON.parse(frames.at(-1) as string).time).toBe(5);
  });

  it("hands_a_run_over_part_by_part_and_goes_on_where_that_is_refused", async () => {
    const { told, hear, open, slice, instances } = running();
    await hear({ type: "load", engine: "engine.wasm" });
    await hear({ type: "save", id: 1, format: "csv" });
    expect(told.at(-1)).toMatchObject({ type: "unsaved", id: 1 });
    await open(1, "good");
    await hear({ type: "save", id: 2, format: "csv" });
    const { parts } = told.at(-1) as { parts: ArrayBuffer[] };
    expect(parts.map((part) => new TextDecoder().decode(part))).toEqual(["t,", "x"]);
    await hear({ type: "save", id: 3, format: "glb" });
    expect(told.at(-1)).toEqual({ type: "unsaved", id: 3, message: "no such format" });
    slice();
    expect([told.at(-1)?.type, instances()]).toEqual(["frames", 1]);
    await open(2, "late trap");
    await hear({ type: "save", id: 4, format: "csv" });
    expect(told.at(-2)).toEqual({ type: "unsaved", id: 4, message: "The engine has failed: oh no" });
    expect(told.at(-1)).toEqual({ type: "trapped", message: "The engine has failed: oh no" });
  });

  it("gives_files_to_every_instance", async () => {
    const { hear, open, engines } = running();
    await hear({ type: "load", engine: "engine.wasm" });
    const content = new TextEncoder().encode("solid").buffer;
    await hear({ type: "file", name: "rock.stl", content });
    await open(1, "trap");
    await hear({ type: "file", name: "käse.csv", content });
    await open(2, "good");
    expect(engines.map(({ given }) => given)).toEqual([
      ["rock.stl: solid"],
      ["rock.stl: solid", "käse.csv: solid"],
    ]);
  });

  it("tells_the_words_of_a_trap_and_runs_the_next_scene_in_a_new_instance", async () => {
    const { told, hear, open, slice, instances } = running();
    await hear({ type: "load", engine: "engine.wasm" });
    await open(1, "late trap");
    slice();
    expect(told.at(-1)).toEqual({ type: "trapped", message: "The engine has failed: oh no" });
    await open(2, "trap");
    const [frame] = (told.at(-1) as { frames: Frame[] }).frames;
    expect(JSON.parse(frame as string)).toEqual({ type: "error", message: "The engine has failed: oh no" });
    await open(3, "good");
    expect(told.at(-1)).toMatchObject({ type: "opened", id: 3, accepted: true });
    expect(instances()).toBe(3);
  });
});
