// Lattices: springs of all cells, bands as they are drawn, and a wave as a recording.

import { describe, expect, it } from "vitest";
import {
  type Bands,
  mostOf,
  pathFrom,
  piecesOf,
  placesOf,
  sharingsOf,
  verticesOf,
} from "../../src/data/bands";
import { springsOf } from "../../src/data/springs";
import { waveRecording } from "../../src/data/waves";
import { bodyNamed, headerOf, scalars } from "./made";

const spring = {
  between: ["a", "a"],
  cell: [1, 0, 0],
  points: [
    [0.1, 0, 0],
    [-0.1, 0, 0],
  ],
};
const lattice = { cell: [[2, 0, 0]], repeat: [3, 1, 1], periodic: true };

describe("springs of a lattice", () => {
  const bodies = [0, 1, 2].map((cell) => bodyNamed(`a-${cell}`));
  const ends = (more: object) =>
    springsOf(
      headerOf({ bodies, resolved: { body: [], spring: [spring], lattice: { ...lattice, ...more } } }),
    ).map(({ ends: [one, other] }) => [one.body, other.body, other.shift]);

  it("lead_to_the_next_cell_and_round_a_ring_to_the_image_of_the_first", () => {
    expect(ends({})).toEqual([
      [0, 1, undefined],
      [1, 2, undefined],
      [2, 0, [6, 0, 0]],
    ]);
  });

  it("end_where_the_lattice_does", () => {
    expect(ends({ periodic: [false] })).toHaveLength(2);
  });
});

describe("bands", () => {
  // Two branches over Γ X | M Γ; the lower one turns at X, and grows there.
  const bands: Bands = {
    kappa: [
      [0, 0, 0],
      [0.5, 0, 0],
      [0.5, 0.5, 0],
      [0, 0, 0],
    ],
    k: [
      [0, 0, 0],
      [3, 0, 0],
      [3, 4, 0],
      [0, 0, 0],
    ],
    omega: [
      [0, 7],
      [0, 6],
      [2, 6],
      [0, 7],
    ],
    decay: [
      [0, 0],
      [-1, 0],
      [0, 0],
      [0, 0],
    ],
    participation: [
      [
        [1, 0, 0, 0, 0],
        [1, 0, 0, 0, 0],
      ],
      [
        [0, 1, 0, 0, 0],
        [1, 0, 0, 0, 0],
      ],
      [
        [0.5, 0.5, 0, 0, 0],
        [1, 0, 0, 0, 0],
      ],
      [
        [1, 0, 0, 0, 0],
        [1, 0, 0, 0, 0],
      ],
    ],
    edges: [],
    labels: [
      [0, "G"],
      [1, "X"],
    ],
    vertices: [0, 1, 2, 3],
    begins: [0, 2],
    warnings: [],
  };
  const places = placesOf(bands);

  it("lie_along_the_path_whose_breaks_take_no_room", () => {
    expect(places).toEqual([0, 3, 3, 8]);
    expect(verticesOf(bands, places)).toEqual([
      { place: 0, name: "Γ" },
      { place: 3, name: "X | 0.5, 0.5, 0" },
      { place: 8, name: "0, 0, 0" },
    ]);
  });

  it("are_cut_at_breaks_and_stand_below_zero_where_they_grow", () => {
    const [sharing, ...others] = sharingsOf(bands);
    expect([mostOf(sharing, 2, 0), others]).toEqual([0, []]);
    expect(piecesOf(bands, places, sharing)).toEqual([
      {
        part: 0,
        points: [
          [0, 0],
          [3, -1],
        ],
      },
      {
        part: 0,
        points: [
          [3, 2],
          [8, 0],
        ],
      },
      {
        part: 0,
        points: [
          [0, 7],
          [3, 6],
        ],
      },
      {
        part: 0,
        points: [
          [3, 6],
          [8, 7],
        ],
      },
    ]);
  });

  it("of_a_ribbon_are_inside_if_they_are_alike_all_over", () => {
    for (const many of [4, 5, 7, 8, 11, 40]) {
      const share = Math.floor(many / 4) / many;
      const shares = [[[share, share]]] as [number, number][][];
      const [, sharing] = sharingsOf({
        ...bands,
        edges: [{ direction: 2, cells: Math.floor(many / 4), shares }],
      });
      expect(sharing.names[mostOf(sharing, 0, 0)]).toBe("inside");
    }
  });

  it("of_a_ribbon_are_cut_where_a_wave_comes_to_an_edge", () => {
    const lower = [
      [0.2, 0.2],
      [0.7, 0.1],
      [0.1, 0.8],
      [0.4, 0.5],
    ];
    const shares = lower.map((low) => [low, [0.25, 0.25]]) as [number, number][][];
    const [, sharing] = sharingsOf({ ...bands, begins: [0], edges: [{ direction: 2, cells: 3, shares }] });
    expect(sharing.title).toBe("the edges along vector 2");
    expect([0, 1, 2, 3].map((row) => sharing.names[mostOf(sharing, row, 0)])).toEqual([
      "inside",
      "low edge",
      "high edge",
      "both edges",
    ]);
    expect(sharing.of(3, 0)[2]).toBeCloseTo(0.9, 12);
    const pieces = piecesOf({ ...bands, begins: [0] }, places, sharing);
    expect(pieces.map(({ part, points }) => [part, points.length])).toEqual([
      [3, 2],
      [0, 2],
      [1, 2],
      [3, 4],
    ]);
  });

  it("tell_the_direction_in_which_a_wave_is_looked_at", () => {
    expect(pathFrom(bands, 0)).toBe("0,0,0 0.5,0,0");
    expect(pathFrom(bands, 3)).toBe("0,0,0 -0.5,-0.5,0");
  });
});

describe("a wave", () => {
  it("is_a_recording_of_bodies_that_look_like_those_of_the_run", () => {
    const run = scalars(
      [0],
      { energy: [1] },
      {
        bodies: [bodyNamed("a", { size: 3 })],
        resolved: { lattice: { ...lattice, repeat: [1, 1, 1] }, body: [], spring: [spring] },
      },
    );
    const head = {
      rows: 2,
      omega: Math.PI,
      decay: 0,
      cell: [[2.5, 0, 0] as [number, number, number]],
      repeat: [2, 1, 1],
      bodies: [0, 1].map((cell) => ({ name: `a-${cell}`, like: 0 })),
    };
    const payload = new ArrayBuffer(2 * 8 + 2 * 2 * 12 * 4);
    new Float64Array(payload, 0, 2).set([0, 2]);
    new Float32Array(payload, 16).set(Array.from({ length: 48 }, (_, k) => k));
    const wave = waveRecording(run, head, payload);
    expect([wave.rows, wave.lastTime, wave.isOver]).toEqual([2, 2, true]);
    expect(wave.header.bodies.map(({ name, size }) => [name, size])).toEqual([
      ["a-0", 3],
      ["a-1", 3],
    ]);
    expect(Array.from(wave.track("position")!.values.slice(6, 9))).toEqual([6, 7, 8]);
    expect(wave.track("placement_gradient")!.values[18]).toBe(30);
    // One spring is within the block, that of its last cell leads out of it.
    expect(springsOf(wave.header)).toHaveLength(1);
  });
});
