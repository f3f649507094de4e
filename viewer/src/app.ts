// The whole page: puts source, clock, picture, plots and panels together.
//
// Data flows one way: the source fills the recording, the clock says which instant, picture and panels show it. Nothing
// is drawn unless one of them has changed.

import type { Outcome, Summary } from "./data/header";
import { Cells } from "./data/lattice";
import type { Recording } from "./data/recording";
import type { Control, Listener, Progress, Source } from "./data/source";
import type { Handle } from "./handle";
import { keysOf } from "./keys";
import { hashOf, lookIn } from "./link";
import { Sliders } from "./live/sliders";
import { RunStatus } from "./live/status";
import { Picture } from "./picture";
import { Player } from "./player";
import { BandsPanel } from "./ui/bands";
import { Banner } from "./ui/banner";
import { h, iconButton } from "./ui/dom";
import { FieldsPanel } from "./ui/fields";
import { helpDialog, listen } from "./ui/help";
import { openLedgerInWords } from "./ui/ledger";
import { Plots } from "./ui/plots";
import { scenePanel } from "./ui/scenetext";
import { outcomeInWords, summaryPanel } from "./ui/summary";
import { Tabs } from "./ui/tabs";
import { switchTheme, watchTheme } from "./ui/theme";
import { Transport } from "./ui/transport";

/** The address follows what is looked at after such a while [ms]. */
const ADDRESS_MS = 300;

/** Parts that a page may have around a run, beside those of every page. */
export interface Surroundings {
  /** The way out, in the head of the page. */
  readonly home: HTMLElement;
  /** Stands under the transport. */
  readonly foot: HTMLElement;
  /** The panel of the scene. */
  readonly scene: HTMLElement;
  /** A run has begun; true where its scene is another one, whose numbers get new sliders. */
  begun(recording: Recording): boolean;
  /** A run has ended, with the hash of its numbers. */
  done(hash: string | null | undefined): void;
  /** A run may have failed: if so, it has no end. */
  failed(): void;
}

export class App implements Listener {
  readonly handle: Handle;
  private readonly player = new Player();
  private readonly transport = new Transport(this.player);
  private readonly plots = new Plots((time) => this.player.seek(time));
  private readonly bands = new BandsPanel({
    show: (wave) => this.showInPicture(wave),
    back: () => this.showInPicture(null),
  });
  private readonly fields = new FieldsPanel();
  private readonly banner = new Banner();
  private readonly picture: Picture;
  private readonly tabs: Tabs;
  private readonly title = h("h1", {}, "Gyration");
  private readonly mode = h("span", { class: "mode" });
  private readonly chip = h("span", { class: "chip", role: "status" });
  private sliders: Sliders | null = null;
  private status: RunStatus | null = null;
  private source: Source | null = null;
  private recording: Recording | null = null;
  /** What the picture shows instead of the recording, if it does. */
  private wave: Recording | null = null;
  private becameReady: () => void = () => {};
  private hasBegun = false;
  private writing = 0;

  constructor(
    page: HTMLElement,
    private readonly around: Surroundings | null = null,
  ) {
    const ready = new Promise<void>((resolve) => {
      this.becameReady = resolve;
    });
    this.picture = new Picture(this.player, (body) => this.plots.choose(body));
    this.tabs = new Tabs((name) => this.opened(name));
    this.tabs.set("Plots", this.plots.element);
    const keys = keysOf(this.player, this.transport, this.picture, {
      help: () => help.showModal(),
      theme: () => this.switchTheme(),
      tab: () => this.tabs.next(),
    });
    const help = helpDialog(keys);
    listen(keys);
    page.append(
      h(
        "header",
        { class: "top" },
        around?.home,
        this.title,
        this.mode,
        this.chip,
        h("span", { class: "gap" }),
        iconButton("theme", "Dark or light (D)", () => this.switchTheme()),
        iconButton("help", "Keys (?)", () => help.showModal()),
      ),
      this.banner.element,
      h(
        "main",
        {},
        h("div", { class: "left" }, this.picture.element, this.transport.element, around?.foot),
        this.tabs.element,
      ),
      help,
    );
    watchTheme(() => this.restyle());
    this.player.changed = (took) => this.moved(took);
    this.picture.settled = () => this.remember();
    window.addEventListener("hashchange", () => this.restore());
    this.handle = this.handleWith(ready);
  }

  async show(source: Source): Promise<void> {
    this.source = source;
    if (source.control) this.offer(source.control);
    if (this.around) this.tabs.set("Scene", this.around.scene);
    await source.start(this);
  }

  /** Opens a panel. */
  open(panel: string): void {
    this.tabs.open(panel);
  }

  /** Gives the run its sliders. */
  private offer(control: Control): void {
    const sliders = new Sliders((overrides) => control.restart(overrides));
    this.sliders = sliders;
    this.status = new RunStatus(control, () => sliders.ask());
    this.tabs.set("Sliders", h("div", {}, this.status.element, sliders.element));
  }

  begun(recording: Recording): void {
    this.recording = recording;
    this.wave = null;
    const { header } = recording;
    document.title = `${header.title ?? header.scene_name ?? "Recording"} – Gyration`;
    this.title.textContent = header.title ?? header.scene_name ?? "Recording";
    this.mode.textContent = header.mode;
    this.banner.clearError();
    this.load(recording);
    if (this.around?.begun(recording) && this.source?.control) this.offer(this.source.control);
    this.sliders?.begun(header);
    this.status?.begun();
    this.tell();
    this.fillPanels();
    // Waves are computed by the server: a report and a site have none.
    if (header.mode !== "report" && !this.around && new Cells(header).hasWaves) {
      this.bands.begun(recording);
      this.tabs.set("Bands", this.bands.element);
      if (this.tabs.shown === "Bands") this.bands.opened();
    }
    if (recording.fields) {
      this.fields.begun(recording.fields, () => recording.rowAt(this.player.time));
      recording.fields.changed.add(() => this.remember());
      this.tabs.set("Fields", this.fields.element);
    }
    if (!this.hasBegun && location.hash) this.restore();
    this.hasBegun = true;
    this.picture.drawNow();
    this.becameReady();
    // The plots come after the first frame: what moves is looked at first.
    requestAnimationFrame(() => {
      this.plots.load(recording);
      this.pointPlots();
      // A run that starts again is looked at from its start, unless the reader stays at an instant.
      if (header.mode === "live" && !this.player.holds) this.player.play();
    });
  }

  grew(): void {
    this.plots.grew();
    if (this.wave) return;
    this.picture.grew();
    this.transport.grew();
    this.moved(null);
  }

  surfaced(): void {
    this.picture.surfaced();
  }

  progress(progress: Progress): void {
    this.status?.progress(progress);
    this.tell();
  }

  done(_: Outcome | null, summary: Summary, hash?: string | null): void {
    const { recording } = this;
    if (!recording) return;
    recording.header.summary = { ...recording.header.summary, ...summary };
    this.player.fit();
    this.transport.offerSpeeds();
    this.transport.grew();
    this.plots.grew();
    this.status?.done(outcomeInWords(recording));
    this.around?.done(hash);
    this.tell();
    this.fillPanels();
    this.moved(null);
  }

  failed(message: string, refused?: string[]): void {
    // What a slider asked for is told beside it.
    if (!(refused && this.sliders?.refuse(refused, message))) this.banner.fail(message);
    if (!refused) this.around?.failed();
  }

  lost(reason: string): void {
    this.banner.lose(reason, () => this.source?.reconnect());
  }

  found(): void {
    this.banner.found();
  }

  /** Says in the head of the page how the run stands. */
  private tell(): void {
    const { recording } = this;
    if (!recording) return;
    const words = outcomeInWords(recording);
    const stopped = typeof recording.header.outcome === "object" && words.startsWith("Stopped");
    const open = openLedgerInWords(recording.header);
    const bad = [stopped ? "stopped early" : "", open ? "energy ledger open" : ""].filter(Boolean);
    const unfinished = recording.isOver ? "interrupted" : "running";
    this.chip.textContent = bad.join(", ") || (recording.header.complete ? "" : unfinished);
    this.chip.className = `chip ${bad.length > 0 ? "bad" : ""}`;
    this.chip.title = open ? `${words} ${open}` : words;
    this.chip.hidden = this.chip.textContent === "";
  }

  /** Writes the panels of words anew; while a run goes on, that is done when one is opened. */
  private fillPanels(): void {
    if (!this.recording) return;
    this.tabs.set("Summary", summaryPanel(this.recording));
    if (!this.around) this.tabs.set("Scene", scenePanel(this.recording.header));
  }

  /** Gives picture and clock a recording. */
  private load(recording: Recording): void {
    this.picture.load(recording);
    this.player.load(recording);
    this.transport.load(recording);
  }

  /** Shows a wave, or the recording again. */
  private showInPicture(wave: Recording | null): void {
    const { recording } = this;
    if (!recording || (!wave && !this.wave)) return;
    this.wave = wave;
    this.mode.textContent = wave ? "wave" : recording.header.mode;
    this.load(wave ?? recording);
    this.player.play();
  }

  private opened(panel: string): void {
    if (panel === "Bands") this.bands.opened();
    if (panel === "Fields") this.fields.opened();
    if (panel === "Plots") this.plots.draw();
    this.remember();
    if (panel === "Summary" && this.recording) this.tabs.set("Summary", summaryPanel(this.recording));
  }

  private moved(frameTook: number | null): void {
    this.transport.moved();
    this.picture.request(frameTook);
    this.pointPlots();
    if (!this.wave) this.fields.moved();
    if (frameTook === null) this.remember();
  }

  /** Shows what the address asks for. */
  private restore(): void {
    if (!this.recording || this.wave) return;
    const look = lookIn(location.hash);
    if (look.time !== undefined || this.hasBegun) this.player.hold(look.time ?? 0);
    this.picture.restore(look);
    this.recording.fields?.look(look.field ?? null, look.width ?? null);
    const panel = look.panel ?? (this.hasBegun ? this.tabs.first : undefined);
    if (panel !== undefined && this.tabs.has(panel)) this.tabs.open(panel);
  }

  /** Writes what is looked at into the address. */
  private remember(): void {
    if (!this.hasBegun) return;
    this.writing ||= window.setTimeout(() => {
      this.writing = 0;
      const { player, recording } = this;
      if (player.playing || this.wave) return;
      const { shown } = this.tabs;
      const look = {
        ...this.picture.look(),
        ...(recording?.fields?.shown && { field: recording.fields.key }),
        ...(recording?.fields?.shown && recording.fields.width && { width: recording.fields.width }),
        ...(player.wanted > 0 && { time: player.wanted }),
        ...(shown && shown !== this.tabs.first && { panel: shown }),
      };
      // A page within another one has no address of its own.
      if (location.origin === "null" && location.protocol !== "file:") return;
      const hash = hashOf(look, location.hash);
      if (hash === location.hash) return;
      history.replaceState(null, "", hash || location.href.replace(/#.*/, ""));
    }, ADDRESS_MS);
  }

  private pointPlots(): void {
    if (this.recording && !this.wave)
      this.plots.pointAt(this.player.time, this.recording.rowAt(this.player.time));
  }

  private switchTheme(): void {
    switchTheme();
    this.restyle();
  }

  private restyle(): void {
    this.picture.restyle();
    this.plots.restyle();
  }

  private handleWith(ready: Promise<void>): Handle {
    const { player, picture } = this;
    const rows = () => (this.wave ?? this.recording)?.rows ?? 0;
    return {
      ready,
      get time() {
        return player.time;
      },
      get rows() {
        return rows();
      },
      get frame() {
        return picture.frames;
      },
      seek: (time) => player.seek(time),
      renderNow: () => picture.drawNow(),
    };
  }
}
