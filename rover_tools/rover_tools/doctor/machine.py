"""What this machine refuses: ports, memory, disks, the loopback. Only the library is imported."""

from __future__ import annotations

import os
import shutil
import socket
import tempfile
from collections.abc import Callable
from pathlib import Path

from rover_tools.doctor.finding import Finding, note, wrong

HOST, PORT = "127.0.0.1", 4567  # where the Unity simulator connects to
SHARED_MEMORY = Path("/dev/shm")
LEAST_MEMORY = 64 * 2**20  # [bytes] 8 MB for each node, and room
LEAST_DISK = 500 * 2**20  # [bytes] a recorded mission has up to 100 MB
TIMEOUT = 2.0  # [s]

MakeSocket = Callable[..., socket.socket]


def check_port(port: int = PORT) -> Finding:
    name = f"port {port}"
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port))
        except OSError as error:
            return note(
                name,
                f"{error.strerror}: end the program that has it (ss -ltnp shows which), or start "
                "the bridge with -p port:=N",
            )
    return Finding(name)


def check_shared_memory(folder: Path = SHARED_MEMORY) -> Finding:
    name = "shared memory"
    try:
        with tempfile.NamedTemporaryFile(prefix="rover-doctor-", dir=folder):
            free = shutil.disk_usage(folder).free
    except OSError as error:
        return wrong(
            name,
            f"{folder}: {error.strerror}; mount it, in a container with --ipc=host or "
            "--shm-size=256m",
        )
    if free < LEAST_MEMORY:
        return wrong(
            name,
            f"{folder} has {free >> 20} MB free, {LEAST_MEMORY >> 20} are needed; in a container "
            "use --shm-size=256m, or remove fastrtps_* there while no node runs",
        )
    return Finding(name)


def check_disk(folder: Path) -> Finding:
    name = "results' disk"
    folder = next(each for each in (folder, *folder.parents) if each.is_dir())
    try:
        free = shutil.disk_usage(folder).free
    except OSError as error:
        return wrong(name, f"{folder}: {error.strerror}; choose another with ROVER_RESULTS")
    if free < LEAST_DISK or not os.access(folder, os.W_OK):
        reason = f"{free >> 20} MB free" if free < LEAST_DISK else "it cannot be written to"
        return wrong(name, f"{folder}: {reason}; delete old results, or set ROVER_RESULTS")
    return Finding(name)


def check_loopback(make_socket: MakeSocket = socket.socket) -> Finding:
    """A datagram and a connection of this process to itself, as nodes and simulator make them."""
    name = "loopback"
    remedy = "let a firewall pass lo (iptables -A INPUT -i lo -j ACCEPT), or bring lo up"
    try:
        _send_datagram(make_socket)
        _connect(make_socket)
    except OSError as error:
        return wrong(name, f"{HOST} refuses ({error.strerror or error}); {remedy}")
    return Finding(name)


def _send_datagram(make_socket: MakeSocket) -> None:
    with make_socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.settimeout(TIMEOUT)
        receiver.bind((HOST, 0))
        receiver.sendto(b"rover", receiver.getsockname())
        receiver.recvfrom(16)


def _connect(make_socket: MakeSocket) -> None:
    with make_socket(socket.AF_INET, socket.SOCK_STREAM) as server:
        server.bind((HOST, 0))
        server.listen(1)
        with make_socket(socket.AF_INET, socket.SOCK_STREAM) as client:
            client.settimeout(TIMEOUT)
            client.connect(server.getsockname())
