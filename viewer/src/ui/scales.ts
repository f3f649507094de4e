// What colours and lengths in the picture mean: the colour bar, and the distance of the grid's lines.

import { type BodyClasses, classLabel, MOST_ALONE } from "../data/classes";
import { mapGradient, seriesColor } from "../math/colors";
import { plain, scaleFor, withUnit } from "../math/format";
import type { Scale } from "../view/coloring";
import { h } from "./dom";

const TICKS = 5;

export class Scales {
  readonly element: HTMLElement;
  private readonly title = h("div", { class: "scale-title" });
  private readonly numbers = h("div", { class: "scale-numbers" });
  private readonly bar: HTMLElement;
  private readonly classes = h("div", { class: "classes", role: "list", "aria-label": "colours of bodies" });
  private readonly grid = h("div", { class: "grid-note" });
  private shown = "";

  constructor() {
    const gradient = h("div", { class: "scale-gradient", style: `background:${mapGradient("to right")}` });
    this.bar = h(
      "div",
      { class: "scale", role: "img", "aria-label": "colour bar" },
      this.title,
      gradient,
      this.numbers,
    );
    this.element = h("div", { class: "scales" }, this.bar, this.classes, this.grid);
  }

  /** The classes of bodies, where colours do not stand for single ones. */
  load(classes: BodyClasses): void {
    const entries = classes.ofBody.length > MOST_ALONE ? classes.names : [];
    this.classes.replaceChildren(
      ...entries.map((_, index) => {
        const swatch = h("i", { style: `background:${seriesColor(index)}` });
        return h("span", { role: "listitem" }, swatch, classLabel(classes, index));
      }),
    );
  }

  show(scale: Scale | null, grid: number | null): void {
    const key = JSON.stringify([scale, grid]);
    if (key === this.shown) return;
    this.shown = key;
    this.classes.hidden = scale !== null;
    this.bar.hidden = scale === null;
    this.grid.textContent = grid === null ? "" : `grid ${withUnit(grid, "m", 3)}`;
    if (!scale) return;
    const { low, high, title } = scale;
    const [factor, units] = scaleFor(Math.max(Math.abs(low), Math.abs(high)), scale.units);
    this.title.textContent = units === "1" ? title : `${title} [${units}]`;
    const digits = Math.max(3, Math.ceil(Math.log10(Math.abs(high) / (high - low))) + 2);
    this.numbers.replaceChildren(
      ...Array.from({ length: TICKS }, (_, k) => {
        const value = low + ((high - low) * k) / (TICKS - 1);
        return h("span", {}, plain(value / factor, Math.min(digits, 7)));
      }),
    );
  }
}
