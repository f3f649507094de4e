// The gallery as links.

import { h } from "../ui/dom";
import { searchOf } from "./address";
import type { GalleryScene } from "./gallery";

/** All scenes; `unknown` is a name that is none of theirs, `files` asks for some of the reader. */
export function overview(scenes: GalleryScene[], unknown: string | null, files: HTMLElement): HTMLElement {
  const problem = `There is no scene "${unknown}" in the gallery. These are there:`;
  return h(
    "main",
    { class: "overview" },
    h("h1", {}, "Gyration"),
    h(
      "p",
      { class: "quiet" },
      "Choose a scene, or drop one of yours here: it runs in this page, and nothing of it leaves your machine. ",
      files,
    ),
    unknown !== null && h("p", { class: "note bad", role: "alert" }, problem),
    h(
      "nav",
      { "aria-label": "scenes" },
      h(
        "ul",
        {},
        ...scenes.map(({ name, title }) =>
          h(
            "li",
            {},
            h("a", { href: searchOf({ scene: name, set: [] }) }, h("b", {}, name), " ", h("span", {}, title)),
          ),
        ),
      ),
    ),
  );
}
