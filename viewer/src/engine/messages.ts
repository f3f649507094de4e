// Messages between the page and its worker.

/** A scene to run, as the engine takes it. */
export interface Asked {
  name: string;
  /** The text of the scene. */
  scene: string;
  /** Overrides, as of `--set`. */
  set: string[];
}

/** The formats in which the engine gives a run, in the order of their codes; each the ending of a file. */
export const FORMATS = ["csv", "glb"] as const;
export type Format = (typeof FORMATS)[number];

export type ToWorker =
  /** The first message: where the engine is, or the engine itself. */
  | { type: "load"; engine: string | WebAssembly.Module }
  /** A file that scenes may name, for all that are opened from now on. */
  | { type: "file"; name: string; content: ArrayBuffer }
  | { type: "open"; id: number; asked: Asked }
  /** Asks for the run so far as a file. */
  | { type: "save"; id: number; format: Format }
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
  /** The file, one part behind the other; or why there is none. */
  | { type: "saved"; id: number; parts: ArrayBuffer[] }
  | { type: "unsaved"; id: number; message: string }
  /** The engine has died, with its words. */
  | { type: "trapped"; message: string };
