// The panels beside the picture, one at a time.

import { h } from "./dom";

export class Tabs {
  readonly element: HTMLElement;
  private readonly bar = h("div", {
    class: "tab-bar",
    role: "tablist",
    "aria-label": "panels",
    onkeydown: (event: KeyboardEvent) => this.turn(event),
  });
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
      {
        type: "button",
        role: "tab",
        id: `tab-${name.toLowerCase()}`,
        "aria-controls": id,
        onclick: () => this.open(name),
      },
      name,
    );
    const panel = h(
      "div",
      { id, class: "panel", role: "tabpanel", "aria-labelledby": tab.id, tabindex: 0, hidden: true },
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
      // One of the bar is reached by Tab, the others by arrows.
      tab.tabIndex = key === name ? 0 : -1;
    }
    this.opened(name);
  }

  /** The panel that is open. */
  get shown(): string | undefined {
    return [...this.panels].find(([, { panel }]) => !panel.hidden)?.[0];
  }

  has(name: string): boolean {
    return this.panels.has(name);
  }

  /** The panel that is open at first. */
  get first(): string | undefined {
    return [...this.panels.keys()][0];
  }

  /** Arrows, Home and End go along the bar. */
  private turn(event: KeyboardEvent): void {
    const names = [...this.panels.keys()];
    const at = names.indexOf(this.shown ?? "");
    const places: Record<string, number> = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: -1 };
    const place = places[event.key];
    if (place === undefined || event.shiftKey || event.ctrlKey || event.metaKey || event.altKey) return;
    const name = names[(place + names.length) % names.length];
    event.preventDefault();
    event.stopPropagation();
    this.open(name);
    this.panels.get(name)?.tab.focus();
  }

  /** The next panel. */
  next(): void {
    const names = [...this.panels.keys()];
    this.open(names[(names.indexOf(this.shown ?? "") + 1) % names.length]);
  }
}
