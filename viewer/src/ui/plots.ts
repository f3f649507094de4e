// The plots: a stack of charts, each of a quantity by choice, all on one axis of time.

import type { Recording } from "../data/recording";
import { ChartView } from "./chart";
import { h, icon, iconButton } from "./dom";
import { type Chart, charts, columnsChart } from "./quantities";

/** Shown first, where the recording has them. */
const FIRST = ["energy", "gap", "stretch", "residual"];
const ALSO = ["work", "velocity", "position"];
const HOW_MANY = 4;
/** Charts follow a growing run at most this often [ms]. */
const PATIENCE_MS = 250;

interface Slot {
  id: string;
  columns: string[];
  view: ChartView | null;
}

export class Plots {
  readonly element: HTMLElement;
  private readonly stack = h("div", { class: "stack" });
  private recording: Recording | null = null;
  private slots: Slot[] = [];
  private body: number | null = null;
  private span: [number, number] | null = null;
  private point: [number, number] = [0, 0];
  private waiting = 0;

  constructor(private readonly seek: (time: number) => void) {
    const add = h(
      "button",
      { type: "button", class: "add", onclick: () => this.add() },
      icon("plus"),
      "Add a plot",
    );
    this.element = h("div", { class: "plots" }, this.stack, add);
    new ResizeObserver(() => this.draw()).observe(this.stack);
  }

  /** Another recording; the choice of plots stays where it can. */
  load(recording: Recording): void {
    this.recording = recording;
    this.span = null;
    const ids = charts(recording, this.body).map((chart) => chart.id);
    const kept = this.slots.filter((slot) => slot.id === "columns" || ids.includes(slot.id));
    this.slots = kept.length > 0 ? kept : firstOf(ids).map((id) => ({ id, columns: [], view: null }));
    this.rebuild();
  }

  /** After new rows. */
  grew(): void {
    this.waiting ||= window.setTimeout(() => {
      this.waiting = 0;
      this.draw();
    }, PATIENCE_MS);
  }

  /** The body whose vectors are shown; all bodies' scalars with `null`. */
  choose(body: number | null): void {
    if (body === this.body) return;
    this.body = body;
    this.rebuild();
  }

  /** Ties the cursors to the time shown. */
  pointAt(time: number, row: number): void {
    this.point = [time, row];
    for (const { view } of this.slots) view?.point(time, row);
  }

  restyle(): void {
    for (const { view } of this.slots) view?.restyle();
    this.pointAt(...this.point);
  }

  draw(): void {
    for (const { view } of this.slots) view?.draw();
    this.pointAt(...this.point);
  }

  private rebuild(): void {
    const { recording } = this;
    if (!recording) return;
    const all = charts(recording, this.body);
    for (const slot of this.slots) {
      slot.view?.destroy();
      const chart =
        slot.id === "columns" ? columnsChart(recording, slot.columns) : all.find((one) => one.id === slot.id);
      slot.view = chart ? this.viewOf(recording, slot, chart, all) : null;
    }
    this.stack.replaceChildren(...this.slots.flatMap(({ view }) => (view ? [view.element] : [])));
    this.draw();
  }

  private viewOf(recording: Recording, slot: Slot, chart: Chart, all: Chart[]): ChartView {
    const choice = h(
      "select",
      { "aria-label": "quantity", onchange: () => this.change(slot, choice.value) },
      ...all.map(({ id, title }) => h("option", { value: id, selected: id === slot.id }, title)),
      h("option", { value: "columns", selected: slot.id === "columns" }, "Columns…"),
    );
    const remove = iconButton("close", "Remove this plot", () => this.remove(slot));
    const title = h("div", { class: "title" }, choice, remove);
    const ports = { seek: this.seek, zoomed: (span: [number, number] | null) => this.zoom(span) };
    const view = new ChartView(recording, chart, ports, title);
    if (slot.id === "columns")
      view.element.insertBefore(this.picker(recording, slot), view.element.children[1]);
    return view;
  }

  /** A search box over all columns; what is chosen is drawn. */
  private picker(recording: Recording, slot: Slot): HTMLElement {
    const names = recording.header.columns.map(([name]) => name);
    const list = h("datalist", { id: "column-names" }, ...names.map((value) => h("option", { value })));
    const entry = h("input", {
      type: "search",
      placeholder: "add a column: die.x",
      list: "column-names",
      "aria-label": "add a column",
      onchange: () => {
        if (!names.includes(entry.value)) return;
        slot.columns.push(entry.value);
        this.rebuild();
      },
    });
    const chosen = slot.columns.map((name) =>
      h(
        "button",
        {
          type: "button",
          class: "chosen",
          title: `Remove ${name}`,
          onclick: () => {
            slot.columns = slot.columns.filter((one) => one !== name);
            this.rebuild();
          },
        },
        `${name} ×`,
      ),
    );
    return h("div", { class: "picker" }, entry, list, ...chosen);
  }

  private zoom(span: [number, number] | null): void {
    this.span = span;
    for (const { view } of this.slots) view?.zoom(this.span);
    this.pointAt(...this.point);
  }

  private change(slot: Slot, id: string): void {
    slot.id = id;
    this.rebuild();
  }

  private remove(slot: Slot): void {
    slot.view?.destroy();
    this.slots = this.slots.filter((one) => one !== slot);
    this.draw();
  }

  private add(): void {
    const { recording } = this;
    if (!recording) return;
    const ids = charts(recording, this.body).map((chart) => chart.id);
    const id = ids.find((one) => !this.slots.some((slot) => slot.id === one)) ?? "columns";
    this.slots.push({ id, columns: [], view: null });
    this.rebuild();
  }
}

function firstOf(ids: string[]): string[] {
  return [...FIRST, ...ALSO].filter((id) => ids.includes(id)).slice(0, HOW_MANY);
}
