// The address of a run of the site: the scene and what is set in it.
//
//   ?scene=dice&set=body.die.velocity=%5B1,0,0%5D&set=time.end=1
//
// A plus sign stands for itself: numbers have it more often than spaces.

export interface Address {
  /** A scene of the gallery; none: the gallery itself. */
  scene: string | null;
  /** Overrides, as of `--set`. */
  set: string[];
}

/** Reads the part of an address behind `?`; parts of others are left out. */
export function addressIn(search: string): Address {
  const address: Address = { scene: null, set: [] };
  for (const part of search.replace(/^\?/, "").split("&")) {
    const [key] = part.split("=", 1);
    const value = decoded(part.slice(key.length + 1));
    if (key === "scene" && value !== "") address.scene ??= value;
    if (key === "set" && value !== "") address.set.push(value);
  }
  return address;
}

/** The part of the address behind `?`, with it; a link keeps its signs wherever it is copied to. */
export function searchOf({ scene, set }: Address): string {
  const parts = [
    ...(scene === null ? [] : [`scene=${encoded(scene)}`]),
    ...set.map((one) => `set=${encoded(one)}`),
  ];
  return `?${parts.join("&")}`;
}

function encoded(text: string): string {
  const readable = encodeURIComponent(text).replaceAll("%3D", "=").replaceAll("%2C", ",");
  // Signs that end a link in running text.
  return readable.replace(/[!'()*]/g, (sign) => `%${sign.charCodeAt(0).toString(16).toUpperCase()}`);
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
