// The run behind a live page: how far it is, what limits its step, pause, restart.

import type { Control, Progress } from "../data/source";
import { counted, withUnit } from "../math/format";
import { h, iconButton, renamed } from "../ui/dom";

export class RunStatus {
  readonly element: HTMLElement;
  private readonly bar = h("progress", { max: 1, value: 0, "aria-label": "progress of the run" });
  private readonly text = h("span", { class: "run-text", role: "status" }, "Starting the run");
  private readonly hold: HTMLButtonElement;
  private paused = false;
  private over = false;

  constructor(control: Control, restart: () => void) {
    this.hold = iconButton("pause", "Pause the run", () =>
      this.paused ? control.resume() : control.pause(),
    );
    const again = iconButton("restart", "Start the run again", restart);
    this.element = h(
      "div",
      { class: "run", role: "group", "aria-label": "run" },
      this.hold,
      again,
      this.bar,
      this.text,
    );
  }

  begun(): void {
    this.over = false;
    this.hold.disabled = false;
    this.element.classList.remove("over");
    this.text.textContent = "Running";
  }

  progress({ time, end, steps, paused, step, limited_by }: Progress): void {
    if (this.over) return;
    this.paused = paused;
    renamed(this.hold, paused ? "play" : "pause", paused ? "Resume the run" : "Pause the run");
    this.bar.max = end || 1;
    this.bar.value = time;
    const limit =
      limited_by && !paused ? `, steps of ${withUnit(step, "s", 2)} limited by ${limited_by}` : "";
    this.text.textContent = `${paused ? "Paused" : "Computing"}: t = ${withUnit(time, "s", 3)} of ${withUnit(end, "s", 3)}, ${counted(steps, "step")}${limit}`;
  }

  done(words: string): void {
    this.over = true;
    this.paused = false;
    this.hold.disabled = true;
    this.bar.value = this.bar.max;
    this.element.classList.add("over");
    renamed(this.hold, "pause", "Pause the run");
    this.text.textContent = words;
  }
}
