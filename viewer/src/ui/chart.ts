// One chart: uPlot with lines thinned to the pixels there are, a line for the time shown, a legend with the values at it.
//
// A click goes to that time, a drag zooms, a double click shows all again. What moves with the scrubber is one element
// and a few numbers; the lines are drawn anew only when rows, width, zoom or colours change.

import uPlot from "uplot";
import type { Recording } from "../data/recording";
import { seriesColor } from "../math/colors";
import { plain, scaleFor } from "../math/format";
import { lowerBound, thinned } from "../math/thin";
import { h } from "./dom";
import type { Chart, LegendKey } from "./quantities";

const HEIGHT = 150;

export interface ChartPorts {
  seek(time: number): void;
  /** The reader has chosen a span of time, or all with `null`. */
  zoomed(span: [number, number] | null): void;
}

export class ChartView {
  readonly element: HTMLElement;
  private readonly cursor = h("div", { class: "time-cursor" });
  private readonly keys: LegendKey[];
  private readonly values: HTMLElement[];
  private readonly body = h("div", { class: "chart-body" });
  private plot: uPlot | null = null;
  private span: [number, number] | null = null;
  private factor = 1;
  private units: string;
  private readonly caption = h("span", { class: "units" });
  private readonly hidden = new Set<number>();
  private setting = false;

  constructor(
    private readonly recording: Recording,
    private readonly chart: Chart,
    private readonly ports: ChartPorts,
    title: HTMLElement,
  ) {
    this.units = chart.units;
    this.keys = chart.keys ?? chart.lines.map(({ label }, index) => ({ label, lines: [index] }));
    this.values = this.keys.map(() => h("b"));
    const legend = this.keys.map(({ label, lines }, index) =>
      h(
        "button",
        { type: "button", class: "key", "aria-pressed": "true", onclick: () => this.toggle(index) },
        h("i", { style: `background:${this.color(lines[0])}` }),
        label,
        this.values[index],
      ),
    );
    this.element = h(
      "section",
      { class: "chart", "data-chart": chart.id },
      h("header", {}, title, this.caption),
      this.body,
      h("div", { class: "legend" }, ...legend, chart.note && h("span", { class: "quiet" }, chart.note)),
    );
  }

  /** Draws the lines for the rows, the width and the colours there are now. */
  draw(): void {
    const width = this.body.clientWidth;
    if (width === 0) return;
    const data = this.data(width);
    if (this.plot && this.plot.width === width) {
      this.plot.setData(data, false);
      this.rescale();
      return;
    }
    this.plot?.destroy();
    this.plot = new uPlot(this.options(width), data, this.body);
    this.plot.over.append(this.cursor);
    this.plot.over.addEventListener("click", (event) => this.clicked(event));
    this.rescale();
  }

  /** After a change of colours. */
  restyle(): void {
    this.plot?.destroy();
    this.plot = null;
    this.draw();
  }

  /** Shows a span of time, all with `null`. */
  zoom(span: [number, number] | null): void {
    this.span = span;
    this.draw();
  }

  /** Puts the cursor on a time [s] and the values of a row into the legend. */
  point(time: number, row: number): void {
    if (!this.plot) return;
    const left = this.plot.valToPos(time, "x");
    const within = left >= -0.5 && left <= this.plot.over.clientWidth + 0.5;
    this.cursor.style.display = within ? "" : "none";
    this.cursor.style.transform = `translateX(${left.toFixed(1)}px)`;
    this.keys.forEach(({ lines }, index) => {
      const values = lines.map((line) => this.chart.lines[line].at(row) / this.factor);
      this.values[index].textContent = spanInWords(values);
    });
  }

  destroy(): void {
    this.plot?.destroy();
    this.element.remove();
  }

  private color(index: number): string {
    const line = this.chart.lines[index];
    return line.label === "sum" ? "var(--text)" : seriesColor(line.hue ?? index);
  }

  private toggle(index: number): void {
    if (!this.hidden.delete(index)) this.hidden.add(index);
    const shown = !this.hidden.has(index);
    this.element.querySelectorAll(".key")[index].setAttribute("aria-pressed", String(shown));
    for (const line of this.keys[index].lines) this.plot?.setSeries(line + 1, { show: shown });
  }

  private clicked(event: MouseEvent): void {
    const { plot } = this;
    // The end of a drag is no click.
    if (!plot || plot.select.width > 2) return;
    this.ports.seek(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
  }

  private range(): [number, number] {
    return this.span ?? [0, this.recording.lastTime || 1];
  }

  private data(width: number): uPlot.AlignedData {
    const { time, rows } = this.recording;
    const { lines } = this.chart;
    const [start, end] = this.range();
    const from = Math.max(0, lowerBound(time, rows, start) - 1);
    const to = Math.min(rows - 1, lowerBound(time, rows, end));
    const table = thinned(time, [from, to], (k, row) => lines[k].at(row), {
      series: lines.length,
      columns: Math.max(50, Math.floor(width)),
    });
    this.fitUnits(table);
    for (let k = 1; k < table.length; k++) {
      const column = table[k];
      for (let i = 0; i < column.length; i++) {
        const value = column[i];
        // A logarithm has no place for what is not positive.
        if (value !== null) column[i] = this.chart.log && value <= 0 ? null : value / this.factor;
      }
    }
    return table as uPlot.AlignedData;
  }

  /** The prefix of the unit under which the ticks are short. */
  private fitUnits(table: (number | null)[][]): void {
    let most = 0;
    for (const column of table.slice(1))
      for (const value of column) most = Math.max(most, Math.abs(value ?? 0));
    [this.factor, this.units] = scaleFor(most, this.chart.units);
    this.caption.textContent = this.units === "1" || !this.units ? "" : this.units;
  }

  private rescale(): void {
    const [min, max] = this.range();
    this.setting = true;
    this.plot?.setScale("x", { min, max });
    this.setting = false;
  }

  private options(width: number): uPlot.Options {
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--muted").trim();
    const grid = { stroke: style.getPropertyValue("--hair").trim(), width: 1 };
    const text = style.getPropertyValue("--text").trim();
    const hidden = new Set([...this.hidden].flatMap((key) => this.keys[key].lines));
    const axis = {
      stroke: ink,
      grid,
      ticks: { ...grid, size: 4 },
      font: "11px system-ui, sans-serif",
      gap: 4,
    };
    return {
      width,
      height: HEIGHT,
      padding: [8, 16, 0, 0],
      legend: { show: false },
      cursor: { y: false, points: { size: 5 }, drag: { x: true, y: false, setScale: false } },
      scales: { x: { time: false }, y: this.chart.log ? { distr: 3 } : { range: withMargin } },
      axes: [
        { ...axis, size: 26, values: (_, ticks) => ticks.map(inSeconds) },
        {
          ...axis,
          grid: { ...grid, filter: (_, ticks) => (this.chart.log ? ticks.map(decade) : ticks) },
          size: 54,
          values: (_, ticks) => ticks.map((tick) => (tick === null ? "" : plain(tick, 5))),
        },
      ],
      series: [
        {},
        ...this.chart.lines.map((line, index) => ({
          label: line.label,
          show: !hidden.has(index),
          stroke: line.label === "sum" ? text : seriesColor(line.hue ?? index),
          width: this.chart.keys ? 0.9 : 1.4,
          pxAlign: 0,
          points: { show: false },
        })),
      ],
      hooks: {
        setSelect: [(plot) => this.selected(plot)],
        setScale: [(plot, key) => this.scaled(plot, key)],
      },
    };
  }

  private selected(plot: uPlot): void {
    const { left, width } = plot.select;
    if (width <= 2) return;
    this.ports.zoomed([plot.posToVal(left, "x"), plot.posToVal(left + width, "x")]);
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  /** uPlot shows all again on a double click; the other charts are to follow. */
  private scaled(_plot: uPlot, key: string): void {
    if (key === "x" && !this.setting && this.span) queueMicrotask(() => this.ports.zoomed(null));
  }
}

/** A number, or the least and the largest of several. */
function spanInWords(values: number[]): string {
  const finite = values.filter(Number.isFinite);
  const [least, most] = [Math.min(...finite), Math.max(...finite)];
  if (values.length === 1 || finite.length === 0) return plain(values[0], 4);
  return least === most ? plain(least, 4) : `${plain(least, 3)} … ${plain(most, 3)}`;
}

/** The last tick tells the unit. */
function inSeconds(tick: number, index: number, ticks: number[]): string {
  return index === ticks.length - 1 ? `${plain(tick, 6)} s` : plain(tick, 6);
}

/** Powers of ten only. */
function decade(tick: number): number | null {
  const power = Math.log10(tick);
  return Math.abs(power - Math.round(power)) < 1e-9 ? tick : null;
}

/** Room above and below; a flat line gets an axis too. */
function withMargin(_: uPlot, low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const margin = 0.06 * (high - low) || 0.5 * Math.abs(high) || 1;
  return [low - margin, high + margin];
}
