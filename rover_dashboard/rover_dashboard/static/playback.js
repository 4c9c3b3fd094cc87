// The bar below a recording: play, seek, speed. It appears when the node says that it plays one.

import { clock } from "./theme.js";

const SEEK_PERIOD = 80; // [ms] at most one seek while the slider is dragged

export class PlaybackBar {
  constructor(connection) {
    this.connection = connection;
    this.bar = document.getElementById("playback");
    this.button = document.getElementById("play");
    this.slider = document.getElementById("position");
    this.time = document.getElementById("position-time");
    this.speed = document.getElementById("playback-speed");
    this.playing = false;
    this.dragged = false;
    this.waiting = null;
    this.bar.addEventListener("submit", (event) => event.preventDefault());
    this.button.addEventListener("click", () => this.change("playing", this.playing ? 0 : 1));
    this.speed.addEventListener("change", () => this.change("speed", Number(this.speed.value)));
    this.slider.addEventListener("input", () => this.seek());
    this.slider.addEventListener("change", () => (this.dragged = false));
  }

  change(name, value) {
    return this.connection.ask({ playback: name, value });
  }

  seek() {
    this.dragged = true;
    this.tell(this.slider.valueAsNumber);
    this.waiting ??= setTimeout(() => {
      this.waiting = null;
      this.change("position", this.slider.valueAsNumber);
    }, SEEK_PERIOD);
  }

  tell(position) {
    const text = `${clock(position)} of ${clock(this.slider.max)}`;
    this.time.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
  }

  // {position, end [s], playing, speed, speeds}
  show(state) {
    document.documentElement.dataset.mode = "recording";
    this.bar.hidden = false;
    this.playing = state.playing;
    this.button.textContent = state.playing ? "Pause" : "Play";
    if (this.speed.options.length !== state.speeds.length) {
      this.speed.replaceChildren(...state.speeds.map((speed) => new Option(`${speed} ×`, speed)));
    }
    this.speed.value = state.speed;
    this.slider.max = state.end;
    if (this.dragged) return;
    this.slider.value = state.position;
    this.tell(state.position);
  }
}
