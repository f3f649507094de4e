// A run of an engine in the page: workers with the engine, and their control.
//
// A scene that is asked for goes to every worker there is, and the first that accepts it stays alone. There is a second
// worker only while the first one does not hear: a slice of its run takes long. A scene that is refused then leaves the
// run before as it is, whoever refuses it.

import type { Asked, Format, Frame, FromWorker, ToWorker } from "../engine/messages";
import { Feed, type Message } from "./feed";
import type { Control, Listener, Source } from "./source";

/** A scene waits so long to be heard [ms]. */
export const HANGS_MS = 2000;

/** A worker as the page sees it. */
export interface EngineWorker {
  onmessage: ((event: MessageEvent<FromWorker>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  postMessage(message: ToWorker): void;
  terminate(): void;
}

/** The reason of a refusal; the overrides, if it is about them. */
interface Refusal {
  message: string;
  set?: string[];
}

interface Pending {
  asked: Asked;
  /** Told once: there is a refusal, or none. */
  answer(refusal: Refusal | null): void;
}

interface Saving {
  /** Who was asked. */
  worker: EngineWorker | null;
  answer(parts: ArrayBuffer[]): void;
  refuse(reason: Error): void;
}

export class EngineRun implements Source {
  /** The scene of the run that is shown, as it was asked for. */
  shown: Asked | null = null;
  private feed: Feed | null = null;
  private listener: Listener | null = null;
  private module: WebAssembly.Module | null = null;
  /** The worker whose run is shown; the one that is tried beside it. */
  private current: EngineWorker | null = null;
  private trial: EngineWorker | null = null;
  /** Scenes without an answer yet, by number. */
  private readonly pending = new Map<number, Pending>();
  /** Files that are waited for, by number. */
  private readonly savings = new Map<number, Saving>();
  /** Files that were handed over, for every worker. */
  private readonly files = new Map<string, ArrayBuffer>();
  private lastId = 0;
  private lastSaving = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;

  readonly control: Control = {
    pause: () => this.current?.postMessage({ type: "pause" }),
    resume: () => this.current?.postMessage({ type: "resume" }),
    restart: (set) => this.restart({ ...(this.shown ?? this.first), set }),
  };

  /** A run of a scene; `address` is where the engine is. */
  constructor(
    private readonly first: Asked,
    private readonly address: string,
    private readonly employ: () => EngineWorker,
  ) {}

  async start(listener: Listener): Promise<void> {
    this.listener = listener;
    this.feed = new Feed(listener);
    this.restart(this.first);
  }

  /** Nothing to do: the engine is never lost. */
  reconnect(): void {}

  /** Hands over a file that scenes may name, for those that are run from now on. */
  give(name: string, content: ArrayBuffer): void {
    this.files.set(name, content);
    for (const worker of this.workers()) worker.postMessage({ type: "file", name, content });
  }

  /** Runs another text, without overrides; in the program's words why it is refused, or null. */
  run(scene: string, name = (this.shown ?? this.first).name): Promise<string | null> {
    return new Promise((resolve) => {
      const asked = { name, scene, set: [] };
      this.ask({ asked, answer: (refusal) => resolve(refusal?.message ?? null) });
    });
  }

  /** The run so far as a file, part by part; an error says why there is none. */
  save(format: Format): Promise<ArrayBuffer[]> {
    const [id, worker] = [++this.lastSaving, this.current];
    return new Promise((answer, refuse) => {
      this.savings.set(id, { worker, answer, refuse });
      if (this.shown && worker) worker.postMessage({ type: "save", id, format });
      else this.saved(id, "The run has not begun: there is nothing to be saved.");
    });
  }

  /** Answers who waits for a file, with its parts or with words. */
  private saved(id: number, found: ArrayBuffer[] | string): void {
    const saving = this.savings.get(id);
    this.savings.delete(id);
    if (typeof found === "string") saving?.refuse(new Error(found));
    else saving?.answer(found);
  }

  /** Has a worker end; who waits for a file from it is told. */
  private end(worker: EngineWorker): void {
    worker.terminate();
    for (const [id, saving] of [...this.savings])
      if (saving.worker === worker) this.saved(id, "Another run has taken its place: it was not saved.");
  }

  private restart(asked: Asked): void {
    const answer = (refusal: Refusal | null) => {
      if (refusal) this.listener?.failed(refusal.message, refusal.set);
    };
    this.ask({ asked, answer });
  }

  private ask(pending: Pending): void {
    const id = ++this.lastId;
    this.pending.set(id, pending);
    this.current ??= this.employed();
    for (const worker of this.workers()) worker.postMessage({ type: "open", id, asked: pending.asked });
    clearTimeout(this.timer);
    // Loading the engine may take any time.
    if (this.module) this.timer = setTimeout(() => this.bypass(id), HANGS_MS);
  }

  /** Has a fresh worker try a scene that nobody hears. */
  private bypass(id: number): void {
    const pending = this.pending.get(id);
    if (!pending) return;
    if (this.trial) this.end(this.trial);
    this.trial = this.employed();
    this.trial.postMessage({ type: "open", id, asked: pending.asked });
  }

  private employed(): EngineWorker {
    const worker = this.employ();
    // Only the workers at hand speak.
    worker.onmessage = ({ data }) => this.workers().includes(worker) && this.hear(worker, data);
    worker.onerror = (event) => {
      if (this.workers().includes(worker)) this.lose(worker, event.message || "its worker cannot be started");
    };
    worker.postMessage({ type: "load", engine: this.module ?? this.address });
    for (const [name, content] of this.files) worker.postMessage({ type: "file", name, content });
    return worker;
  }

  private workers(): EngineWorker[] {
    return [this.current, this.trial].filter((worker) => worker !== null);
  }

  private hear(worker: EngineWorker, message: FromWorker): void {
    switch (message.type) {
      case "loaded":
        this.module = message.engine;
        break;
      case "unloaded":
        this.lose(worker, message.message);
        break;
      case "heard":
        if (message.id === this.lastId) clearTimeout(this.timer);
        break;
      case "opened":
        if (message.accepted) this.accepted(worker, message.id, message.frames);
        else this.refused(message.id, message.frames);
        break;
      case "frames":
        if (worker === this.current) this.show(message.frames);
        break;
      case "paused":
        if (worker === this.current) this.feed?.halted(message.paused);
        break;
      case "saved":
        this.saved(message.id, message.parts);
        break;
      case "unsaved":
        this.saved(message.id, message.message);
        break;
      case "trapped":
        this.listener?.failed(message.message);
    }
  }

  /** Keeps the worker that has accepted a scene, and shows its run. */
  private accepted(worker: EngineWorker, id: number, frames: Frame[]): void {
    for (const other of this.workers()) if (other !== worker) this.end(other);
    this.current = worker;
    this.trial = null;
    const pending = this.pending.get(id);
    if (pending) this.shown = pending.asked;
    this.show(frames);
    this.settle(id, null);
  }

  /** Takes the reason out of the messages of a refusal; the others are of the run that goes on. */
  private refused(id: number, frames: Frame[]): void {
    let refusal: Refusal = { message: "The engine refuses the scene without a word." };
    for (const frame of frames) {
      const message = typeof frame === "string" ? (JSON.parse(frame) as Message) : null;
      if (message?.type === "error") refusal = message;
      else this.show([frame]);
    }
    if (id === this.lastId) {
      clearTimeout(this.timer);
      if (this.trial) this.end(this.trial);
      this.trial = null;
    }
    const pending = this.pending.get(id);
    this.pending.delete(id);
    pending?.answer(refusal);
  }

  /** Answers all that has been asked for up to a number. */
  private settle(last: number, refusal: Refusal | null): void {
    for (const [id, { answer }] of [...this.pending]) {
      if (id > last) continue;
      this.pending.delete(id);
      answer(refusal);
    }
  }

  private show(frames: Frame[]): void {
    for (const frame of frames) this.feed?.take(frame);
  }

  /** Does without a worker that cannot work; what is asked for next gets another. */
  private lose(worker: EngineWorker, reason: string): void {
    this.end(worker);
    if (worker === this.trial) {
      this.trial = null;
      return;
    }
    this.current = this.trial;
    this.trial = null;
    if (this.current) return;
    const message = `The engine cannot be used: ${reason}`;
    if (this.pending.size === 0) this.listener?.failed(message);
    else this.settle(this.lastId, { message });
  }
}
