// Words across the page: an error of the program, as it came, or a server that is gone.

import { h, iconButton } from "./dom";

export class Banner {
  readonly element = h("div", { class: "banners", "aria-live": "assertive" });
  private lost: HTMLElement | null = null;
  private error: HTMLElement | null = null;

  /** An error of the program; it goes with the next run. */
  fail(message: string): void {
    this.clearError();
    const text = h("pre", {}, message.trimEnd());
    this.error = h(
      "div",
      { class: "banner error", role: "alert" },
      text,
      iconButton("close", "Close", () => this.clearError()),
    );
    this.element.append(this.error);
  }

  clearError(): void {
    this.error?.remove();
    this.error = null;
  }

  /** The server is gone. */
  lose(reason: string, reconnect: () => void): void {
    this.found();
    const again = h("button", { type: "button", class: "strong", onclick: reconnect }, "Reconnect");
    const words = `${reason} What has come so far can still be looked at. Is \`gyration view\` still running? If it was started again, open the address that it printed.`;
    this.lost = h("div", { class: "banner lost", role: "alert" }, h("p", {}, words), again);
    this.element.append(this.lost);
  }

  found(): void {
    this.lost?.remove();
    this.lost = null;
  }
}
