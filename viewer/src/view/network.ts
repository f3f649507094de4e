// The network of forces: a bar from centre to centre of two bodies that push each other, and from a centre to where a
// support pushes.
//
// A force counts in parts of the mean force of the sample, whatever the weight of a body: its bar is as wide as it is
// strong, and its colour says so too. Bars are seen through whatever stands before them, one hides another, and bodies
// are pale meanwhile.

import {
  Color,
  CylinderGeometry,
  InstancedBufferAttribute,
  type InstancedMesh,
  SRGBColorSpace,
  type WebGLRenderer,
} from "three";
import type { Frame } from "../data/frame";
import { WIDTH } from "../data/network";
import type { Recording } from "../data/recording";
import { between, type Rgb, rgb } from "../math/colors";
import type { Scale } from "./coloring";
import { instancesOf, matricesOf, moved } from "./instances";
import { barMaterial } from "./material";

/** Forces of so many means and more have the last colour. */
const STRONGEST = 4;
/** A bar is no wider than one of so many means. */
const WIDEST = 6;
/** The radius of a bar of the mean force, in sizes of a body. */
const RADIUS = 0.05;
/** The radius of a bar of no force, in that of the mean: what is drawn can be seen. */
const THINNEST = 0.2;
/** More bars than these have fewer sides. */
const CROWD = 2000;
const SIDES = [12, 5];

/** Slate, amber, vermilion, crimson: seen on light and on dark. */
export const FORCE_COLORS = ["#8a97ab", "#d9a441", "#e2702f", "#c8102e"].map(rgb);

/** The mean force of the contacts of a sample [N]; 0 without any. */
export function meanForce(contacts: Float32Array): number {
  let sum = 0;
  for (let at = 2; at < contacts.length; at += WIDTH) sum += contacts[at];
  return contacts.length > 0 ? (WIDTH * sum) / contacts.length : 0;
}

/** The colour of a force of so many means. */
export function forceColor(means: number): Rgb {
  return between(FORCE_COLORS, means / STRONGEST);
}

/** The radius of the bar of a force of so many means, in that of the mean. */
export function thickness(means: number): number {
  return THINNEST + (1 - THINNEST) * Math.min(means, WIDEST);
}

export class NetworkLayer {
  private readonly material = barMaterial();
  private mesh: InstancedMesh | null = null;
  private room = 0;
  private last: Float32Array | null = null;
  private readonly radius: number;
  private readonly color = new Color();
  /** What of the last frame is drawn; `null` where nothing is known of it. */
  scale: Scale | null = null;

  constructor(
    private readonly recording: Recording,
    private readonly add: (mesh: InstancedMesh) => void,
  ) {
    const sizes = recording.header.bodies.map(({ size }) => size).sort((a, b) => a - b);
    this.radius = RADIUS * (sizes[sizes.length >> 1] ?? 0);
  }

  /** Puts the bars where they are; none where they are not shown. */
  place(frame: Frame, shown: boolean): void {
    const contacts = shown ? this.contactsAt(frame.row) : null;
    const mean = contacts ? meanForce(contacts) : 0;
    this.scale = shown ? scaleOf(mean) : null;
    const count = contacts && mean > 0 ? contacts.length / WIDTH : 0;
    if (contacts && count > this.room) this.reserve(count);
    const { mesh } = this;
    if (!mesh) return;
    mesh.visible = count > 0;
    mesh.count = count;
    if (!contacts || count === 0) return;
    const matrices = matricesOf(mesh);
    for (let k = 0; k < count; k++) {
      const at = WIDTH * k;
      const [first, second, force] = [contacts[at], contacts[at + 1], contacts[at + 2]];
      const from = frame.position.subarray(3 * first, 3 * first + 3);
      const to =
        second < 0
          ? contacts.subarray(at + 3, at + WIDTH)
          : frame.position.subarray(3 * second, 3 * second + 3);
      writeBar(matrices, 16 * k, from, to, this.radius * thickness(force / mean));
      mesh.setColorAt(k, this.color.setRGB(...forceColor(force / mean), SRGBColorSpace));
    }
    mesh.instanceColor!.needsUpdate = true;
    moved(mesh);
  }

  /** The contacts of a sample; those before it while they are on their way, lest a picture that plays flickers. */
  private contactsAt(row: number): Float32Array | null {
    const { network } = this.recording;
    const found = network?.at(row) ?? null;
    if (found || !network?.isLoading) this.last = found;
    return this.last;
  }

  dispose(): void {
    this.drop();
    this.material.dispose();
  }

  private drop(): void {
    this.mesh?.removeFromParent();
    this.mesh?.geometry.dispose();
    this.mesh?.dispose();
    this.mesh = null;
  }

  /** Room for so many bars, and some more. */
  private reserve(count: number): void {
    this.drop();
    this.room = Math.ceil(1.25 * count);
    const sides = SIDES[this.room > CROWD ? 1 : 0];
    // From the origin along y.
    const geometry = new CylinderGeometry(1, 1, 1, sides, 1, true).translate(0, 0.5, 0);
    const mesh = instancesOf(geometry, this.material, this.room);
    mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * this.room), 3);
    mesh.renderOrder = 4;
    // What was drawn before hides no bar.
    mesh.onBeforeRender = (renderer: WebGLRenderer) => renderer.clearDepth();
    this.mesh = mesh;
    this.add(mesh);
  }
}

function scaleOf(mean: number): Scale {
  return { title: "Force between bodies", units: "N", low: 0, high: STRONGEST * mean };
}

/** A cylinder about y from 0 to 1, brought to a line and a radius, as a column-major 4×4 matrix. */
export function writeBar(
  into: Float32Array,
  at: number,
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  radius: number,
): void {
  const [x, y, z] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const length = Math.hypot(x, y, z) || 1;
  const [a, b, c] = [x / length, y / length, z / length];
  // Two directions across. Source: Duff et al., J. Comput. Graph. Tech. 6 (2017) 1.
  const sign = c >= 0 ? 1 : -1;
  const p = -1 / (sign + c);
  const q = a * b * p;
  const across = [1 + sign * a * a * p, sign * q, -sign * a, q, sign + b * b * p, -b];
  for (let k = 0; k < 3; k++) {
    into[at + k] = radius * across[3 + k];
    into[at + 4 + k] = [x, y, z][k];
    into[at + 8 + k] = radius * across[k];
    into[at + 12 + k] = from[k];
  }
  into[at + 3] = into[at + 7] = into[at + 11] = 0;
  into[at + 15] = 1;
}
