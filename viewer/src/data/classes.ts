// Classes of bodies, by which they are coloured: each a class of its own as long as there are few; of more, those of a
// group are a class, or where the scene names no group, those of a sort. Plots on paper have the same classes.

import { describedIn, groupWords } from "./described";
import type { Header, Json } from "./header";
import { table } from "./json";

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
export function classesOf({ bodies, resolved }: Pick<Header, "bodies" | "resolved">): BodyClasses {
  const before = known.get(bodies);
  if (before) return before;
  const described = describedIn({ resolved });
  const groups = bodies.map(({ name }): string | undefined => groupWords(described(name))[0]);
  const grouped = groups.some((group) => group !== undefined);
  const words = bodies.map(({ name, kind }, index) => {
    if (bodies.length <= MOST_ALONE) return name;
    return groups[index] ?? (grouped ? WITHOUT_GROUP : sortOf(kind, described(name)));
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

/** Kind and shape in words. */
function sortOf(kind: string, body: { [key: string]: Json }): string {
  const shape = Object.keys(table(body.shape))[0];
  return shape ? `${kind}, ${shape.replaceAll("_", " ")}` : `${kind} bodies`;
}
