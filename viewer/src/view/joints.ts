// Marks of joints where their points are: a ball, the rod of a hinge in its ring, a rail with its sleeve, the cube of a
// weld, the line that a distance keeps; and pins, with the arm to the centre of mass.
//
// A mark is at the point of the second: the joint holds it at that of the first. Marks have a depth of their own, so
// that they are seen through bodies, as joints lie within these.

import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  CylinderGeometry,
  Group,
  type InstancedMesh,
  LineBasicMaterial,
  OctahedronGeometry,
  SphereGeometry,
  TorusGeometry,
} from "three";
import type { End } from "../data/ends";
import type { Frame } from "../data/frame";
import type { Vec3 } from "../data/header";
import { type Joint, jointsOf, pinsOf } from "../data/joints";
import type { Recording } from "../data/recording";
import { across, cross, dot, unit } from "../math/mat3";
import { instancesOf, matricesOf, moved } from "./instances";
import { markMaterial } from "./material";
import { LinkLines, placed, pointing } from "./places";

/** A mark's unit of length in sizes of the smallest body that is joined. */
const SIZE = 0.05;
/** Half the length of a hinge's rod, and of a rail beyond its points, in units. */
const ROD = 2.6;
const RAIL = 4;

/** Parts of marks, each a mesh whose third axis is the joint's, of unit size. */
const PARTS = {
  ball: () => new SphereGeometry(1, 20, 12),
  dot: () => new SphereGeometry(0.6, 12, 8),
  rod: () => new CylinderGeometry(0.38, 0.38, 2 * ROD, 14).rotateX(Math.PI / 2),
  ring: () => new TorusGeometry(1, 0.24, 8, 24),
  rail: () => new BoxGeometry(0.5, 0.5, 2),
  sleeve: () => new BoxGeometry(1.7, 1.7, 2.4),
  cube: () => new BoxGeometry(1.7, 1.7, 1.7),
  pin: () => new OctahedronGeometry(1.2),
} satisfies Record<string, () => BufferGeometry>;

type Part = keyof typeof PARTS;

const PARTS_OF: Record<Joint["kind"], Part[]> = {
  ball: ["ball"],
  hinge: ["rod", "ring"],
  slider: ["rail", "sleeve"],
  weld: ["cube"],
  distance: ["dot"],
};

/** What is drawn of a joint or pin. */
interface Mark {
  parts: Part[];
  ends: [End, End];
  axis: Vec3;
  /** A direction across the axis. */
  beside: Vec3;
  /** Its unit of length [m]. */
  unit: number;
}

export class JointLayer {
  readonly group = new Group();
  private readonly marks: Mark[];
  private readonly meshes = new Map<Part, InstancedMesh>();
  private readonly material = markMaterial();
  private readonly line = new LineBasicMaterial({ depthTest: false, transparent: true });
  private readonly links: LinkLines;

  constructor({ header }: Recording) {
    const joints = jointsOf(header);
    const pins = pinsOf(header);
    const size = (ends: End[]) =>
      SIZE *
      Math.min(...ends.flatMap(({ body }) => (body === null ? [] : [header.bodies[body].size || Infinity])));
    this.marks = [
      ...joints.map(({ kind, ends, axis }) => ({ parts: PARTS_OF[kind], ends, axis })),
      ...pins.map((ends) => ({ parts: ["pin" as const], ends, axis: [0, 0, 1] as Vec3 })),
    ].map((mark): Mark => {
      const unitOfLength = size(mark.ends);
      return {
        ...mark,
        beside: across(unit(mark.axis, [0, 0, 1])),
        unit: Number.isFinite(unitOfLength) ? unitOfLength : 0,
      };
    });
    // Both ends of a distance have a dot.
    this.marks.push(
      ...this.marks
        .filter(({ parts }) => parts.includes("dot"))
        .map(({ ends: [one, other], ...mark }): Mark => ({ ...mark, ends: [other, one] })),
    );
    for (const part of Object.keys(PARTS) as Part[]) {
      const count = this.marks.filter(({ parts }) => parts.includes(part)).length;
      if (count === 0) continue;
      const mesh = instancesOf(PARTS[part](), this.material, count);
      mesh.renderOrder = 4;
      this.meshes.set(part, mesh);
      this.group.add(mesh);
    }
    const [first] = this.meshes.values();
    if (first) {
      first.renderOrder = 3.5;
      first.onBeforeRender = (renderer) => renderer.clearDepth();
    }
    const lined = joints.filter(({ kind }) => kind === "distance" || kind === "weld");
    this.links = new LinkLines([...lined.map(({ ends }) => ends), ...pins], this.line);
    this.links.lines.renderOrder = 3;
    this.group.add(this.links.lines);
  }

  /** Joints and pins. */
  get count(): number {
    return this.marks.length;
  }

  paint(color: string): void {
    this.line.color.set(color);
    const own = new Color(color);
    for (const mesh of this.meshes.values()) {
      for (let k = 0; k < mesh.count; k++) mesh.setColorAt(k, own);
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  place(frame: Frame): void {
    if (!this.group.visible) return;
    this.links.place(frame);
    const used = new Map<Part, number>();
    for (const mark of this.marks) {
      const axes = axesOf(mark, frame);
      for (const part of mark.parts) {
        const mesh = this.meshes.get(part);
        const at = used.get(part) ?? 0;
        used.set(part, at + 1);
        if (mesh) writePart(matricesOf(mesh), 16 * at, part, mark.unit, axes);
      }
    }
    for (const mesh of this.meshes.values()) moved(mesh);
  }

  dispose(): void {
    for (const mesh of this.meshes.values()) {
      mesh.geometry.dispose();
      mesh.dispose();
    }
    this.links.dispose();
    this.material.dispose();
    this.line.dispose();
  }
}

/** The axes of a mark, those of the joint or of a body that is welded, as columns; and where its ends are. */
function axesOf({ ends: [one, other], axis, beside }: Mark, frame: Frame) {
  const along = pointing(one, axis, frame);
  const turned = pointing(one, beside, frame);
  // What a body that deforms shears is at right angles no more.
  const away = dot(turned, along);
  const first = unit(turned.map((value, k) => value - away * along[k]) as Vec3, across(along));
  return { first, second: cross(along, first), along, from: placed(one, frame), to: placed(other, frame) };
}

/** Writes where a part of a mark is, as a matrix by columns. */
function writePart(
  into: Float32Array,
  start: number,
  part: Part,
  size: number,
  axes: ReturnType<typeof axesOf>,
) {
  const { first, second, along, from, to } = axes;
  // A rail reaches from point to point, and beyond both.
  const way = part === "rail" ? dot(to.map((value, k) => value - from[k]) as Vec3, along) : 0;
  const long = part === "rail" ? 0.5 * Math.abs(way) + RAIL * size : size;
  const at = part === "pin" ? from : to;
  for (let k = 0; k < 3; k++) {
    into[start + k] = size * first[k];
    into[start + 4 + k] = size * second[k];
    into[start + 8 + k] = long * along[k];
    into[start + 12 + k] = at[k] - 0.5 * way * along[k];
  }
  into[start + 15] = 1;
}
