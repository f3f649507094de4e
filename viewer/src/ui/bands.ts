// The panel of a lattice: its bands over the path of wave vectors, in the colour of what moves most, or of a ribbon of
// where that is. A click on a point of a band shows that wave in the picture, over some cells.

import {
  type Bands,
  heightOf,
  mostOf,
  PLACES,
  pathFrom,
  piecesOf,
  placesOf,
  type Sharing,
  sharingsOf,
  verticesOf,
} from "../data/bands";
import type { Recording } from "../data/recording";
import { servedBands, servedWave } from "../data/waves";
import { seriesColor } from "../math/colors";
import { plain, roundBelow } from "../math/format";
import { h, s } from "./dom";

/** The drawing, and the frame in it [units of the drawing]. */
const WIDTH = 420;
const HEIGHT = 300;
const FRAME = { left: 52, right: 408, top: 12, bottom: 272 };
/** Ticks of the frequencies, about. */
const TICKS = 5;
/** The amplitude at first, a part of the nearest length. */
const AMPLITUDE = 0.25;

/** What the panel wants shown in the picture. */
export interface BandsPorts {
  show(wave: Recording): void;
  /** The run again. */
  back(): void;
}

interface Point {
  row: number;
  branch: number;
}

export class BandsPanel {
  readonly element: HTMLElement;
  private readonly drawing = s("svg", {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    role: "img",
    tabindex: 0,
    "aria-label": "bands: frequency over wave vector",
  });
  private readonly mark = s("circle", { r: 5, class: "mark" });
  private readonly near = s("circle", { r: 4, class: "near" });
  private readonly said = h("p", { class: "quiet", role: "status" });
  private readonly keys = h("div", { class: "legend" });
  private readonly path: HTMLInputElement;
  private readonly amplitude: HTMLInputElement;
  private readonly colors: HTMLSelectElement;
  private readonly controls: HTMLElement;
  private run: Recording | null = null;
  private bands: Bands | null = null;
  private places: number[] = [];
  private sharings: Sharing[] = [];
  private range: [number, number] = [0, 1];
  private chosen: Point | null = null;
  /** Counts what was asked for: a late answer to an earlier question is dropped. */
  private asked = 0;
  private stale = true;

  constructor(private readonly ports: BandsPorts) {
    this.path = h("input", {
      type: "text",
      "aria-label": "path of wave vectors",
      placeholder: "path: G=0,0,0 X=1/2,0,0",
      spellcheck: "false",
      onchange: () => void this.load(),
    });
    this.amplitude = h("input", {
      type: "range",
      min: 0.02,
      max: 1,
      step: "any",
      value: AMPLITUDE,
      "aria-label": "amplitude",
      onchange: () => void this.showWave(),
    });
    this.colors = h("select", {
      "aria-label": "colours of bands",
      hidden: true,
      onchange: () => this.bands && this.draw(this.bands),
    });
    this.controls = h(
      "div",
      { class: "wave-controls", hidden: true },
      h("label", {}, "amplitude ", this.amplitude),
      h("button", { type: "button", class: "strong", onclick: () => this.back() }, "Back to the run"),
    );
    this.element = h(
      "section",
      { class: "bands" },
      this.path,
      h("span", { class: "units" }, "ω [rad/s]"),
      this.drawing,
      h("div", { class: "coloured" }, this.colors, this.keys),
      this.said,
      this.controls,
    );
    this.drawing.addEventListener("pointermove", (event) => this.put(this.near, this.pointAt(event)));
    this.drawing.addEventListener("pointerleave", () => this.put(this.near, null));
    this.drawing.addEventListener("click", (event) => this.choose(this.pointAt(event)));
    this.drawing.addEventListener("keydown", (event) => this.pressed(event));
  }

  /** Another run: its bands are asked for when the panel is opened. */
  begun(run: Recording): void {
    this.run = run;
    this.stale = true;
    this.forget();
  }

  /** The panel is looked at. */
  opened(): void {
    if (this.stale) void this.load();
  }

  private forget(): void {
    this.asked++;
    this.chosen = null;
    this.controls.hidden = true;
  }

  private async load(): Promise<void> {
    this.stale = false;
    if (this.chosen) this.back();
    this.say("Looking for the waves of the lattice …");
    const bands = await this.answered(servedBands(this.path.value));
    if (!bands) return;
    this.bands = bands;
    this.places = placesOf(bands);
    this.offer(bands);
    this.draw(bands);
    this.say("Click a point of a band to see its wave; arrow keys go along bands.", bands.warnings);
  }

  /** What colours may tell of these bands; the choice stays where it can. */
  private offer(bands: Bands): void {
    const chosen = this.colors.value;
    this.sharings = sharingsOf(bands);
    this.colors.replaceChildren(...this.sharings.map(({ title }) => h("option", { value: title }, title)));
    this.colors.hidden = this.sharings.length < 2;
    if (this.sharings.some(({ title }) => title === chosen)) this.colors.value = chosen;
  }

  /** What colours tell. */
  private get sharing(): Sharing {
    return this.sharings[Math.max(0, this.colors.selectedIndex)];
  }

  /** What was asked for; none if it was refused, which is said, or nobody waits for it any more. */
  private async answered<T>(answer: Promise<T>): Promise<T | null> {
    const number = ++this.asked;
    try {
      const found = await answer;
      return number === this.asked ? found : null;
    } catch (error) {
      if (number === this.asked) this.say(error instanceof Error ? error.message : String(error));
      return null;
    }
  }

  private say(words: string, warnings: string[] = []): void {
    this.said.replaceChildren(words, ...warnings.map((warning) => h("span", { class: "warning" }, warning)));
  }

  private back(): void {
    this.forget();
    this.put(this.mark, null);
    if (this.bands) this.say("Click a point of a band to see its wave.", this.bands.warnings);
    this.ports.back();
  }

  private choose(point: Point | null): void {
    if (!point) return;
    this.chosen = point;
    this.put(this.mark, point);
    void this.showWave();
  }

  private async showWave(): Promise<void> {
    const { bands, run, chosen } = this;
    if (!bands || !run || !chosen) return;
    const path = pathFrom(bands, chosen.row);
    const wave = await this.answered(servedWave(run, path, chosen.branch, Number(this.amplitude.value)));
    if (!wave) return;
    this.controls.hidden = false;
    this.say(inWords(bands, chosen, this.sharings));
    this.ports.show(wave);
  }

  /** Left and right along the path, up and down from branch to branch. */
  private pressed(event: KeyboardEvent): void {
    const { bands, chosen } = this;
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!by || !bands) return;
    event.preventDefault();
    event.stopPropagation();
    const within = (value: number, many: number) => Math.min(many - 1, Math.max(0, value));
    const from = chosen ?? { row: -by[0], branch: -by[1] };
    this.choose({
      row: within(from.row + by[0], bands.omega.length),
      branch: within(from.branch + by[1], bands.omega[0].length),
    });
  }

  private x(place: number): number {
    return FRAME.left + ((FRAME.right - FRAME.left) * place) / (this.places.at(-1) || 1);
  }

  private y(height: number): number {
    const [low, high] = this.range;
    return FRAME.bottom - ((FRAME.bottom - FRAME.top) * (height - low)) / (high - low);
  }

  private draw(bands: Bands): void {
    const { sharing } = this;
    const pieces = piecesOf(bands, this.places, sharing);
    const heights = pieces.flatMap(({ points }) => points.map(([, height]) => height));
    const [low, high] = [Math.min(0, ...heights), Math.max(...heights, 0)];
    this.range = [1.06 * low, high > low ? 1.06 * high : 1];
    const { left, right, top, bottom } = FRAME;
    const verticals = verticesOf(bands, this.places).flatMap(({ place, name }, index, all) => [
      s("line", { class: "hair", x1: this.x(place), x2: this.x(place), y1: top, y2: bottom }),
      s(
        "text",
        {
          x: this.x(place),
          y: bottom + 16,
          "text-anchor": index === 0 ? "start" : index === all.length - 1 ? "end" : "middle",
        },
        name,
      ),
    ]);
    const step = roundBelow((this.range[1] - this.range[0]) / TICKS);
    const levels = Array.from(
      { length: 2 * TICKS + 8 },
      (_, k) => (Math.ceil(this.range[0] / step) + k) * step,
    );
    const horizontals = levels
      .filter((level) => level <= this.range[1])
      .flatMap((level) => [
        s("line", { class: "hair", x1: left, x2: right, y1: this.y(level), y2: this.y(level) }),
        s("text", { x: left - 6, y: this.y(level) + 4, "text-anchor": "end" }, plain(level, 4)),
      ]);
    // What comes first in a legend lies over what comes later: waves at the edges over the many others.
    const lines = [...pieces]
      .sort((a, b) => b.part - a.part)
      .map(({ part, points }) =>
        s("polyline", {
          points: points
            .map(([place, height]) => `${this.x(place).toFixed(2)},${this.y(height).toFixed(2)}`)
            .join(" "),
          stroke: colorOf(sharing, part),
        }),
      );
    this.put(this.mark, this.chosen);
    this.put(this.near, null);
    this.drawing.replaceChildren(...verticals, ...horizontals, ...lines, this.near, this.mark);
    const shown = sharing.names
      .map((name, part) => ({ name, part }))
      .filter(({ part }) => pieces.some((piece) => piece.part === part));
    this.keys.replaceChildren(
      ...shown.map(({ name, part }) =>
        h("span", { class: "key" }, h("i", { style: `background:${colorOf(sharing, part)}` }), name),
      ),
    );
  }

  private put(circle: SVGElement, point: Point | null): void {
    circle.toggleAttribute("hidden", point === null);
    if (!point || !this.bands) return;
    circle.setAttribute("cx", String(this.x(this.places[point.row])));
    circle.setAttribute("cy", String(this.y(heightOf(this.bands, point.row, point.branch))));
  }

  /** The point of a band nearest to the pointer. */
  private pointAt({ clientX, clientY }: MouseEvent): Point | null {
    const { bands } = this;
    const box = this.drawing.getBoundingClientRect();
    if (!bands || box.width === 0) return null;
    const [x, y] = [((clientX - box.left) * WIDTH) / box.width, ((clientY - box.top) * HEIGHT) / box.height];
    let found: Point | null = null;
    let least = Number.POSITIVE_INFINITY;
    bands.omega.forEach((branches, row) => {
      branches.forEach((_, branch) => {
        const away = Math.hypot(this.x(this.places[row]) - x, this.y(heightOf(bands, row, branch)) - y);
        if (away < least) [least, found] = [away, { row, branch }];
      });
    });
    return found;
  }
}

/** The colour of a part; what is inside a ribbon has none of its own. */
function colorOf({ names }: Sharing, part: number): string {
  return names === PLACES && part === PLACES.length - 1 ? "var(--muted)" : seriesColor(part);
}

/** A wave in a line: κ, branch, frequency, decay, what moves, and where. */
function inWords(bands: Bands, { row, branch }: Point, sharings: Sharing[]): string {
  const kappa = bands.kappa[row].map((part) => plain(part, 4)).join(", ");
  const [omega, decay] = [bands.omega[row][branch], bands.decay[row][branch]];
  const most = sharings.map((sharing) => {
    const part = mostOf(sharing, row, branch);
    return `${sharing.names[part]} has ${plain(100 * sharing.of(row, branch)[part], 3)} % of the energy`;
  });
  const rate =
    decay === 0 ? "" : `, ${decay < 0 ? "growth" : "decay"} ${plain(Math.abs(decay))} 1/s (not drawn)`;
  const swings = omega === 0 ? ": it does not oscillate, its shape is swung through" : "";
  return `κ = (${kappa}), branch ${branch}: ω = ${plain(omega, 6)} rad/s${rate}${swings}; ${most.join(", ")}.`;
}
