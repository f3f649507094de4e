// Runs scenes in slices, and hears the page between two of them.
//
// A run goes on until it ends, fails, or another is accepted in its place. A trap ends the instance of the engine; the
// next scene that is asked for gets a new one of the same compiled module.

import type { Asked, Format, FromWorker, ToWorker } from "./messages";
import { Engine, type Exports, Refusal } from "./module";
import { Slice } from "./slice";

/** Frames are gathered for so long before they are sent [ms]. */
const NEWS_MS = 50;

/** Services of the browser. */
export interface Host {
  tell(message: FromWorker, transfer: ArrayBuffer[]): void;
  /** Calls back after the messages that wait. */
  later(work: () => void): void;
  /** [ms] */
  now(): number;
  compile(address: string): Promise<WebAssembly.Module>;
  instantiate(module: WebAssembly.Module): Exports;
}

export class Runner {
  private module: WebAssembly.Module | null = null;
  private engine: Engine | null = null;
  /** Files that were handed over, for every instance of the engine. */
  private readonly files = new Map<string, ArrayBuffer>();
  private slice = new Slice();
  private going = false;
  private paused = false;
  private waits = false;
  private told = 0;
  private heard: Promise<void> = Promise.resolve();

  constructor(private readonly host: Host) {}

  /** Takes the messages of the page one after the other: the first may take its time. */
  hear(message: ToWorker): void {
    this.heard = this.heard
      .then(() => this.act(message))
      .catch((error) => this.tell({ type: "trapped", message: this.wordsOfTrap(error) }));
  }

  private async act(message: ToWorker): Promise<void> {
    switch (message.type) {
      case "load":
        await this.load(message.engine);
        break;
      case "file":
        this.files.set(message.name, message.content);
        this.engine?.give(message.name, message.content);
        break;
      case "open":
        this.open(message.id, message.asked);
        break;
      case "save":
        this.save(message.id, message.format);
        break;
      case "pause":
      case "resume":
        this.paused = message.type === "pause";
        this.tellFrames();
        this.tell({ type: "paused", paused: this.paused });
        this.goOn();
    }
  }

  private async load(engine: string | WebAssembly.Module): Promise<void> {
    if (typeof engine !== "string") {
      this.module = engine;
      return;
    }
    try {
      this.module = await this.host.compile(engine);
      this.tell({ type: "loaded", engine: this.module });
    } catch (error) {
      this.tell({ type: "unloaded", message: wordsOf(error) });
    }
  }

  private open(id: number, asked: Asked): void {
    if (!this.module) return;
    this.tell({ type: "heard", id });
    try {
      this.engine ??= this.started(this.module);
      const accepted = this.engine.open(asked);
      if (accepted) {
        this.going = true;
        this.paused = false;
        this.slice = new Slice();
      }
      this.tell({ type: "opened", id, accepted, frames: this.engine.frames() });
    } catch (trap) {
      const message = this.wordsOfTrap(trap);
      const frame = JSON.stringify({ type: "error", message });
      this.tell({ type: "opened", id, accepted: false, frames: [frame] });
    }
    this.goOn();
  }

  private started(module: WebAssembly.Module): Engine {
    const engine = new Engine(this.host.instantiate(module));
    for (const [name, content] of this.files) engine.give(name, content);
    return engine;
  }

  private save(id: number, format: Format): void {
    try {
      if (!this.engine) throw new Refusal("There is no run to be saved.");
      this.tell({ type: "saved", id, parts: this.engine.save(format) });
    } catch (error) {
      const trapped = !(error instanceof Refusal);
      const message = trapped ? this.wordsOfTrap(error) : error.message;
      this.tell({ type: "unsaved", id, message });
      if (trapped) this.tell({ type: "trapped", message });
    }
  }

  /** Has the next slice run once the messages that wait are heard. */
  private goOn(): void {
    if (this.waits || !this.going || this.paused) return;
    this.waits = true;
    this.host.later(() => {
      this.waits = false;
      this.advance();
      this.goOn();
    });
  }

  private advance(): void {
    const { engine, host, slice } = this;
    if (!engine || !this.going || this.paused) return;
    try {
      const began = host.now();
      this.going = engine.advance(slice.evaluations);
      const now = host.now();
      slice.took(now - began);
      if (now - this.told >= NEWS_MS) this.tellFrames();
      while (!this.going && this.tellFrames());
    } catch (trap) {
      this.tell({ type: "trapped", message: this.wordsOfTrap(trap) });
    }
  }

  /** Sends the frames since the last call; false where there are none. */
  private tellFrames(): boolean {
    this.told = this.host.now();
    const frames = this.engine?.frames() ?? [];
    if (frames.length > 0) this.tell({ type: "frames", frames });
    return frames.length > 0;
  }

  private tell(message: FromWorker): void {
    const contents = "frames" in message ? message.frames : "parts" in message ? message.parts : [];
    this.host.tell(
      message,
      contents.filter((content) => typeof content !== "string"),
    );
  }

  /** Gives the engine up; its last words. */
  private wordsOfTrap(trap: unknown): string {
    const { engine } = this;
    this.engine = null;
    this.going = false;
    let words = wordsOf(trap);
    try {
      words = engine?.lastWords(trap) ?? words;
    } catch {
      // A memory that is spoilt has no words.
    }
    return `The engine has failed: ${words}`;
  }
}

function wordsOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
