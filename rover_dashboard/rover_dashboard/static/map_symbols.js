// What is drawn over the map; each thing has a shape of its own, not only a colour.

import { colour } from "./theme.js";

const ROVER = 9; // [px] from its middle to its nose
const SCALES = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100]; // [m]
const SCALE_LENGTH = 110; // [px] at most

// The breadcrumbs lie on the track: wider dots below it.
export function drawTrack(context, view, track, breadcrumbs) {
  for (const point of breadcrumbs) dot(context, view.at(point), 2.6, "breadcrumb");
  line(context, view, track, "track", 1.5);
}

export function drawHome(context, view, home) {
  if (!home) return;
  const [x, y] = view.at(home);
  context.lineWidth = 2;
  context.strokeStyle = colour("ink");
  context.fillStyle = colour("panel");
  context.beginPath();
  context.rect(x - 5, y - 5, 10, 10);
  context.fill();
  context.stroke();
}

// markers: points by namespace, as in mission_markers
export function drawOverlay(context, view, markers, plan) {
  for (const point of markers.examined ?? []) dot(context, view.at(point), 1.6, "examined");
  for (const point of markers.frontiers ?? []) ring(context, view.at(point), 4, 2, "frontier");
  line(context, view, plan ?? markers.path ?? [], "plan", 3);
  for (const point of markers.goal ?? []) {
    ring(context, view.at(point), 7, 2.5, "goal");
    dot(context, view.at(point), 2.5, "goal");
  }
  for (const point of markers.blocked ?? []) cross(context, view.at(point), 5);
  for (const corners of markers.outlines ?? []) outline(context, corners.map((each) => view.at(each)));
  for (const point of markers.rocks ?? []) diamond(context, view.at(point), 6);
}

// Of heat: {x, y, delivered}; bigger with evidence, with a tick when served.
export function drawSources(context, view, sources) {
  for (const source of sources) {
    const [x, y] = view.at([source.x, source.y]);
    const radius = 5 + 4 * Math.min(1, source.observations / 50);
    dot(context, [x, y], radius, source.delivered ? "delivered" : "source");
    ring(context, [x, y], radius, 1.5, "ink");
    if (!source.delivered) continue;
    context.beginPath();
    context.moveTo(x - 0.5 * radius, y);
    context.lineTo(x - 0.1 * radius, y + 0.4 * radius);
    context.lineTo(x + 0.5 * radius, y - 0.4 * radius);
    context.strokeStyle = "#fff";
    context.lineWidth = 2;
    context.stroke();
  }
}

export function drawRover(context, view, vehicle) {
  if (!vehicle) return;
  const [x, y] = view.at([vehicle.x, vehicle.y]);
  context.save();
  context.translate(x, y);
  context.rotate((-vehicle.yaw * Math.PI) / 180); // the canvas' y axis points down
  context.beginPath();
  context.moveTo(ROVER, 0);
  context.lineTo(-ROVER, -0.75 * ROVER);
  context.lineTo(-0.5 * ROVER, 0);
  context.lineTo(-ROVER, 0.75 * ROVER);
  context.closePath();
  context.fillStyle = colour("rover");
  context.strokeStyle = colour("panel");
  context.lineWidth = 2;
  context.stroke();
  context.fill();
  context.restore();
}

export function drawScale(context, view, width, height) {
  const metres = SCALES.filter((each) => each * view.scale <= SCALE_LENGTH).at(-1) ?? SCALES[0];
  const length = metres * view.scale;
  const [x, y] = [width - 12 - length, height - 12];
  context.strokeStyle = context.fillStyle = colour("ink");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + length, y);
  context.lineTo(x + length, y - 5);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  context.fillText(`${metres} m`, x + length / 2, y - 5);
  context.fillText("N", width - 18, 34);
  context.beginPath();
  context.moveTo(width - 18, 8);
  context.lineTo(width - 13, 21);
  context.lineTo(width - 23, 21);
  context.closePath();
  context.fill();
}

function line(context, view, points, name, width) {
  if (points.length < 2) return;
  context.beginPath();
  points.forEach((point, index) => {
    const [x, y] = view.at(point);
    if (index) context.lineTo(x, y);
    else context.moveTo(x, y);
  });
  context.strokeStyle = colour(name);
  context.lineWidth = width;
  context.lineJoin = context.lineCap = "round";
  context.stroke();
}

function dot(context, [x, y], radius, name) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = colour(name);
  context.fill();
}

function ring(context, [x, y], radius, width, name) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.strokeStyle = colour(name);
  context.lineWidth = width;
  context.stroke();
}

function cross(context, [x, y], size) {
  context.beginPath();
  context.moveTo(x - size, y - size);
  context.lineTo(x + size, y + size);
  context.moveTo(x + size, y - size);
  context.lineTo(x - size, y + size);
  context.strokeStyle = colour("blocked");
  context.lineWidth = 3;
  context.stroke();
}

function outline(context, corners) {
  context.beginPath();
  corners.forEach(([x, y], index) => (index ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.closePath();
  context.fillStyle = colour("outline");
  context.globalAlpha = 0.25;
  context.fill();
  context.globalAlpha = 1;
  context.setLineDash([5, 3]);
  context.strokeStyle = colour("outline");
  context.lineWidth = 1.5;
  context.stroke();
  context.setLineDash([]);
}

function diamond(context, [x, y], size) {
  context.beginPath();
  context.moveTo(x, y - size);
  context.lineTo(x + size, y);
  context.lineTo(x, y + size);
  context.lineTo(x - size, y);
  context.closePath();
  context.fillStyle = colour("rock");
  context.strokeStyle = "#000";
  context.lineWidth = 1.5;
  context.fill();
  context.stroke();
}
