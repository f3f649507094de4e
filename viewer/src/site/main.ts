// The page of the site: the gallery as links, or a scene of it that runs in the page.

import "../style";
import "../style/site.css";
import { App } from "../app";
import { EngineRun, type EngineWorker } from "../data/engine";
import { h } from "../ui/dom";
import { watchTheme } from "../ui/theme";
import { addressIn } from "./address";
import { Desk } from "./desk";
import { gallery, hashes } from "./gallery";
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
  if (!subject) {
    watchTheme(() => {});
    document.body.append(overview(scenes, scene));
    return;
  }
  const first = { name: subject.name, scene: subject.text, set };
  const run = new EngineRun(first, new URL("engine.wasm", location.href).href, employed);
  const app = new App(document.body, new Desk(subject, compared, run));
  window.gyration = app.handle;
  await app.show(run);
}

start().catch((error: Error) => {
  document.getElementById("loading")?.remove();
  document.body.append(h("p", { class: "note bad", role: "alert" }, error.message));
});
