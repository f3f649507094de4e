// The messages of a run that is watched while it runs, made into a recording: from a server's websocket or an engine in
// the page.
//
// A text is JSON: a header, progress, the end, an error. A binary message is a u32 length L, a JSON text of L bytes
// padded with spaces so that 4 + L is a multiple of 8, and a payload of little-endian numbers.

import { checkedHeader, type Header, type Outcome, type Summary } from "./header";
import { Network } from "./network";
import { Recording } from "./recording";
import type { Listener, Progress } from "./source";

/** What a binary message says of its payload. */
export type Announced =
  | { kind: "rows"; run: number; first: number; rows: number }
  | { kind: "network"; run: number; first: number; rows: number }
  | { kind: "blob"; run: number; name: string };

export type Message =
  | { type: "header"; header: Header }
  | ({ type: "progress" } & Progress)
  | { type: "done"; outcome: Outcome | null; summary?: Summary; hash?: string | null }
  | { type: "error"; message: string; set?: string[] };

/** A binary message taken apart. */
export function unpacked<Head = Announced>(message: ArrayBuffer): { announced: Head; payload: ArrayBuffer } {
  const length = new DataView(message).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(message, 4, length));
  return { announced: JSON.parse(text) as Head, payload: message.slice(4 + length) };
}

/** Rows of a payload: the times, then for each array its numbers. */
export function rowsOf(
  payload: ArrayBuffer,
  rows: number,
  strides: number[],
): [Float64Array, Float32Array[]] {
  let at = 8 * rows;
  const values = strides.map((stride) => {
    const numbers = new Float32Array(payload, at, rows * stride);
    at += 4 * rows * stride;
    return numbers;
  });
  return [new Float64Array(payload, 0, rows), values];
}

export class Feed {
  private recording: Recording | null = null;
  private begun = false;
  private last: Progress | null = null;

  constructor(private readonly listener: Listener) {}

  /** Takes a message as it comes: a text or a binary one. */
  take(message: string | ArrayBuffer): void {
    if (typeof message === "string") this.told(JSON.parse(message) as Message);
    else this.given(message);
  }

  /** Takes a text that has been read. */
  told(message: Message): void {
    const { listener } = this;
    switch (message.type) {
      case "header":
        this.open(message.header);
        break;
      case "progress":
        this.last = message;
        listener.progress(message);
        break;
      case "done":
        if (this.recording) {
          this.recording.header = { ...this.recording.header, complete: true, outcome: message.outcome };
          listener.done(message.outcome, message.summary ?? {}, message.hash);
        }
        break;
      case "error":
        listener.failed(message.message, message.set);
    }
  }

  /** Tells how far the run is once more: it is halted now, or goes on. */
  halted(paused: boolean): void {
    if (this.last) this.told({ type: "progress", ...this.last, paused });
  }

  private open(header: Header): void {
    try {
      this.recording = new Recording(checkedHeader(header));
      if (header.network) this.recording.network = new Network();
      this.begun = false;
      this.last = null;
    } catch (error) {
      this.listener.failed((error as Error).message);
    }
  }

  private given(message: ArrayBuffer): void {
    const { recording, listener } = this;
    if (!recording) return;
    const { announced, payload } = unpacked(message);
    if (announced.run !== recording.header.run) return;
    if (announced.kind === "network") {
      recording.network?.put(announced.first, new Float32Array(payload));
      return;
    }
    if (announced.kind === "rows") {
      const strides = recording.header.arrays.map((array) => array.stride);
      recording.put(announced.first, ...rowsOf(payload, announced.rows, strides));
      this.offer(recording);
      return;
    }
    const [what, index, part] = announced.name.split("/");
    if (what === "events") {
      recording.setEvents(new Float64Array(payload));
      if (this.begun) listener.grew();
    } else if (what === "surface") {
      const k = Number(index);
      const surface = recording.surfaces[k] ?? { points: new Float32Array(0), triangles: new Uint32Array(0) };
      if (part === "points") surface.points = new Float32Array(payload);
      else surface.triangles = new Uint32Array(payload);
      recording.surfaces[k] = surface;
      if (this.begun && surface.points.length > 0 && surface.triangles.length > 0) listener.surfaced();
    }
  }

  /** The first row makes it a recording to show. */
  private offer(recording: Recording): void {
    if (this.begun) {
      this.listener.grew();
    } else {
      this.begun = true;
      this.listener.begun(recording);
    }
  }
}
