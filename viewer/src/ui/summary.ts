// The summary in words: outcome, ledger, bodies, solver, provenance, notes.

import type { Body, Header } from "../data/header";
import type { Recording } from "../data/recording";
import { counted, plain, withUnit, words } from "../math/format";
import { h } from "./dom";
import { type Books, books, openLedgerInWords, residualInWords } from "./ledger";

/** Bodies whose mass properties are listed. */
const MOST_BODIES = 12;

export function summaryPanel(recording: Recording): HTMLElement {
  const { header } = recording;
  return h(
    "div",
    { class: "words" },
    ...notes(header),
    section(
      "Outcome",
      h("p", { class: "outcome" }, outcomeInWords(recording)),
      openLedger(header),
      ...warnings(header),
      events(header),
    ),
    ledgerSection(recording),
    bodiesSection(header),
    solverSection(header),
    provenance(header),
  );
}

/** How the run ended, or how far it is, in a sentence. */
export function outcomeInWords({ header, lastTime, rows, isOver }: Recording): string {
  const words = header.summary?.outcome_in_words;
  if (words === "completed") return `The run reached its end, t = ${withUnit(lastTime, "s")}.`;
  if (typeof words === "string") return sentence(words);
  const { outcome } = header;
  if (outcome === "completed") return `The run reached its end, t = ${withUnit(lastTime, "s")}.`;
  if (outcome && typeof outcome === "object") {
    if ("at_rest" in outcome)
      return `It came to rest and stopped at t = ${withUnit(outcome.at_rest.time, "s")}.`;
    const { time, what, advice } = outcome.stopped;
    return `Stopped at t = ${withUnit(time, "s", 7)}: ${what}. ${advice}`;
  }
  if (isOver) return `Interrupted at t = ${withUnit(lastTime, "s")}; it can be resumed.`;
  return `Running: ${counted(rows, "sample")} up to t = ${withUnit(lastTime, "s")} of ${withUnit(header.end, "s")}.`;
}

function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");
}

function section(title: string, ...content: (Node | string | null)[]): HTMLElement {
  return h("section", {}, h("h2", {}, title), ...content);
}

/** Cells by rows; the first column names the row. */
function table(head: string[] | null, rows: (string | Node)[][]): HTMLElement {
  const cells = (tag: "td" | "th", row: (string | Node)[]) =>
    row.map((cell, index) =>
      h(index === 0 ? "th" : tag, index === 0 && tag === "td" ? { scope: "row" } : {}, cell),
    );
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      {},
      head && h("thead", {}, h("tr", {}, ...cells("th", head))),
      h("tbody", {}, ...rows.map((row) => h("tr", {}, ...cells("td", row)))),
    ),
  );
}

function notes({ notes, thinned }: Header): HTMLElement[] {
  const all = [...(notes ?? [])];
  if (thinned && !all.some((note) => note.includes("thinned") || note.includes(String(thinned.kept)))) {
    all.push(`This report shows ${thinned.kept} of the recording's ${counted(thinned.of, "sample")}.`);
  }
  return all.map((note) => h("p", { class: "note", role: "note" }, note));
}

function openLedger(header: Header): HTMLElement | null {
  const words = openLedgerInWords(header);
  return words ? h("p", { class: "note bad", role: "note" }, words) : null;
}

function warnings({ summary }: Header): HTMLElement[] {
  return (summary?.warnings ?? []).map((words) =>
    h("p", { class: "note bad", role: "note" }, `Warning: ${words}.`),
  );
}

function events(header: Header): HTMLElement | null {
  const counts = Object.entries(header.summary?.events ?? {}).filter(([, count]) => count > 0);
  if (counts.length === 0) return null;
  return h(
    "p",
    { class: "quiet" },
    `Events: ${counts.map(([kind, count]) => counted(count, words(kind))).join(", ")}.`,
  );
}

function ledgerSection(recording: Recording): HTMLElement {
  const seen = books(recording);
  if (!seen) return section("Energy", h("p", { class: "quiet" }, "No energies are recorded."));
  return section(
    "Energy",
    h("p", {}, ledgerInWords(seen)),
    table(
      ["energy", "at the start", "at the end"],
      [...seen.energies, seen.sum].map(({ name, start, end }) => [
        name,
        withUnit(start, "J"),
        withUnit(end, "J"),
      ]),
    ),
    seen.works.length > 0
      ? table(
          ["work done on the bodies", ""],
          [...seen.works.map(({ name, value }) => [`of ${name}`, withUnit(value, "J")])],
        )
      : null,
    h("p", { class: "quiet" }, residualInWords(seen)),
  );
}

/** What became of the energy, in two sentences. */
function ledgerInWords({ sum, works }: Books): string {
  const joules = (value: number) => withUnit(Math.abs(value), "J", 3);
  const change = sum.end - sum.start;
  const whole = Math.max(
    Math.abs(sum.start),
    Math.abs(sum.end),
    ...works.map(({ value }) => Math.abs(value)),
  );
  const counts = works
    .filter(({ value }) => Math.abs(value) > 1e-3 * whole)
    .sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
  const moved = counts.map(({ name, value }) => `${name} ${value > 0 ? "gave" : "took"} ${joules(value)}`);
  const kept = Math.abs(change) <= 1e-3 * whole;
  const first = kept
    ? "The energy is at the end what it was at the start."
    : `The bodies ${change > 0 ? "gained" : "lost"} ${joules(change)}.`;
  return moved.length > 0 ? `${first} ${sentence(moved.join(", "))}` : first;
}

function bodiesSection({ bodies }: Header): HTMLElement {
  const rows = bodies
    .slice(0, MOST_BODIES)
    .map((body) => [
      body.name,
      body.kind,
      massInWords(body.mass),
      withUnit(body.size, "m"),
      eulerTensor(body),
    ]);
  const more = bodies.length - rows.length;
  return section(
    "Bodies",
    table(["body", "kind", "mass", "size", "Euler tensor [kg m²]"], rows),
    more > 0 ? h("p", { class: "quiet" }, `and ${more} more`) : null,
  );
}

function massInWords(mass: number): string {
  return mass >= 1 ? `${plain(mass)} kg` : withUnit(1000 * mass, "g");
}

/** Three numbers if it is diagonal, else the six of its upper triangle. */
function eulerTensor({ euler_tensor: j }: Body): string {
  const largest = Math.max(...j.map(Math.abs));
  const number = (value: number) => (Math.abs(value) <= 1e-12 * largest ? "0" : plain(value, 4));
  const off = Math.max(Math.abs(j[1]), Math.abs(j[2]), Math.abs(j[5]));
  if (off <= 1e-12 * largest) return `diag(${[j[0], j[4], j[8]].map(number).join(", ")})`;
  return `xx ${number(j[0])}, yy ${number(j[4])}, zz ${number(j[8])}, xy ${number(j[1])}, xz ${number(j[2])}, yz ${number(j[5])}`;
}

function solverSection({ summary, tolerances }: Header): HTMLElement | null {
  const statistics = Object.entries(summary?.statistics ?? {});
  const rows = statistics.map(([name, value]) => [
    words(name),
    name.endsWith("_step") ? withUnit(value, "s", 3) : plain(value, name === "largest_projection" ? 3 : 12),
  ]);
  if (tolerances)
    rows.unshift(["tolerances", `rtol ${plain(tolerances.rtol)}, atol ${plain(tolerances.atol)}`]);
  return rows.length > 0 ? section("Solver", table(null, rows)) : null;
}

function provenance({ version, commit, scene_name: scene, overrides, gravity }: Header): HTMLElement {
  const rows: string[][] = [];
  if (scene) rows.push(["scene", scene]);
  if (overrides && overrides.length > 0) rows.push(["changed", overrides.join("  ")]);
  rows.push(["gravity", `(${gravity.map((value) => plain(value)).join(", ")}) m/s²`]);
  if (version)
    rows.push(["program", `gyration ${version}${commit ? `, commit ${commit.slice(0, 12)}` : ""}`]);
  return section("Provenance", table(null, rows));
}
