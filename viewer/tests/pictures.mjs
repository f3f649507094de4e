// The README's pictures: `npm run pictures` leaves them in docs/pictures, made by the real program.
//
// They are to be small enough to commit: together below 280 kB.

import { execFileSync, execSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { indexedPng } from "./palette.mjs";

const REPOSITORY = join(import.meta.dirname, "../..");
const PROGRAM = process.env.GYRATION_BIN ?? join(REPOSITORY, "target/release/gyration");
const PICTURES = join(REPOSITORY, "docs/pictures");
const MOST_BYTES = 280_000;
const VIEWPORT = { width: 960, height: 600 };

const folder = mkdtempSync(join(tmpdir(), "gyration-pictures-"));

function report(scene, ...set) {
  const recording = join(folder, `${scene}.gyr`);
  const overrides = set.flatMap((one) => ["--set", one]);
  execFileSync(PROGRAM, ["run", scene, "-o", recording, "--quiet", ...overrides], { stdio: "ignore" });
  const file = join(folder, `${scene}.html`);
  execFileSync(PROGRAM, ["report", recording, "-o", file], { stdio: "ignore" });
  return `file://${file}`;
}

const launched = await chromium.launch({
  executablePath:
    process.env.GYRATION_CHROMIUM ?? execSync("command -v chromium", { encoding: "utf8" }).trim(),
  chromiumSandbox: process.getuid?.() !== 0,
  args: [
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
  ],
});

/** One picture: what is opened, what is pressed, the time that is shown [s]. */
async function picture(name, url, { keys = "", time, scheme = "light", prepare = async () => {} }) {
  const page = await launched.newPage({ viewport: VIEWPORT, colorScheme: scheme });
  await page.goto(`${url}#quality=full`);
  await page.waitForFunction(() => window.gyration !== undefined);
  await page.evaluate(() => window.gyration.ready);
  await page.waitForTimeout(1500);
  for (const key of keys) await page.keyboard.press(key);
  await prepare(page);
  await page.evaluate((at) => window.gyration.seek(at), time);
  await page.waitForTimeout(2500);
  const path = join(PICTURES, `${name}.png`);
  const shot = (await page.screenshot()).toString("base64");
  writeFileSync(path, indexedPng(await pixelsOf(page, shot)));
  await page.close();
  return path;
}

/** The pixels of a PNG, decoded by the browser. */
async function pixelsOf(page, base64) {
  const [width, height, pixels] = await page.evaluate(async (png) => {
    const image = await createImageBitmap(
      new Blob([Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0))]),
    );
    const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
    canvas.drawImage(image, 0, 0);
    const { data } = canvas.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let k = 0; k < data.length; k += 8192) text += String.fromCharCode(...data.subarray(k, k + 8192));
    return [image.width, image.height, btoa(text)];
  }, base64);
  return { width, height, data: Buffer.from(pixels, "base64") };
}

async function sliders(page) {
  await page.keyboard.press("Space");
  await page.getByRole("tab", { name: "Sliders" }).click();
  await page.getByRole("searchbox").fill("velocity");
  const velocity = page.getByRole("textbox", { name: "body.die.velocity.x, exact" });
  await velocity.fill("0.8");
  await velocity.press("Enter");
  await page.waitForTimeout(4000);
}

async function byStretch(page) {
  await page.getByRole("combobox", { name: "colouring" }).selectOption("stretch");
}

async function live(scene, options) {
  const server = spawn(PROGRAM, ["view", scene, "--no-open"]);
  const url = await new Promise((resolve) =>
    server.stdout.on("data", (data) => resolve(String(data).trim())),
  );
  const path = await picture("page-live", url, options);
  server.kill();
  return path;
}

try {
  const made = [
    await picture("page-report", report("dice"), { time: 0.195, keys: "cv" }),
    await picture("page-stretch", report("elastic-bounce-tilted"), {
      time: 0.305,
      keys: "a",
      prepare: byStretch,
    }),
    await picture("page-crawl", report("crawl"), { time: 3.3, keys: "oc", scheme: "dark" }),
    await live("dice", { time: 0.2, keys: "", prepare: sliders, scheme: "dark" }),
  ];
  const bytes = made.filter(existsSync).reduce((sum, path) => sum + statSync(path).size, 0);
  for (const path of made) console.log(`${path}: ${(statSync(path).size / 1e3).toFixed(0)} kB`);
  if (bytes > MOST_BYTES)
    throw new Error(`the pictures have ${bytes} bytes together, more than ${MOST_BYTES}`);
} finally {
  await launched.close();
  rmSync(folder, { recursive: true, force: true });
}
