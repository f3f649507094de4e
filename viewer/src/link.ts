// What is looked at, as the part of the address behind `#`: whoever opens the link sees the same.
//
//   #t=0.245&show=forces,joints&color=stretch&body=die&follow=1&camera=1,2,3,0,0,0&panel=Summary&field=speed&width=0.1
//
// The camera is place and target [m], from the followed centre where one is followed. What is as it begins is left out,
// and parts of others are kept.

import { COLORINGS, type Coloring } from "./view/coloring";
import type { Sight } from "./view/framing";
import { LAYERS, type Layer } from "./view/scene";

export interface Look {
  /** [s] */
  time?: number;
  show?: Layer[];
  color?: Coloring;
  /** A body, or several by their group. */
  body?: string;
  group?: string;
  follow?: boolean;
  camera?: Sight;
  panel?: string;
  /** The field that is shown, and its width [m] if that is not the usual one. */
  field?: string;
  width?: number;
}

/** What is this much shorter than the camera is away cannot be seen. */
const CLOSE = 1e-6;

const OWN = ["t", "show", "color", "body", "group", "follow", "camera", "panel", "field", "width"];

/** What an address asks for; parts that make no sense are left out. */
export function lookIn(hash: string): Look {
  const parts = new URLSearchParams(hash.replace(/^#/, ""));
  const look: Look = {};
  const given = (key: string, take: (value: string) => void) => {
    const value = parts.get(key);
    if (value !== null) take(value);
  };
  given("t", (value) => {
    const time = numberIn(value);
    if (Number.isFinite(time)) look.time = time;
  });
  given("show", (value) => {
    const names = value.split(",");
    look.show = LAYERS.filter((layer) => names.includes(layer));
  });
  given("color", (value) => {
    const color = COLORINGS.find((coloring) => coloring === value);
    if (color) look.color = color;
  });
  given("body", (value) => {
    look.body = value;
  });
  given("group", (value) => {
    look.group = value;
  });
  given("follow", (value) => {
    look.follow = value === "1";
  });
  given("camera", (value) => {
    const [x, y, z, tx, ty, tz, ...more] = value.split(",").map(numberIn);
    const numbers = [x, y, z, tx, ty, tz];
    if (more.length > 0 || !numbers.every(Number.isFinite)) return;
    const far = Math.hypot(x - tx, y - ty, z - tz);
    if (far > 0 && far < Number.POSITIVE_INFINITY)
      look.camera = { position: [x, y, z], target: [tx, ty, tz] };
  });
  given("panel", (value) => {
    look.panel = value;
  });
  given("field", (value) => {
    look.field = value;
  });
  given("width", (value) => {
    const width = numberIn(value);
    if (width > 0 && Number.isFinite(width)) look.width = width;
  });
  return look;
}

/** A decimal number; NaN for all else that the language would take for one. */
function numberIn(text: string): number {
  return /^[-+.\deE]+$/.test(text) ? Number(text) : Number.NaN;
}

/** The address of a look; what others have written behind `#` stays. */
export function hashOf(look: Look, before: string): string {
  const others = before
    .replace(/^#/, "")
    .split("&")
    .filter((part) => part !== "" && ![...new URLSearchParams(part).keys()].some((key) => OWN.includes(key)));
  const { time, show, color, body, group, follow, camera, panel, field, width } = look;
  const far = camera ? Math.hypot(...camera.position.map((part, axis) => part - camera.target[axis])) : 0;
  const rounded = (part: number) => (Math.abs(part) < CLOSE * far ? 0 : Number(part.toPrecision(6)));
  const numbers = camera && [...camera.position, ...camera.target].map(rounded);
  const own: [string, string | undefined][] = [
    ["t", time?.toString()],
    ["show", show?.join(",")],
    ["color", color],
    ["body", body],
    ["group", group],
    ["follow", follow === undefined ? undefined : follow ? "1" : "0"],
    ["camera", numbers?.join(",")],
    ["panel", panel],
    ["field", field],
    ["width", width?.toString()],
  ];
  const written = own.flatMap(([key, value]) =>
    value === undefined ? [] : [`${key}=${encodeURIComponent(value).replaceAll("%2C", ",")}`],
  );
  const all = [...others, ...written].join("&");
  return all === "" ? "" : `#${all}`;
}
