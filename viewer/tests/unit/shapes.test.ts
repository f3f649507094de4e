// Surfaces: normals by crease angle, fewer triangles for crowds.

import { describe, expect, it } from "vitest";
import { coarsened } from "../../src/view/coarse";
import { shaded } from "../../src/view/crease";

const CUBE = Float32Array.from(
  [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1]),
);
const CUBE_TRIANGLES = Uint32Array.of(
  ...[
    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7,
    5,
  ],
);

/** A ball of rings and sectors. */
function ball(rings: number): [Float32Array, Uint32Array] {
  const sectors = 2 * rings;
  const points: number[] = [0, 0, -1];
  for (let i = 1; i < rings; i++) {
    for (let j = 0; j < sectors; j++) {
      const [polar, azimuth] = [Math.PI * (i / rings), 2 * Math.PI * (j / sectors)];
      points.push(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), -Math.cos(polar));
    }
  }
  points.push(0, 0, 1);
  const top = points.length / 3 - 1;
  const at = (i: number, j: number) => 1 + (i - 1) * sectors + (j % sectors);
  const triangles: number[] = [];
  for (let j = 0; j < sectors; j++) {
    triangles.push(0, at(1, j + 1), at(1, j), top, at(rings - 1, j), at(rings - 1, j + 1));
    for (let i = 1; i < rings - 1; i++) {
      triangles.push(at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return [Float32Array.from(points), Uint32Array.from(triangles)];
}

/** Volume by the divergence theorem. */
function volume(points: Float32Array, triangles: Uint32Array): number {
  let six = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) =>
      Array.from(points.subarray(3 * triangles[t + k], 3 * triangles[t + k] + 3)),
    );
    six +=
      a[0] * (b[1] * c[2] - b[2] * c[1]) +
      a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

describe("normals", () => {
  it("keep_the_edges_of_a_cube", () => {
    const { position, normal } = shaded(CUBE, CUBE_TRIANGLES);
    expect(position.length / 3).toBe(24);
    for (let k = 0; k < normal.length; k += 3) {
      const parts = Array.from(normal.subarray(k, k + 3))
        .map(Math.abs)
        .sort();
      expect(parts).toEqual([0, 0, 1]);
      // Outward.
      const [x, y, z] = [0, 1, 2].map((axis) => position[k + axis] * normal[k + axis]);
      expect(x + y + z).toBeCloseTo(1, 6);
    }
  });

  it("are_smooth_on_a_ball_and_radial", () => {
    const [points, triangles] = ball(24);
    const { position, normal } = shaded(points, triangles);
    expect(position.length).toBe(points.length);
    for (let k = 0; k < normal.length; k += 3) {
      const radial =
        normal[k] * position[k] + normal[k + 1] * position[k + 1] + normal[k + 2] * position[k + 2];
      // The mean over facets of 7.5 degrees is off by a part of that.
      expect(radial).toBeGreaterThan(0.995);
    }
  });

  it("leave_every_triangle_where_it_was", () => {
    const { position, index } = shaded(CUBE, CUBE_TRIANGLES);
    index.forEach((vertex, corner) => {
      const point = CUBE_TRIANGLES[corner];
      expect(Array.from(position.subarray(3 * vertex, 3 * vertex + 3))).toEqual(
        Array.from(CUBE.subarray(3 * point, 3 * point + 3)),
      );
    });
  });
});

describe("coarse surfaces", () => {
  it("have_no_more_triangles_than_asked_for_and_much_the_same_volume", () => {
    const [points, triangles] = ball(30);
    for (const most of [800, 300, 120]) {
      const coarse = coarsened(points, triangles, most);
      expect(coarse.triangles.length / 3).toBeLessThanOrEqual(most);
      const ratio = volume(coarse.points, coarse.triangles) / volume(points, triangles);
      expect(ratio).toBeGreaterThan(0.7);
      expect(ratio).toBeLessThan(1.05);
    }
  });

  it("become_lumps_of_twenty_triangles_where_hardly_any_are_left", () => {
    const [points, triangles] = ball(30);
    const coarse = coarsened(points, triangles, 20);
    expect(coarse.triangles.length / 3).toBe(20);
    // An icosahedron in a ball has 0.605 of its volume.
    expect(volume(coarse.points, coarse.triangles) / volume(points, triangles)).toBeGreaterThan(0.58);
  });

  it("stay_as_they_are_where_they_are_few", () => {
    expect(coarsened(CUBE, CUBE_TRIANGLES, 12).triangles).toBe(CUBE_TRIANGLES);
  });
});
