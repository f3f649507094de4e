// The panel of the fields of many bodies: which is shown in the picture, and the width with which bodies are seen.

import { FIELD_NAMES, type FieldMap, type Fields, rangeOf, unitsOf } from "../data/fields";
import { plain, scaleFor, withUnit } from "../math/format";
import { h } from "./dom";

export class FieldsPanel {
  readonly element: HTMLElement;
  private readonly shown: HTMLInputElement;
  private readonly field: HTMLSelectElement;
  private readonly width: HTMLInputElement;
  private readonly said = h("p", { class: "quiet", role: "status" });
  private fields: Fields | null = null;
  private row: () => number = () => 0;

  constructor() {
    this.shown = h("input", { type: "checkbox", onchange: () => this.choose() });
    this.field = h(
      "select",
      { "aria-label": "field", onchange: () => this.choose() },
      ...Object.entries(FIELD_NAMES).map(([value, name]) => h("option", { value }, name)),
    );
    this.width = h("input", {
      type: "text",
      inputmode: "decimal",
      "aria-label": "width in metres",
      spellcheck: "false",
      onchange: () => this.choose(),
    });
    this.element = h(
      "section",
      { class: "fields" },
      h("label", { class: "row" }, this.shown, "show in the picture"),
      h("label", { class: "row" }, h("span", {}, "field"), this.field),
      h("label", { class: "row" }, h("span", {}, "width b [m]"), this.width),
      this.said,
      h(
        "p",
        { class: "quiet" },
        "Bodies are seen from each point with a Gaussian of the standard deviation b; at first it is two mean ",
        "distances of nearest neighbours. The map lies in the middle of the bodies, over their two longest sides. Colours reach ",
        "as far as the samples that have been looked at.",
      ),
    );
  }

  /** Another recording; `row` tells the sample that is shown. */
  begun(fields: Fields, row: () => number): void {
    this.fields = fields;
    this.row = row;
    fields.changed.add(() => this.tell());
    this.tell();
  }

  /** The panel is looked at for the first time: so are the fields. */
  opened(): void {
    const { fields } = this;
    if (!fields || fields.touched) return;
    fields.touched = true;
    fields.shown = true;
    fields.tell();
  }

  private choose(): void {
    const { fields } = this;
    if (!fields) return;
    const text = this.width.value.trim().replace(",", ".");
    const width = Number(text);
    if (text !== "" && !(width > 0 && Number.isFinite(width))) {
      this.say(`\u201c${text}\u201d is no width: write a length in metres above zero.`, true);
      return;
    }
    if (fields.problem !== null) fields.again();
    fields.shown = this.shown.checked;
    fields.key = this.field.value;
    fields.width = text === "" ? null : width;
    fields.tell();
  }

  /** The sample that is shown is another one. */
  moved(): void {
    if (this.fields?.shown) this.tell();
  }

  private tell(): void {
    const { fields } = this;
    if (!fields) return;
    this.shown.checked = fields.shown;
    this.field.value = fields.key;
    const map = fields.known(this.row());
    if (document.activeElement !== this.width)
      this.width.value = fields.width === null ? "" : String(fields.width);
    if (map) this.width.placeholder = `${plain(map.usual, 3)}, as usual`;
    if (!fields.shown) this.say("");
    else if (fields.problem !== null) this.say(asSentence(fields.problem), true);
    else if (map) this.say(inWords(map, fields.key));
    else this.say("Averaging \u2026");
  }

  private say(words: string, bad = false): void {
    this.said.replaceChildren(words);
    this.said.classList.toggle("bad-words", bad);
  }
}

/** An answer of the server, which begins and ends as words within others do. */
function asSentence(words: string): string {
  return `${words.charAt(0).toUpperCase()}${words.slice(1).replace(/\.$/, "")}.`;
}

/** What a map shows, in a line. */
export function inWords(map: FieldMap, key: string): string {
  const index = map.fields.findIndex((field) => field.key === key);
  const field = map.fields[index];
  if (!field) return "";
  const at = `At t = ${withUnit(map.time, "s")}, seen with b = ${withUnit(map.width, "m", 3)}`;
  const range = rangeOf(map.values[index]);
  if (!range) {
    const isZero = map.values[index].some((value) => Number.isFinite(value));
    const what = isZero ? "is zero at all points" : "has no value at any point";
    return `${at}, the ${field.name} ${what}: there is no map.`;
  }
  const [factor, units] = scaleFor(Math.max(...range.map(Math.abs)), unitsOf(field));
  const [low, high] = range.map((value) => plain(value / factor, 3));
  return `${at}, the ${field.name} on the map is ${low} to ${high} ${units}.`;
}
