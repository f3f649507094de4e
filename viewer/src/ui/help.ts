// The keys of the page, and the overlay that lists them.

import { h, iconButton } from "./dom";

export interface Key {
  /** As `KeyboardEvent.key` gives them. */
  keys: string[];
  /** As they are written on a keyboard. */
  shown: string;
  does: string;
  act: () => void;
}

/** The overlay; it is a dialog, so that Escape closes it. */
export function helpDialog(keys: Key[]): HTMLDialogElement {
  const dialog = h("dialog", { class: "help", "aria-label": "help" });
  const rows = keys.map(({ shown, does }) =>
    h("tr", {}, h("th", {}, h("kbd", {}, shown)), h("td", {}, does)),
  );
  const mouse = [
    ["drag", "turn the view"],
    ["right drag, or two fingers", "move the view"],
    ["wheel, or pinch", "come closer, go away"],
    ["click a body", "choose it for the plots"],
    ["the address", "is a link to what is looked at"],
    ["click in a plot", "go to that time"],
    ["drag in a plot", "zoom; double click: all again"],
  ].map(([shown, does]) => h("tr", {}, h("th", {}, shown), h("td", {}, does)));
  const half = Math.ceil((rows.length + mouse.length) / 2);
  dialog.append(
    h(
      "header",
      {},
      h("h2", {}, "Keys and mouse"),
      iconButton("close", "Close help", () => dialog.close()),
    ),
    h(
      "div",
      { class: "columns" },
      h("table", {}, h("tbody", {}, ...rows.slice(0, half))),
      h("table", {}, h("tbody", {}, ...rows.slice(half), ...mouse)),
    ),
    h(
      "p",
      { class: "quiet" },
      "A contact force is drawn asinh(f/mg) half body sizes long: in proportion below the weight, by logarithm above. ",
      "The network of forces has a bar for each contact, as wide as its force is of the mean. ",
      "Axes of strain are orange where the body is extended, blue where it is shortened. ",
      "Between samples, slow playing moves bodies along straight lines; at rest only samples are shown.",
    ),
  );
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}

/** Listens to the keys, except where someone writes or chooses. */
export function listen(keys: Key[]): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target instanceof Element ? event.target : document.body;
    if (target.closest("input:not(.scrubber), select, textarea, dialog[open]")) return;
    if (event.key === " " && target.closest("button")) return;
    const pressed = event.shiftKey && event.key.startsWith("Arrow") ? `Shift+${event.key}` : event.key;
    const key = keys.find(({ keys }) => keys.includes(pressed));
    if (!key) return;
    event.preventDefault();
    key.act();
  });
}
