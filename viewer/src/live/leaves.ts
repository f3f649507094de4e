// The numbers of a resolved scene and how they are addressed: dotted keys as `gyration run --set` takes them.
//
// An item of an array is addressed by its name if it has one, else by its index from zero. A number within a list of
// numbers (a vector, a matrix) is changed by sending the whole list, since a key addresses values, not components.

import type { Json } from "../data/header";

/** A number of the scene. */
export interface Leaf {
  /** What is set: `body.die.velocity`. */
  key: string;
  /** Where in the list that stands at the key: `[0]`, `[2, 1]`; empty for a plain number. */
  path: number[];
  value: number;
}

const NAME = /^[A-Za-z0-9_-]+$/;

/** All numbers of a scene, in its order. */
export function leaves(scene: Json, prefix: string[] = []): Leaf[] {
  if (typeof scene === "number") return [{ key: prefix.join("."), path: [], value: scene }];
  if (Array.isArray(scene)) {
    if (isNumeric(scene)) return listed(prefix.join("."), scene, []);
    return scene.flatMap((item, index) => leaves(item, [...prefix, segment(item, index)]));
  }
  if (typeof scene === "object" && scene !== null) {
    return Object.entries(scene).flatMap(([name, item]) => leaves(item, [...prefix, name]));
  }
  return [];
}

/** A list of numbers, or of such lists. */
function isNumeric(list: Json[]): boolean {
  return (
    list.length > 0 &&
    list.every((item) => typeof item === "number" || (Array.isArray(item) && isNumeric(item)))
  );
}

function listed(key: string, list: Json[], path: number[]): Leaf[] {
  return list.flatMap((item, index) =>
    typeof item === "number"
      ? [{ key, path: [...path, index], value: item }]
      : listed(key, item as Json[], [...path, index]),
  );
}

function segment(item: Json, index: number): string {
  const name = typeof item === "object" && item !== null && !Array.isArray(item) ? item.name : undefined;
  return typeof name === "string" && NAME.test(name) ? name : String(index);
}

/** What stands at a key. */
export function valueAt(scene: Json, key: string): Json | undefined {
  let at: Json | undefined = scene;
  for (const word of key.split(".")) {
    if (Array.isArray(at)) {
      at = at.find((item, index) => segment(item, index) === word);
    } else if (typeof at === "object" && at !== null) {
      at = at[word];
    } else {
      return undefined;
    }
  }
  return at;
}

/** The override that gives leaves of one key new values: `body.die.velocity=[1, 0, 0]`. */
export function override(scene: Json, key: string, changes: { path: number[]; value: number }[]): string {
  let value = structuredClone(valueAt(scene, key) ?? null);
  for (const change of changes) value = replaced(value, change.path, change.value);
  return `${key}=${toml(value)}`;
}

function replaced(value: Json, [first, ...rest]: number[], number: number): Json {
  if (first === undefined || !Array.isArray(value)) return number;
  return value.map((item, index) => (index === first ? replaced(item, rest, number) : item));
}

/** A number or list as TOML writes it; whole numbers are given as they are. */
function toml(value: Json): string {
  if (Array.isArray(value)) return `[${value.map(toml).join(", ")}]`;
  return typeof value === "number" ? String(value) : JSON.stringify(value);
}

/** The group of a leaf: the table it stands in, by name. */
export function groupOf(key: string): string {
  const words = key.split(".");
  const named = words[0] === "body" || words[0] === "support" || words[0] === "contact";
  return words.slice(0, named && words.length > 2 ? 2 : 1).join(".");
}
