// Numbers that the program has refused: which they are, and why, in its words. They are left out of what is asked for,
// so that the run goes on with the last good ones.

import type { Leaf } from "./leaves";

/** A number that differs from the scene's text. */
export interface Change {
  leaf: Leaf;
  value: number;
}

/** Which of the numbers asked for a message is about: those that it names, else all. */
export function culprits(asked: Change[], message: string): Change[] {
  const named = asked.filter(({ leaf }) => lineOf(leaf.key, message) !== null);
  return named.length > 0 ? named : asked;
}

/** What a message says of a key: `must be greater than 0 kg/m^3, found -5 kg/m^3`. */
export function reasonFor(key: string, message: string): string {
  const [first] = message.split("\n");
  return (lineOf(key, message) ?? first).replace(/^(\w+: )*--set:[\d:]+ /, "");
}

/** What stands behind a key in the first line that speaks of it. */
function lineOf(key: string, message: string): string | null {
  for (const line of message.split("\n")) {
    const at = ` ${line}`.indexOf(` ${key}`);
    if (at < 0) continue;
    const rest = /^(\.\w+)*: (.+)$/.exec(line.slice(at + key.length));
    if (rest) return rest[2];
  }
  return null;
}
