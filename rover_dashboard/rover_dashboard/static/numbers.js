// What the mission and the vehicle say in figures.

import { clock } from "./theme.js";

const show = (id, text) => {
  const element = document.getElementById(id);
  if (element.textContent !== text) element.textContent = text;
};

const OF_ROBOT = {
  rover: (mission) => {
    show("samples", `${mission.samples_collected} of ${mission.samples_total}`);
    show("home", `${mission.home_distance.toFixed(1)} m away`);
    show("driven", `${mission.distance.toFixed(0)} m`);
    const givenUp = mission.rocks_given_up ? `, ${mission.rocks_given_up} given up` : "";
    show("rocks", `${mission.rocks_known}${givenUp}`);
    show("recoveries", String(mission.recoveries));
  },
  heat: (mission) => {
    show("sources", String(mission.sources_known));
    show("served", String(mission.sources_delivered));
    show("driven", `${mission.distance.toFixed(1)} m`);
    show("payloads", String(mission.payloads));
    show("ramp", mission.ramp);
    show("interrupts", String(mission.interrupts));
  },
};

export function showMission(robot, mission) {
  if (!mission) return;
  show("state", mission.state);
  show("reason", mission.reason);
  show("elapsed", clock(mission.elapsed));
  show("explored", `${(100 * mission.explored).toFixed(0)} %`);
  document.getElementById("explored-bar").value = mission.explored;
  show("run", String(mission.run));
  OF_ROBOT[robot](mission);
}

export function showVehicle(vehicle) {
  if (!vehicle) return;
  const slow = vehicle.turn !== undefined; // the second robot
  show("speed", `${vehicle.speed.toFixed(slow ? 2 : 1)} m/s`);
  if (slow) {
    show("turn", `${Math.abs(vehicle.turn).toFixed(0)}°/s${sideOf(vehicle.turn)}`);
    return;
  }
  show("steering", `${Math.abs(vehicle.steering).toFixed(0)}°${sideOf(vehicle.steering)}`);
  show("arm", vehicle.arm || "at rest");
}

function sideOf(angle) {
  if (Math.abs(angle) <= 0.05) return "";
  return angle > 0 ? " left" : " right";
}

export function showGround(squareMetres) {
  const digits = squareMetres < 20 ? 1 : 0;
  show("ground", squareMetres === undefined ? "–" : `${squareMetres.toFixed(digits)} m²`);
}
