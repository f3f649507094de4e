// Chromium over the page: opens it, watches for errors and for requests that leave the machine, reads its pixels.

import { execSync } from "node:child_process";
import { type Browser, type BrowserContextOptions, chromium, type Page } from "playwright-core";
import { afterAll } from "vitest";

/** WebGL on the processor, and nothing that would want a network. */
const ARGUMENTS = [
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

let launched: Promise<Browser> | null = null;

export function browser(more: string[] = []): Promise<Browser> {
  const executablePath =
    process.env.GYRATION_CHROMIUM ?? execSync("command -v chromium", { encoding: "utf8" }).trim();
  const launch = () =>
    chromium.launch({
      executablePath,
      chromiumSandbox: process.getuid?.() !== 0,
      args: [...ARGUMENTS, ...more],
    });
  if (more.length > 0) return launch();
  launched ??= launch();
  return launched;
}

afterAll(async () => (await launched)?.close());

export interface Opened {
  page: Page;
  /** Errors of the console, of scripts, and requests to elsewhere. */
  problems: string[];
  close(): Promise<void>;
}

export interface Opening {
  ready?: boolean;
  on?: Promise<Browser>;
  /** Done to the page before it is led anywhere. */
  before?: (page: Page) => Promise<void>;
}

export const DESK = { viewport: { width: 1280, height: 800 } };
export const PHONE = { viewport: { width: 360, height: 740 }, hasTouch: true };

/** Opens a page and waits for its first frame, unless told that there will be none. */
export async function opened(
  where: string,
  options: BrowserContextOptions = DESK,
  { ready = true, on = browser(), before }: Opening = {},
): Promise<Opened> {
  const url = where.startsWith("http") ? where : `file://${where}`;
  const context = await (await on).newContext(options);
  context.setDefaultTimeout(60_000);
  const page = await context.newPage();
  await before?.(page);
  const problems: string[] = [];
  page.on("console", (message) => message.type() === "error" && problems.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`script: ${error.message}`));
  page.on("request", (request) => {
    const to = request.url();
    const own = to === url.split("#")[0] || to.startsWith("data:") || to.startsWith("blob:");
    if (!own && !(url.startsWith("http") && to.startsWith(new URL(url).origin)))
      problems.push(`request: ${to}`);
  });
  await page.goto(url, { waitUntil: "commit" });
  await page.waitForFunction(() => window.gyration !== undefined);
  if (ready) await page.evaluate(() => window.gyration.ready);
  return { page, problems, close: () => context.close() };
}

/** The picture at a time as bytes that can be compared, three a pixel: one pixel in so many along and down. */
export async function pixelsAt(page: Page, time: number, along = 4, down = 4): Promise<Uint8Array> {
  const text = await page.evaluate(
    ([at, right, up]) => {
      window.gyration.seek(at);
      window.gyration.renderNow();
      const canvas = document.querySelector<HTMLCanvasElement>(".picture canvas")!;
      const gl = canvas.getContext("webgl2")!;
      const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
      const all = new Uint8Array(4 * width * height);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
      let some = "";
      for (let y = 0; y < height; y += up) {
        for (let x = 0; x < width; x += right) {
          const from = 4 * (y * width + x);
          some += String.fromCharCode(all[from], all[from + 1], all[from + 2]);
        }
      }
      // A text in base64 is handed over many times faster than a list of numbers.
      return btoa(some);
    },
    [time, along, down] as const,
  );
  return Buffer.from(text, "base64");
}

/** How many colours there are, roughly. */
export function colors(pixels: Uint8Array): number {
  const seen = new Set<number>();
  for (let k = 0; k < pixels.length; k += 3) {
    seen.add(((pixels[k] >> 3) << 10) | ((pixels[k + 1] >> 3) << 5) | (pixels[k + 2] >> 3));
  }
  return seen.size;
}

/** Pixels that differ visibly. */
export function differing(a: Uint8Array, b: Uint8Array): number {
  let count = 0;
  for (let k = 0; k < a.length; k += 3) {
    if ([k, k + 1, k + 2].some((part) => Math.abs(a[part] - b[part]) > 24)) count++;
  }
  return count;
}

export async function lastTime(page: Page): Promise<number> {
  return page.evaluate(() => Number(document.querySelector<HTMLInputElement>(".scrubber")!.max));
}
