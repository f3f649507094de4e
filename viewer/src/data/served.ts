// A recording on the server's disk. One that is still being written is asked for new rows each second.

import { type FieldMap, Fields, mapIn } from "./fields";
import { checkedHeader, type Header } from "./header";
import { Network, type Samples } from "./network";
import { Recording, type Track } from "./recording";
import type { Listener, Source } from "./source";

const POLL_MS = 1000;

/** Forces asked for at once are those of so many bodies, each counted once a sample. */
const BODIES_AT_ONCE = 2000;

/** Rows asked for at once are about this many bytes. */
const PORTION_BYTES = 8e6;

export function servedRecording(first: Header): Source {
  return new Served(first);
}

/** What is known of a recording before its rows are. */
function announced(header: Header): Recording {
  const recording = new Recording(header);
  // Of one body alone a mean tells nothing.
  if (header.bodies.length > 1) recording.fields = new Fields(servedMap);
  if (header.network) recording.network = new Network(forcesFrom(recording));
  return recording;
}

class Served implements Source {
  readonly control = null;
  private recording: Recording;
  private listener: Listener | null = null;
  private timer = 0;
  private begun = false;

  constructor(first: Header) {
    this.recording = announced(first);
  }

  async start(listener: Listener): Promise<void> {
    this.listener = listener;
    const { recording } = this;
    await Promise.all(
      recording.header.surfaces.map(async (_, k) => {
        const [points, triangles] = await Promise.all([
          bytes(`surface/${k}/points`),
          bytes(`surface/${k}/triangles`),
        ]);
        recording.surfaces[k] = { points: new Float32Array(points), triangles: new Uint32Array(triangles) };
      }),
    );
    await this.portion(recording);
    if (recording !== this.recording) return;
    this.begun = true;
    listener.begun(recording);
    await this.rest();
  }

  reconnect(): void {
    window.clearTimeout(this.timer);
    void this.poll();
  }

  /** All that the header announces; then over, or again in a second. */
  private async rest(): Promise<void> {
    const { recording, listener } = this;
    if (!listener) return;
    try {
      while (recording === this.recording && recording.rows < recording.header.rows) {
        await this.portion(recording);
        listener.grew();
      }
      if (recording !== this.recording) return;
      recording.setEvents(new Float64Array(await bytes("events")));
      listener.grew();
    } catch (error) {
      this.lose(error);
      return;
    }
    const { complete, outcome, summary, end } = recording.header;
    if (complete) {
      listener.done(outcome, summary ?? {});
      return;
    }
    listener.progress({ time: recording.lastTime, end, steps: 0, step: 0, paused: false, limited_by: "" });
    this.timer = window.setTimeout(() => void this.poll(), POLL_MS);
  }

  private async poll(): Promise<void> {
    try {
      const header = await servedHeader();
      if (this.listener && (header.run !== this.recording.header.run || !this.begun)) {
        // Another recording stands in its place.
        this.recording = announced(header);
        this.begun = false;
        this.listener.found();
        await this.start(this.listener);
        return;
      }
      this.recording.header = header;
    } catch (error) {
      this.lose(error);
      return;
    }
    this.listener?.found();
    await this.rest();
  }

  private async portion(recording: Recording): Promise<void> {
    const { rows } = recording.header;
    // What is computed of a short recording is no longer offered of a long one.
    const offered = new Set(recording.header.arrays.map((array) => array.name));
    const arrays = [...recording.tracks.values()].filter((track) => offered.has(track.spec.name));
    const from = recording.rows;
    const rowBytes = 8 + 4 * arrays.reduce((sum, track) => sum + track.stride, 0);
    const to = Math.min(rows, from + Math.max(1, Math.floor(PORTION_BYTES / rowBytes)));
    const query = `?from=${from}&to=${to}`;
    const [time, ...values] = await Promise.all([
      bytes(`time${query}`),
      ...arrays.map((track) => bytes(track.spec.name + query)),
    ]);
    const there = new Map(arrays.map((track, k) => [track, new Float32Array(values[k])]));
    const unknown = (track: Track) => new Float32Array((to - from) * track.stride).fill(Number.NaN);
    recording.put(
      from,
      new Float64Array(time),
      [...recording.tracks.values()].map((track) => there.get(track) ?? unknown(track)),
    );
  }

  private lose(error: unknown): void {
    this.listener?.lost(error instanceof ServerError ? error.message : "The server does not answer.");
  }
}

/** Brings forces between bodies, some samples at once where bodies are few: what plays needs the next ones soon. */
function forcesFrom(recording: Recording): (row: number) => Promise<Samples> {
  const { length } = recording.header.bodies;
  const many = Math.max(1, Math.floor(BODIES_AT_ONCE / Math.max(1, length)));
  return async (row) => {
    const to = Math.min(recording.rows, row + many);
    return { first: row, numbers: new Float32Array(await bytes(`network?from=${row}&to=${to}`)) };
  };
}

/** The map of the fields at a sample, with a width [m] or the usual one. */
async function servedMap(row: number, width: number | null, signal: AbortSignal): Promise<FieldMap> {
  const query = width === null ? "" : `&width=${width}`;
  return mapIn(await (await answer(`api/fields?row=${row}${query}`, signal)).arrayBuffer());
}

/** An answer of the server that is an error, in its words. */
class ServerError extends Error {}

/** The header that the server gives. */
export async function servedHeader(): Promise<Header> {
  return checkedHeader(await (await answer("api/header")).json());
}

async function bytes(path: string): Promise<ArrayBuffer> {
  return (await answer(`api/blob/${path}`)).arrayBuffer();
}

/** What the server gives at a path relative to the address of the page, which has its token. */
export async function answer(path: string, signal: AbortSignal | null = null): Promise<Response> {
  const response = await fetch(path, { cache: "no-store", signal });
  if (!response.ok)
    throw new ServerError((await response.text()) || `The server answers ${response.status}.`);
  return response;
}
