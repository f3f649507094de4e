// The picture: canvas, what is laid over it, and the scene of the recording on its stage. Without WebGL it says so, and
// the rest of the page goes on.

import { classesOf } from "./data/classes";
import type { Vec3 } from "./data/header";
import type { Recording } from "./data/recording";
import type { Look } from "./link";
import type { Player } from "./player";
import { h } from "./ui/dom";
import { EdgeMarks } from "./ui/edge";
import { Scales } from "./ui/scales";
import { themeColor } from "./ui/theme";
import { Toolbar } from "./ui/toolbar";
import { SceneView, type Shown } from "./view/scene";
import { Stage } from "./view/stage";

/** A press that moves less than this is a click [px]. */
const CLICK_PX = 4;

export class Picture {
  readonly element: HTMLElement;
  readonly toolbar: Toolbar;
  private readonly shown: Shown = {
    coloring: "body",
    forces: false,
    network: false,
    velocity: false,
    axes: false,
    trails: false,
    ghosts: false,
    supports: true,
    joints: true,
    follow: null,
  };
  private readonly canvas = h("canvas", {
    role: "img",
    "aria-label": "the bodies in space; shift and arrows turn the view",
    tabindex: 0,
  });
  private readonly scales = new Scales();
  private readonly edge = new EdgeMarks();
  private readonly stage: Stage | null;
  private view: SceneView | null = null;
  private playing = false;
  private readonly redraw = () => this.request(null);
  /** Called after the reader has moved the camera or changed what is shown. */
  settled: () => void = () => {};

  constructor(
    private readonly player: Player,
    chose: (body: number | null) => void,
  ) {
    this.toolbar = new Toolbar(
      this.shown,
      () => {
        this.request(null);
        this.settled();
      },
      chose,
      () => this.reset(),
    );
    this.stage = stageOn(this.canvas);
    const missing = h(
      "p",
      { class: "no-webgl", role: "alert" },
      "This browser has no WebGL, so that the bodies cannot be drawn. Plots, ledger and scene are there all the same.",
    );
    this.element = h(
      "div",
      { class: "picture" },
      this.stage ? this.canvas : missing,
      this.stage && this.toolbar.element,
      this.stage && this.edge.element,
      this.stage && this.scales.element,
    );
    if (!this.stage) return;
    this.stage.settled = () => this.settled();
    this.stage.prepare = () => this.prepare();
    this.stage.covered = () => this.toolbar.element.offsetTop + this.toolbar.element.offsetHeight;
    new ResizeObserver(() => this.stage?.resize()).observe(this.canvas);
    this.listenForClicks();
  }

  get frames(): number {
    return this.stage?.frames ?? 0;
  }

  load(recording: Recording): void {
    const { stage } = this;
    if (!stage) return;
    const before = this.view;
    const again = before !== null && before.recording.header.bodies.length === recording.header.bodies.length;
    before?.dispose();
    stage.expect(recording.header.bodies.length);
    this.view = new SceneView(stage, recording, this.shown, again ? before.framing : null);
    if (recording.network) recording.network.came = () => this.request(null);
    recording.fields?.changed.add(this.redraw);
    this.toolbar.load(recording, this.view);
    if (!again) stage.look();
    this.scales.load(classesOf(recording.header));
    this.restyle();
  }

  grew(): void {
    this.view?.grew();
    this.toolbar.refresh();
  }

  surfaced(): void {
    this.view?.surfaced();
    this.request(null);
  }

  /** A frame as soon as the browser draws; `took`, while playing: what the last one took [ms]. */
  request(took: number | null): void {
    if (took !== null && this.playing) this.stage?.tookWhilePlaying(took);
    this.playing = took !== null;
    this.stage?.request();
  }

  drawNow(): void {
    this.stage?.draw();
  }

  /** The first view again. */
  reset(): void {
    this.shown.follow = null;
    if (this.stage) this.stage.touched = false;
    this.view?.refit();
    this.toolbar.refresh();
    this.request(null);
    this.settled();
  }

  /** What is looked at from where, as far as it is not as it begins. */
  look(): Look {
    const { stage, view } = this;
    if (!stage || !view) return {};
    const { position, target } = stage.sight;
    const from = view.heldAt() ?? [0, 0, 0];
    const beside = (at: Vec3) => at.map((value, axis) => value - from[axis]) as Vec3;
    return {
      ...this.toolbar.look(view.framing.travels),
      ...(stage.touched && { camera: { position: beside(position), target: beside(target) } }),
    };
  }

  /** Shows what a look tells at the time of the clock, and all else as it begins. */
  restore(look: Look): void {
    const { stage, view } = this;
    if (!stage || !view) return;
    stage.touched = false;
    view.refit();
    this.toolbar.restore(look, view.framing.travels);
    view.place(this.player.time, false);
    if (look.camera) {
      const from = view.heldAt() ?? [0, 0, 0];
      const [position, target] = [look.camera.position, look.camera.target].map(
        (at) => at.map((value, axis) => value + from[axis]) as Vec3,
      );
      stage.stand({ position, target });
      stage.touched = true;
    }
    this.request(null);
  }

  /** Turns the view about its target by angles to the right and upwards [rad]. */
  turn(right: number, up: number): void {
    this.stage?.turn(right, up);
  }

  /** Comes closer by a factor. */
  approach(factor: number): void {
    this.stage?.approach(factor);
  }

  /** After a change of theme. */
  restyle(): void {
    this.stage?.background(themeColor("--sky"), Number(themeColor("--skylight")));
    this.view?.paint({
      ground: themeColor("--ground"),
      line: themeColor("--line"),
      shadow: Number(themeColor("--shadow")),
      mark: themeColor("--mark"),
      sky: themeColor("--sky"),
    });
    this.request(null);
  }

  private prepare(): void {
    const { view, player } = this;
    if (!view) return;
    view.place(player.time, player.smooth);
    this.edge.show(view.edgeMarks());
    const grid =
      this.shown.supports && view.recording.header.supports.length > 0 ? view.supports.spacing : null;
    this.scales.show(view.colors.scale(this.shown.coloring), view.network.scale, view.fields.scale, grid);
  }

  /** A click on a body chooses it, a click beside all bodies chooses none. */
  private listenForClicks(): void {
    let from: [number, number] = [0, 0];
    this.canvas.addEventListener("pointerdown", ({ clientX, clientY }) => {
      from = [clientX, clientY];
    });
    this.canvas.addEventListener("click", ({ clientX, clientY }) => {
      if (Math.hypot(clientX - from[0], clientY - from[1]) > CLICK_PX || !this.view) return;
      const { left, top, width, height } = this.canvas.getBoundingClientRect();
      const body = this.view.bodyAt((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
      if (this.view.recording.header.bodies.length > 1) this.toolbar.choose(body);
    });
  }
}

function stageOn(canvas: HTMLCanvasElement): Stage | null {
  try {
    return new Stage(canvas);
  } catch {
    return null;
  }
}
