// The network of forces: how it comes, and what is drawn of it.

import { Matrix4, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { Network, samplesIn, WIDTH } from "../../src/data/network";
import { FORCE_COLORS, forceColor, meanForce, thickness, writeBar } from "../../src/view/network";

/** A sample of contacts of these forces, between bodies 0 and 1. */
function sample(...forces: number[]): number[] {
  return [forces.length, ...forces.flatMap((force) => [0, 1, force, 0, 0, 0])];
}

describe("forces that come", () => {
  it("are_taken_apart_by_sample", () => {
    const samples = samplesIn(Float32Array.from([...sample(1, 2), ...sample(), ...sample(3)]));
    expect(samples.map((contacts) => contacts.length / WIDTH)).toEqual([2, 0, 1]);
    expect(samples[2][2]).toBe(3);
    expect(() => samplesIn(Float32Array.from(sample(1, 2).slice(0, -1)))).toThrow("cut short");
  });

  it("are_asked_for_once_and_the_last_wish_counts", async () => {
    const asked: number[] = [];
    let come = () => {};
    const network = new Network((row) => {
      asked.push(row);
      return new Promise((resolve) => {
        come = () => resolve({ first: row, numbers: Float32Array.from([...sample(row), ...sample()]) });
      });
    });
    let came = 0;
    network.came = () => came++;
    for (const row of [4, 4, 7, 9]) expect(network.at(row)).toBeNull();
    expect(asked).toEqual([4]);
    come();
    await new Promise((resolve) => setTimeout(resolve));
    expect(asked).toEqual([4, 9]);
    come();
    await new Promise((resolve) => setTimeout(resolve));
    expect(came).toBe(2);
    expect([4, 5, 9].map((row) => network.at(row)?.[2])).toEqual([4, undefined, 9]);
    expect(network.at(5)).toHaveLength(0);
    expect(asked).toEqual([4, 9]);
  });

  it("of_a_run_come_by_themselves", () => {
    const network = new Network();
    network.put(3, Float32Array.from(sample(1)));
    expect(network.at(3)).toHaveLength(WIDTH);
    expect(network.at(4)).toBeNull();
  });

  it("of_a_server_that_is_gone_are_asked_for_again", async () => {
    let tries = 0;
    const network = new Network(async () => {
      tries++;
      throw new Error("gone");
    });
    for (const expected of [1, 2]) {
      expect(network.at(0)).toBeNull();
      await new Promise((resolve) => setTimeout(resolve));
      expect(tries).toBe(expected);
    }
  });
});

describe("bars", () => {
  it("are_as_wide_and_as_coloured_as_the_force_is_of_the_mean", () => {
    const contacts = Float32Array.from(sample(1, 3, 5).slice(1));
    expect(meanForce(contacts)).toBe(3);
    expect(meanForce(new Float32Array(0))).toBe(0);
    expect(forceColor(0)).toEqual(FORCE_COLORS[0]);
    expect(forceColor(100)).toEqual(FORCE_COLORS.at(-1));
    expect(thickness(1)).toBe(1);
    expect(thickness(2)).toBeGreaterThan(1.5);
    expect(thickness(1e6)).toBeLessThan(6);
  });

  it("stand_from_one_end_to_the_other_and_are_round", () => {
    const matrix = new Matrix4();
    for (const to of [
      [3, 2, 7],
      [1, 2, -4],
      [1, 2, 9],
      [-5, 2.5, 2.9],
    ]) {
      writeBar(matrix.elements as unknown as Float32Array, 0, [1, 2, 3], to, 0.5);
      const at = (x: number, y: number, z: number) => new Vector3(x, y, z).applyMatrix4(matrix);
      expect(at(0, 1, 0).distanceTo(new Vector3(...to))).toBeLessThan(1e-12);
      const along = at(0, 1, 0).sub(at(0, 0, 0));
      for (const side of [at(1, 0, 0), at(0, 0, 1)]) {
        const across = side.sub(at(0, 0, 0));
        expect(across.length()).toBeCloseTo(0.5, 12);
        expect(across.dot(along)).toBeCloseTo(0, 12);
      }
      // Else its faces would look inward.
      expect(matrix.determinant()).toBeGreaterThan(0);
    }
  });
});
