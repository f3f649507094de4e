// The worker of the page: its engine runs here, so that the page is free to draw.

import type { FromWorker, ToWorker } from "./messages";
import type { Exports } from "./module";
import { Runner } from "./runner";

/** The global scope of a worker. */
interface Scope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer: Transferable[]): void;
}

const scope = self as unknown as Scope;

/** A message to oneself comes at once, other than a timer. */
const channel = new MessageChannel();
const waiting: (() => void)[] = [];
channel.port1.onmessage = () => waiting.shift()?.();

const runner = new Runner({
  tell: (message, transfer) => scope.postMessage(message, transfer),
  later: (work) => {
    waiting.push(work);
    channel.port2.postMessage(null);
  },
  now: () => performance.now(),
  compile: compiled,
  instantiate: (module) => new WebAssembly.Instance(module, {}).exports as unknown as Exports,
});

scope.onmessage = ({ data }) => runner.hear(data);

/** The module at an address; compiled while it comes, where the server gives it its type. */
async function compiled(address: string): Promise<WebAssembly.Module> {
  const response = await fetch(address, { cache: "no-cache" });
  if (!response.ok) throw new Error(`the server answers ${response.status} for ${address}`);
  const type = response.headers.get("content-type")?.trim().toLowerCase();
  if (type === "application/wasm") return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
