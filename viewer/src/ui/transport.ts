// The bar under the picture: play, step, scrub, speed, loop; events as ticks, the part that has not come yet pale.

import type { Recording } from "../data/recording";
import { clock, plain, words } from "../math/format";
import { type Player, speedsFor } from "../player";
import { h, iconButton, pressed, renamed } from "./dom";

const TICKS = 400;

export class Transport {
  readonly element: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly loop: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly ticks = h("div", { class: "ticks", "aria-hidden": "true" });
  private readonly pending = h("div", { class: "pending", "aria-hidden": "true" });
  private readonly now = h("output", { class: "now", "aria-label": "time" });
  private readonly total = h("span", { class: "total" });
  private readonly speed: HTMLSelectElement;
  private recording: Recording | null = null;
  private shownTicks = "";
  private speeds: number[] = [1];

  constructor(private readonly player: Player) {
    this.play = iconButton("play", "Play (space)", () => player.toggle(), { class: "icon big" });
    this.loop = iconButton("loop", "Loop (L)", () => this.toggleLoop(), { "aria-pressed": "false" });
    this.slider = h("input", {
      type: "range",
      class: "scrubber",
      min: 0,
      max: 1,
      step: "any",
      value: 0,
      "aria-label": "time",
      oninput: () => player.seek(Number(this.slider.value)),
    });
    this.speed = h("select", {
      "aria-label": "speed",
      title: "Speed ([ and ])",
      onchange: () => this.chooseSpeed(Number(this.speed.value)),
    });
    this.element = h(
      "div",
      { class: "transport", role: "group", "aria-label": "playback" },
      iconButton("first", "To the start (Home)", () => player.seek(0), { class: "icon wide-only" }),
      iconButton("back", "One sample back (←)", () => player.step(-1)),
      this.play,
      iconButton("forward", "One sample on (→)", () => player.step(1)),
      iconButton("last", "To the end (End)", () => player.toEnd(), {
        class: "icon wide-only",
      }),
      h("div", { class: "track" }, this.ticks, this.slider, this.pending),
      h("span", { class: "clock" }, this.now, this.total),
      this.speed,
      this.loop,
    );
  }

  load(recording: Recording): void {
    this.recording = recording;
    this.shownTicks = "";
    this.offerSpeeds();
    this.grew();
    this.moved();
  }

  /** The speeds that go with how long the whole takes. */
  offerSpeeds(): void {
    this.speeds = speedsFor(this.player.duration);
    const { speed } = this.player;
    if (!this.speeds.includes(speed)) this.speeds = [...this.speeds, speed].sort((a, b) => a - b);
    this.speed.replaceChildren(
      ...this.speeds.map((speed) => h("option", { value: speed }, speedInWords(speed))),
    );
    this.moved();
  }

  /** After new rows or events. */
  grew(): void {
    const { recording } = this;
    if (!recording) return;
    const { header, lastTime, isOver } = recording;
    const end = isOver ? lastTime : Math.max(header.end, lastTime);
    this.slider.max = String(end || 1);
    this.pending.style.left = `${end > 0 ? (100 * lastTime) / end : 100}%`;
    this.total.textContent = ` / ${plain(end, 5)} s`;
    this.drawTicks(end);
  }

  /** After a change of time, speed or play. */
  moved(): void {
    const { player, recording } = this;
    renamed(this.play, player.playing ? "pause" : "play", player.playing ? "Pause (space)" : "Play (space)");
    const spacing = recording && recording.rows > 1 ? recording.lastTime / (recording.rows - 1) : 0;
    this.slider.value = String(player.time);
    this.slider.setAttribute("aria-valuetext", `${clock(player.time, spacing)} seconds`);
    this.now.textContent = clock(player.time, spacing);
    this.speed.value = String(player.speed);
    pressed(this.loop, player.loop);
  }

  toggleLoop(): void {
    this.player.toggleLoop();
    this.moved();
  }

  /** The next faster or slower speed. */
  changeSpeed(by: 1 | -1): void {
    const at = this.speeds.indexOf(this.player.speed) + by;
    this.chooseSpeed(this.speeds[Math.min(this.speeds.length - 1, Math.max(0, at))]);
  }

  private chooseSpeed(speed: number): void {
    this.player.chooseSpeed(speed);
    this.moved();
  }

  private drawTicks(end: number): void {
    const events = this.recording?.events ?? [];
    const key = `${events.length} ${end}`;
    if (key === this.shownTicks) return;
    this.shownTicks = key;
    const every = Math.ceil(events.length / TICKS);
    const marks = events
      .filter((_, index) => index % every === 0)
      .map((event) => {
        const title = `${words(event.kind)}${event.body ? ` of ${event.body}` : ""} at ${plain(event.time, 5)} s`;
        return h("i", { class: event.kind, style: `left:${(100 * event.time) / end}%`, title });
      });
    this.ticks.replaceChildren(...marks);
  }
}

function speedInWords(speed: number): string {
  return speed >= 1 ? `× ${plain(speed, 1)}` : `× 1/${plain(1 / speed, 1)}`;
}
