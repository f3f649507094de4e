// The files beside the page: the scenes of the gallery, and the hashes of their runs on the machine of the build.

export interface GalleryScene {
  name: string;
  title: string;
  /** The scene file. */
  text: string;
  /** It is a file of the reader, which no address opens. */
  own?: true;
}

/** Hashes by name of the scene, 16 hexadecimal digits. */
export type Hashes = Record<string, string>;

export async function gallery(): Promise<GalleryScene[]> {
  const scenes = (await beside("gallery.json")) as GalleryScene[];
  if (!Array.isArray(scenes) || !scenes.every(({ name, text }) => name && typeof text === "string"))
    throw new Error("gallery.json holds no scenes.");
  return scenes;
}

/** The hashes; none if there is no file of them: runs then have nothing to be compared with. */
export async function hashes(): Promise<Hashes> {
  try {
    return (await beside("hashes.json")) as Hashes;
  } catch {
    return {};
  }
}

async function beside(name: string): Promise<unknown> {
  const response = await fetch(name, { cache: "no-cache" }).catch(() => null);
  if (!response?.ok)
    throw new Error(
      `${name} is not there: ${response ? `the server answers ${response.status}` : "no server answers"}.`,
    );
  return response.json();
}
