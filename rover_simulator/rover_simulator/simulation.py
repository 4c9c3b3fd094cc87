"""The world, the rover and its camera together: commands in, telemetry out."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import astuple
from typing import Any

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.sensors.camera import Camera
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.vehicle.arm import Arm
from rover_simulator.vehicle.contacts import Contacts
from rover_simulator.vehicle.dead_man import DeadMan
from rover_simulator.vehicle.fixed_turn import FixedTurn
from rover_simulator.vehicle.ground import Ground, ground_under
from rover_simulator.vehicle.vehicle import STEP, Controls, Vehicle
from rover_simulator.wire.command_values import parse_base64, parse_number
from rover_simulator.wire.telemetry_format import format_telemetry
from rover_simulator.world import boulders
from rover_simulator.world.terrain import terrain_of
from rover_simulator.world.world import World

RESUME_LEAP = 2.0  # [s] longer than from one memory to the next
START_TIME = 1.0  # [s] a ROS clock that reads zero counts as not yet set
INSETS = ("inset_image1", "inset_image2", "inset_image3")  # the original shows them on its screen

# Takes the time [s], the camera's JPEG file and the files of the insets by name.
ShowInsets = Callable[[float, bytes, Mapping[str, bytes]], None]


class Simulation:
    """Advances frame by frame; the same world and commands give the same telemetry."""

    def __init__(
        self, world: World, terrain_seed: int, frame_steps: int, dead_man: float = math.inf
    ) -> None:
        """frame_steps: physics steps of 0.02 s a rendered frame; dead_man: [s] as in `DeadMan`."""
        self._world = world
        self._dead_man_age = dead_man
        self._terrain = terrain_of(world, terrain_seed)
        self._frame_steps = frame_steps
        self._first_row: Callable[[Pose], int] = lambda _: 0
        self._show_insets: ShowInsets | None = None
        self.reset()

    def reset(self) -> None:
        """Everything is as it was at the beginning, the time too."""
        self._camera = Camera(Renderer(self._world, self._terrain), self._first_row)
        self._arm = Arm([(float(x), float(y)) for x, y in self._world.samples])
        self._fixed_turn = FixedTurn()
        self._controls = Controls()
        self._dead_man = DeadMan(self._dead_man_age)
        self.time = START_TIME
        self._contacts = Contacts()
        self.distance = 0.0  # [m] driven
        self._put(Vehicle(self._world.start))

    def place(self, pose: Pose) -> str:
        """Put the rover somewhere, standing; a frozen one is free then.

        Why it cannot be, and nothing is changed then; empty when it is done.
        """
        if not self._world.is_navigable(pose.x, pose.y):
            return f"({pose.x:.2f}, {pose.y:.2f}) m is not navigable"
        if self._arm.picking_up and not self._arm.frozen:
            return "the arm moves"
        self._arm = Arm(self._arm.samples)
        self._fixed_turn, self._controls = FixedTurn(), Controls()
        self._put(Vehicle(pose))
        return ""

    def crop_images(self, first_row: Callable[[Pose], int]) -> None:
        """Render only the rows of an image from `first_row(pose)` on, for their reader."""
        self._first_row = self._camera.first_row = first_row

    def show_insets(self, show: ShowInsets) -> None:
        """Hand over the insets of each command, and tell the server that they are shown."""
        self._show_insets = show

    def memory(self) -> dict[str, Any]:
        """What a simulation of the same world needs to go on, for JSON."""
        return {
            "time": self.time,
            "pose": astuple(self._vehicle.pose),
            "speed": self._vehicle.speed,
            "controls": astuple(self._controls),
            "samples": self._arm.on_the_ground,
            "contacts": self.contacts,
            "distance": self.distance,
        }

    def resume(self, memory: dict[str, Any]) -> None:
        """Go on as `memory` has it, a little later; only before the first frame.

        The clock leaps by RESUME_LEAP: what was sent after the memory was made lies behind it. A
        pickup in progress begins anew. Raises ValueError, TypeError or KeyError for anything else.
        """
        pose, controls = Pose(*memory["pose"]), Controls(*memory["controls"])
        samples = [(float(x), float(y)) for x, y in memory["samples"]]
        vehicle = Vehicle(pose)
        vehicle.roll_on(float(memory["speed"]), controls)
        self._contacts, self.distance = Contacts(int(memory["contacts"])), float(memory["distance"])
        self.time, self._controls = float(memory["time"]) + RESUME_LEAP, controls
        for place in self._arm.samples:
            if place not in samples:
                self._camera.hide_sample(*place)
        self._arm = Arm(samples)
        self._put(vehicle)

    @property
    def pose(self) -> Pose:
        return self._vehicle.pose

    @property
    def samples_left(self) -> int:
        return len(self._arm.samples)

    @property
    def contacts(self) -> int:
        """How often the rover touched a wall or a boulder."""
        return self._contacts.count

    @property
    def dead_man_stops(self) -> int:
        """How often the rover braked because no command came."""
        return self._dead_man.stops

    @property
    def longest_unbraked(self) -> float:
        """[s] that the rover moved without a new command until it braked, at the longest."""
        return self._dead_man.longest

    def advance(self) -> None:
        """One rendered frame: its physics, then its image."""
        if not self._held:
            moving, frame = self._vehicle.speed != 0.0, self._frame_steps * STEP
            self._controls = self._dead_man.controls(self.time, frame, self._controls, moving)
        for _ in range(self._frame_steps):
            self._step()
        self._arm.advance(self._frame_steps * STEP)
        if self._arm.lifted is not None:
            self._camera.hide_sample(*self._arm.lifted)
        self.time += self._frame_steps * STEP
        self._camera.advance(self.pose, self._ground.height)

    def telemetry(self) -> dict[str, str]:
        """Of this frame, with the image of the one before."""
        vehicle, controls = self._vehicle, self._controls
        return format_telemetry(
            pose=vehicle.pose,
            speed=0.0 if self._held else vehicle.reported_speed,
            throttle=controls.throttle,
            brake=controls.brake,
            steering_angle=controls.steering,
            near_sample=self._arm.near_sample(vehicle.pose),
            picking_up=self._arm.picking_up,
            sample_count=len(self._arm.samples),
            samples=self._arm.samples,
            image=self._camera.image,
            sim_time=self.time,
            shows_insets=self._show_insets is not None,
        )

    def handle(self, event: str, data: Mapping[str, Any]) -> bool:
        """Apply an event of the server; whether a telemetry answers it.

        Values that cannot be parsed lose their answer, as in the original; those before them are
        applied.
        """
        actions = {
            "data": self._drive,
            "manual": lambda _: None,
            "pickup": self._pick_up,
            "fixed_turn": self._turn_fixed,
        }
        if event not in actions:
            return False
        try:
            actions[event](data)
        except (KeyError, TypeError, ValueError):
            return False
        if event != "manual":  # which commands nothing
            self._dead_man.hear(self.time)
        return True

    @property
    def _held(self) -> bool:
        """Whether the body is held still, and commands are ignored."""
        return self._arm.picking_up or self._fixed_turn.running

    def _drive(self, data: Mapping[str, Any]) -> None:
        """In the order steering, throttle, brake, insets; ignored while the body is held."""
        before = self._controls
        steering = math.radians(parse_number(data["steering_angle"]))
        steering = max(-ROVER.max_steering, min(ROVER.max_steering, steering))
        self._hold(Controls(steering, before.throttle, before.brake))
        throttle = parse_number(data["throttle"])
        self._hold(Controls(steering, throttle, before.brake))
        self._hold(Controls(steering, throttle, parse_number(data.get("brake", "0"))))
        insets = {key: parse_base64(data.get(key, "")) for key in INSETS}
        if self._show_insets is not None:
            self._show_insets(self.time, self._camera.image, insets)

    def _pick_up(self, _: Mapping[str, Any]) -> None:
        if not self._held:
            self._vehicle.halt()
            self._arm.start(self._vehicle.pose)

    def _turn_fixed(self, data: Mapping[str, Any]) -> None:
        """Only a rover that stands still, with all controls at zero, turns."""
        clockwise = math.radians(parse_number(data["angle"]))
        seconds = parse_number(data.get("time", "0"))
        standing = self._vehicle.reported_speed == 0.0
        if standing and self._controls == Controls() and not self._held:
            self._vehicle.halt()
            self._fixed_turn.start(-clockwise, seconds)

    def _hold(self, controls: Controls) -> None:
        if not self._held:
            self._controls = controls

    def _step(self) -> None:
        if self._arm.picking_up:
            return
        if self._fixed_turn.running:
            self._vehicle.rotate(self._fixed_turn.advance(STEP))
            self._ground = self._ground_under()
            return
        before = self._vehicle.pose
        self._vehicle.step(self._controls, self._ground)
        depth = boulders.overlap(self._vehicle.pose, self._world.boulders)
        blocked = depth > 0.0 and depth > boulders.overlap(before, self._world.boulders)
        if blocked:
            self._vehicle.bump(before)
        after = self._vehicle.pose
        self.distance += math.hypot(after.x - before.x, after.y - before.y)
        self._ground = self._ground_under()
        self._contacts.note(blocked, self._ground.height, STEP)

    def _ground_under(self) -> Ground:
        return ground_under(self._vehicle.pose, self._terrain.surface_at)

    def _put(self, vehicle: Vehicle) -> None:
        """Another vehicle in this one's place."""
        self._vehicle = vehicle
        self._ground = self._ground_under()
        self._camera.capture(vehicle.pose, self._ground.height)
