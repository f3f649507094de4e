// Files of the reader: dropped anywhere on the page, or chosen. They stay in it.

import { h } from "../ui/dom";

/** What a reader hands over: a scene, and what scenes name: meshes and tables. */
export interface Handed {
  scene: { name: string; text: string } | null;
  data: { name: string; content: ArrayBuffer }[];
}

const SCENE = /\.(toml|json)$/i;

/** Reads files; the first that is a scene by its name is the scene. */
export async function read(files: readonly File[]): Promise<Handed> {
  const scene = files.find(({ name }) => SCENE.test(name));
  const data = files.filter(({ name }) => !SCENE.test(name));
  return {
    scene: scene ? { name: scene.name.replace(SCENE, ""), text: await scene.text() } : null,
    data: await Promise.all(
      data.map(async (file) => ({ name: file.name, content: await file.arrayBuffer() })),
    ),
  };
}

/** A button that asks for files. */
export function fileButton(take: (files: File[]) => void): HTMLElement {
  const input = h("input", {
    type: "file",
    multiple: true,
    accept: ".toml,.json,.stl,.obj,.ply,.csv",
    hidden: true,
    onchange: () => {
      if (input.files?.length) take([...input.files]);
      // The same file may be chosen again once it has changed.
      input.value = "";
    },
  });
  const title =
    "Open a scene (TOML) of yours, with the meshes and tables that it names; or drop them on the page";
  const button = h("button", { type: "button", title, onclick: () => input.click() }, "Open files…");
  return h("span", { class: "files" }, button, input);
}

/** Takes what is dropped anywhere on the page. */
export function listenForDrops(take: (files: File[]) => void): void {
  const show = (on: boolean) => document.documentElement.classList.toggle("dropping", on);
  const hasFiles = ({ dataTransfer }: DragEvent) => dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!hasFiles(event)) return;
    // Else the browser leaves the page for the file.
    event.preventDefault();
    show(true);
  });
  addEventListener("dragleave", (event) => event.relatedTarget === null && show(false));
  addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    show(false);
    take([...(event.dataTransfer?.files ?? [])]);
  });
}
