// Values of JSON of which nothing is known beforehand: what is missing is empty.

import type { Json, Vec3 } from "./header";

export function table(value: Json | undefined): { [key: string]: Json } {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? value : {};
}

export function list(value: Json | undefined): Json[] {
  return Array.isArray(value) ? value : [];
}

export function vector(value: Json | undefined): Vec3 {
  const [x, y, z] = list(value).map(Number);
  return [x ?? 0, y ?? 0, z ?? 0];
}
