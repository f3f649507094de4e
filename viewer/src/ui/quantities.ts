// What can be plotted: groups of series of a recording, found by the names and dimensions of its arrays.

import { classesOf, classLabel, MOST_ALONE } from "../data/classes";
import type { Recording, Track } from "../data/recording";
import { words } from "../math/format";
import { principalStretches, vonMises } from "../math/mat3";
import { derived } from "./derived";

export interface Line {
  label: string;
  at: (row: number) => number;
  /** Which colour it has; its place in the chart if none is given. */
  hue?: number;
}

/** An entry of the legend, for one line or several of one colour. */
export interface LegendKey {
  label: string;
  lines: number[];
}

/** Lines of one unit for one chart. */
export interface Chart {
  id: string;
  title: string;
  units: string;
  log: boolean;
  lines: Line[];
  /** Where lines share an entry of the legend. */
  keys?: LegendKey[];
  /** What the legend does not tell. */
  note?: string;
}

/** Bodies with a line in one chart; more would be a tangle. */
const MOST_LINES = 40;

/** The charts of a recording; those of single bodies are of `body`, or of all where that is one line each. */
export function charts(recording: Recording, body: number | null): Chart[] {
  const shown = body === null ? drawnBodies(recording) : [body];
  const one = body ?? 0;
  return [
    energies(recording),
    works(recording),
    residual(recording),
    gap(recording, shown),
    vector(recording, "linear_momentum", "Momentum", one),
    vector(recording, "angular_momentum", "Angular momentum", one),
    vector(recording, "position", "Position", one),
    vector(recording, "velocity", "Velocity", one),
    vector(recording, "contact_force", "Contact force", one),
    forceParts(recording, one),
    stretches(recording, one),
    stress(recording, shown),
    pressure(recording, shown),
  ].filter((chart): chart is Chart => chart !== null && chart.lines.length > 0);
}

/** A chart of columns by their names in the CSV. */
export function columnsChart(recording: Recording, names: string[]): Chart {
  const lines: Line[] = [];
  let units = "";
  for (const [name, array, place] of recording.header.columns) {
    const track = recording.track(array);
    if (!names.includes(name) || !track) continue;
    units ||= track.spec.units;
    lines.push({ label: name, at: (row) => track.values[row * track.stride + place] });
  }
  return { id: "columns", title: "Columns", units, log: false, lines };
}

function scalars(recording: Recording, prefix: string): Track[] {
  return [...recording.tracks.values()].filter(
    ({ spec }) => spec.name.startsWith(prefix) && spec.stride === 1,
  );
}

function plainLine(track: Track, label: string): Line {
  return { label, at: (row) => track.values[row] };
}

function energies(recording: Recording): Chart {
  const parts = scalars(recording, "energy_").filter(({ spec }) => spec.name !== "energy_residual");
  const lines = parts.map((track) => plainLine(track, words(track.spec.name.slice("energy_".length))));
  if (lines.length > 1) {
    lines.push({ label: "sum", at: (row) => parts.reduce((sum, track) => sum + track.values[row], 0) });
  }
  return { id: "energy", title: "Energy", units: "J", log: false, lines };
}

function works(recording: Recording): Chart {
  const lines = scalars(recording, "work_").map((track) =>
    plainLine(track, words(track.spec.name.slice("work_".length))),
  );
  return { id: "work", title: "Work", units: "J", log: false, lines };
}

function residual(recording: Recording): Chart | null {
  const track = recording.track("energy_residual");
  return track
    ? {
        id: "residual",
        title: "Ledger residual",
        units: "J",
        log: false,
        lines: [plainLine(track, "residual")],
      }
    : null;
}

/** Bodies with lines of their own: of many an even choice, with one of each class at least. */
export function drawnBodies({ header }: Recording): number[] {
  const count = header.bodies.length;
  if (count <= MOST_LINES) return header.bodies.map((_, index) => index);
  const even = Array.from({ length: MOST_LINES }, (_, k) => Math.floor((k * (count - 1)) / (MOST_LINES - 1)));
  const { members, ofBody } = classesOf(header);
  const seen = new Set(even.map((body) => ofBody[body]));
  const missing = members.flatMap(([first], index) => (seen.has(index) ? [] : [first]));
  return [...even, ...missing].sort((a, b) => a - b);
}

/** A chart of a number of each body: lines in the colours of their classes, which are what the legend names. */
function ofBodies(recording: Recording, chart: Omit<Chart, "lines">, at: [number, Line["at"]][]): Chart {
  const { bodies } = recording.header;
  const classes = classesOf(recording.header);
  const lines = at.map(([body, of]) => ({ label: bodies[body].name, at: of, hue: classes.ofBody[body] }));
  if (lines.length <= MOST_ALONE) return { ...chart, lines };
  const keys = classes.names.flatMap((_, index) => {
    const own = at.flatMap(([body], line) => (classes.ofBody[body] === index ? [line] : []));
    return own.length > 0 ? [{ label: classLabel(classes, index), lines: own }] : [];
  });
  if (bodies.length <= MOST_LINES) return { ...chart, lines, keys };
  return { ...chart, lines, keys, note: `lines of ${lines.length} of ${bodies.length} bodies` };
}

function scalarPerBody(recording: Recording, array: string, bodies: number[]): [number, Line["at"]][] {
  const track = recording.track(array);
  if (!track) return [];
  const has = (body: number) => {
    for (let row = 0; row < recording.rows; row += Math.max(1, recording.rows >> 4)) {
      if (Number.isFinite(track.values[row * track.stride + body])) return true;
    }
    return false;
  };
  return bodies.filter(has).map((body) => [body, (row) => track.values[row * track.stride + body]]);
}

function gap(recording: Recording, bodies: number[]): Chart {
  const chart = { id: "gap", title: "Gap", units: "m", log: true };
  return ofBodies(recording, chart, scalarPerBody(recording, "gap", bodies));
}

function pressure(recording: Recording, bodies: number[]): Chart {
  const chart = { id: "pressure", title: "Pressure", units: "Pa", log: false };
  return ofBodies(recording, chart, scalarPerBody(recording, "pressure", bodies));
}

function vector(recording: Recording, array: string, title: string, body: number): Chart | null {
  const track = recording.track(array);
  if (!track) return null;
  const lines = ["x", "y", "z"].map((label, k) => ({
    label,
    at: (row: number) => track.values[row * track.stride + 3 * body + k],
  }));
  return { id: array, title: ofBody(recording, title, body), units: track.spec.units, log: false, lines };
}

/** The contact force along and across the normals of its contacts, where that is more than what the sum tells. */
function forceParts(recording: Recording, body: number): Chart | null {
  const parts = ["normal", "tangential"].flatMap((label) => {
    const track = recording.track(`${label}_force`);
    return track ? [{ label, at: (row: number) => track.values[row * track.stride + body] }] : [];
  });
  const title = ofBody(recording, "Contact force by direction", body);
  return { id: "contact_force_parts", title, units: "N", log: false, lines: parts };
}

function stretches(recording: Recording, body: number): Chart | null {
  const track = recording.track("placement_gradient");
  if (!track || recording.header.bodies[body].kind === "rigid") return null;
  const values = () =>
    derived(recording, `stretch ${body}`, 3, (row) => {
      const at = row * track.stride + 9 * body;
      return principalStretches(track.values.subarray(at, at + 9));
    });
  const lines = ["λ₁", "λ₂", "λ₃"].map((label, k) => ({ label, at: (row: number) => values()[3 * row + k] }));
  return {
    id: "stretch",
    title: ofBody(recording, "Principal stretches", body),
    units: "1",
    log: false,
    lines,
  };
}

function stress(recording: Recording, bodies: number[]): Chart | null {
  const track = recording.track("cauchy_stress");
  if (!track) return null;
  const values = (body: number) =>
    derived(recording, `stress ${body}`, 1, (row) => {
      const at = row * track.stride + 9 * body;
      return [vonMises(track.values.subarray(at, at + 9))];
    });
  const lines = bodies
    .filter((body) => recording.header.bodies[body].kind !== "rigid")
    .map((body): [number, Line["at"]] => [body, (row) => values(body)[row]]);
  return ofBodies(recording, { id: "stress", title: "Von Mises stress", units: "Pa", log: false }, lines);
}

function ofBody(recording: Recording, title: string, body: number): string {
  const { bodies } = recording.header;
  return bodies.length > 1 ? `${title} of ${bodies[body].name}` : title;
}
