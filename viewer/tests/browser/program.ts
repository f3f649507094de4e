// The real program: recordings, reports, servers.

import { type ChildProcess, execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll } from "vitest";

const REPOSITORY = join(import.meta.dirname, "../../..");
const PROGRAM = process.env.GYRATION_BIN ?? join(REPOSITORY, "target/release/gyration");

if (!existsSync(PROGRAM))
  throw new Error(`${PROGRAM} is not there: cargo build --release, or set GYRATION_BIN`);

/** A folder that goes when the tests of a file are over. */
export const folder = mkdtempSync(join(tmpdir(), "gyration-page-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

function call(...parts: string[]): string {
  return execFileSync(PROGRAM, parts, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
}

const SCENES = join(REPOSITORY, "scenes");

/** The names of the gallery, and how long each scene lasts [s]. */
export function gallery(): [string, number][] {
  return readdirSync(SCENES)
    .filter((file) => file.endsWith(".toml"))
    .map((file) => {
      const scene = file.replace(".toml", "");
      const end = /^end\s*=\s*([\d.]+)/m.exec(text(scene));
      return [scene, Number(end?.[1] ?? 1)];
    });
}

/** The file of a scene of the gallery. */
export function text(scene: string): string {
  return readFileSync(join(SCENES, `${scene}.toml`), "utf8");
}

let made = 0;

/** Runs a scene; the folder of its recording. */
export function recorded(scene: string, ...set: string[]): string {
  const path = join(folder, `${made++}.gyr`);
  try {
    call("run", scene, "-o", path, "--quiet", ...set.flatMap((one) => ["--set", one]));
  } catch (error) {
    // A run that stops early (1) leaves a recording all the same.
    if ((error as { status?: number }).status !== 1) throw error;
  }
  return path;
}

/** Runs a scene and interrupts it on the way; the folder of its recording. */
export async function interrupted(scene: string, ...set: string[]): Promise<string> {
  const path = join(folder, `${made++}.gyr`);
  const parts = ["run", scene, "-o", path, "--quiet", ...set.flatMap((one) => ["--set", one])];
  const child = spawn(PROGRAM, parts, { cwd: folder, stdio: "ignore" });
  const ended = new Promise((resolve) => child.once("exit", resolve));
  while (!existsSync(join(path, "time"))) await new Promise((resolve) => setTimeout(resolve, 50));
  child.kill("SIGINT");
  await ended;
  return path;
}

/** The report of a recording, as a file. */
export function reported(recording: string): string {
  const path = recording.replace(".gyr", ".html");
  call("report", recording, "-o", path);
  return path;
}

export interface Served {
  url: string;
  port: number;
  stop(): Promise<void>;
}

const running = new Set<ChildProcess>();
afterAll(() => {
  for (const child of running) child.kill();
});

/** `gyration view`, once it listens. */
export async function served(what: string, ...more: string[]): Promise<Served> {
  const child = spawn(PROGRAM, ["view", what, "--no-open", ...more], { cwd: folder });
  running.add(child);
  const said = { out: "", err: "" };
  child.stderr.on("data", (data) => {
    said.err += data;
  });
  const url = await new Promise<string>((resolve, reject) => {
    child.stdout.on("data", (data) => {
      said.out += data;
      const found = /http:\/\/\S+/.exec(said.out);
      if (found) resolve(found[0]);
    });
    child.on("exit", (code) => reject(new Error(`gyration view ended with ${code}: ${said.err}`)));
  });
  const stop = () =>
    new Promise<void>((resolve) => {
      running.delete(child);
      child.once("exit", () => resolve());
      child.kill("SIGKILL");
    });
  return { url, port: Number(new URL(url).port), stop };
}
