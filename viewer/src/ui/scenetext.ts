// The scene's text as it was written, and as it was understood with every default.

import type { Header } from "../data/header";
import { h } from "./dom";

export function scenePanel(header: Header): HTMLElement {
  const text = h("pre", { class: "code", tabindex: 0, "aria-label": "scene" });
  const written = h("button", { type: "button", onclick: () => show(true) }, "As written");
  const resolved = h("button", { type: "button", onclick: () => show(false) }, "Resolved, in SI units");
  const copy = h("button", { type: "button", onclick: () => void copied() }, "Copy");
  const show = (asWritten: boolean) => {
    written.setAttribute("aria-pressed", String(asWritten));
    resolved.setAttribute("aria-pressed", String(!asWritten));
    if (asWritten) text.replaceChildren(colored(header.scene ?? ""));
    else text.textContent = JSON.stringify(header.resolved ?? null, null, 2);
  };
  const copied = async () => {
    const range = document.createRange();
    range.selectNodeContents(text);
    getSelection()?.removeAllRanges();
    getSelection()?.addRange(range);
    try {
      await navigator.clipboard.writeText(text.textContent ?? "");
      copy.textContent = "Copied";
    } catch {
      copy.textContent = "Selected";
    }
    window.setTimeout(() => {
      copy.textContent = "Copy";
    }, 1500);
  };
  show(Boolean(header.scene));
  const changed = header.overrides?.length
    ? h("p", { class: "quiet" }, `Changed for this run: ${header.overrides.join("  ")}`)
    : null;
  return h(
    "div",
    { class: "scene" },
    h("div", { class: "segments" }, written, resolved, copy),
    changed,
    text,
  );
}

/** Lines whose parts are set apart: of ten thousand bodies the text is long enough as it is. */
const MOST_COLORED = 3000;

/** TOML with comments, headings and keys set apart. */
function colored(text: string): DocumentFragment {
  const lines = text.split("\n");
  const whole = document.createDocumentFragment();
  for (const line of lines.slice(0, MOST_COLORED)) whole.append(...parts(line), "\n");
  whole.append(lines.slice(MOST_COLORED).join("\n"));
  return whole;
}

function parts(line: string): Node[] {
  if (/^\s*#/.test(line)) return [h("span", { class: "comment" }, line)];
  if (/^\s*\[/.test(line) && !line.includes("=")) return [h("span", { class: "heading" }, line)];
  const key = /^(\s*[A-Za-z0-9_.-]+)(\s*=.*)$/.exec(line);
  if (!key) return [document.createTextNode(line)];
  return [h("span", { class: "key-name" }, key[1]), document.createTextNode(key[2])];
}
