// Who pushes whom: the contacts that count at a sample, each once, where a source can tell them.
//
// A contact is six numbers: index of the first body; index of the second, or a negative number for what is no body of
// the picture; the force along the normal, positive where they push [N]; the point where the first is pushed [m].
// Samples stand one behind the other, each with the number of its contacts before them.

export const WIDTH = 6;

/** Numbers that are kept of what can be asked for again: 80 MB. */
const MOST_KEPT = 20_000_000;

/** The samples of numbers that stand one behind the other. */
export function samplesIn(numbers: Float32Array): Float32Array[] {
  const samples: Float32Array[] = [];
  for (let at = 0; at < numbers.length; ) {
    const from = at + 1;
    at = from + WIDTH * numbers[at];
    if (!(at <= numbers.length)) throw new Error("The forces between bodies are cut short.");
    samples.push(numbers.subarray(from, at));
  }
  return samples;
}

/** Samples that stand one behind the other, and which is the first. */
export interface Samples {
  first: number;
  numbers: Float32Array;
}

export class Network {
  /** Called when samples have come. */
  came: () => void = () => {};
  private readonly rows = new Map<number, Float32Array>();
  private kept = 0;
  private loads = false;
  private wanted: number | null = null;

  /** `load` brings samples from the first of them on, a given one among them; without it they come by themselves. */
  constructor(private readonly load: ((row: number) => Promise<Samples>) | null = null) {}

  /** Takes samples in, from one on. */
  put(first: number, numbers: Float32Array): void {
    samplesIn(numbers).forEach((sample, k) => {
      if (!this.rows.has(first + k)) this.kept += sample.length;
      this.rows.set(first + k, sample);
    });
    this.came();
  }

  /** The contacts of a sample; `null` where they are not there (yet). */
  at(row: number): Float32Array | null {
    const known = this.rows.get(row) ?? null;
    this.wanted = known ? null : row;
    if (!known) void this.fetch();
    return known;
  }

  /** Whether samples are on their way. */
  get isLoading(): boolean {
    return this.loads;
  }

  /** Asks for what is wanted, one thing after the other: while a recording plays, only the last wish counts. */
  private async fetch(): Promise<void> {
    const { load } = this;
    if (!load || this.loads) return;
    this.loads = true;
    try {
      while (this.wanted !== null) {
        const row = this.wanted;
        const { first, numbers } = await load(row);
        if (this.kept > MOST_KEPT) this.forget();
        this.put(first, numbers);
        if (this.wanted !== null && (this.wanted === row || this.rows.has(this.wanted))) this.wanted = null;
      }
    } catch {
      // A server that is gone is told by whoever asks for rows.
      this.wanted = null;
    } finally {
      this.loads = false;
    }
  }

  private forget(): void {
    this.rows.clear();
    this.kept = 0;
  }
}
