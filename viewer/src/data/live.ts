// A run of the server that is watched while it runs: a websocket with its messages, and its control.

import { Feed } from "./feed";
import type { Control, Listener, Source } from "./source";

export class LiveRun implements Source {
  private socket: WebSocket | null = null;
  private listener: Listener | null = null;
  private feed: Feed | null = null;

  readonly control: Control = {
    pause: () => this.send({ type: "pause" }),
    resume: () => this.send({ type: "resume" }),
    restart: (set) => this.send({ type: "restart", set }),
  };

  async start(listener: Listener): Promise<void> {
    this.listener = listener;
    this.feed = new Feed(listener);
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
      if (mine()) this.feed?.take(data as string | ArrayBuffer);
    };
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}
