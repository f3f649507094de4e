// The panels beside the picture, one at a time.

import { h } from "./dom";

export class Tabs {
  readonly element: HTMLElement;
  private readonly bar = h("div", { class: "tab-bar", role: "tablist" });
  private readonly panels = new Map<string, { tab: HTMLButtonElement; panel: HTMLElement }>();

  constructor(private readonly opened: (name: string) => void) {
    this.element = h("aside", { class: "side" }, this.bar);
  }

  /** Adds a panel, or gives one that is there other content. */
  set(name: string, content: HTMLElement): void {
    const known = this.panels.get(name);
    if (known) {
      known.panel.replaceChildren(content);
      return;
    }
    const id = `panel-${name.toLowerCase()}`;
    const tab = h(
      "button",
      { type: "button", role: "tab", "aria-controls": id, onclick: () => this.open(name) },
      name,
    );
    const panel = h(
      "div",
      { id, class: "panel", role: "tabpanel", "aria-label": name, hidden: true },
      content,
    );
    this.panels.set(name, { tab, panel });
    this.bar.append(tab);
    this.element.append(panel);
    if (this.panels.size === 1) this.open(name);
  }

  open(name: string): void {
    for (const [key, { tab, panel }] of this.panels) {
      panel.hidden = key !== name;
      tab.setAttribute("aria-selected", String(key === name));
    }
    this.opened(name);
  }

  /** The panel that is open. */
  get shown(): string | undefined {
    return [...this.panels].find(([, { panel }]) => !panel.hidden)?.[0];
  }

  /** The next panel. */
  next(): void {
    const names = [...this.panels.keys()];
    this.open(names[(names.indexOf(this.shown ?? "") + 1) % names.length]);
  }
}
