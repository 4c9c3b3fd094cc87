// The moment under the pointer, in all plots, on the maps and in the video.
const track = JSON.parse(document.getElementById("track").textContent);
const areas = [...document.querySelectorAll(".area")];
const video = document.querySelector("video");
const duration = track.time.at(-1);

function show(time) {
  let at = track.time.findIndex((each) => each >= time);
  if (at < 0) at = track.time.length - 1;
  for (const area of areas) {
    const cursor = area.querySelector("i");
    cursor.style.display = "block";
    cursor.style.left = `${(100 * track.time[at]) / duration}%`;
  }
  for (const here of document.querySelectorAll(".here")) {
    here.setAttribute("cx", track.x[at]);
    here.setAttribute("cy", -track.y[at]);
    here.style.visibility = "visible";
  }
  document.getElementById("moment").textContent = `${track.time[at].toFixed(0)} s, ${track.state[at]}`;
  for (const output of document.querySelectorAll("output[data-values]")) {
    const value = JSON.parse(output.dataset.values)[at];
    output.textContent = value === null ? "" : value.toFixed(output.dataset.digits);
  }
}

function timeAt(event) {
  const box = areas[0].getBoundingClientRect();
  return duration * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
}

for (const area of areas) {
  area.addEventListener("pointermove", (event) => show(timeAt(event)));
  area.addEventListener("click", (event) => {
    show(timeAt(event));
    if (video) video.currentTime = (video.dataset.seconds * timeAt(event)) / duration;
  });
}
video?.addEventListener("timeupdate", () => show((duration * video.currentTime) / video.dataset.seconds));
video?.addEventListener("error", () => video.closest("section").remove(), true);
