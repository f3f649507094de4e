// Matrices, formats and colours against answers known by hand.

import { describe, expect, it } from "vitest";
import { mapped } from "../../src/math/colors";
import { clock, plain, roundBelow, scaleFor, withUnit } from "../../src/math/format";
import {
  across,
  cross,
  dot,
  greatestStretch,
  leftCauchyGreen,
  norm,
  principalStretches,
  symmetricAxes,
  vonMises,
} from "../../src/math/mat3";

const ROUNDING = 1e-12;

describe("symmetric matrices", () => {
  it("give_back_a_matrix_from_its_axes", () => {
    const s = [2, -1, 0.5, -1, 3, 0.25, 0.5, 0.25, 1];
    const { values, vectors } = symmetricAxes(s);
    for (let i = 0; i < 3; i++) {
      for (let j = 0; j < 3; j++) {
        const sum = [0, 1, 2].reduce((total, k) => total + values[k] * vectors[k][i] * vectors[k][j], 0);
        expect(Math.abs(sum - s[3 * i + j])).toBeLessThan(ROUNDING);
      }
    }
    expect(values[0] >= values[1] && values[1] >= values[2]).toBe(true);
  });

  it("have_axes_at_right_angles_where_values_coincide", () => {
    const { vectors } = symmetricAxes([2, 0, 0, 0, 2, 0, 0, 0, 2]);
    expect(Math.abs(dot(vectors[0], cross(vectors[1], vectors[2])))).toBeCloseTo(1, 12);
  });
});

describe("stretch and stress", () => {
  it("greatest_stretch_of_simple_shear_is_the_closed_form", () => {
    // P = I + γ e₁⊗e₂ has λ = γ/2 + √(1 + γ²/4).
    for (const shear of [1e-3, 0.3, 1, 5]) {
      const exact = shear / 2 + Math.sqrt(1 + (shear * shear) / 4);
      expect(Math.abs(greatestStretch([1, shear, 0, 0, 1, 0, 0, 0, 1]) / exact - 1)).toBeLessThan(1e-9);
    }
  });

  it("greatest_stretch_agrees_with_the_principal_axes", () => {
    const p = [1.2, 0.3, -0.1, 0.05, 0.8, 0.4, -0.2, 0.1, 1.1];
    const { values } = symmetricAxes(leftCauchyGreen(p));
    principalStretches(p).forEach((stretch, k) => {
      expect(stretch).toBeCloseTo(Math.sqrt(values[k]), 10);
    });
  });

  it("greatest_stretch_of_a_rotation_is_one", () => {
    const [c, s] = [Math.cos(0.7), Math.sin(0.7)];
    expect(greatestStretch([c, -s, 0, s, c, 0, 0, 0, 1])).toBeCloseTo(1, 7);
  });

  it("von_mises_of_tension_is_the_tension_and_of_shear_root_three_times_it", () => {
    expect(vonMises([5, 0, 0, 0, 0, 0, 0, 0, 0])).toBeCloseTo(5, 12);
    expect(vonMises([0, 2, 0, 2, 0, 0, 0, 0, 0])).toBeCloseTo(2 * Math.sqrt(3), 12);
    expect(vonMises([3, 0, 0, 0, 3, 0, 0, 0, 3])).toBe(0);
  });

  it("a_direction_across_is_a_unit_vector_at_right_angles", () => {
    for (const n of [
      [0, 0, 1],
      [1, 0, 0],
      [0, 1, 0],
    ] as [number, number, number][]) {
      expect(Math.abs(dot(across(n), n))).toBeLessThan(ROUNDING);
      expect(norm(across(n))).toBeCloseTo(1, 12);
    }
  });
});

describe("numbers as people read them", () => {
  it("plain_numbers_have_the_digits_asked_for_and_no_tail_of_zeros", () => {
    expect([0, 1.5, -0.00012346, 123456.7, 1e-9, 4, 2e6].map((value) => plain(value))).toEqual([
      "0",
      "1.5",
      "−0.0001235",
      "123457",
      "1e−9",
      "4",
      "2e6",
    ]);
  });

  it("prefixes_follow_the_size_and_only_where_the_unit_takes_one", () => {
    expect(withUnit(0.0032, "m")).toBe("3.2 mm");
    expect(withUnit(1234, "Pa")).toBe("1.234 kPa");
    expect(withUnit(0.001, "m")).toBe("1 mm");
    expect(withUnit(2.3e-15, "J")).toBe("2.3e−15 J");
    expect(withUnit(0, "J")).toBe("0 J");
    expect(withUnit(0.5, "kg m/s")).toBe("0.5 kg m/s");
    expect(scaleFor(0.02, "J")).toEqual([1e-3, "mJ"]);
    expect(scaleFor(0.02, "1/s")).toEqual([1, "1/s"]);
  });

  it("what_is_no_number_is_a_dash", () => {
    expect(plain(Number.NaN)).toBe("–");
    expect(plain(Number.POSITIVE_INFINITY)).toBe("∞");
  });

  it("the_clock_has_the_decimals_of_the_samples", () => {
    expect(clock(0.1 + 0.2, 0.005)).toBe("0.300");
    expect(clock(2, 1)).toBe("2");
  });

  it("round_steps_are_one_two_five", () => {
    expect([0.9, 1, 3.7, 7, 0.0021].map(roundBelow).map((value) => plain(value))).toEqual([
      "0.5",
      "1",
      "2",
      "5",
      "0.002",
    ]);
  });

  it("the_colour_map_grows_lighter_throughout", () => {
    const light = ([r, g, b]: number[]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
    for (let k = 0; k < 20; k++) expect(light(mapped((k + 1) / 20))).toBeGreaterThan(light(mapped(k / 20)));
  });
});
