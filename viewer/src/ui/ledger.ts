// The energy ledger of a recording: energies at start and end, works, and how well the books close.

import type { Header } from "../data/header";
import type { Recording } from "../data/recording";
import { withUnit, words } from "../math/format";

export interface Entry {
  name: string;
  start: number;
  end: number;
}

export interface Books {
  energies: Entry[];
  sum: Entry;
  works: { name: string; value: number }[];
  /** Residual at the end [J]. */
  residual: number;
  /** Largest |residual| [J], of all samples. */
  largest: number;
  /** The energy in play [J]: the largest kinetic energy, or sum of |works|. */
  inPlay: number;
}

/** A residual below this fraction of the energies is their own rounding. */
const ROUNDING = 16 * Number.EPSILON;

/** The ledger from the first sample to the last; `null` if no energies are recorded. */
export function books(recording: Recording): Books | null {
  const { rows, header } = recording;
  const tracks = [...recording.tracks.values()].filter(({ spec }) => spec.stride === 1);
  const energies = tracks
    .filter(({ spec }) => spec.name.startsWith("energy_") && spec.name !== "energy_residual")
    .map(({ spec, values }) => ({
      name: words(spec.name.slice("energy_".length)),
      start: values[0],
      end: values[rows - 1],
    }));
  if (energies.length === 0 || rows === 0) return null;
  const total = (key: "start" | "end") => energies.reduce((sum, entry) => sum + entry[key], 0);
  const works = tracks
    .filter(({ spec }) => spec.name.startsWith("work_"))
    .map(({ spec, values }) => ({ name: words(spec.name.slice("work_".length)), value: values[rows - 1] }));
  const residuals = recording.track("energy_residual")?.values;
  return {
    energies,
    sum: { name: "sum", start: total("start"), end: total("end") },
    works,
    residual: residuals?.[rows - 1] ?? Number.NaN,
    largest: header.summary?.largest_residual ?? largestSize(residuals, rows),
    inPlay: header.summary?.energy_in_play ?? inPlay(recording),
  };
}

/** How well the books close, in a sentence. */
export function residualInWords({ residual, largest, inPlay: play, energies }: Books): string {
  if (!Number.isFinite(residual)) return "No residual is recorded.";
  const joules = (value: number) => withUnit(value, "J", 2);
  const size = energies.reduce((sum, { end }) => sum + Math.abs(end), 0);
  const relation =
    largest <= ROUNDING * size
      ? ", which is the rounding of the energies"
      : play > 0
        ? `, ${(largest / play).toExponential(1).replace("-", "−")} of the energy in play (${joules(play)})`
        : "";
  const end = `At the end the ledger is off by ${joules(residual)}`;
  return `${end}; at no sample by more than ${joules(largest)}${relation}.`;
}

/** What must not be overlooked of a run whose energy balance is open; `null` if it closes. */
export function openLedgerInWords({ summary }: Header): string | null {
  if (summary?.ledger !== "open") return null;
  const joules = (value?: number | null) =>
    typeof value === "number" ? withUnit(value, "J", 2) : "not a number";
  const { largest_residual: residual, energy_in_play: play } = summary;
  return `Energy ledger open: residual ${joules(residual)}, energy in play ${joules(play)}. Do not trust the run.`;
}

function largestSize(values: Float32Array | undefined, rows: number): number {
  let largest = 0;
  for (let row = 0; values && row < rows; row++) largest = Math.max(largest, Math.abs(values[row]));
  return largest;
}

function inPlay(recording: Recording): number {
  const works = [...recording.tracks.values()].filter(({ spec }) => spec.name.startsWith("work_"));
  const kinetic = recording.track("energy_kinetic")?.values;
  let most = 0;
  for (let row = 0; row < recording.rows; row++) {
    const worked = works.reduce((sum, { values }) => sum + Math.abs(values[row]), 0);
    most = Math.max(most, worked, kinetic?.[row] ?? 0);
  }
  return most;
}
