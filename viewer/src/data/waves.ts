// Waves of a lattice, asked from the server: its bands, and a wave as a recording of one period over some cells.

import type { Bands } from "./bands";
import { rowsOf, unpacked } from "./feed";
import type { ArraySpec, Vec3 } from "./header";
import { table } from "./json";
import { Recording } from "./recording";
import { answer } from "./served";

/** What the server says of a wave before its rows. */
export interface WaveHead {
  rows: number;
  omega: number;
  decay: number;
  /** The cell vectors at rest [m], and how many cells there are along each. */
  cell: Vec3[];
  repeat: number[];
  /** Its bodies, and which body of the run each looks like. */
  bodies: { name: string; like: number }[];
}

export async function servedBands(path: string): Promise<Bands> {
  const query = path.trim() === "" ? "" : `?path=${encodeURIComponent(path)}`;
  return (await (await answer(`api/bands${query}`)).json()) as Bands;
}

/** The wave of a branch at the first point of a path; the amplitude is a part of the nearest length. */
export async function servedWave(
  run: Recording,
  path: string,
  branch: number,
  amplitude: number,
): Promise<Recording> {
  const query = `path=${encodeURIComponent(path)}&branch=${branch}&amplitude=${amplitude}`;
  const { announced, payload } = unpacked<WaveHead>(await (await answer(`api/wave?${query}`)).arrayBuffer());
  return waveRecording(run, announced, payload);
}

/** A period as a recording: the bodies of all cells look like those of the run. */
export function waveRecording(run: Recording, head: WaveHead, payload: ArrayBuffer): Recording {
  const count = head.bodies.length;
  const arrays = [specOf("position", "m", count, 3), specOf("placement_gradient", "1", count, 9)];
  const [time, values] = rowsOf(
    payload,
    head.rows,
    arrays.map(({ stride }) => stride),
  );
  const resolved = table(run.header.resolved);
  const { cell, repeat } = head;
  const wave = new Recording({
    ...run.header,
    bodies: head.bodies.map(({ name, like }) => ({ ...run.header.bodies[like], name })),
    resolved: { ...resolved, lattice: { ...table(resolved.lattice), cell, repeat, periodic: false } },
    arrays,
    columns: [],
    rows: head.rows,
    end: time[head.rows - 1],
    complete: true,
    outcome: "completed",
    summary: {},
    notes: [],
  });
  wave.surfaces.push(...run.surfaces);
  wave.put(0, time, values);
  return wave;
}

function specOf(name: string, units: string, bodies: number, width: number): ArraySpec {
  return { name, units, description: "", dims: [["body", bodies]], stride: width * bodies };
}
