// Messages between the page and its worker.

/** A scene to run, as the engine takes it. */
export interface Asked {
  name: string;
  /** The text of the scene. */
  scene: string;
  /** Overrides, as of `--set`. */
  set: string[];
}

export type ToWorker =
  /** The first message: where the engine is, or the engine itself. */
  | { type: "load"; engine: string | WebAssembly.Module }
  | { type: "open"; id: number; asked: Asked }
  | { type: "pause" }
  | { type: "resume" };

/** A message of the engine, as `Feed` takes it. */
export type Frame = string | ArrayBuffer;

export type FromWorker =
  | { type: "loaded"; engine: WebAssembly.Module }
  | { type: "unloaded"; message: string }
  /** The engine looks at the scene from now on. */
  | { type: "heard"; id: number }
  /** The run has begun; or it is refused, and the one before goes on. */
  | { type: "opened"; id: number; accepted: boolean; frames: Frame[] }
  | { type: "frames"; frames: Frame[] }
  | { type: "paused"; paused: boolean }
  /** The engine has died, with its words. */
  | { type: "trapped"; message: string };
