// Small helpers for elements: no framework is needed for a page of this size.

type Child = Node | string | null | undefined | false;

type Attributes = Record<string, unknown>;

/** An element with attributes, listeners (`onclick`) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child): child is Node | string => Boolean(child)));
  return element;
}

/** Drawings of 24 by 24, stroked. */
const ICONS = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M8 5v14M16 5v14",
  first: "M6 5v14M18 5.5v13L9 12z",
  last: "M18 5v14M6 5.5v13l9-6.5z",
  back: "M15 6l-7 6 7 6M18.5 6v12",
  forward: "M9 6l7 6-7 6M5.5 6v12",
  loop: "M4 11a6 6 0 0 1 6-6h8M15 2l3 3-3 3M20 13a6 6 0 0 1-6 6H6M9 22l-3-3 3-3",
  follow: "M12 3v4M12 17v4M3 12h4M17 12h4M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",
  frame: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  force: "M12 20V5M7 10l5-6 5 6M5 20h14",
  network: "M5 5l7 6 7-5M12 11l-5 8M12 11l6 8M5 5h.01M19 6h.01M7 19h.01M18 19h.01M12 11h.01",
  velocity: "M3 12h16M14 6l6 6-6 6",
  axes: "M4 20L20 4M4 4l16 16M4 9V4h5M15 20h5v-5",
  trail: "M3 18c4 0 4-11 8-11s3 8 6 8 3-4 4-6",
  ghosts: "M4 8h9v9H4zM8 8V4.500h8V13h-3M16 8h4v9h-7",
  supports: "M3 17l5-8h8l5 8zM9.500 17l1-8M14.500 17l-1-8M5.500 13h13",
  joints: "M4 20l6-6M14 10l6-6M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  theme: "M12 4a8 8 0 1 0 0 16zM12 4a8 8 0 0 1 0 16",
  help: "M9 9a3 3 0 1 1 4.500 2.600c-1 .6-1.500 1.200-1.500 2.400M12 17.500v.01",
  restart: "M5 12a7 7 0 1 0 2.500-5.400M4 4v4.500h4.500",
  close: "M6 6l12 12M18 6L6 18",
  plus: "M12 5v14M5 12h14",
} as const;

export type Icon = keyof typeof ICONS;

const SVG = "http://www.w3.org/2000/svg";

/** An element of a drawing with attributes and children. */
export function s<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number> = {},
  ...children: (Node | string)[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export function icon(name: Icon): SVGSVGElement {
  return s("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, s("path", { d: ICONS[name] }));
}

/** A button that is an icon; its name is read out and shown as a hint. */
export function iconButton(
  name: Icon,
  label: string,
  onclick: () => void,
  attributes: Attributes = {},
): HTMLButtonElement {
  return h(
    "button",
    { type: "button", class: "icon", title: label, "aria-label": label, onclick, ...attributes },
    icon(name),
  );
}

/** Another drawing and name for a button. */
export function renamed(button: HTMLButtonElement, name: Icon, label: string): void {
  if (button.getAttribute("aria-label") === label) return;
  button.replaceChildren(icon(name));
  button.title = label;
  button.setAttribute("aria-label", label);
}

export function pressed(button: HTMLElement, on: boolean): void {
  button.setAttribute("aria-pressed", String(on));
}
