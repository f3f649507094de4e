// Normals for a triangulated surface: smooth where it is, with an edge where neighbouring triangles differ by more
// than the crease angle. Points that need several normals are doubled.

/** Faces that differ by more than this keep an edge between them [rad]. */
export const CREASE = Math.PI / 6;
export const COARSE_CREASE = (75 * Math.PI) / 180;

export interface Shaded {
  position: Float32Array;
  normal: Float32Array;
  index: Uint32Array;
}

/** The surface with normals in the reference placement. */
export function shaded(points: Float32Array, triangles: Uint32Array, crease = CREASE): Shaded {
  const faces = faceNormals(points, triangles);
  const incident = corners(points.length / 3, triangles);
  const position: number[] = [];
  const normal: number[] = [];
  const index = new Uint32Array(triangles.length);
  for (let point = 0; point < incident.length; point++) {
    const made: number[] = [];
    for (const corner of incident[point]) {
      const n = cornerNormal(corner, incident[point], faces, Math.cos(crease));
      let vertex = made.find((old) => sameDirection(normal, 3 * old, n));
      if (vertex === undefined) {
        vertex = position.length / 3;
        made.push(vertex);
        position.push(points[3 * point], points[3 * point + 1], points[3 * point + 2]);
        normal.push(...n);
      }
      index[corner] = vertex;
    }
  }
  return { position: new Float32Array(position), normal: new Float32Array(normal), index };
}

/** Normal of each triangle, with twice its area as length. */
function faceNormals(p: Float32Array, triangles: Uint32Array): Float64Array {
  const normals = new Float64Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    normals[t] = uy * vz - uz * vy;
    normals[t + 1] = uz * vx - ux * vz;
    normals[t + 2] = ux * vy - uy * vx;
  }
  return normals;
}

/** The corners, places in the list of indices, that meet at each point. */
function corners(points: number, triangles: Uint32Array): number[][] {
  const meeting: number[][] = Array.from({ length: points }, () => []);
  for (let corner = 0; corner < triangles.length; corner++) meeting[triangles[corner]].push(corner);
  return meeting;
}

/** Sum of the normals around the point, of the faces that lie within the crease angle of this one. */
function cornerNormal(
  corner: number,
  around: number[],
  faces: Float64Array,
  creaseCosine: number,
): [number, number, number] {
  const own = corner - (corner % 3);
  const [x, y, z] = [faces[own], faces[own + 1], faces[own + 2]];
  const length = Math.hypot(x, y, z);
  let [sx, sy, sz] = [0, 0, 0];
  for (const other of around) {
    const face = other - (other % 3);
    const [fx, fy, fz] = [faces[face], faces[face + 1], faces[face + 2]];
    const cosine = (x * fx + y * fy + z * fz) / (length * Math.hypot(fx, fy, fz));
    if (cosine >= creaseCosine || face === own) {
      sx += fx;
      sy += fy;
      sz += fz;
    }
  }
  const size = Math.hypot(sx, sy, sz);
  return size > 0 ? [sx / size, sy / size, sz / size] : [0, 0, 1];
}

function sameDirection(normals: number[], at: number, n: [number, number, number]): boolean {
  return normals[at] * n[0] + normals[at + 1] * n[1] + normals[at + 2] * n[2] > 1 - 1e-6;
}
