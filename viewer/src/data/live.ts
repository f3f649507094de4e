// A run that is watched while it runs: a websocket with headers, rows, progress, and its control.
//
// A binary message is a u32 length L, a JSON text of L bytes padded with spaces so that 4 + L is a multiple of 8, and
// a payload of little-endian numbers.

import { checkedHeader, type Header, type Outcome, type Summary } from "./header";
import { Recording } from "./recording";
import type { Control, Listener, Progress, Source } from "./source";

/** What a binary message says of its payload. */
export type Announced =
  | { kind: "rows"; run: number; first: number; rows: number }
  | { kind: "blob"; run: number; name: string };

type Message =
  | { type: "header"; header: Header }
  | ({ type: "progress" } & Progress)
  | { type: "done"; outcome: Outcome | null; summary?: Summary }
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

export class LiveRun implements Source {
  private socket: WebSocket | null = null;
  private listener: Listener | null = null;
  private recording: Recording | null = null;
  private begun = false;

  readonly control: Control = {
    pause: () => this.send({ type: "pause" }),
    resume: () => this.send({ type: "resume" }),
    restart: (set) => this.send({ type: "restart", set }),
  };

  async start(listener: Listener): Promise<void> {
    this.listener = listener;
    this.connect();
  }

  reconnect(): void {
    this.connect();
  }

  private connect(): void {
    const old = this.socket;
    this.socket = null;
    old?.close();
    // Relative to the address of the page, which has the server's token; `ws` for `http`.
    const socket = new WebSocket(new URL("api/live", location.href).href.replace(/^http/, "ws"));
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    // Only the socket at hand speaks.
    const mine = () => this.socket === socket;
    socket.onopen = () => mine() && this.listener?.found();
    socket.onclose = () => mine() && this.listener?.lost("The server does not answer.");
    socket.onmessage = ({ data }) => {
      if (!mine()) return;
      if (typeof data === "string") this.told(JSON.parse(data) as Message);
      else this.given(data as ArrayBuffer);
    };
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private told(message: Message): void {
    const { listener } = this;
    if (!listener) return;
    switch (message.type) {
      case "header":
        this.open(message.header);
        break;
      case "progress":
        listener.progress(message);
        break;
      case "done":
        if (this.recording) {
          this.recording.header = { ...this.recording.header, complete: true, outcome: message.outcome };
          listener.done(message.outcome, message.summary ?? {});
        }
        break;
      case "error":
        listener.failed(message.message, message.set);
    }
  }

  private open(header: Header): void {
    try {
      this.recording = new Recording(checkedHeader(header));
      this.begun = false;
    } catch (error) {
      this.listener?.failed((error as Error).message);
    }
  }

  private given(message: ArrayBuffer): void {
    const { recording, listener } = this;
    if (!recording || !listener) return;
    const { announced, payload } = unpacked(message);
    if (announced.run !== recording.header.run) return;
    if (announced.kind === "rows") {
      const strides = recording.header.arrays.map((array) => array.stride);
      recording.put(announced.first, ...rowsOf(payload, announced.rows, strides));
      this.offer();
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
  private offer(): void {
    const { recording, listener } = this;
    if (!recording || !listener) return;
    if (this.begun) {
      listener.grew();
    } else {
      this.begun = true;
      listener.begun(recording);
    }
  }
}
