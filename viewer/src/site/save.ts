// Saves the run so far: as a table, or as an animation in space.

import { FORMATS, type Format } from "../engine/messages";
import { h } from "../ui/dom";

/** What is saved, by format: what a reader is told of it, and its type. */
const FILES: Record<Format, { label: string; title: string; type: string }> = {
  csv: {
    label: "CSV",
    title: "Save the run so far as a table (CSV): a row a sample, all its columns",
    type: "text/csv",
  },
  glb: {
    label: "GLB",
    title: "Save the run so far as an animation (GLB), which viewers of three-dimensional scenes open",
    type: "model/gltf-binary",
  },
};

export class SaveButtons {
  readonly element: HTMLElement;
  private readonly told = h("span", { role: "status" });
  private readonly buttons: HTMLButtonElement[];

  /** `name` gives that of the files; `save` gives their parts. */
  constructor(
    private readonly name: () => string,
    private readonly save: (format: Format) => Promise<ArrayBuffer[]>,
  ) {
    this.buttons = FORMATS.map((format) => {
      const { label, title } = FILES[format];
      const onclick = () => void this.give(format);
      return h("button", { type: "button", title, "aria-label": title, onclick }, label);
    });
    this.element = h(
      "div",
      { class: "save", role: "group", "aria-label": "save" },
      h("span", { "aria-hidden": "true" }, "Save"),
      ...this.buttons,
      this.told,
    );
  }

  private async give(format: Format): Promise<void> {
    const name = `${this.name()}.${format}`;
    this.say(`${name} is being written.`);
    for (const button of this.buttons) button.disabled = true;
    try {
      const content = new Blob(await this.save(format), { type: FILES[format].type });
      download(name, content);
      this.say(`${name}: ${(content.size / 1e6).toPrecision(2)} MB`);
    } catch (error) {
      this.say((error as Error).message, true);
    }
    for (const button of this.buttons) button.disabled = false;
    this.buttons[FORMATS.indexOf(format)].focus();
  }

  private say(words: string, bad = false): void {
    this.told.className = bad ? "bad" : "";
    this.told.textContent = words;
  }
}

/** Hands a file to the browser, which asks the reader where to or puts it among the downloads. */
function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  h("a", { href: address, download: name }).click();
  // The browser has begun to read it by then.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
