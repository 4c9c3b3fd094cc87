// The states of the run: a strip in proportion to time, and the latest changes in words.

import { clock } from "./theme.js";

const LISTED = 12;

export class Timeline {
  constructor() {
    this.strip = document.getElementById("strip");
    this.end = document.getElementById("strip-end");
    this.list = document.getElementById("transitions");
    this.rows = []; // [start [s], state, reason]
    this.now = 0;
  }

  add({ restart, rows }) {
    if (restart) {
      this.rows = [];
      this.strip.replaceChildren();
      this.now = 0;
    }
    for (const row of rows) {
      this.rows.push(row);
      const part = document.createElement("div");
      part.dataset.state = row[1];
      part.title = `${clock(row[0])} ${row[1]}: ${row[2]}`;
      this.strip.append(part);
    }
    this.stretch();
    this.write();
  }

  // [s] of mission time, where the newest state goes on to.
  advance(now) {
    this.now = now;
    this.stretch();
  }

  stretch() {
    const starts = this.rows.map((row) => row[0]);
    const end = Math.max(this.now, ...starts.slice(-1), 0);
    starts.push(end);
    [...this.strip.children].forEach((part, index) => {
      part.style.flexGrow = Math.max(0, starts[index + 1] - starts[index]);
    });
    this.end.textContent = clock(end);
  }

  write() {
    const items = this.rows.slice(-LISTED).reverse().map(([start, state, reason]) => {
      const item = document.createElement("li");
      const time = document.createElement("time");
      time.textContent = clock(start);
      const name = document.createElement("strong");
      name.textContent = state;
      name.dataset.state = state;
      item.append(time, name, reason);
      return item;
    });
    this.list.replaceChildren(...items);
  }
}
