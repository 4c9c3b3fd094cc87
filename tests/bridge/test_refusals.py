"""Requests that are refused at the server's door, over HTTP: each is told why."""

from __future__ import annotations

import http.client
import json
from collections.abc import Iterator

import pytest
import websocket

from rover_bridge.access import Access
from rover_bridge.server import SocketServer
from rover_bridge.transport import ConnectionRefused, ListenError, ServerEvent, WireLimits
from rover_simulator.wire.unity_client import ConnectionLostError, UnityClient

PAGE, EVIL = "http://robot:8000", "http://evil.example"
POLLING = "/socket.io/?EIO=4&transport=polling"
WAIT = 60.0  # [s]


class Door:
    """A server, and requests to it."""

    def __init__(self, access: Access, host: str = "127.0.0.1") -> None:
        self.events: list[ServerEvent] = []
        self.server = SocketServer(host, 0, self.events.append, WireLimits(), access)
        self.port = self.server.port

    def ask(
        self, path: str = POLLING, method: str = "GET", **headers: str
    ) -> tuple[int, str, dict]:
        """Status, body and headers of the answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=WAIT)
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.request(method, path, headers=named)
        answer = connection.getresponse()
        result = answer.status, answer.read().decode(), dict(answer.getheaders())
        connection.close()
        return result

    def open(self, query: str = "", **options: object) -> None:
        """Open a WebSocket, as websocket-client does: with the server's address as its origin."""
        url = f"ws://127.0.0.1:{self.port}/socket.io/?EIO=4&transport=websocket{query}"
        websocket.create_connection(url, timeout=WAIT, **options).shutdown()

    @property
    def refusals(self) -> list[str]:
        return [e.reason for e in self.events if isinstance(e, ConnectionRefused)]


@pytest.fixture
def door() -> Iterator[Door]:
    door = Door(Access(PAGE))
    yield door
    door.server.close()


def test_a_page_of_another_origin_is_refused_and_told_why(door):
    with pytest.raises(websocket.WebSocketBadStatusException) as caught:
        door.open(origin=EVIL)
    assert caught.value.status_code == 403
    assert EVIL.encode() in caught.value.resp_body
    status, body, _ = door.ask(method="POST", Origin=EVIL)
    assert (status, EVIL in body) == (403, True)
    assert len(door.refusals) == 2
    assert EVIL in door.refusals[0]


def test_an_allowed_page_and_programs_are_served(door):
    door.open(origin=PAGE)
    door.open()
    door.open(suppress_origin=True)
    assert door.refusals == []


@pytest.mark.parametrize("origin", [PAGE, EVIL, None])
def test_only_the_allowed_origin_is_named_in_an_answer(door, origin):
    _, _, headers = door.ask(**({"Origin": origin} if origin else {}))
    assert headers.get("Access-Control-Allow-Origin") == (PAGE if origin == PAGE else None)
    assert "Access-Control-Allow-Credentials" not in headers


def test_jsonp_is_refused(door):
    status, body, _ = door.ask(POLLING + "&j=0")
    assert (status, body) == (400, "JSONP is not served\n")


def test_a_script_of_another_site_is_refused(door):
    assert door.ask(Sec_Fetch_Site="cross-site")[0] == 403
    assert door.ask(Sec_Fetch_Site="same-origin")[0] == 200


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Content_Length": "99999999"}, 413),
        ({"Transfer_Encoding": "chunked"}, 411),
        ({"Content_Length": "-1"}, 400),
        ({"Content_Length": "many"}, 400),
        ({}, 400),
    ],
)
def test_a_body_that_is_none_is_refused(door, headers, status):
    assert door.ask(method="POST", **headers)[0] == status


def test_a_session_that_is_silent_makes_room():
    server = SocketServer("127.0.0.1", 0, lambda event: None, WireLimits(max_connections=3))
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=WAIT)

    def ask(method: str, sid: str = "", body: str | None = None) -> tuple[int, str]:
        connection.request(method, POLLING + (f"&sid={sid}" if sid else ""), body)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()

    begun = [ask("GET") for _ in range(7)]  # on one connection
    assert [status for status, _ in begun] == [200] * 7
    sids = [json.loads(body[1:])["sid"] for _, body in begun]
    assert [ask("POST", sid, "40")[0] for sid in sids] == [400] + [200] * 6
    connection.close()
    server.close()


def test_the_token_opens_the_door():
    door = Door(Access(token="t-1"))
    with pytest.raises(websocket.WebSocketBadStatusException) as caught:
        door.open()
    assert (caught.value.status_code, b"token" in caught.value.resp_body) == (403, True)
    door.open("&token=t-1")
    door.open(header=["Authorization: Bearer t-1"])
    assert len(door.refusals) == 1
    door.server.close()


def test_a_simulator_is_told_why_it_is_refused():
    door = Door(Access(token="t-1"))
    told: list[str] = []
    simulator = UnityClient("127.0.0.1", door.port, told.append)
    for _ in range(2):
        with pytest.raises(ConnectionLostError, match="token"):
            simulator.connect(timeout=WAIT)
    assert told == [f"refused by the server: {simulator.refused}"]
    door.server.close()


@pytest.mark.parametrize("host", ["::1", "::", "localhost"])
def test_addresses_of_this_machine_are_listened_on(host):
    try:
        door = Door(Access(), host)
    except ListenError as error:
        pytest.skip(f"this machine has no {host}: {error}")
    name = "[::1]" if ":" in host else host
    url = f"ws://{name}:{door.port}/socket.io/?EIO=4&transport=websocket"
    websocket.create_connection(url, timeout=WAIT).shutdown()  # its origin is the address
    assert door.refusals == []
    door.server.close()


@pytest.mark.parametrize(
    "host", ["192.0.2.7", "2001:db8::1", "no.such.host.invalid", "a b", "\x00"]
)
def test_other_addresses_are_one_clear_error(host):
    with pytest.raises(ListenError, match="cannot listen on"):
        Door(Access(), host)
