// Marks at the edge of the picture: the names of bodies that fly off, where they have left it.

import { h } from "./dom";

export interface EdgeMark {
  name: string;
  /** Where on the edge, from −1 to 1, to the right and upwards. */
  at: [number, number];
}

export class EdgeMarks {
  private readonly marks = h("div", { "aria-hidden": "true" });
  /** Told to a reader of the screen where another one leaves, not where a mark moves. */
  private readonly told = h("p", { class: "told", role: "status" });
  readonly element = h("div", { class: "edge-marks" }, this.marks, this.told);
  private shown = "";

  show(marks: EdgeMark[]): void {
    const key = marks
      .map(({ name, at }) => `${name} ${at.map((part) => part.toFixed(3)).join(" ")}`)
      .join("|");
    if (key === this.shown) return;
    this.shown = key;
    const words = marks.map(({ name }) => name).join(", ");
    const told = words === "" ? "" : `out of the picture: ${words}`;
    if (told !== this.told.textContent) this.told.textContent = told;
    this.marks.replaceChildren(
      ...marks.map(({ name, at: [x, y] }) => {
        const arrow = h("i", { style: `transform:rotate(${Math.atan2(-y, x).toFixed(3)}rad)` }, "➤");
        const place = `left:${(50 * (1 + x)).toFixed(2)}%;top:${(50 * (1 - y)).toFixed(2)}%`;
        const shift = `translate:${(-50 * (1 + x)).toFixed(1)}% ${(-50 * (1 - y)).toFixed(1)}%`;
        const title = `${name} has left the picture`;
        return h("span", { class: "edge-mark", style: `${place};${shift}`, title }, name, arrow);
      }),
    );
  }
}
