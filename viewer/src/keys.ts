// The keys and what they do.

import type { Picture } from "./picture";
import type { Player } from "./player";
import type { Key } from "./ui/help";
import type { Transport } from "./ui/transport";

interface PageActions {
  help(): void;
  theme(): void;
  tab(): void;
}

const SOME_SAMPLES = 10;
/** By how much a key turns the view [rad] and comes closer. */
const TURN = Math.PI / 24;
const CLOSER = 1.15;

export function keysOf(player: Player, transport: Transport, picture: Picture, page: PageActions): Key[] {
  const { toolbar } = picture;
  const key = (keys: string, shown: string, does: string, act: () => void): Key => ({
    keys: keys.split(" ").map((name) => (name === "Space" ? " " : name)),
    shown,
    does,
    act,
  });
  return [
    key("Space k", "space", "play, pause", () => player.toggle()),
    key("ArrowRight", "→", "a sample on", () => player.step(1)),
    key("ArrowLeft", "←", "a sample back", () => player.step(-1)),
    key("PageDown", "PgDn", "ten samples on", () => player.step(SOME_SAMPLES)),
    key("PageUp", "PgUp", "ten samples back", () => player.step(-SOME_SAMPLES)),
    key(".", ".", "to the next event", () => player.stepEvent(1)),
    key(",", ",", "to the event before", () => player.stepEvent(-1)),
    key("Home", "Home", "to the start", () => player.seek(0)),
    key("End", "End", "to the end", () => player.toEnd()),
    key("]", "]", "faster", () => transport.changeSpeed(1)),
    key("[", "[", "slower", () => transport.changeSpeed(-1)),
    key("l L", "L", "loop", () => transport.toggleLoop()),
    key("f F", "F", "follow the body or group", () => toolbar.toggleFollow()),
    key("Shift+ArrowRight", "⇧ →", "view from farther right", () => picture.turn(TURN, 0)),
    key("Shift+ArrowLeft", "⇧ ←", "view from farther left", () => picture.turn(-TURN, 0)),
    key("Shift+ArrowUp", "⇧ ↑", "view from higher up", () => picture.turn(0, TURN)),
    key("Shift+ArrowDown", "⇧ ↓", "view from farther down", () => picture.turn(0, -TURN)),
    key("+ =", "+", "closer", () => picture.approach(CLOSER)),
    key("- _", "−", "away", () => picture.approach(1 / CLOSER)),
    key("r R", "R", "first view again", () => picture.reset()),
    key("b B", "B", "next colouring", () => toolbar.nextColoring()),
    key("c C", "C", "contact forces", () => toolbar.toggle("forces")),
    key("n N", "N", "network of forces between bodies", () => toolbar.toggle("network")),
    key("v V", "V", "velocities", () => toolbar.toggle("velocity")),
    key("a A", "A", "principal axes of strain", () => toolbar.toggle("axes")),
    key("t T", "T", "trails", () => toolbar.toggle("trails")),
    key("o O", "O", "onion skins", () => toolbar.toggle("ghosts")),
    key("g G", "G", "supports", () => toolbar.toggle("supports")),
    key("j J", "J", "joints, springs, bonds, pins", () => toolbar.toggle("joints")),
    key("p P", "P", "next panel", () => page.tab()),
    key("d D", "D", "dark or light", () => page.theme()),
    key("?", "?", "this help", () => page.help()),
  ];
}
