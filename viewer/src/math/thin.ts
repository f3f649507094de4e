// Long series for a narrow picture: of the rows behind a column of pixels, the smallest and the largest value of each
// series, in the order in which they come. Nothing that sticks out is lost, however long the series.

export type Series = ArrayLike<number>;

/** The first index whose time is not before `t`. */
export function lowerBound(time: Series, rows: number, t: number): number {
  let low = 0;
  let high = rows;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle] < t) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * Rows of `[from, to]` thinned to `columns` columns: abscissae first, then the series, as uPlot wants them.
 * NaN becomes `null`, a gap in the line. `at(k, row)` is series k.
 */
export function thinned(
  time: Series,
  [from, to]: [number, number],
  at: (series: number, row: number) => number,
  { series, columns }: { series: number; columns: number },
): (number | null)[][] {
  const count = to - from + 1;
  const table: (number | null)[][] = Array.from({ length: series + 1 }, () => []);
  if (count <= 2 * columns) {
    for (let row = from; row <= to; row++) {
      table[0].push(time[row]);
      for (let k = 0; k < series; k++) table[k + 1].push(finite(at(k, row)));
    }
    return table;
  }
  for (let column = 0; column < columns; column++) {
    const first = from + Math.floor((column * count) / columns);
    const last = from + Math.floor(((column + 1) * count) / columns) - 1;
    table[0].push(time[first], time[last]);
    for (let k = 0; k < series; k++) table[k + 1].push(...extremes(k, first, last, at));
  }
  // The ends stay what they are, so that lines meet the edges.
  for (let k = 0; k < series; k++) {
    table[k + 1][0] = finite(at(k, from));
    table[k + 1][table[k + 1].length - 1] = finite(at(k, to));
  }
  return table;
}

function extremes(
  series: number,
  first: number,
  last: number,
  at: (series: number, row: number) => number,
): [number | null, number | null] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  let [lowRow, highRow] = [first, first];
  for (let row = first; row <= last; row++) {
    const value = at(series, row);
    if (value < low) [low, lowRow] = [value, row];
    if (value > high && value !== Number.POSITIVE_INFINITY) [high, highRow] = [value, row];
  }
  if (low > high) return [null, null];
  return lowRow <= highRow ? [finite(low), finite(high)] : [finite(high), finite(low)];
}

/** Plots show finite numbers only. */
function finite(value: number): number | null {
  return Number.isFinite(value) ? value : null;
}
