// The cells of a lattice, as a resolved scene tells them: in which cell which copy of a body is, and what is beside it.

import type { Header, Vec3 } from "./header";
import { list, table, vector } from "./json";

/** Cells away along each vector. */
export type Cell = [number, number, number];

export class Cells {
  readonly repeat: Cell;
  private readonly vectors: Vec3[];
  private readonly periodic: boolean[];

  constructor({ resolved }: Pick<Header, "resolved">) {
    const { cell, repeat, periodic } = table(table(resolved).lattice);
    this.vectors = list(cell).map(vector);
    this.repeat = [0, 1, 2].map((a) => Number(list(repeat)[a] ?? 1)) as Cell;
    this.periodic = [0, 1, 2].map((a) =>
      Boolean(Array.isArray(periodic) ? periodic[a] : (periodic ?? this.vectors.length > 0)),
    );
  }

  /** Whether waves run through it. */
  get hasWaves(): boolean {
    return this.vectors.some((_, a) => this.periodic[a]);
  }

  get count(): number {
    return this.repeat.reduce((product, many) => product * many, 1);
  }

  /** The cell of this number; the first direction is fastest. */
  at(number: number): Cell {
    const [x, y] = this.repeat;
    return [number % x, Math.floor(number / x) % y, Math.floor(number / (x * y))];
  }

  /** Where a cell is [m]. */
  place(cell: number[]): Vec3 {
    return [0, 1, 2].map((axis) =>
      this.vectors.reduce((sum, a, index) => sum + cell[index] * a[axis], 0),
    ) as Vec3;
  }

  /** What a cell sees in a direction: the number of a cell, and how far from it the image is; `null` beyond a free end. */
  beside(cell: Cell, offset: number[]): { number: number; shift: Vec3 } | null {
    const seen = cell.map((n, a) => n + (offset[a] ?? 0));
    const turns = seen.map((n, a) =>
      this.periodic[a] ? Math.floor(n / this.repeat[a]) * this.repeat[a] : 0,
    );
    const [x, y, z] = seen.map((n, a) => n - turns[a]);
    const [nx, ny, nz] = this.repeat;
    if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) return null;
    return { number: x + nx * (y + ny * z), shift: this.place(turns) };
  }

  /** The name of the copy of a body in a cell. */
  nameIn(name: string, number: number): string {
    return this.count > 1 ? `${name}-${number}` : name;
  }
}
