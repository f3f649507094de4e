// Scenes that the page asks of an engine in a worker, and what comes of that.

import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { EngineRun, type EngineWorker, HANGS_MS } from "../../src/data/engine";
import type { Asked, FromWorker, ToWorker } from "../../src/engine/messages";
import { Told } from "./made";

const PROGRESS = { type: "progress", time: 0, end: 1, steps: 0, step: 0, paused: false, limited_by: "" };

/** A worker that says what the test has it say. */
class FakeWorker implements EngineWorker {
  onmessage: EngineWorker["onmessage"] = null;
  onerror: EngineWorker["onerror"] = null;
  readonly heard: ToWorker[] = [];
  ended = false;
  postMessage = (message: ToWorker) => void this.heard.push(message);
  terminate = () => {
    this.ended = true;
  };
  say(message: FromWorker): void {
    this.onmessage?.({ data: message } as MessageEvent<FromWorker>);
  }
  /** The scenes that it has been asked for, by number. */
  get asked(): [number, Asked][] {
    return this.heard.flatMap((message) => (message.type === "open" ? [[message.id, message.asked]] : []));
  }
}

const MODULE = {} as WebAssembly.Module;

function opened(id: number): FromWorker {
  return { type: "opened", id, accepted: true, frames: [JSON.stringify(PROGRESS)] };
}

function refused(id: number, set: string[]): FromWorker {
  const error = JSON.stringify({ type: "error", message: "no such key", set });
  return { type: "opened", id, accepted: false, frames: [JSON.stringify({ ...PROGRESS, time: 7 }), error] };
}

describe("a run of the engine", () => {
  const workers: FakeWorker[] = [];
  let told: Told;
  let run: EngineRun;

  beforeEach(async () => {
    vi.useFakeTimers();
    workers.length = 0;
    told = new Told();
    run = new EngineRun({ name: "dice", scene: "text", set: ["a=1"] }, "engine.wasm", () => {
      workers.push(new FakeWorker());
      return workers.at(-1)!;
    });
    await run.start(told);
    workers[0].say({ type: "loaded", engine: MODULE });
    workers[0].say({ type: "heard", id: 1 });
    workers[0].say(opened(1));
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it("begins_with_the_scene_of_the_address", () => {
    expect(workers[0].heard).toEqual([
      { type: "load", engine: "engine.wasm" },
      { type: "open", id: 1, asked: { name: "dice", scene: "text", set: ["a=1"] } },
    ]);
    expect(run.shown?.set).toEqual(["a=1"]);
    expect(told.calls).toEqual(["progress 0 running"]);
  });

  it("hands_files_that_scenes_name_to_every_worker", async () => {
    const content = new ArrayBuffer(3);
    run.give("rock.stl", content);
    expect(workers[0].heard.at(-1)).toEqual({ type: "file", name: "rock.stl", content });
    void run.run("text of mine", "mine");
    vi.advanceTimersByTime(HANGS_MS);
    expect(workers[1].heard.slice(1)).toEqual([
      { type: "file", name: "rock.stl", content },
      { type: "open", id: 2, asked: { name: "mine", scene: "text of mine", set: [] } },
    ]);
  });

  it("hands_files_of_its_run_over_and_says_why_there_is_none", async () => {
    const table = run.save("csv");
    expect(workers[0].heard.at(-1)).toEqual({ type: "save", id: 1, format: "csv" });
    const parts = [new ArrayBuffer(3)];
    workers[0].say({ type: "saved", id: 1, parts });
    expect(await table).toBe(parts);
    const refused = run.save("glb");
    workers[0].say({ type: "unsaved", id: 2, message: "no surfaces" });
    await expect(refused).rejects.toThrow("no surfaces");
    // The worker does not hear, and another run takes the place of its own.
    const late = run.save("csv");
    run.control.restart(["b=2"]);
    vi.advanceTimersByTime(HANGS_MS);
    workers[1].say(opened(2));
    await expect(late).rejects.toThrow("taken its place");
  });

  it("goes_on_where_a_restart_is_refused_and_names_its_overrides", () => {
    run.control.restart(["b=2"]);
    workers[0].say({ type: "heard", id: 2 });
    workers[0].say(refused(2, ["b=2"]));
    expect(told.calls.slice(1)).toEqual(["progress 7 running", "failed no such key of b=2"]);
    expect(run.shown?.set).toEqual(["a=1"]);
    vi.advanceTimersByTime(10 * HANGS_MS);
    expect(workers).toHaveLength(1);
  });

  it("of_an_edited_text_is_shown_or_answers_why_it_is_refused", async () => {
    const bad = run.run("bad text");
    workers[0].say(refused(2, []));
    expect(await bad).toBe("no such key");
    const good = run.run("good text");
    workers[0].say(opened(3));
    expect(await good).toBeNull();
    expect(run.shown).toEqual({ name: "dice", scene: "good text", set: [] });
    run.control.restart(["c=3"]);
    expect(workers[0].asked.at(-1)).toEqual([4, { name: "dice", scene: "good text", set: ["c=3"] }]);
    expect(told.calls.filter((call) => call.startsWith("failed"))).toEqual([]);
  });

  it("that_traps_is_told_and_starts_again_in_the_same_worker", () => {
    workers[0].say({ type: "trapped", message: "The engine has failed: oh no" });
    expect(told.calls.at(-1)).toBe("failed The engine has failed: oh no");
    run.control.restart(["a=1"]);
    expect(workers[0].asked.at(-1)?.[0]).toBe(2);
  });

  it("whose_slice_hangs_is_replaced_by_a_worker_with_the_compiled_module", () => {
    run.control.restart(["b=2"]);
    vi.advanceTimersByTime(HANGS_MS - 1);
    expect(workers).toHaveLength(1);
    vi.advanceTimersByTime(1);
    expect(workers[1].heard[0]).toEqual({ type: "load", engine: MODULE });
    expect(workers[1].asked).toEqual([[2, { name: "dice", scene: "text", set: ["b=2"] }]]);
    workers[1].say(opened(2));
    expect(workers[0].ended).toBe(true);
    expect(run.shown?.set).toEqual(["b=2"]);
    // Who is gone says nothing.
    const calls = told.calls.length;
    workers[0].say(refused(2, ["b=2"]));
    workers[0].say({ type: "frames", frames: [JSON.stringify(PROGRESS)] });
    expect(told.calls).toHaveLength(calls);
    run.control.pause();
    expect(workers[1].heard.at(-1)).toEqual({ type: "pause" });
  });

  it("whose_slice_hangs_stays_where_the_restart_is_refused", () => {
    run.control.restart(["b=2"]);
    vi.advanceTimersByTime(HANGS_MS);
    workers[1].say(refused(2, ["b=2"]));
    expect(workers.map(({ ended }) => ended)).toEqual([false, true]);
    // The first one comes to it as well.
    workers[0].say(refused(2, ["b=2"]));
    expect(told.calls.filter((call) => call.startsWith("failed"))).toEqual(["failed no such key of b=2"]);
    workers[0].say({ type: "frames", frames: [JSON.stringify({ ...PROGRESS, time: 9 })] });
    expect(told.calls.at(-1)).toBe("progress 9 running");
  });

  it("that_hears_after_all_is_asked_for_what_was_asked_for_since", () => {
    run.control.restart(["b=2"]);
    vi.advanceTimersByTime(HANGS_MS);
    run.control.restart(["c=3"]);
    workers[0].say({ type: "heard", id: 2 });
    workers[0].say(opened(2));
    expect(workers.map(({ ended }) => ended)).toEqual([false, true]);
    workers[0].say({ type: "heard", id: 3 });
    workers[0].say(opened(3));
    expect(run.shown?.set).toEqual(["c=3"]);
    vi.advanceTimersByTime(10 * HANGS_MS);
    expect(workers).toHaveLength(2);
  });

  it("without_an_engine_says_why_and_tries_again_when_asked", async () => {
    const other = new EngineRun({ name: "dice", scene: "text", set: [] }, "engine.wasm", () => {
      workers.push(new FakeWorker());
      return workers.at(-1)!;
    });
    await other.start(told);
    workers[1].say({ type: "unloaded", message: "the server answers 404" });
    expect(told.calls.at(-1)).toBe("failed The engine cannot be used: the server answers 404");
    other.control.restart([]);
    expect(workers[2].heard[0]).toEqual({ type: "load", engine: "engine.wasm" });
  });
});
