// What of the scene is shown: colouring, arrows, trails, skins, planes, the body that is followed.

import { groupsOf } from "../data/described";
import type { Recording } from "../data/recording";
import type { Look } from "../link";
import { counted } from "../math/format";
import { COLORINGS, type Coloring } from "../view/coloring";
import { LAYERS, type Layer, type SceneView, type Shown } from "../view/scene";
import { h, type Icon, iconButton, pressed } from "./dom";

const TOGGLES: [Layer, Icon, string, string][] = [
  ["forces", "force", "Contact forces", "C"],
  ["network", "network", "Network of forces between bodies", "N"],
  ["velocity", "velocity", "Velocities", "V"],
  ["axes", "axes", "Principal axes of strain", "A"],
  ["trails", "trail", "Trails of the centres", "T"],
  ["ghosts", "ghosts", "Onion skins", "O"],
  ["supports", "supports", "Supports", "G"],
  ["joints", "joints", "Joints, springs, bonds, pins", "J"],
];

/** What is shown at first. */
const BEGINNING: Layer[] = ["supports", "joints"];
/** Stands before a group among the values of the choice. */
const GROUP = "group:";

function chosenBy(value: string): number | string | null {
  if (value.startsWith(GROUP)) return value.slice(GROUP.length);
  return value === "" ? null : Number(value);
}

const labelOf = (coloring: Coloring) => `Colour by ${coloring}`;

export class Toolbar {
  readonly element: HTMLElement;
  private readonly buttons = new Map<Layer, HTMLButtonElement>();
  private readonly coloring: HTMLSelectElement;
  private readonly options: HTMLOptionElement[];
  private readonly body: HTMLSelectElement;
  private readonly following: HTMLButtonElement;
  /** The body that was chosen, or a group of them, followed or not. */
  private chosen: number | string | null = null;
  private bodies: string[] = [];
  private groups = new Map<string, number[]>();

  constructor(
    private readonly shown: Shown,
    private readonly changed: () => void,
    private readonly chose: (body: number | null) => void,
    reset: () => void,
  ) {
    this.options = COLORINGS.map((value) => h("option", { value }, labelOf(value)));
    this.coloring = h(
      "select",
      { "aria-label": "colouring", onchange: () => this.color(this.coloring.value as Coloring) },
      ...this.options,
    );
    this.body = h("select", {
      "aria-label": "body",
      onchange: () => this.choose(chosenBy(this.body.value)),
    });
    this.following = iconButton("follow", "Follow the body or group (F)", () => this.toggleFollow());
    for (const [name, icon, label, key] of TOGGLES) {
      this.buttons.set(
        name,
        iconButton(icon, `${label} (${key})`, () => this.toggle(name)),
      );
    }
    this.element = h(
      "div",
      { class: "toolbar", role: "group", "aria-label": "what is shown" },
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
    COLORINGS.forEach((coloring, index) => {
      const label = labelOf(coloring);
      const reason = colors.absent(coloring);
      this.options[index].disabled = reason !== null;
      this.options[index].textContent = reason ? `${label} – ${reason}` : label;
      if (reason && this.shown.coloring === coloring) this.shown.coloring = "body";
    });
    this.body.replaceChildren(
      h("option", { value: "" }, counted(bodies.length, "body")),
      ...bodies.map((body, index) => h("option", { value: index }, body.name)),
    );
    this.bodies = bodies.map(({ name }) => name);
    this.groups = groupsOf(recording.header);
    if (this.groups.size > 0) {
      const options = [...this.groups].map(([name, members]) =>
        h("option", { value: GROUP + name }, `${name} (${members.length})`),
      );
      this.body.append(h("optgroup", { label: "Groups" }, ...options));
    }
    this.body.hidden = bodies.length < 2;
    this.buttons.get("axes")!.disabled = bodies.every((body) => body.kind === "rigid");
    this.buttons.get("joints")!.disabled = !isJoined;
    // What few recordings have takes no room.
    const network = this.buttons.get("network")!;
    network.disabled = network.hidden = recording.network === null;
    if (network.hidden) this.shown.network = false;
    if (this.chosen !== null && !this.members()) this.choose(null);
    if (this.shown.follow) this.shown.follow = this.members() ?? (bodies.length > 0 ? [0] : null);
    this.refresh();
  }

  toggle(name: Layer): void {
    if (this.buttons.get(name)?.disabled) return;
    this.shown[name] = !this.shown[name];
    this.refresh();
    this.changed();
  }

  toggleFollow(): void {
    this.shown.follow = this.shown.follow === null ? (this.members() ?? [0]) : null;
    this.refresh();
    this.changed();
  }

  /** The next colouring that is to be had. */
  nextColoring(): void {
    const free = COLORINGS.filter((_, index) => !this.options[index].disabled);
    this.color(free[(free.indexOf(this.shown.coloring) + 1) % free.length]);
  }

  /** Chooses a body by its number, or a group by its name. */
  choose(chosen: number | string | null): void {
    this.chosen = chosen;
    if (this.shown.follow !== null) this.shown.follow = this.members();
    this.refresh();
    this.chose(typeof chosen === "number" ? chosen : null);
    this.changed();
  }

  /** What is chosen and shown, as far as it is not as it begins; bodies are followed at first where `travels`. */
  look(travels: boolean): Look {
    const { coloring, follow } = this.shown;
    const show = LAYERS.filter((layer) => this.shown[layer]);
    return {
      ...(show.join() !== BEGINNING.join() && { show }),
      ...(coloring !== "body" && { color: coloring }),
      ...(typeof this.chosen === "number" && { body: this.bodies[this.chosen] }),
      ...(typeof this.chosen === "string" && { group: this.chosen }),
      ...((follow !== null) !== travels && { follow: follow !== null }),
    };
  }

  /** Shows what a look tells, and all else as it begins. */
  restore({ show = BEGINNING, color = "body", body, group, follow }: Look, travels: boolean): void {
    for (const layer of LAYERS) {
      this.shown[layer] = show.includes(layer) && !(layer === "network" && this.buttons.get(layer)!.hidden);
    }
    const index = COLORINGS.indexOf(color);
    this.shown.coloring = this.options[index].disabled ? "body" : color;
    const place = this.bodies.indexOf(body ?? "");
    const isGroup = group !== undefined && this.groups.has(group);
    this.shown.follow = null;
    this.choose(place >= 0 ? place : isGroup ? group : null);
    if (follow ?? travels) this.shown.follow = this.members() ?? [0];
    this.refresh();
  }

  /** The bodies that are chosen. */
  private members(): number[] | null {
    if (typeof this.chosen === "string") return this.groups.get(this.chosen) ?? null;
    return this.chosen !== null && this.chosen < this.bodies.length ? [this.chosen] : null;
  }

  refresh(): void {
    for (const [name, button] of this.buttons) pressed(button, this.shown[name]);
    pressed(this.following, this.shown.follow !== null);
    this.coloring.value = this.shown.coloring;
    this.body.value = typeof this.chosen === "string" ? GROUP + this.chosen : String(this.chosen ?? "");
  }

  private color(coloring: Coloring): void {
    this.shown.coloring = coloring;
    this.refresh();
    this.changed();
  }
}
