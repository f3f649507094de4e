// Fields of many bodies: maps as they come, what is asked for, and colours.

import { describe, expect, it } from "vitest";
import { type FieldMap, Fields, mapIn, rangeOf, unitsOf } from "../../src/data/fields";
import { TWO_SIDED, VIRIDIS } from "../../src/math/colors";
import { inWords } from "../../src/ui/fields";
import { colorsAlong, evened, FieldLayer, gradientOf, texelsOf } from "../../src/view/fields";

const HEAD = {
  time: 0.5,
  width: 0.2,
  usual: 0.2,
  counts: [2, 1] as [number, number],
  origin: [0, 0, 0] as [number, number, number],
  across: [3, 0, 0] as [number, number, number],
  up: [0, 0, 2] as [number, number, number],
  fields: [
    { key: "density", name: "density", units: "kg/m^3" },
    { key: "speed", name: "speed", units: "m/s" },
  ],
};

const mapOf = (density: number[], speed = [0, 0]): FieldMap => ({
  ...HEAD,
  values: [Float32Array.from(density), Float32Array.from(speed)],
});

/** Answers that come when they are told to. */
function asked() {
  const waiting: {
    row: number;
    width: number | null;
    signal: AbortSignal;
    give: (map: FieldMap) => void;
    fail: (e: Error) => void;
  }[] = [];
  const fields = new Fields(
    (row, width, signal) => new Promise((give, fail) => waiting.push({ row, width, signal, give, fail })),
  );
  return { fields, waiting };
}

const settled = () => new Promise((resolve) => setTimeout(resolve));

describe("a map", () => {
  it("is_read_from_a_message_with_the_numbers_of_each_field", () => {
    const text = new TextEncoder().encode(JSON.stringify(HEAD));
    const length = text.length + ((12 - (text.length % 8)) % 8);
    const message = new Uint8Array(4 + length + 16).fill(32);
    new DataView(message.buffer).setUint32(0, length, true);
    message.set(text, 4);
    message.set(new Uint8Array(Float32Array.from([1, 2, 3, Number.NaN]).buffer), 4 + length);
    const map = mapIn(message.buffer);
    expect(map.values.map((values) => Array.from(values))).toEqual([
      [1, 2],
      [3, Number.NaN],
    ]);
    expect([map.usual, map.across]).toEqual([0.2, [3, 0, 0]]);
  });
});

describe("a map in words", () => {
  it("has_a_range_or_is_zero_or_has_no_value", () => {
    const none = Number.NaN;
    const infinite = Number.POSITIVE_INFINITY;
    const words = (density: number[]) => inWords(mapOf(density), "density");
    expect(words([1, 3])).toMatch(/the density on the map is 1 to 3 kg\/m³\.$/);
    expect(words([0, none])).toMatch(/the density is zero at all points: there is no map\.$/);
    expect(words([none, infinite])).toMatch(/the density has no value at any point: there is no map\.$/);
    expect(HEAD.fields.map(unitsOf)).toEqual(["kg/m³", "m/s"]);
  });
});

describe("fields of a recording", () => {
  it("are_asked_for_one_sample_after_the_other_and_only_the_last_wish_counts", async () => {
    const { fields, waiting } = asked();
    for (const row of [1, 2, 3]) expect(fields.at(row)).toBeNull();
    expect(waiting.map(({ row }) => row)).toEqual([1]);
    waiting[0].give(mapOf([1, 2]));
    await settled();
    expect(waiting.map(({ row }) => row)).toEqual([1, 3]);
    waiting[1].give(mapOf([0, 5]));
    await settled();
    expect(fields.at(3)?.values[0][1]).toBe(5);
    expect([fields.at(1)?.values[0][1], fields.isLoading]).toEqual([2, false]);
    expect(fields.range("density")).toEqual([0, 5]);
    // A speed of zero everywhere has no colours.
    expect(fields.range("speed")).toBeNull();
  });

  it("of_another_width_are_asked_for_anew_and_late_ones_are_dropped", async () => {
    const { fields, waiting } = asked();
    fields.at(0);
    expect(waiting[0].signal.aborted).toBe(false);
    fields.width = 0.5;
    expect(waiting[0].signal.aborted).toBe(true);
    waiting[0].give(mapOf([7, 7]));
    fields.at(0);
    await settled();
    expect(waiting.map(({ row, width }) => [row, width])).toEqual([
      [0, null],
      [0, 0.5],
    ]);
    expect([fields.known(0), fields.range("density")]).toEqual([null, null]);
  });

  it("that_are_no_longer_shown_are_given_up_without_a_complaint", async () => {
    const { fields, waiting } = asked();
    fields.look("speed", null);
    fields.at(0);
    fields.look(null, null);
    expect(waiting[0].signal.aborted).toBe(true);
    waiting[0].fail(new Error("aborted"));
    await settled();
    expect([fields.problem, fields.isLoading, waiting.length]).toEqual([null, false, 1]);
  });

  it("that_are_refused_say_why_and_are_not_asked_for_again", async () => {
    const { fields, waiting } = asked();
    const told: (string | null)[] = [];
    fields.changed.add(() => told.push(fields.problem));
    fields.at(0);
    waiting[0].fail(new Error("write record = { pairs = true }"));
    await settled();
    fields.at(1);
    expect([told.at(-1), waiting.length]).toEqual(["write record = { pairs = true }", 1]);
    fields.width = 0.1;
    fields.at(1);
    expect([fields.problem, waiting.length]).toEqual([null, 2]);
  });

  it("are_shown_by_a_link_that_names_one_of_them", () => {
    const { fields } = asked();
    fields.look("vorticity", 0.5);
    expect([fields.shown, fields.key, fields.width]).toEqual([false, "density", null]);
    fields.look("power", 0.5);
    expect([fields.shown, fields.key, fields.width]).toEqual([true, "power", 0.5]);
    fields.look(null, null);
    expect(fields.shown).toBe(false);
  });
});

describe("colours of a field", () => {
  it("are_even_about_zero_where_both_signs_count", () => {
    expect(evened([-2, 1])).toEqual([-2, 2]);
    expect(evened([-0.01, 1])).toEqual([-0.01, 1]);
    expect(evened([3, 3])).toEqual([1.5, 4.5]);
    expect([colorsAlong([-2, 2]), colorsAlong([0, 2])]).toEqual([TWO_SIDED, VIRIDIS]);
    const [r, g, b] = texelsOf(Float32Array.of(0), [-2, 2]);
    expect([r, g, b]).toEqual([247, 247, 247]);
  });

  it("fade_towards_zero_and_are_none_where_there_is_no_number", () => {
    const texels = texelsOf(Float32Array.of(0.15, Number.NaN, 1, 0), [0, 1]);
    expect([3, 7, 11, 15].map((at) => texels[at])).toEqual([128, 0, 255, 0]);
    expect(texelsOf(Float32Array.of(Number.POSITIVE_INFINITY), [0, 1])[3]).toBe(0);
    const speeds = texelsOf(Float32Array.of(1, 1, 1), [0, 1], Float32Array.of(4, 0.6, 0));
    expect([speeds[3], speeds[7], speeds[11]]).toEqual([255, 128, 0]);
    expect(gradientOf([-1, 1])).toMatch(
      /^linear-gradient\(to right, rgb\(0 60 110 \/ 1\.00\), .*rgb\(138 53 0 \/ 1\.00\)\)$/,
    );
    expect(Array.from(texels.subarray(8, 11))).toEqual([253, 231, 37]);
    expect(rangeOf(Float32Array.of(Number.NaN, 2))).toEqual([2, 2]);
    expect(rangeOf(Float32Array.of(Number.POSITIVE_INFINITY, 2))).toEqual([2, 2]);
    expect(rangeOf(Float32Array.of(0, 0))).toBeNull();
  });

  it("lie_on_a_plane_from_the_first_point_to_the_last", async () => {
    const { fields, waiting } = asked();
    const layer = new FieldLayer(fields);
    layer.place(0);
    expect([layer.mesh.visible, waiting.length]).toEqual([false, 0]);
    fields.shown = true;
    layer.place(0);
    waiting[0].give(mapOf([1, 3]));
    await settled();
    layer.place(0);
    expect(layer.mesh.visible).toBe(true);
    expect(layer.scale).toEqual({ title: "Density", units: "kg/m³", low: 1, high: 3 });
    const { elements } = layer.mesh.matrix;
    expect([elements[0], elements[6]]).toEqual([3, 2]);
    // The one before stays until the next has come.
    layer.place(1);
    expect(layer.mesh.visible).toBe(true);
    fields.shown = false;
    layer.place(1);
    expect([layer.mesh.visible, layer.scale]).toEqual([false, null]);
  });
});
