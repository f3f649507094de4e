// The stage: renderer, lights, camera. It draws when asked, once an animation frame at most, and never by itself.
//
// Everything on it stands in a root whose unit is the scene's radius, so that light and clipping planes are
// the same for a millimetre and a kilometre. Up is against gravity.

import { Color, Group, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Vec3 } from "../data/header";
import { across, cross } from "../math/mat3";
import { type Framing, type Sight, sightOf } from "./framing";
import { LIGHT } from "./material";
import { contextOf, type Quality, Thrift } from "./quality";

const FIELD_OF_VIEW = 32;
/** Where the first look comes from: to the right, back, up. */
const FIRST_LOOK = [0.5, 1, 0.42];
/** Pixels of a crowd, a side, beside those of a few. */
const CROWD_RATIO = 0.7;
/** Room around what is framed. */
const MARGIN = 1.12;
/** The part of the picture's height that buttons above it may take from what is framed. */
const MOST_COVERED = 0.3;
/** Keys leave this angle between the view and up or down [rad]. */
const LEAST_POLAR = 0.02;
/** Where light comes from, in the same directions. */
const KEY = [-0.5, 0.75, 1.5];
const FILL = [1, 0.5, 0.25];

/** Before there is anything to look at. */
const UNIT: Pick<Framing, "reach" | "center" | "radius"> = {
  reach: ([x, y, z]) => Math.hypot(x, y, z),
  center: [0, 0, 0],
  radius: 1,
};

export class Stage {
  readonly root = new Group();
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 200);
  readonly quality: Quality;
  readonly renderer: WebGLRenderer;
  /** Frames drawn so far. */
  frames = 0;
  /** Whether the reader has moved the camera. */
  touched = false;
  /** Called before each frame. */
  prepare: () => void = () => {};
  /** Called after the reader has moved the camera. */
  settled: () => void = () => {};
  /** How much of the canvas lies under buttons, from its top [px]. */
  covered: () => number = () => 0;
  private readonly scene = new Scene();
  private controls: OrbitControls;
  private asked = 0;
  private framing: Framing = { ...UNIT, up: [0, 0, 1], fromBelow: false, travels: false };
  private readonly thrift: Thrift;

  /** Fails where there is no WebGL. */
  constructor(readonly canvas: HTMLCanvasElement) {
    const made = contextOf(canvas);
    if (!made) throw new Error("no WebGL");
    this.quality = made.quality;
    this.renderer = new WebGLRenderer({ canvas, context: made.context, stencil: true });
    this.renderer.setPixelRatio(Math.min(this.quality.pixelRatio, devicePixelRatio));
    this.thrift = new Thrift(this.renderer, this.quality);
    this.scene.add(this.root);
    this.controls = this.newControls();
    canvas.addEventListener("webglcontextrestored", () => this.request());
  }

  /** A frame, as soon as the browser draws. */
  request(): void {
    this.asked ||= requestAnimationFrame(() => this.draw());
  }

  /** A frame, now. */
  draw(): void {
    cancelAnimationFrame(this.asked);
    this.asked = 0;
    this.prepare();
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = 0.01 * distance;
    this.camera.far = distance + 60;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    this.frames++;
  }

  /** While playing: how long the last frame took [ms]. Fewer pixels clear the picture: it is drawn before that is seen. */
  tookWhilePlaying(milliseconds: number): void {
    if (this.thrift.saw(milliseconds)) this.draw();
  }

  /** Takes fewer pixels where there are many bodies. */
  expect(bodies: number): void {
    const ratio = this.quality.pixelRatio * (bodies > this.quality.crowd ? CROWD_RATIO : 1);
    this.renderer.setPixelRatio(Math.min(ratio, devicePixelRatio));
    this.resize();
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = this.renderer.getPixelRatio();
    if (width === 0 || height === 0) return;
    if (this.canvas.width === Math.floor(width * ratio) && this.canvas.height === Math.floor(height * ratio))
      return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.request();
  }

  background(color: string, sky: number): void {
    this.scene.background = new Color(color);
    LIGHT.sky.value = sky;
  }

  /** Makes a ball the unit of the stage. */
  frame(framing: Framing): void {
    this.framing = framing;
    const { center, radius, up } = framing;
    this.root.scale.setScalar(1 / radius);
    this.root.position.set(...center).divideScalar(-radius);
    if (this.camera.up.distanceTo(new Vector3(...up)) > 1e-6) {
      this.camera.up.set(...up);
      this.controls.dispose();
      this.controls = this.newControls();
    }
    LIGHT.up.value.set(...up);
    LIGHT.key.value.copy(this.direction(KEY));
    LIGHT.fill.value.copy(this.direction(FILL));
  }

  /** The first look again. */
  look(): void {
    this.touched = false;
    const [aside, inward, high] = FIRST_LOOK;
    const back = this.direction([aside, inward, this.framing.fromBelow ? -0.6 * high : high]);
    const right = new Vector3().crossVectors(this.camera.up, back).normalize();
    const above = new Vector3().crossVectors(back, right);
    const axes = [right, above, back].map((axis) => axis.toArray() as Vec3) as [Vec3, Vec3, Vec3];
    const tall = Math.tan((0.5 * FIELD_OF_VIEW * Math.PI) / 180) / MARGIN;
    const wide = tall * this.camera.aspect;
    const free = 1 - 2 * Math.min(MOST_COVERED, this.covered() / Math.max(1, this.canvas.clientHeight));
    this.stand(sightOf(this.framing, axes, { across: [wide, wide], upright: [tall, free * tall] }));
  }

  /** Where the camera stands [m]. */
  get sight(): Sight {
    const place = (at: Vector3) => this.root.worldToLocal(at.clone()).toArray() as Vec3;
    return { position: place(this.camera.position), target: place(this.controls.target) };
  }

  /** Puts the camera where it is to stand [m]. */
  stand({ position, target }: Sight): void {
    this.controls.target.copy(this.root.localToWorld(new Vector3(...target)));
    this.camera.position.copy(this.root.localToWorld(new Vector3(...position)));
    this.controls.update();
    this.request();
  }

  /** Turns the camera about its target by angles to the right and upwards [rad]. */
  turn(right: number, up: number): void {
    const { target } = this.controls;
    const away = this.camera.position.clone().sub(target);
    away.applyAxisAngle(this.camera.up, right);
    const polar = away.angleTo(this.camera.up);
    const by = Math.min(Math.PI - LEAST_POLAR - polar, Math.max(LEAST_POLAR - polar, -up));
    away.applyAxisAngle(new Vector3().crossVectors(this.camera.up, away).normalize(), by);
    this.moved(target.clone().add(away));
  }

  /** Comes closer to the target by a factor. */
  approach(factor: number): void {
    const { target } = this.controls;
    this.moved(this.camera.position.clone().sub(target).divideScalar(factor).add(target));
  }

  private moved(to: Vector3): void {
    this.touched = true;
    this.camera.position.copy(to);
    this.controls.update();
    this.request();
    this.settled();
  }

  /** Where a point of the scene [m] lies beyond the edge of the picture, from −1 to 1; `null` if it is within. */
  beyond(at: Vec3): [number, number] | null {
    const seen = this.root.localToWorld(new Vector3(...at)).applyMatrix4(this.camera.matrixWorldInverse);
    const tall = Math.tan((0.5 * FIELD_OF_VIEW * Math.PI) / 180);
    const depth = -seen.z;
    const [x, y] = [seen.x / (tall * this.camera.aspect), seen.y / tall];
    const most = Math.max(Math.abs(x), Math.abs(y));
    // What is behind the camera has left by the side on which it is.
    return most <= Math.max(0, depth) || most === 0 ? null : [x / most, y / most];
  }

  /** Moves camera and target by a distance of the scene [m]. */
  shift(by: Vector3): void {
    const moved = by.divideScalar(this.framing.radius);
    this.controls.target.add(moved);
    this.camera.position.add(moved);
  }

  /** The point of the scene looked at [m]. */
  get target(): Vector3 {
    return this.root.worldToLocal(this.controls.target.clone());
  }

  /** A unit vector from its parts to the right, backwards and up. */
  private direction([right, back, high]: number[]): Vector3 {
    const up = this.framing.up;
    const side = across(up);
    const inward = cross(up, side);
    return new Vector3(...up)
      .multiplyScalar(high)
      .addScaledVector(new Vector3(...side), right)
      .addScaledVector(new Vector3(...inward), -back)
      .normalize();
  }

  private newControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    controls.minDistance = 0.02;
    controls.maxDistance = 60;
    controls.addEventListener("change", () => this.request());
    controls.addEventListener("start", () => {
      this.touched = true;
    });
    controls.addEventListener("end", () => this.settled());
    return controls;
  }
}
