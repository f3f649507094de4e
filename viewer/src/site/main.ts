// The page of the site: the gallery as links, or a scene of it that runs in the page.

import "../style";
import "../style/site.css";
import { App } from "../app";
import { EngineRun, type EngineWorker } from "../data/engine";
import { h } from "../ui/dom";
import { watchTheme } from "../ui/theme";
import { addressIn } from "./address";
import { Desk } from "./desk";
import { fileButton, type Handed, listenForDrops, read } from "./files";
import { type GalleryScene, gallery, type Hashes, hashes } from "./gallery";
import { overview } from "./overview";

function employed(): EngineWorker {
  return new Worker(new URL("../engine/worker.ts", import.meta.url), { type: "module" });
}

async function start(): Promise<void> {
  const { scene, set } = addressIn(location.search);
  const compared = hashes();
  const scenes = await gallery();
  const subject = scenes.find(({ name }) => name === scene);
  document.getElementById("loading")?.remove();
  if (subject) await show(subject, set, compared);
  else offer(scenes, scene, compared);
}

/** Shows the gallery, until a scene of the reader comes. */
function offer(scenes: GalleryScene[], unknown: string | null, compared: Promise<Hashes>): void {
  let page: HTMLElement | null = null;
  const take = async (files: File[]) => {
    if (!page) return;
    const { scene, data } = await read(files);
    if (!scene) {
      const words = "Drop the scene, a file .toml, together with the files that it names.";
      page.prepend(h("p", { class: "note bad", role: "alert" }, words));
      return;
    }
    page.remove();
    page = null;
    const { name, text } = scene;
    await show({ name, title: name, text, own: true }, [], compared, data);
  };
  watchTheme(() => {});
  page = overview(
    scenes,
    unknown,
    fileButton((files) => void take(files)),
  );
  document.body.append(page);
  listenForDrops((files) => void take(files));
}

/** Shows a run of a scene. */
async function show(
  subject: GalleryScene,
  set: string[],
  compared: Promise<Hashes>,
  data: Handed["data"] = [],
): Promise<void> {
  const first = { name: subject.name, scene: subject.text, set };
  const run = new EngineRun(first, new URL("engine.wasm", location.href).href, employed);
  for (const { name, content } of data) run.give(name, content);
  const desk = new Desk(subject, compared, run, () => app.open("Scene"));
  const app = new App(document.body, desk);
  window.gyration = app.handle;
  await app.show(run);
}

start().catch((error: Error) => {
  document.getElementById("loading")?.remove();
  document.body.append(h("p", { class: "note bad", role: "alert" }, error.message));
});
