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
  /** Of a ribbon, by the direction along which it ends. */
  edges: Edges[];
  /** Rows with a name, rows with a vertex, rows at which the path begins anew. */
  labels: [number, string][];
  vertices: number[];
  begins: number[];
  warnings: string[];
}

/** How much of each wave runs at the two edges of a direction. */
export interface Edges {
  /** From 1. */
  direction: number;
  /** How many cells deep each is. */
  cells: number;
  /** Shares in the kinetic energy of each branch: where the cells begin, where they end. */
  shares: [number, number][][];
}

/** What may move, in the order of the shares. */
export const PARTS = ["translation", "rotation", "shear", "stretch", "breathing"];
/** Where a wave of a ribbon may run. */
export const PLACES = ["low edge", "high edge", "both edges", "inside"];
/** A wave whose share at one edge is more than this part of that at the other runs at both. */
const AT_BOTH = 0.5;

/** What has which share in the energy of a wave: kinds of motion, or places. */
export interface Sharing {
  title: string;
  names: string[];
  of(row: number, branch: number): number[];
}

/** The ways in which the energy of waves can be shared out: by what moves, and by where that is. */
export function sharingsOf({ participation, edges }: Bands): Sharing[] {
  const byPart = {
    title: "what moves most",
    names: PARTS,
    of: (row: number, branch: number) => participation[row][branch],
  };
  const byPlace = edges.map(({ direction, shares }) => ({
    title: `the edges along vector ${direction}`,
    names: PLACES,
    of: (row: number, branch: number) => {
      const [low, high] = shares[row][branch];
      const inside = 1 - low - high;
      const isAtBoth = Math.min(low, high) > Math.max(inside, AT_BOTH * Math.max(low, high));
      return isAtBoth ? [0, 0, low + high, inside] : [low, high, 0, inside];
    },
  }));
  return [byPart, ...byPlace];
}

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

/** Which has most of the energy of a wave. */
export function mostOf(sharing: Sharing, row: number, branch: number): number {
  const shares = sharing.of(row, branch);
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

/** A piece of a branch in which one part has most of the energy. */
export interface Piece {
  part: number;
  points: [number, number][];
}

/** The branches, cut where the path begins anew and where another part has most. */
export function piecesOf(bands: Bands, places: number[], sharing: Sharing): Piece[] {
  const anew = new Set([0, ...bands.begins]);
  const pieces: Piece[] = [];
  bands.omega[0]?.forEach((_, branch) => {
    places.forEach((place, row) => {
      const [point, part] = [
        [place, heightOf(bands, row, branch)] as [number, number],
        mostOf(sharing, row, branch),
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
