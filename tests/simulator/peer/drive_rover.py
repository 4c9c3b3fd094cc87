"""A program for the Unity simulator in the style of 2017: one process, one state, two steps.

    python drive_rover.py PORT

A server that the simulator connects to. It answers each telemetry by a perception step and
a decision step, which keep all that they know in one object, and sends throttle, brake and steering
as text, with two pictures for the screen.
"""

from __future__ import annotations

import base64
import sys
from io import BytesIO

import eventlet
import eventlet.wsgi
import numpy as np
import socketio
from PIL import Image

sio = socketio.Server()


class RoverState:
    img = None
    vel = yaw = 0.0
    steer = throttle = brake = 0.0
    near_sample = picking_up = send_pickup = False
    mode = "forward"
    nav_angles = np.array([])
    vision_image = np.zeros((160, 320, 3), np.uint8)


Rover = RoverState()


def read_telemetry(data):
    Rover.vel = float(data["speed"])
    Rover.yaw = float(data["yaw"])
    x, y = data["position"].split(";")
    Rover.pos = float(x), float(y)
    Rover.near_sample = int(data["near_sample"])
    Rover.picking_up = int(data["picking_up"])
    Rover.samples_to_find = int(data["sample_count"])
    Rover.img = np.asarray(Image.open(BytesIO(base64.b64decode(data["image"]))))


def perception_step():
    """Bright pixels below the horizon, as bearings left of the axis."""
    ground = (Rover.img > 160).all(axis=2)
    ground[:90] = False
    Rover.vision_image[..., 2] = ground * 255
    rows, cols = ground[90:].nonzero()
    near = rows > 5
    Rover.nav_angles = np.arctan2(160 - cols[near], 114.0)


def decision_step():
    Rover.throttle = Rover.brake = Rover.steer = 0.0
    ahead = np.abs(Rover.nav_angles) < 0.3
    if Rover.near_sample and not Rover.picking_up:
        Rover.brake = 10.0 if Rover.vel else 0.0
        Rover.send_pickup = Rover.vel == 0
    elif ahead.sum() < 2500:
        Rover.mode = "stop"
        if Rover.vel > 0.2:
            Rover.brake = 10.0
        else:
            Rover.steer = -15.0
    else:
        Rover.mode = "forward"
        Rover.throttle = 0.2 if Rover.vel < 2.0 else 0.0
        Rover.steer = float(np.clip(np.degrees(Rover.nav_angles.mean()), -15, 15))


def picture(image):
    file = BytesIO()
    Image.fromarray(image).save(file, "JPEG")
    return base64.b64encode(file.getvalue()).decode()


def send_control(first="", second=""):
    command = {
        "steering_angle": str(Rover.steer), "throttle": str(Rover.throttle),
        "brake": str(Rover.brake), "inset_image1": first, "inset_image2": second,
    }  # fmt: skip
    sio.emit("data", command, skip_sid=True)
    eventlet.sleep(0)


@sio.on("telemetry")
def telemetry(sid, data):
    if not data:
        sio.emit("manual", {}, skip_sid=True)
        return
    read_telemetry(data)
    perception_step()
    decision_step()
    if Rover.send_pickup and not Rover.picking_up:
        sio.emit("pickup", {}, skip_sid=True)
        Rover.send_pickup = False
        eventlet.sleep(0)
    else:
        send_control(picture(Rover.vision_image), picture(Rover.vision_image))


@sio.on("connect")
def connect(sid, environ):
    send_control()
    sio.emit("get_samples", {}, skip_sid=True)


def no_page(environ, start_response):
    start_response("404 Not Found", [])
    return []


if __name__ == "__main__":
    application = socketio.Middleware(sio, no_page)
    eventlet.wsgi.server(eventlet.listen(("", int(sys.argv[1]))), application, log_output=False)
