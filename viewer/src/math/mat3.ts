// 3×3 matrices, row-major, nine numbers: what the page needs of a placement gradient P.

import type { Vec3 } from "../data/header";

export type Mat3 = ArrayLike<number>;

/** A symmetric matrix's eigenvalues, descending, and the unit eigenvectors that belong to them. */
export interface Axes {
  values: Vec3;
  vectors: [Vec3, Vec3, Vec3];
}

/** P Pᵀ, left Cauchy–Green: its eigenvectors are the principal axes of strain in space. */
export function leftCauchyGreen(p: Mat3): number[] {
  const product = new Array<number>(9);
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 3; j++) {
      product[3 * i + j] = p[3 * i] * p[3 * j] + p[3 * i + 1] * p[3 * j + 1] + p[3 * i + 2] * p[3 * j + 2];
    }
  }
  return product;
}

/** Largest principal stretch, √ of the largest eigenvalue of P Pᵀ. */
export function greatestStretch(p: Mat3): number {
  return principalStretches(p)[0];
}

/** Principal stretches, descending. */
export function principalStretches(p: Mat3): Vec3 {
  const [a, b, c] = eigenvalues(leftCauchyGreen(p));
  return [Math.sqrt(a), Math.sqrt(Math.max(0, b)), Math.sqrt(Math.max(0, c))];
}

/**
 * Eigenvalues of a symmetric matrix in closed form, descending: m + 2√p cos(φ + 2πk/3), with φ a third of the angle of
 * the characteristic polynomial of the deviator. Source: O. K. Smith, Comm. ACM 4 (1961) 168.
 */
export function eigenvalues(s: Mat3): Vec3 {
  const mean = (s[0] + s[4] + s[8]) / 3;
  const [a, b, c] = [s[0] - mean, s[4] - mean, s[8] - mean];
  const off = s[1] * s[1] + s[2] * s[2] + s[5] * s[5];
  const p = (a * a + b * b + c * c + 2 * off) / 6;
  if (!(p > 0)) return [mean, mean, mean];
  const half =
    (a * (b * c - s[5] * s[5]) - s[1] * (s[1] * c - s[5] * s[2]) + s[2] * (s[1] * s[5] - b * s[2])) / 2;
  const angle = Math.acos(Math.min(1, Math.max(-1, half / (p * Math.sqrt(p))))) / 3;
  const largest = mean + 2 * Math.sqrt(p) * Math.cos(angle);
  const smallest = mean + 2 * Math.sqrt(p) * Math.cos(angle + (2 * Math.PI) / 3);
  return [largest, 3 * mean - largest - smallest, smallest];
}

/** Eigenvalues and vectors of a symmetric matrix by Jacobi rotations; a handful of sweeps reaches rounding. */
export function symmetricAxes(symmetric: Mat3): Axes {
  const s = Array.from(symmetric);
  const v = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  for (let sweep = 0; sweep < 12; sweep++) {
    const off = s[1] * s[1] + s[2] * s[2] + s[5] * s[5];
    if (off <= 1e-30 * (s[0] * s[0] + s[4] * s[4] + s[8] * s[8])) break;
    for (const [i, j] of PAIRS) rotate(s, v, i, j);
  }
  const order = [0, 1, 2].sort((a, b) => s[4 * b] - s[4 * a]);
  const vector = (k: number): Vec3 => [v[k], v[3 + k], v[6 + k]];
  return {
    values: [s[4 * order[0]], s[4 * order[1]], s[4 * order[2]]],
    vectors: [vector(order[0]), vector(order[1]), vector(order[2])],
  };
}

const PAIRS = [
  [0, 1],
  [0, 2],
  [1, 2],
] as const;

/** s ← Rᵀ s R and v ← v R with the rotation in the plane (i, j) that clears s_ij. */
function rotate(s: number[], v: number[], i: number, j: number): void {
  const off = s[3 * i + j];
  if (off === 0) return;
  const theta = (s[4 * j] - s[4 * i]) / (2 * off);
  const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const cos = 1 / Math.hypot(t, 1);
  const sin = t * cos;
  for (let k = 0; k < 3; k++) {
    const [a, b] = [s[3 * k + i], s[3 * k + j]];
    s[3 * k + i] = cos * a - sin * b;
    s[3 * k + j] = sin * a + cos * b;
  }
  for (let k = 0; k < 3; k++) {
    const [a, b] = [s[3 * i + k], s[3 * j + k]];
    s[3 * i + k] = cos * a - sin * b;
    s[3 * j + k] = sin * a + cos * b;
    const [c, d] = [v[3 * k + i], v[3 * k + j]];
    v[3 * k + i] = cos * c - sin * d;
    v[3 * k + j] = sin * c + cos * d;
  }
}

/** Von Mises stress √(3/2 |dev sym T|²) of a Cauchy stress T. */
export function vonMises(t: Mat3): number {
  const mean = (t[0] + t[4] + t[8]) / 3;
  const [a, b, c] = [t[0] - mean, t[4] - mean, t[8] - mean];
  const [xy, xz, yz] = [(t[1] + t[3]) / 2, (t[2] + t[6]) / 2, (t[5] + t[7]) / 2];
  return Math.sqrt(1.5 * (a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)));
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function norm(a: ArrayLike<number>): number {
  return Math.hypot(a[0], a[1], a[2]);
}

/** The vector with length one; `fallback` if it has none. */
export function unit(a: Vec3, fallback: Vec3): Vec3 {
  const length = norm(a);
  return length > 0 ? [a[0] / length, a[1] / length, a[2] / length] : fallback;
}

/** Some unit vector at right angles to a unit vector; along world x where that is possible. */
export function across(n: Vec3): Vec3 {
  const start: Vec3 = Math.abs(n[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const along = dot(start, n);
  return unit([start[0] - along * n[0], start[1] - along * n[1], start[2] - along * n[2]], [1, 0, 0]);
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
