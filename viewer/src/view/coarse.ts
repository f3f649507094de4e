// A surface with fewer triangles for crowds: points in one cell of a lattice become one, triangles that lose their
// area go. Only what is drawn small is drawn coarse.

interface Triangulated {
  points: Float32Array;
  triangles: Uint32Array;
}

/** Cells a side below which clusters no longer look like the body. */
const FEWEST_CELLS = 3;

/** The surface with about `most` triangles at the most, or with twenty. */
export function coarsened(points: Float32Array, triangles: Uint32Array, most: number): Triangulated {
  if (triangles.length / 3 <= most) return { points, triangles };
  // A closed surface through a lattice of n cells a side has of the order of 12 n² triangles.
  for (let cells = Math.ceil(Math.sqrt(most / 6)); cells >= FEWEST_CELLS; cells--) {
    const made = clustered(points, triangles, cells);
    if (made.triangles.length / 3 <= most) return made;
  }
  return lumped(points);
}

/** An icosahedron's corners, in directions from its middle, and faces. */
const G = (1 + Math.sqrt(5)) / 2;
const CORNERS = [0, 1, 2].flatMap((axis) =>
  [1, -1].flatMap((a) =>
    [G, -G].map((b) => {
      const corner = [0, 0, 0];
      corner[(axis + 1) % 3] = a;
      corner[(axis + 2) % 3] = b;
      return corner;
    }),
  ),
);
const FACES = facesOf(CORNERS);

/** Neighbours three by three, outward; neighbouring corners are 2 apart. */
function facesOf(corners: number[][]): [number, number, number][] {
  const near = (a: number[], b: number[]) =>
    Math.abs(Math.hypot(...a.map((value, k) => value - b[k])) - 2) < 1e-9;
  const faces: [number, number, number][] = [];
  corners.forEach((a, i) => {
    corners.forEach((b, j) => {
      corners.forEach((c, k) => {
        const outward =
          a[0] * (b[1] * c[2] - b[2] * c[1]) +
          a[1] * (b[2] * c[0] - b[0] * c[2]) +
          a[2] * (b[0] * c[1] - b[1] * c[0]);
        if (i < j && i < k && outward > 0 && near(a, b) && near(b, c) && near(c, a)) faces.push([i, j, k]);
      });
    });
  });
  return faces;
}

/** The outermost points in the directions of an icosahedron's corners, joined as its corners are. */
function lumped(points: Float32Array): Triangulated {
  const outermost = CORNERS.map(([x, y, z]) => {
    let best = 0;
    let most = Number.NEGATIVE_INFINITY;
    for (let k = 0; k < points.length; k += 3) {
      const reach = x * points[k] + y * points[k + 1] + z * points[k + 2];
      if (reach > most) [most, best] = [reach, k];
    }
    return best;
  });
  const kept = FACES.filter(([i, j, k]) => new Set([outermost[i], outermost[j], outermost[k]]).size === 3);
  return {
    points: Float32Array.from(outermost.flatMap((at) => [points[at], points[at + 1], points[at + 2]])),
    triangles: Uint32Array.from(kept.flat()),
  };
}

function clustered(points: Float32Array, triangles: Uint32Array, cells: number): Triangulated {
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
