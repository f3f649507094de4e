// What of the scene is shown: colouring, arrows, trails, skins, planes, the body that is followed.

import type { Recording } from "../data/recording";
import { counted } from "../math/format";
import type { Coloring } from "../view/coloring";
import type { SceneView, Shown } from "../view/scene";
import { h, type Icon, iconButton, pressed } from "./dom";

type Toggle = "forces" | "velocity" | "axes" | "trails" | "ghosts" | "supports" | "joints";

const TOGGLES: [Toggle, Icon, string, string][] = [
  ["forces", "force", "Contact forces", "C"],
  ["velocity", "velocity", "Velocities", "V"],
  ["axes", "axes", "Principal axes of strain", "A"],
  ["trails", "trail", "Trails of the centres", "T"],
  ["ghosts", "ghosts", "Onion skins", "O"],
  ["supports", "supports", "Supports", "G"],
  ["joints", "joints", "Joints, springs, bonds, pins", "J"],
];

const COLORINGS: [Coloring, string][] = [
  ["body", "Colour by body"],
  ["stretch", "Colour by stretch"],
  ["stress", "Colour by stress"],
];

export class Toolbar {
  readonly element: HTMLElement;
  private readonly buttons = new Map<Toggle, HTMLButtonElement>();
  private readonly coloring: HTMLSelectElement;
  private readonly options: HTMLOptionElement[];
  private readonly body: HTMLSelectElement;
  private readonly following: HTMLButtonElement;
  /** The body that was chosen, followed or not. */
  chosen: number | null = null;

  constructor(
    private readonly shown: Shown,
    private readonly changed: () => void,
    private readonly chose: (body: number | null) => void,
    reset: () => void,
  ) {
    this.options = COLORINGS.map(([value, label]) => h("option", { value }, label));
    this.coloring = h(
      "select",
      { "aria-label": "colouring", onchange: () => this.color(this.coloring.value as Coloring) },
      ...this.options,
    );
    this.body = h("select", {
      "aria-label": "body",
      onchange: () => this.choose(this.body.value === "" ? null : Number(this.body.value)),
    });
    this.following = iconButton("follow", "Follow the body (F)", () => this.toggleFollow());
    for (const [name, icon, label, key] of TOGGLES) {
      this.buttons.set(
        name,
        iconButton(icon, `${label} (${key})`, () => this.toggle(name)),
      );
    }
    this.element = h(
      "div",
      { class: "toolbar", role: "toolbar", "aria-label": "what is shown" },
      h("div", { class: "selects" }, this.coloring, this.body),
      h(
        "div",
        { class: "buttons" },
        ...this.buttons.values(),
        this.following,
        iconButton("frame", "First view again (R)", reset),
      ),
    );
    this.refresh();
  }

  /** Another recording: its bodies, and the colourings that it allows. */
  load(recording: Recording, { colors, isJoined }: Pick<SceneView, "colors" | "isJoined">): void {
    const { bodies } = recording.header;
    COLORINGS.forEach(([coloring, label], index) => {
      const reason = colors.absent(coloring);
      this.options[index].disabled = reason !== null;
      this.options[index].textContent = reason ? `${label} – ${reason}` : label;
      if (reason && this.shown.coloring === coloring) this.shown.coloring = "body";
    });
    this.body.replaceChildren(
      h("option", { value: "" }, counted(bodies.length, "body")),
      ...bodies.map((body, index) => h("option", { value: index }, body.name)),
    );
    this.body.hidden = bodies.length < 2;
    this.buttons.get("axes")!.disabled = bodies.every((body) => body.kind === "rigid");
    this.buttons.get("joints")!.disabled = !isJoined;
    if (this.chosen !== null && this.chosen >= bodies.length) this.choose(null);
    if (this.shown.follow !== null && this.shown.follow >= bodies.length) this.shown.follow = null;
    this.refresh();
  }

  toggle(name: Toggle): void {
    if (this.buttons.get(name)?.disabled) return;
    this.shown[name] = !this.shown[name];
    this.refresh();
    this.changed();
  }

  toggleFollow(): void {
    this.shown.follow = this.shown.follow === null ? (this.chosen ?? 0) : null;
    this.refresh();
    this.changed();
  }

  /** The next colouring that is to be had. */
  nextColoring(): void {
    const free = COLORINGS.map(([coloring]) => coloring).filter((_, index) => !this.options[index].disabled);
    this.color(free[(free.indexOf(this.shown.coloring) + 1) % free.length]);
  }

  choose(body: number | null): void {
    this.chosen = body;
    if (this.shown.follow !== null) this.shown.follow = body;
    this.refresh();
    this.chose(body);
    this.changed();
  }

  refresh(): void {
    for (const [name, button] of this.buttons) pressed(button, this.shown[name]);
    pressed(this.following, this.shown.follow !== null);
    this.coloring.value = this.shown.coloring;
    this.body.value = this.chosen === null ? "" : String(this.chosen);
  }

  private color(coloring: Coloring): void {
    this.shown.coloring = coloring;
    this.refresh();
    this.changed();
  }
}
