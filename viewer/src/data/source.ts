// Where a recording comes from: the page itself (report), a server's files (recording), a run of the server (live) or of
// an engine in the page.
//
// A source calls back with what it has; the page draws whatever is there, and does not know which source it is.

import type { Outcome, Summary } from "./header";
import type { Recording } from "./recording";

export interface Progress {
  time: number;
  end: number;
  steps: number;
  step: number;
  paused: boolean;
  limited_by: string;
}

/** What a source tells. */
export interface Listener {
  /** A recording begins: forget the one before. */
  begun(recording: Recording): void;
  /** There are more rows, or events. */
  grew(): void;
  /** A surface has come. */
  surfaced(): void;
  progress(progress: Progress): void;
  /** It is over: all that will come has come; the hash of its numbers, if the source has one. */
  done(outcome: Outcome | null, summary: Summary, hash?: string | null): void;
  /** Words for the reader, and the overrides that were refused, if it is about them; the recording before stays. */
  failed(message: string, refused?: string[]): void;
  /** The server is gone, with the reason; or it is back. */
  lost(reason: string): void;
  found(): void;
}

/** What a live run can be told. */
export interface Control {
  pause(): void;
  resume(): void;
  restart(overrides: string[]): void;
}

export interface Source {
  /** Only a live run listens. */
  readonly control: Control | null;
  start(listener: Listener): Promise<void>;
  /** Tries again after `lost`. */
  reconnect(): void;
}
