// The hash of a run, and how it compares with that of the machine of the build.

import { h } from "../ui/dom";

export type Agreement = "equal" | "other" | "unknown";

/** Compares a hash with the expected one, if there is one. */
export function agreement(hash: string, expected: string | undefined): Agreement {
  if (expected === undefined) return "unknown";
  return hash === expected ? "equal" : "other";
}

const WORDS: Record<Agreement, string> = {
  equal: "the same numbers as on the machine of the build, bit for bit",
  other: "other numbers than on the machine of the build",
  unknown: "",
};

export class Verdict {
  readonly element = h(
    "p",
    { class: "verdict quiet", role: "status" },
    "The run begins when the engine has come.",
  );

  /** A run goes on: its hash is that of all its rows. */
  wait(): void {
    this.element.className = "verdict quiet";
    this.element.replaceChildren("The hash of all numbers comes with the end of the run.");
  }

  /** Promises nothing. */
  clear(): void {
    this.element.replaceChildren();
  }

  /** A run has ended; null: rows were left out, so that it has no hash. */
  show(hash: string | null, expected: string | undefined): void {
    if (hash === null) {
      this.element.replaceChildren("No hash: the run is long, and some of its rows are left out here.");
      return;
    }
    const compared = agreement(hash, expected);
    this.element.className = `verdict ${compared}`;
    this.element.replaceChildren("hash ", h("code", {}, hash), WORDS[compared] && `: ${WORDS[compared]}`);
  }
}
