// What a resolved scene tells of the bodies and supports of a recording, by their names.

import type { Header, Json } from "./header";
import { list, table } from "./json";

/** The table of a body or support of this name; copies have the name of the body and a number. */
export function describedIn({
  resolved,
}: {
  resolved?: Json | undefined;
}): (name: string) => { [key: string]: Json } {
  const scene = table(resolved);
  const known = new Map<string, Json>();
  for (const one of [...list(scene.support), ...list(scene.body)]) known.set(String(table(one).name), one);
  return (name) => table(known.get(name) ?? known.get(name.replace(/-\d+$/, "")));
}

/** The groups of what a scene tells of a body; its copies are one, too. */
export function groupWords({ group, copies, name }: { [key: string]: Json }): string[] {
  const words = [...(Array.isArray(group) ? group : [group]), ...(copies ? [name] : [])];
  return words.filter((word) => typeof word === "string");
}

/** The bodies of each group that has several, in the order of their first bodies. */
export function groupsOf(header: Pick<Header, "bodies" | "resolved">): Map<string, number[]> {
  const described = describedIn(header);
  const groups = new Map<string, number[]>();
  for (const [index, { name }] of header.bodies.entries()) {
    for (const word of groupWords(described(name))) {
      const members = groups.get(word) ?? [];
      members.push(index);
      groups.set(word, members);
    }
  }
  return new Map([...groups].filter(([, members]) => members.length > 1));
}
