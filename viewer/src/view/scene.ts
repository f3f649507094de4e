// The scene of a recording on a stage: its layers, what of them is shown, and the body that is followed.

import { Raycaster, Vector2, Vector3 } from "three";
import { Frame } from "../data/frame";
import type { Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { type Strays, straysOf } from "../data/strays";
import { rgb } from "../math/colors";
import type { EdgeMark } from "../ui/edge";
import { BodyLayer } from "./bodies";
import { type Coloring, Colors } from "./coloring";
import { FieldLayer } from "./fields";
import { type Framing, framed } from "./framing";
import { GhostLayer } from "./ghosts";
import { JointLayer } from "./joints";
import { LIGHT, PALENESS } from "./material";
import { NetworkLayer } from "./network";
import { OutlineLayer } from "./outlines";
import { directionsFor } from "./quality";
import { SolidLayer } from "./solids";
import { SpringLayer } from "./springs";
import type { Stage } from "./stage";
import { SupportLayer } from "./supports";
import { TrailLayer } from "./trails";
import { VectorLayer } from "./vectors";

/** What can be shown or not; `joints` are springs, bonds and pins as well, `network` the forces between bodies. */
export const LAYERS = [
  "forces",
  "network",
  "velocity",
  "axes",
  "trails",
  "ghosts",
  "supports",
  "joints",
] as const;

/** How pale bodies are behind the network of forces. */
const PALE = 0.62;

export type Layer = (typeof LAYERS)[number];

/** What is shown. */
export interface Shown extends Record<Layer, boolean> {
  coloring: Coloring;
  /** The bodies whose centre the camera goes with. */
  follow: number[] | null;
}

export class SceneView {
  readonly frame = new Frame();
  readonly colors: Colors;
  readonly supports: SupportLayer;
  solids: SolidLayer;
  private bodies: BodyLayer;
  /** The layer whose bodies have the colours of their names. */
  private painted: BodyLayer | null = null;
  private readonly outlines: OutlineLayer;
  private readonly springs: SpringLayer;
  private readonly joints: JointLayer;
  private readonly vectors: VectorLayer;
  readonly network: NetworkLayer;
  readonly fields: FieldLayer;
  private readonly trails: TrailLayer;
  private ghosts: GhostLayer;
  private followed: { bodies: number[]; at: Vector3 } | null = null;
  /** Rows that the framing has seen. */
  private framedRows = 0;
  /** Rows by which bodies that fly off were found. */
  private strayRows = 0;
  framing!: Framing;
  private strays!: Strays;
  private center: Vec3 = [0, 0, 0];

  constructor(
    private readonly stage: Stage,
    readonly recording: Recording,
    private readonly shown: Shown,
    kept: Framing | null = null,
  ) {
    this.colors = new Colors(recording);
    this.bodies = new BodyLayer(recording, stage.quality);
    this.outlines = new OutlineLayer(recording);
    this.supports = new SupportLayer(recording);
    this.solids = new SolidLayer(recording, stage.quality);
    this.springs = new SpringLayer(recording);
    this.joints = new JointLayer(recording);
    this.vectors = new VectorLayer(recording);
    this.network = new NetworkLayer(recording, (mesh) => stage.root.add(mesh));
    this.fields = new FieldLayer(recording.fields);
    this.trails = new TrailLayer(recording);
    this.ghosts = new GhostLayer(recording, stage.quality);
    stage.root.clear();
    stage.root.add(
      this.supports.group,
      this.solids.group,
      this.bodies.group,
      this.outlines.group,
      this.vectors.group,
    );
    stage.root.add(
      this.springs.group,
      this.joints.group,
      this.trails.lines,
      this.ghosts.group,
      this.fields.mesh,
    );
    this.cast();
    this.fit(kept ?? framed(recording));
    // A run that starts again is looked at as the one before.
    if (kept) this.framedRows = Number.POSITIVE_INFINITY;
  }

  /** Fits stage and layers to what has been recorded. */
  refit(): void {
    this.fit(framed(this.recording));
    if (!this.stage.touched) this.stage.look();
  }

  /** After new rows: fits again once the recording has doubled, unless the reader has chosen a view. */
  grew(): void {
    if (!this.stage.touched && this.recording.rows >= 2 * this.framedRows) this.refit();
    if (this.recording.rows >= 1.2 * this.strayRows) this.findStrays();
  }

  /** After a surface has come. */
  surfaced(): void {
    for (const layer of [this.bodies, this.solids]) {
      layer.group.removeFromParent();
      layer.dispose();
    }
    this.bodies = new BodyLayer(this.recording, this.stage.quality);
    this.solids = new SolidLayer(this.recording, this.stage.quality);
    this.stage.root.add(this.bodies.group, this.solids.group);
    this.cast();
  }

  private fit(framing: Framing): void {
    this.framing = framing;
    this.framedRows = this.recording.rows;
    this.findStrays();
    this.center = framing.center;
    if (framing.travels && this.shown.follow === null && !this.stage.touched) this.shown.follow = [0];
    this.supports.fit(framing.radius);
    this.vectors.fit(framing.radius);
    this.stage.frame(framing);
    this.followed = null;
  }

  /** Puts everything where it is at a time [s]. */
  place(time: number, smooth: boolean): void {
    const { shown, frame } = this;
    frame.take(this.recording, time, smooth);
    this.bodies.place(frame);
    this.outlines.place(frame);
    this.color();
    this.springs.group.visible = shown.joints;
    this.springs.place(frame);
    this.joints.group.visible = shown.joints;
    this.joints.place(frame);
    this.supports.group.visible = shown.supports;
    this.solids.group.visible = shown.supports;
    this.solids.place(frame.time);
    this.supports.place(frame.time, this.middle(), LIGHT.key.value.toArray() as Vec3);
    this.vectors.shown = shown;
    this.vectors.place(frame);
    this.network.place(frame, shown.network);
    this.fields.place(frame.row);
    PALENESS.pale.value = shown.network ? PALE : 0;
    this.trails.lines.visible = shown.trails;
    this.trails.place(frame.row);
    this.ghosts.group.visible = shown.ghosts;
    this.ghosts.place();
    this.follow();
  }

  /** Colours every body; colours that are names stay as they are. */
  private color(): void {
    const { coloring } = this.shown;
    if (coloring === "body" && this.painted === this.bodies) return;
    this.painted = coloring === "body" ? this.bodies : null;
    const colorOf = this.colors.at(coloring, this.frame);
    this.bodies.paint(colorOf);
    this.outlines.paint(colorOf);
  }

  /** Colours what takes them from the theme. */
  paint(theme: { ground: string; line: string; shadow: number; mark: string; sky: string }): void {
    PALENESS.paper.value.set(...rgb(theme.sky));
    this.supports.paint(theme.ground, theme.line, theme.shadow);
    this.springs.paint(theme.mark);
    this.joints.paint(theme.mark);
  }

  /** Whether there are joints, springs, bonds or pins. */
  get isJoined(): boolean {
    return this.springs.count + this.joints.count > 0;
  }

  /** The body under a point of the canvas, from −1 to 1. */
  bodyAt(x: number, y: number): number | null {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(x, y), this.stage.camera);
    return this.bodies.hitBy(ray);
  }

  /** The bodies that have flown out of the picture, and where. */
  edgeMarks(): EdgeMark[] {
    return [...this.strays.bodies].flatMap((body) => {
      const at = this.stage.beyond(this.centerOf(body));
      return at ? [{ name: this.recording.header.bodies[body].name, at }] : [];
    });
  }

  private findStrays(): void {
    this.strayRows = this.recording.rows;
    this.strays = straysOf(this.recording);
  }

  dispose(): void {
    this.bodies.dispose();
    this.supports.dispose();
    this.solids.dispose();
    this.springs.dispose();
    this.joints.dispose();
    this.vectors.dispose();
    this.network.dispose();
    this.fields.dispose();
    this.trails.dispose();
    this.ghosts.dispose();
  }

  /** Moves the camera as the centre of the followed bodies has moved since it was looked at last. */
  private follow(): void {
    const bodies = this.shown.follow;
    if (bodies === null) {
      this.followed = null;
      return;
    }
    const at = new Vector3(...this.centerOf(...bodies));
    if (![at.x, at.y, at.z].every(Number.isFinite)) return;
    if (this.followed?.bodies === bodies) this.stage.shift(at.clone().sub(this.followed.at));
    else this.stage.shift(at.clone().sub(this.stage.target));
    this.followed = { bodies, at };
  }

  /** The point around which the planes are drawn: the followed centre, else the middle of the scene. */
  private middle(): Vec3 {
    return this.heldAt() ?? this.center;
  }

  /** The centre of mass of the followed bodies [m]. */
  heldAt(): Vec3 | null {
    return this.shown.follow && this.centerOf(...this.shown.follow);
  }

  private cast(): void {
    this.supports.shade(this.bodies.casters, directionsFor(this.stage.quality, this.bodies.triangles));
  }

  /** Σ mᵢ pᵢ / Σ mᵢ. */
  private centerOf(...bodies: number[]): Vec3 {
    const masses = bodies.map((body) => this.recording.header.bodies[body].mass);
    const whole = masses.reduce((sum, mass) => sum + mass, 0);
    return [0, 1, 2].map((axis) =>
      bodies.reduce((sum, body, k) => sum + (masses[k] / whole) * this.frame.position[3 * body + axis], 0),
    ) as Vec3;
  }
}
