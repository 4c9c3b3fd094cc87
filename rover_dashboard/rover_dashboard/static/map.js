// The map: known ground, and over it the rover, where it was, and where it wants to go.

import { drawHome, drawOverlay, drawRover, drawScale, drawSources, drawTrack } from "./map_symbols.js";
import { channels, colour, onSchemeChange } from "./theme.js";
import { boundsOf, View } from "./view.js";

const UNKNOWN = 255; // in the picture of the map; otherwise the probability of an obstacle [%]

export class MapView {
  constructor() {
    this.canvas = document.getElementById("map");
    this.track = [];
    this.plan = null;
    this.markers = null;
    this.sources = null; // of heat
    this.vehicle = null;
    this.picture = null; // {x, y, width, height, resolution [m], grey: ImageData, image: canvas}
    this.waiting = false;
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
    onSchemeChange(() => {
      if (this.picture) paint(this.picture);
      this.redraw();
    });
  }

  addTrack({ restart, rows }) {
    if (restart) this.track = [];
    for (const row of rows) this.track.push(row);
    this.redraw();
  }

  async showMap(message) {
    if (!message.content) {
      this.picture = null;
    } else {
      const { x, y, width, height, resolution } = message;
      const picture = { x, y, width, height, resolution, grey: await greyOf(message.content) };
      paint(picture);
      this.picture = picture;
    }
    this.redraw();
  }

  show(name, value) {
    this[name] = value;
    this.redraw();
  }

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw() {
    const { canvas } = this;
    const ratio = devicePixelRatio;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = colour("unknown");
    context.fillRect(0, 0, width, height);
    const rover = this.vehicle ? [[this.vehicle.x, this.vehicle.y]] : [];
    const bounds = boundsOf(this.picture, [...rover, ...this.track.slice(0, 1)]);
    if (!bounds) return;
    const view = new View(bounds, width, height, this.picture?.resolution ?? 1);
    this.drawPicture(context, view);
    drawTrack(context, view, this.track, this.markers?.breadcrumbs ?? []);
    drawHome(context, view, this.track[0]);
    drawOverlay(context, view, this.markers ?? {}, this.plan);
    drawSources(context, view, this.sources ?? []);
    drawRover(context, view, this.vehicle);
    drawScale(context, view, width, height);
  }

  drawPicture(context, view) {
    if (!this.picture) return;
    const { x, y, width, height, image } = this.picture;
    const [left, top] = view.at([x, y + height]);
    context.imageSmoothingEnabled = false;
    context.drawImage(image, left, top, view.scale * width, view.scale * height);
  }
}

async function greyOf(content) {
  const bitmap = await createImageBitmap(content, { colorSpaceConversion: "none" });
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

// Give the picture's values the colours of the scheme.
function paint(picture) {
  const ground = channels(colour("ground"));
  const obstacle = channels(colour("obstacle"));
  const { width, height, data } = picture.grey;
  const painted = new ImageData(width, height);
  for (let at = 0; at < data.length; at += 4) {
    const value = data[at];
    if (value === UNKNOWN) continue; // transparent
    for (let channel = 0; channel < 3; channel += 1) {
      const low = ground[channel];
      painted.data[at + channel] = low + ((obstacle[channel] - low) * value) / 100;
    }
    painted.data[at + 3] = 255;
  }
  picture.image = new OffscreenCanvas(width, height);
  picture.image.getContext("2d").putImageData(painted, 0, 0);
}
