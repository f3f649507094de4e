// What colours and lengths in the picture mean: the colour bar, and the distance of the grid's lines.

import { type BodyClasses, classLabel, MOST_ALONE } from "../data/classes";
import { mapGradient, seriesColor } from "../math/colors";
import { plain, scaleFor, withUnit } from "../math/format";
import type { Scale } from "../view/coloring";
import { gradientOf } from "../view/fields";
import { FORCE_COLORS } from "../view/network";
import { h } from "./dom";

const TICKS = 5;

/** A gradient with its title and numbers. */
class Bar {
  readonly element: HTMLElement;
  private readonly title = h("div", { class: "scale-title" });
  private readonly numbers = h("div", { class: "scale-numbers" });
  private readonly colors = h("div", { class: "scale-gradient" });

  constructor(
    label: string,
    private readonly gradient: string,
  ) {
    this.element = h(
      "div",
      { class: "scale", role: "img", "aria-label": label },
      this.title,
      this.colors,
      this.numbers,
    );
  }

  show(scale: Scale | null, gradient = this.gradient): void {
    this.element.hidden = scale === null;
    if (!scale) return;
    this.colors.style.background = gradient;
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

export class Scales {
  readonly element: HTMLElement;
  private readonly bar = new Bar("colour bar", mapGradient("to right"));
  private readonly forces = new Bar("colours of forces", mapGradient("to right", FORCE_COLORS));
  private readonly fields = new Bar("colours of fields", mapGradient("to right"));
  private readonly classes = h("div", { class: "classes", role: "list", "aria-label": "colours of bodies" });
  private readonly grid = h("div", { class: "grid-note" });
  private shown = "";

  constructor() {
    const bars = h(
      "div",
      { class: "scale-bars" },
      this.fields.element,
      this.forces.element,
      this.bar.element,
    );
    this.element = h("div", { class: "scales" }, bars, this.classes, this.grid);
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

  /** The scale of the bodies, those of the forces between them and of a field. */
  show(scale: Scale | null, forces: Scale | null, field: Scale | null, grid: number | null): void {
    const key = JSON.stringify([scale, forces, field, grid]);
    if (key === this.shown) return;
    this.shown = key;
    this.classes.hidden = scale !== null;
    this.bar.show(scale);
    this.forces.show(forces);
    this.fields.show(field, field ? gradientOf([field.low, field.high]) : undefined);
    // Words over a map need a ground.
    this.element.classList.toggle("grounded", field !== null);
    this.grid.textContent = grid === null ? "" : `grid ${withUnit(grid, "m", 3)}`;
  }
}
