// What the mission and the vehicle say in figures.

import { clock } from "./theme.js";

const show = (id, text) => {
  const element = document.getElementById(id);
  if (element.textContent !== text) element.textContent = text;
};

export function showMission(mission) {
  if (!mission) return;
  show("state", mission.state);
  show("reason", mission.reason);
  show("elapsed", clock(mission.elapsed));
  show("samples", `${mission.samples_collected} of ${mission.samples_total}`);
  show("explored", `${(100 * mission.explored).toFixed(0)} %`);
  document.getElementById("explored-bar").value = mission.explored;
  show("home", `${mission.home_distance.toFixed(1)} m away`);
  show("driven", `${mission.distance.toFixed(0)} m`);
  const givenUp = mission.rocks_given_up ? `, ${mission.rocks_given_up} given up` : "";
  show("rocks", `${mission.rocks_known}${givenUp}`);
  show("recoveries", String(mission.recoveries));
  show("run", String(mission.run));
}

export function showVehicle(vehicle) {
  if (!vehicle) return;
  show("speed", `${vehicle.speed.toFixed(1)} m/s`);
  const side = vehicle.steering > 0.05 ? " left" : vehicle.steering < -0.05 ? " right" : "";
  show("steering", `${Math.abs(vehicle.steering).toFixed(0)}°${side}`);
  show("arm", vehicle.arm || "at rest");
}

export function showGround(squareMetres) {
  show("ground", squareMetres === undefined ? "–" : `${squareMetres} m²`);
}
