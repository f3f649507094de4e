// Parts of the site around a run: the way back to the gallery, the editor, the verdict; the address follows the run.

import type { Surroundings } from "../app";
import type { EngineRun } from "../data/engine";
import type { Recording } from "../data/recording";
import { h } from "../ui/dom";
import { searchOf } from "./address";
import { Editor } from "./editor";
import type { GalleryScene, Hashes } from "./gallery";
import { SaveButtons } from "./save";
import { Verdict } from "./verdict";

export class Desk implements Surroundings {
  readonly home = h("a", { class: "home", href: location.pathname }, "Gallery");
  readonly scene: HTMLElement;
  readonly foot: HTMLElement;
  private readonly editor: Editor;
  private readonly verdict = new Verdict();
  /** The text of the run that is shown. */
  private text: string;

  constructor(
    private readonly subject: GalleryScene,
    private readonly hashes: Promise<Hashes>,
    private readonly run: EngineRun,
  ) {
    this.text = subject.text;
    this.editor = new Editor(subject.text, (text) => run.run(text));
    this.scene = this.editor.element;
    const saving = new SaveButtons(
      () => run.shown?.name ?? subject.name,
      (format) => run.save(format),
    );
    this.foot = h("div", { class: "foot" }, this.verdict.element, saving.element);
  }

  begun({ header }: Recording): boolean {
    const { shown } = this.run;
    this.editor.begun(header);
    this.verdict.wait();
    if (!shown) return false;
    history.replaceState(null, "", searchOf({ scene: this.subject.name, set: shown.set }) + location.hash);
    const another = shown.scene !== this.text;
    this.text = shown.scene;
    return another;
  }

  failed(): void {
    this.verdict.clear();
  }

  async done(hash: string | null | undefined): Promise<void> {
    const { subject, run } = this;
    const { shown } = run;
    const hashes = await this.hashes;
    // Another run may have begun since.
    if (hash === undefined || shown !== run.shown) return;
    const isOfTheGallery = shown?.scene === subject.text && shown.set.length === 0;
    this.verdict.show(hash, isOfTheGallery ? hashes[subject.name] : undefined);
  }
}
