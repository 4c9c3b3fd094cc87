// Which part of the map frame a canvas shows: north up, the same scale in both directions.

const STEP = 5; // [cells] the view grows in steps, so that it does not creep
const PADDING = 10; // [px]

export class View {
  // bounds: {left, bottom, right, top} [m]; size of the canvas [px of the style sheet];
  // resolution: of the map's cells [m]
  constructor(bounds, width, height, resolution) {
    const step = STEP * resolution;
    const left = step * Math.floor(bounds.left / step);
    const bottom = step * Math.floor(bounds.bottom / step);
    const right = step * Math.ceil(bounds.right / step);
    const top = step * Math.ceil(bounds.top / step);
    this.scale = Math.min(
      (width - 2 * PADDING) / Math.max(step, right - left),
      (height - 2 * PADDING) / Math.max(step, top - bottom),
    ); // [px/m]
    this.x0 = width / 2 - (this.scale * (left + right)) / 2;
    this.y0 = height / 2 + (this.scale * (bottom + top)) / 2;
  }

  // Of a point of the map frame [m], on the canvas.
  at([x, y]) {
    return [this.x0 + this.scale * x, this.y0 - this.scale * y];
  }
}

export function boundsOf(picture, points) {
  const xs = points.map((point) => point[0]);
  const ys = points.map((point) => point[1]);
  if (picture) {
    xs.push(picture.x, picture.x + picture.width);
    ys.push(picture.y, picture.y + picture.height);
  }
  if (!xs.length) return null;
  return {
    left: Math.min(...xs), right: Math.max(...xs), bottom: Math.min(...ys), top: Math.max(...ys),
  };
}
