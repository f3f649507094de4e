// The data of a report: script elements of the page that hold JSON and base64 of raw deflate.

import { checkedHeader } from "./header";
import { Network } from "./network";
import { Recording } from "./recording";
import type { Listener, Source } from "./source";

/** The report in this page; `null` if it has none and is served. */
export function embeddedReport(page: Document): Source | null {
  const element = page.getElementById("gyration-header");
  if (!element) return null;
  return {
    control: null,
    reconnect() {},
    async start(listener: Listener) {
      const header = checkedHeader(JSON.parse(element.textContent ?? ""));
      const recording = new Recording(header);
      // Unpacked when it is first looked at: all samples at once.
      if (header.network) {
        const all = async () => ({ first: 0, numbers: new Float32Array(await blob(page, "network")) });
        recording.network = new Network(all);
      }
      const surfaces = header.surfaces.map(async (_, k) => {
        const [points, triangles] = await Promise.all([
          blob(page, `surface/${k}/points`),
          blob(page, `surface/${k}/triangles`),
        ]);
        recording.surfaces[k] = { points: new Float32Array(points), triangles: new Uint32Array(triangles) };
      });
      const [time, ...values] = await Promise.all([
        blob(page, "time"),
        ...header.arrays.map((array) => blob(page, array.name)),
      ]);
      recording.put(
        0,
        new Float64Array(time),
        values.map((value) => new Float32Array(value)),
      );
      recording.setEvents(new Float64Array(await blob(page, "events")));
      await Promise.all(surfaces);
      listener.begun(recording);
      listener.done(header.outcome, header.summary ?? {});
    },
  };
}

async function blob(page: Document, name: string): Promise<ArrayBuffer> {
  const element = page.querySelector(`script[data-blob="${CSS.escape(name)}"]`);
  if (!element)
    throw new Error(`The report has lost its data "${name}": it may have been cut short on the way.`);
  try {
    return await inflated(bytesOf((element.textContent ?? "").trim()));
  } catch {
    throw new Error(
      `The data "${name}" of this report cannot be read: it may have been cut short on the way.`,
    );
  }
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Raw deflate undone. */
export async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).arrayBuffer();
}
