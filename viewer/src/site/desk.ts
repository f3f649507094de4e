// Parts of the site around a run: the way back to the gallery, the editor, the verdict; the address follows the run.

import type { Surroundings } from "../app";
import type { EngineRun } from "../data/engine";
import type { Recording } from "../data/recording";
import { h } from "../ui/dom";
import { searchOf } from "./address";
import { Editor } from "./editor";
import { listenForDrops, read } from "./files";
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
  /** The name of the scene in the editor. */
  private name: string;

  constructor(
    private readonly subject: GalleryScene,
    private readonly hashes: Promise<Hashes>,
    private readonly run: EngineRun,
    /** Shows the panel of the scene. */
    private readonly opened: () => void = () => {},
  ) {
    this.text = subject.text;
    this.editor = new Editor(subject.text, {
      run: (text) => run.run(text, this.name),
      take: (files) => void this.take(files),
      isOwn: subject.own ?? false,
    });
    this.name = subject.name;
    listenForDrops((files) => void this.take(files));
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
    if (!this.subject.own)
      history.replaceState(null, "", searchOf({ scene: this.subject.name, set: shown.set }) + location.hash);
    const another = shown.scene !== this.text;
    this.text = shown.scene;
    return another;
  }

  /** Opens a scene of the reader in the editor; what scenes name is for those that run from now on. */
  private async take(files: File[]): Promise<void> {
    const { scene, data } = await read(files);
    for (const { name, content } of data) this.run.give(name, content);
    if (scene) this.name = scene.name;
    this.opened();
    await this.editor.take(
      scene?.text ?? null,
      data.map(({ name }) => name),
    );
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
