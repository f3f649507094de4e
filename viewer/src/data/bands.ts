// The bands of a lattice along a path of wave vectors, and what is drawn of them: as `gyration bands --plot` does.

import type { Vec3 } from "./header";

export interface Bands {
  /** κ of each row. */
  kappa: Vec3[];
  /** k of each row [1/m]. */
  k: Vec3[];
  /** ω of each branch [rad/s], and its decay rate [1/s]. */
  omega: number[][];
  decay: number[][];
  /** Shares of `PARTS` in the kinetic energy of each branch. */
  participation: number[][][];
  /** Rows with a name, rows with a vertex, rows at which the path begins anew. */
  labels: [number, string][];
  vertices: number[];
  begins: number[];
  warnings: string[];
}

/** What may move, in the order of the shares. */
export const PARTS = ["translation", "rotation", "shear", "stretch", "breathing"];

/** How far along the path each row is [1/m]; where it begins anew it goes on from where it ended. */
export function placesOf({ k, begins }: Bands): number[] {
  const anew = new Set(begins);
  let at = 0;
  return k.map((here, row) => {
    if (row > 0 && !anew.has(row)) at += Math.hypot(...here.map((part, axis) => part - k[row - 1][axis]));
    return at;
  });
}

/** What a wave is drawn at: ω, or below zero the rate of one that grows without oscillating. */
export function heightOf({ omega, decay }: Bands, row: number, branch: number): number {
  return omega[row][branch] === 0 ? Math.min(0, decay[row][branch]) : omega[row][branch];
}

/** Which of `PARTS` has most of the kinetic energy. */
export function partOf({ participation }: Bands, row: number, branch: number): number {
  const shares = participation[row][branch];
  return shares.reduce((most, share, part) => (share > shares[most] + 1e-9 ? part : most), 0);
}

/** The vertices with their names; where the path begins anew two stand at one place. */
export function verticesOf(bands: Bands, places: number[]): { place: number; name: string }[] {
  const found: { place: number; name: string }[] = [];
  for (const row of bands.vertices) {
    const last = found.at(-1);
    const name = nameOf(bands, row);
    if (last && last.place === places[row]) last.name += ` | ${name}`;
    else found.push({ place: places[row], name });
  }
  return found;
}

function nameOf({ labels, kappa }: Bands, row: number): string {
  const label = labels.find(([at]) => at === row)?.[1];
  if (label) return ["G", "GAMMA", "Gamma"].includes(label) ? "Γ" : label;
  return kappa[row].map((part) => String(Math.round(1e3 * part) / 1e3 + 0)).join(", ");
}

/** A piece of a branch in which one of `PARTS` moves most. */
export interface Piece {
  part: number;
  points: [number, number][];
}

/** The branches, cut where the path begins anew and where something else moves most. */
export function piecesOf(bands: Bands, places: number[]): Piece[] {
  const anew = new Set([0, ...bands.begins]);
  const pieces: Piece[] = [];
  bands.omega[0]?.forEach((_, branch) => {
    places.forEach((place, row) => {
      const [point, part] = [
        [place, heightOf(bands, row, branch)] as [number, number],
        partOf(bands, row, branch),
      ];
      const last = pieces.at(-1);
      if (last && !anew.has(row)) last.points.push(point);
      if (!last || anew.has(row) || last.part !== part) pieces.push({ part, points: [point] });
    });
  });
  return pieces.filter(({ points }) => points.length > 1);
}

/** The path from a row onwards, which tells waves of one frequency apart as the bands do. */
export function pathFrom({ kappa, begins }: Bands, row: number): string {
  const here = kappa[row];
  const before = kappa[row - 1] ?? here;
  const isLast = row + 1 >= kappa.length || begins.includes(row + 1);
  const next = isLast ? here.map((part, a) => 2 * part - before[a]) : kappa[row + 1];
  return [here, next].map((vertex) => vertex.join(",")).join(" ");
}
