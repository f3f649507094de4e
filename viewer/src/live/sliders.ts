// Sliders for the numbers of a live scene: drag one, and the run starts again with it. A number that the program refuses
// is marked with the reason and left out; nothing else waits for it.
//
// Thousands of numbers are no reason for thousands of sliders: a search narrows them down, and a list grows on demand.

import type { Header, Json } from "../data/header";
import { plain } from "../math/format";
import { h, iconButton } from "../ui/dom";
import { groupOf, type Leaf, leaves, override, valueAt } from "./leaves";
import { rangeFor, tidy } from "./range";
import { type Change, culprits, reasonFor } from "./refusals";

/** A run starts again this long after the last move of a slider [ms]. */
const PATIENCE_MS = 150;
/** Sliders shown at once. */
const PORTION = 60;
const PLACES = 1000;
/** Letters of a slider's name. */
const LONGEST_NAME = 22;

export class Sliders {
  readonly element: HTMLElement;
  private readonly search: HTMLInputElement;
  private readonly list = h("div", { class: "sliders" });
  private readonly reset: HTMLButtonElement;
  /** The scene as it was first: ranges are about its numbers. */
  private scene: Json = null;
  private all: Leaf[] = [];
  private given: string[] = [];
  /** Changed numbers by key and path. */
  private readonly changes = new Map<string, Change>();
  /** Why some of them are refused; an empty reason: what is typed is no number. */
  private readonly refused = new Map<string, string>();
  /** The numbers of the run that is shown, of those that were changed. */
  private running = new Map<string, number>();
  /** What was asked for last. */
  private asked: { overrides: string; changes: Change[] } = { overrides: "", changes: [] };
  /** What was asked for since a run began. */
  private readonly unanswered = new Set<string>();
  /** The rows that are shown. */
  private readonly rows = new Map<string, HTMLElement>();
  private shown = PORTION;
  private timer = 0;

  constructor(private readonly restart: (overrides: string[]) => void) {
    this.search = h("input", {
      type: "search",
      placeholder: "Search the scene's numbers",
      "aria-label": "search the scene's numbers",
      oninput: () => {
        this.shown = PORTION;
        this.build();
      },
    });
    this.reset = h("button", { type: "button", onclick: () => this.resetAll() }, "Reset all");
    this.element = h(
      "div",
      { class: "controls" },
      h("div", { class: "row" }, this.search, this.reset),
      this.list,
    );
  }

  /** A run has begun: with what was asked for last, unless another page asked. */
  begun(header: Header): void {
    this.unanswered.clear();
    if (this.asked.overrides === JSON.stringify(header.overrides ?? [])) {
      this.running = new Map(this.asked.changes.map(({ leaf, value }) => [idOf(leaf), value]));
    }
    // The first scene gives the sliders.
    if (this.scene !== null || !header.resolved) return;
    this.scene = header.resolved;
    this.given = header.overrides ?? [];
    this.all = leaves(this.scene);
    this.build();
  }

  /** Starts the run again with all numbers but those that are refused. */
  ask(): void {
    const changes = [...this.changes].flatMap(([id, change]) => (this.refused.has(id) ? [] : [change]));
    const overrides = this.overrides(changes);
    this.asked = { overrides: JSON.stringify(overrides), changes };
    this.unanswered.add(this.asked.overrides);
    this.restart(overrides);
  }

  /** The program has refused overrides: marks the numbers that are to blame; whether that is told enough. */
  refuse(overrides: string[], message: string): boolean {
    const refused = JSON.stringify(overrides);
    // What was asked for since is answered as well.
    if (refused !== this.asked.overrides) return this.unanswered.has(refused);
    const fresh = this.asked.changes.filter(({ leaf, value }) => this.running.get(idOf(leaf)) !== value);
    const blamed = culprits(fresh, message);
    for (const { leaf } of blamed) this.mark(leaf, reasonFor(leaf.key, message));
    // What else was asked for at once is no worse for it.
    if (blamed.length > 0 && blamed.length < fresh.length) this.ask();
    return blamed.length > 0 && blamed.every(({ leaf }) => this.rows.has(idOf(leaf)));
  }

  /** Everything that differs from the scene's text, as `--set` takes it. */
  private overrides(changed: Change[]): string[] {
    const byKey = new Map<string, { path: number[]; value: number }[]>();
    for (const { leaf, value } of changed) {
      byKey.set(leaf.key, [...(byKey.get(leaf.key) ?? []), { path: leaf.path, value }]);
    }
    const kept = this.given.filter((given) => !byKey.has(given.split("=")[0].trim()));
    return [...kept, ...[...byKey].map(([key, changes]) => override(this.scene, key, changes))];
  }

  /** Marks a number with why it is refused, or takes the mark away. */
  private mark(leaf: Leaf, reason: string | null): void {
    const id = idOf(leaf);
    if (reason === null) this.refused.delete(id);
    else this.refused.set(id, reason);
    this.showMark(id);
  }

  private showMark(id: string): void {
    const row = this.rows.get(id);
    const reason = this.refused.get(id);
    if (!row) return;
    row.classList.toggle("refused", reason !== undefined);
    row.querySelector(".exact")?.setAttribute("aria-invalid", String(reason !== undefined));
    row.querySelector(".reason")?.remove();
    if (reason !== undefined) row.append(h("p", { class: "reason", role: "alert" }, reason));
  }

  private build(): void {
    const wanted = this.search.value.toLowerCase().split(/\s+/);
    const found = this.all.filter((leaf) => wanted.every((word) => named(leaf).toLowerCase().includes(word)));
    const groups = new Map<string, HTMLElement>();
    this.rows.clear();
    for (const leaf of found.slice(0, this.shown)) {
      const name = groupOf(leaf.key);
      let group = groups.get(name);
      if (!group) {
        group = h("fieldset", {}, h("legend", {}, name));
        groups.set(name, group);
      }
      group.append(this.slider(leaf, name));
    }
    const more = found.length - this.shown;
    this.list.replaceChildren(...groups.values());
    if (found.length === 0)
      this.list.append(h("p", { class: "quiet" }, "No number of the scene has this in its key."));
    if (more > 0) {
      this.list.append(
        h("button", { type: "button", class: "add", onclick: () => this.showMore() }, `${more} more`),
      );
    }
    this.reset.disabled = this.changes.size === 0;
  }

  private showMore(): void {
    this.shown += PORTION;
    this.build();
  }

  private slider(leaf: Leaf, group: string): HTMLElement {
    const range = rangeFor(leaf.key, leaf.value, reachOf(this.scene, leaf));
    const name = named(leaf);
    const value = () => this.changes.get(idOf(leaf))?.value ?? leaf.value;
    const drag = h("input", {
      type: "range",
      min: 0,
      max: PLACES,
      step: 1,
      value: PLACES * range.place(value()),
      "aria-label": name,
      oninput: () => take(tidy(range.at(Number(drag.value) / PLACES)), false),
    });
    const entry = h("input", {
      type: "text",
      inputmode: "decimal",
      class: "exact",
      value: typed(value()),
      "aria-label": `${name}, exact`,
      onchange: () => {
        const number = Number(entry.value.replace("−", "-"));
        if (entry.value.trim() === "") take(leaf.value, true);
        else if (Number.isFinite(number)) take(number, true);
        else this.mark(leaf, `${entry.value} is not a number`);
      },
    });
    const back = iconButton("restart", `Back to ${plain(leaf.value)}`, () => take(leaf.value, true));
    const label = h(
      "span",
      { class: "name", title: name },
      shortened(name.slice(group.length).replace(/^\./, "") || name),
    );
    const row = h("div", { class: "slider", "data-key": name }, label, entry, back, drag);
    const take = (number: number, moves: boolean) => {
      this.change(leaf, number);
      entry.value = typed(number);
      if (moves) drag.value = String(PLACES * range.place(number));
      row.classList.toggle("changed", number !== leaf.value);
    };
    row.classList.toggle("changed", value() !== leaf.value);
    this.rows.set(idOf(leaf), row);
    this.showMark(idOf(leaf));
    return row;
  }

  private change(leaf: Leaf, value: number): void {
    this.mark(leaf, null);
    if (value === leaf.value) this.changes.delete(idOf(leaf));
    else this.changes.set(idOf(leaf), { leaf, value });
    this.reset.disabled = this.changes.size === 0;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.ask(), PATIENCE_MS);
  }

  private resetAll(): void {
    this.changes.clear();
    this.refused.clear();
    this.build();
    this.ask();
  }
}

function idOf(leaf: Leaf): string {
  return `${leaf.key} ${leaf.path.join(" ")}`;
}

/** The key, with components by letters: `body.die.velocity.x`, `body.block.gradient.xz`. */
function named({ key, path }: Leaf): string {
  if (path.length === 0) return key;
  const letters = path.every((index) => index < 3)
    ? path.map((index) => "xyz"[index]).join("")
    : path.join(".");
  return `${key}.${letters}`;
}

/** The end of a long key says more than its beginning. */
function shortened(key: string): string {
  const words = key.split(".");
  while (words.length > 2 && words.join(".").length > LONGEST_NAME) words.shift();
  const short = words.join(".");
  return short === key ? key : `… ${short}`;
}

/** How far a component that is zero may go: as far as its neighbours; one, if they are zero too. */
function reachOf(scene: Json, { key }: Leaf): number {
  const value = valueAt(scene, key);
  const numbers = Array.isArray(value)
    ? (value.flat(4) as Json[]).filter((item) => typeof item === "number")
    : [];
  return Math.max(0, ...numbers.map(Math.abs)) || 1;
}

/** As one would type it: rounding in the last digits is left out. */
function typed(value: number): string {
  const short = Number(value.toPrecision(9));
  const size = Math.abs(short);
  return size !== 0 && (size < 1e-4 || size >= 1e7) ? short.toExponential() : String(short);
}
