// Classes of bodies, by which they are coloured: each a class of its own as long as there are few; of more, those of a
// group are a class, or where the scene names no group, those of a sort. Plots on paper have the same classes.

import type { Header, Json } from "./header";

/** Bodies of which each has a colour of its own. */
export const MOST_ALONE = 7;
/** Bodies without a group, where others have one. */
const WITHOUT_GROUP = "without a group";

export interface BodyClasses {
  /** Names of the classes, in the order of their first bodies. */
  names: string[];
  /** The class of each body. */
  ofBody: number[];
  /** The bodies of each class. */
  members: number[][];
}

const known = new WeakMap<object, BodyClasses>();

/** The classes of the bodies of a recording. */
export function classesOf({ bodies, resolved }: Header): BodyClasses {
  const before = known.get(bodies);
  if (before) return before;
  const described = new Map<string, { [key: string]: Json }>();
  for (const body of listAt(resolved, "body")) {
    if (isTable(body) && typeof body.name === "string") described.set(body.name, body);
  }
  const groups = bodies.map(({ name }) => groupOf(described.get(name)));
  const grouped = groups.some((group) => group !== null);
  const words = bodies.map(({ name, kind }, index) => {
    if (bodies.length <= MOST_ALONE) return name;
    return groups[index] ?? (grouped ? WITHOUT_GROUP : sortOf(kind, described.get(name)));
  });
  const names = [...new Set(words)];
  const place = new Map(names.map((name, index) => [name, index]));
  const ofBody = words.map((word) => place.get(word) ?? 0);
  const members = names.map(() => [] as number[]);
  for (const [body, of] of ofBody.entries()) members[of].push(body);
  const classes = { names, ofBody, members };
  known.set(bodies, classes);
  return classes;
}

/** A class in a legend: its name, and how many bodies are of it. */
export function classLabel({ names, members, ofBody }: BodyClasses, index: number): string {
  return ofBody.length <= MOST_ALONE ? names[index] : `${names[index]} (${members[index].length})`;
}

function groupOf(body: { [key: string]: Json } | undefined): string | null {
  const group = body?.group;
  const first = Array.isArray(group) ? group[0] : group;
  return typeof first === "string" ? first : null;
}

/** Kind and shape in words. */
function sortOf(kind: string, body: { [key: string]: Json } | undefined): string {
  const shape = isTable(body?.shape) ? Object.keys(body.shape)[0] : undefined;
  return shape ? `${kind}, ${shape.replaceAll("_", " ")}` : `${kind} bodies`;
}

function listAt(value: Json | undefined, key: string): Json[] {
  const list = isTable(value) ? value[key] : undefined;
  return Array.isArray(list) ? list : [];
}

function isTable(value: Json | undefined): value is { [key: string]: Json } {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
