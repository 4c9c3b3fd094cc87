// Small plots over mission time, by uPlot.

import uPlot from "./vendor/uplot/uPlot.esm.js";
import { clock, colour, onSchemeChange } from "./theme.js";

const HEIGHT = 120;
const REDRAW = 250; // [ms]
const RATE = { title: "Frame rate", unit: "1/s of wall time", colour: "green", digits: 0, floor: 0 };
const AGE = { title: "Age of the map", unit: "s", colour: "orange", digits: 2, floor: 0 };
// With the column that the node sends; the first one is the time.
const PLOTS = {
  rover: [
    { column: 1, title: "Speed", unit: "m/s", colour: "blue", digits: 1 },
    { column: 2, title: "Steering, left positive", unit: "°", colour: "vermillion", digits: 0 },
    { column: 3, ...RATE },
    { column: 4, title: "Telemetry to command", unit: "ms", colour: "purple", digits: 1, floor: 0 },
    { column: 5, ...AGE },
  ],
  heat: [
    { column: 1, title: "Speed", unit: "m/s", colour: "blue", digits: 2 },
    { column: 2, title: "Turn rate, left positive", unit: "°/s", colour: "vermillion", digits: 0 },
    { column: 3, title: "Sensor 1: warmest over median", unit: "K", colour: "purple", digits: 1, floor: 0 },
    { column: 4, title: "Sensor 2: warmest over median", unit: "K", colour: "purple", digits: 1, floor: 0 },
    { column: 5, ...RATE },
    { column: 7, ...AGE },
  ],
};

export class Plots {
  constructor() {
    this.parent = document.getElementById("plots");
    this.robot = "rover";
    this.columns = [];
    this.dirty = false;
    this.make();
    onSchemeChange(() => this.make());
    new ResizeObserver(() => this.resize()).observe(this.parent);
    setInterval(() => this.redraw(), REDRAW);
  }

  add({ restart, rows }) {
    if (restart) this.columns = [];
    for (const row of rows) row.forEach((value, index) => (this.columns[index] ??= []).push(value));
    this.dirty = true;
  }

  // Whose plots are shown.
  choose(robot) {
    if (robot === this.robot) return;
    this.robot = robot;
    this.make();
  }

  make() {
    this.parent.replaceChildren();
    this.plots = PLOTS[this.robot].map((plot) => {
      const figure = document.createElement("figure");
      const title = document.createElement("h3");
      const value = document.createElement("output");
      title.append(`${plot.title} [${plot.unit}]`, value);
      figure.append(title);
      this.parent.append(figure);
      const chart = new uPlot(options(plot, figure), this.data(plot.column), figure);
      chart.root.setAttribute("role", "img");
      chart.root.setAttribute("aria-label", `${plot.title} in ${plot.unit} over mission time`);
      return { ...plot, figure, value, chart };
    });
    this.dirty = true;
  }

  data(column) {
    return [this.columns[0] ?? [], this.columns[column] ?? []];
  }

  redraw() {
    if (!this.dirty || document.hidden) return;
    this.dirty = false;
    this.plots.forEach(({ chart, value, digits, column }) => {
      const data = this.data(column);
      chart.setData(data);
      const last = data[1].at(-1);
      value.textContent = last === undefined || last === null ? "–" : last.toFixed(digits);
    });
  }

  resize() {
    for (const { chart, figure } of this.plots) {
      chart.setSize({ width: figure.clientWidth, height: HEIGHT });
    }
  }
}

function options(plot, figure) {
  const axis = {
    stroke: colour("muted"),
    grid: { stroke: colour("line"), width: 1 },
    ticks: { stroke: colour("line"), width: 1, size: 4 },
    font: "11px system-ui, sans-serif",
  };
  const range = (_, low, high) => {
    if (low === null) return [0, 1];
    const bottom = plot.floor ?? low;
    return high - bottom < 0.1 ? [bottom, bottom + 1] : [bottom, high + 0.05 * (high - bottom)];
  };
  return {
    width: figure.clientWidth,
    height: HEIGHT,
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, sync: { key: "mission" } },
    scales: { x: { time: false }, y: { range } },
    axes: [
      { ...axis, size: 26, space: 60, values: (_, ticks) => ticks.map(clock) },
      { ...axis, size: 40, space: 24 },
    ],
    series: [{}, { stroke: colour(plot.colour), width: 1.5, spanGaps: false, points: { show: false } }],
  };
}
