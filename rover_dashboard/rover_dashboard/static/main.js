// Leads each message of the node to the part of the page that shows it.

import { Connection } from "./connection.js";
import { Controls } from "./controls.js";
import { MapView } from "./map.js";
import { showGround, showMission, showVehicle } from "./numbers.js";
import { Pictures } from "./pictures.js";
import { PlaybackBar } from "./playback.js";
import { Plots } from "./plots.js";
import { Timeline } from "./timeline.js";

const map = new MapView();
const pictures = new Pictures();
const plots = new Plots();
const timeline = new Timeline();
const link = document.getElementById("link");
let simulator = null;
let health = null; // level and text of the whole graph
let connected = "connecting";
let recorded = false; // a recording is shown, not the graph
let robot = "rover"; // whose mission is shown

const parts = {
  playback: ({ data }) => {
    recorded = true;
    pictures.recorded = true;
    playback.show(data);
    showLink();
  },
  robot: ({ data }) => {
    if (!data) return;
    robot = data;
    document.documentElement.dataset.robot = robot;
    plots.choose(robot);
    showLink();
  },
  camera: (message) => pictures.show("camera", message),
  vision: (message) => pictures.show("vision", message),
  thermal_1: (message) => pictures.show("thermal_1", message),
  thermal_2: (message) => pictures.show("thermal_2", message),
  map: (message) => {
    map.showMap(message);
    showGround(message.ground);
  },
  plan: ({ data }) => map.show("plan", data),
  markers: ({ data }) => map.show("markers", data),
  sources: ({ data }) => map.show("sources", data),
  vehicle: ({ data }) => {
    map.show("vehicle", data);
    showVehicle(data);
  },
  mission: ({ data }) => {
    showMission(robot, data);
    if (data) timeline.advance(data.elapsed);
    const { dataset } = document.documentElement;
    dataset.elapsed = data?.elapsed ?? 0;
    dataset.run = data?.run ?? 0;
  },
  track: ({ data }) => map.addTrack(data),
  plots: ({ data }) => plots.add(data),
  timeline: ({ data }) => timeline.add(data),
  settings: ({ data }) => controls.offer(data),
  parameters: ({ data }) => controls.showValues(data),
  simulator: ({ data }) => {
    simulator = data;
    showLink();
  },
  health: ({ data }) => {
    health = data;
    showLink();
  },
};

const connection = new Connection(
  (message) => parts[message.slot]?.(message),
  (state) => {
    connected = state;
    showLink();
  },
);
const controls = new Controls(connection);
const playback = new PlaybackBar(connection);

function showLink() {
  const lacksSimulator = robot === "rover" && simulator !== "connected";
  const waiting = connected === "connected" && !recorded && lacksSimulator;
  const troubled = connected === "connected" && !recorded && health?.level > 0;
  link.dataset.link = waiting || troubled ? "waiting" : connected;
  link.textContent = waiting
    ? "no simulator"
    : troubled
    ? health.text
    : { connecting: "connecting", connected: recorded ? "recording" : "live", lost: "connection lost, trying again" }[connected];
}
