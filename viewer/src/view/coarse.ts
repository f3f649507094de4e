// A surface with fewer triangles for crowds: points in one cell of a lattice become one, triangles that lose their
// area go. Only what is drawn small is drawn coarse.

/** The surface with about `most` triangles at the most. */
export function coarsened(
  points: Float32Array,
  triangles: Uint32Array,
  most: number,
): { points: Float32Array; triangles: Uint32Array } {
  if (triangles.length / 3 <= most) return { points, triangles };
  // A closed surface through a lattice of n cells a side has of the order of 12 n² triangles.
  for (let cells = Math.ceil(Math.sqrt(most / 6)); cells >= 3; cells--) {
    const made = clustered(points, triangles, cells);
    if (made.triangles.length / 3 <= most) return made;
  }
  return clustered(points, triangles, 3);
}

function clustered(
  points: Float32Array,
  triangles: Uint32Array,
  cells: number,
): { points: Float32Array; triangles: Uint32Array } {
  const cell = cellOf(points, cells);
  const vertexOf = new Map<number, number>();
  const vertex = new Uint32Array(points.length / 3);
  const sums: number[] = [];
  const counts: number[] = [];
  for (let point = 0; point < vertex.length; point++) {
    const key = cell(point);
    let made = vertexOf.get(key);
    if (made === undefined) {
      made = counts.length;
      vertexOf.set(key, made);
      counts.push(0);
      sums.push(0, 0, 0);
    }
    vertex[point] = made;
    counts[made]++;
    for (let k = 0; k < 3; k++) sums[3 * made + k] += points[3 * point + k];
  }
  const kept: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [vertex[triangles[t]], vertex[triangles[t + 1]], vertex[triangles[t + 2]]];
    if (a !== b && b !== c && c !== a) kept.push(a, b, c);
  }
  return {
    points: Float32Array.from(sums, (sum, k) => sum / counts[Math.floor(k / 3)]),
    triangles: Uint32Array.from(kept),
  };
}

/** The number of the cell in which a point lies. */
function cellOf(points: Float32Array, cells: number): (point: number) => number {
  const low = [0, 1, 2].map((k) => minimum(points, k));
  const high = [0, 1, 2].map((k) => -minimum(points, k, -1));
  const width = Math.max(...high.map((value, k) => value - low[k])) / cells || 1;
  return (point) => {
    const [i, j, k] = low.map((start, axis) =>
      Math.min(cells - 1, Math.floor((points[3 * point + axis] - start) / width)),
    );
    return (i * cells + j) * cells + k;
  };
}

function minimum(points: Float32Array, axis: number, sign = 1): number {
  let least = Number.POSITIVE_INFINITY;
  for (let at = axis; at < points.length; at += 3) least = Math.min(least, sign * points[at]);
  return least;
}
