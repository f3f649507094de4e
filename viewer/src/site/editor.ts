// The scene's text, to be changed and run; refusals in the program's words.

import type { Header } from "../data/header";
import { h } from "../ui/dom";
import { fileButton } from "./files";

const HINT = "Runs the text as it stands, without what sliders have changed.";
const EDITED = "The address opens the scene of the gallery, not the edited text.";
const OWN = "No address opens it: it stays on this machine.";

/** What the editor asks of the page. */
export interface EditorUses {
  /** Answers in the program's words why it refuses a text, or with null. */
  run(text: string): Promise<string | null>;
  /** Takes files that the reader has chosen. */
  take(files: File[]): void;
  /** Whether the text is a file of the reader. */
  isOwn: boolean;
}

export class Editor {
  readonly element: HTMLElement;
  private readonly text: HTMLTextAreaElement;
  private readonly back: HTMLButtonElement;
  private readonly hint = h("p", { class: "quiet", id: "scene-hint", role: "status" }, HINT);
  private readonly refusal = h("div", { id: "scene-refusal", role: "alert" });
  private readonly given = h("p", { class: "quiet", role: "status" });
  private readonly names = new Set<string>();
  private readonly changed = h("p", { class: "quiet" });
  private readonly resolved = h("pre", { class: "code", tabindex: 0, "aria-label": "resolved scene" });
  /** Counts what was asked for: only the last answer is shown. */
  private asked = 0;

  constructor(
    private readonly original: string,
    private readonly uses: EditorUses,
  ) {
    this.text = h("textarea", {
      class: "code",
      id: "scene-text",
      rows: 24,
      spellcheck: "false",
      autocapitalize: "off",
      autocomplete: "off",
      "aria-describedby": "scene-hint scene-refusal",
      oninput: () => this.tell(),
      onkeydown: (event: KeyboardEvent) => {
        if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
        event.preventDefault();
        void this.start();
      },
    });
    this.text.value = original;
    const runs = h("button", { type: "button", class: "strong", onclick: () => void this.start() }, "Run");
    runs.title = "Ctrl+Enter";
    const back = uses.isOwn ? "Back to the file's text" : "Back to the gallery's text";
    this.back = h("button", { type: "button", onclick: () => this.restore() }, back);
    this.element = h(
      "div",
      { class: "scene editor" },
      h("label", { for: "scene-text" }, "Scene"),
      this.text,
      h("div", { class: "segments" }, runs, h("kbd", {}, "Ctrl+Enter"), this.back, fileButton(uses.take)),
      this.given,
      this.refusal,
      this.hint,
      this.changed,
      h("details", {}, h("summary", {}, "Resolved, in SI units"), this.resolved),
    );
    this.tell();
  }

  /** A run has begun. */
  begun({ overrides, resolved }: Header): void {
    this.changed.textContent = overrides?.length ? `Changed for this run: ${overrides.join("  ")}` : "";
    this.resolved.textContent = JSON.stringify(resolved ?? null, null, 2);
  }

  /** Takes another text, and the names of files that it may name; runs. */
  async take(text: string | null, names: string[]): Promise<void> {
    for (const name of names) this.names.add(name);
    if (this.names.size > 0) this.given.textContent = `Files in the page: ${[...this.names].join(", ")}`;
    if (text !== null) this.text.value = text;
    this.tell();
    await this.start();
  }

  private async start(): Promise<void> {
    const asked = ++this.asked;
    const refusal = await this.uses.run(this.text.value);
    if (asked !== this.asked) return;
    this.text.setAttribute("aria-invalid", String(refusal !== null));
    this.refusal.replaceChildren(
      refusal === null ? "" : h("pre", { class: "refusal", tabindex: 0 }, refusal.trimEnd()),
    );
  }

  private restore(): void {
    this.text.value = this.original;
    this.text.focus();
    this.tell();
  }

  /** Says what the address opens. */
  private tell(): void {
    const edited = this.text.value !== this.original;
    this.back.disabled = !edited;
    const words = [HINT, this.uses.isOwn ? OWN : edited ? EDITED : ""].filter(Boolean).join(" ");
    if (this.hint.textContent !== words) this.hint.textContent = words;
  }
}
