"""The parts of eventlet, engineio and socketio that are private, and that the bridge relies on."""

import inspect

import engineio
import engineio.socket
import pytest
import socketio
import socketio.packet
from engineio.async_drivers.eventlet import WebSocketWSGI
from eventlet import greenio, websocket, wsgi
from socketio import base_manager


def parameters(function: object) -> list[str]:
    return list(inspect.signature(function).parameters)


@pytest.mark.parametrize(
    ("function", "expected"),
    [
        (websocket.RFC6455WebSocket._recv_frame, ["self", "message"]),
        (websocket.RFC6455WebSocket._apply_mask, ["data", "mask", "length", "offset"]),
        (websocket.RFC6455WebSocket.close, ["self", "close_data"]),
        (websocket.RFC6455WebSocket.wait, ["self"]),
        (WebSocketWSGI._handle_hybi_request, ["self", "environ"]),
        (WebSocketWSGI.__init__, ["self", "handler", "server"]),
        (wsgi.HttpProtocol.handle_one_request, ["self"]),
        (wsgi.HttpProtocol.get_environ, ["self"]),
        (engineio.Server._trigger_event, ["self", "event", "args", "kwargs"]),
        (engineio.Server.handle_request, ["self", "environ", "start_response"]),
        (engineio.socket.Socket.receive, ["self", "pkt"]),
        (socketio.Server._handle_event, ["self", "eio_sid", "namespace", "id", "data"]),
        (socketio.Server._handle_eio_message, ["self", "eio_sid", "data"]),
        (socketio.Server._engineio_server_class, ["self"]),
    ],
)
def test_what_is_overridden_or_called_has_this_signature(function, expected):
    assert parameters(function) == expected


@pytest.mark.parametrize(
    ("function", "expected"),
    [
        (engineio.socket.Socket.close, {"wait"}),
        (engineio.socket.Socket.send, {"pkt"}),
        (websocket.RFC6455WebSocket.__init__, {"sock", "environ", "max_frame_length"}),
        (base_manager.BaseManager.eio_sid_from_sid, {"sid", "namespace"}),
        (greenio.shutdown_safe, {"sock"}),
    ],
)
def test_what_is_called_takes_these_arguments(function, expected):
    assert expected <= set(parameters(function))


def test_an_engine_has_its_sockets_by_session_and_the_class_of_its_websockets():
    engine = engineio.Server(async_mode="eventlet", monitor_clients=False)
    assert engine.sockets == {}
    assert engine._async["websocket"] is WebSocketWSGI
    session = engineio.socket.Socket(engine, "sid")
    assert (session.sid, session.upgraded, session.queue.qsize()) == ("sid", False, 0)


def test_an_origin_is_allowed_by_a_function_of_any_arguments():
    """Older versions call it with the origin, newer ones also with the environ."""
    engine = engineio.Server(cors_allowed_origins=lambda origin, *_: origin == "http://a")
    assert engine._cors_allowed_origins({"HTTP_ORIGIN": "http://a"}) == ["http://a"]
    assert engine._cors_allowed_origins({"HTTP_ORIGIN": "http://b"}) == []


def test_the_http_server_takes_a_pool_and_a_protocol():
    assert {"custom_pool", "protocol", "socket_timeout", "debug"} <= set(parameters(wsgi.server))
    source = inspect.getsource(wsgi.server)
    assert "pool.spawn(serv.process_request, connection)" in source
    assert "connection = [client_addr, client_socket, STATE_IDLE]" in source


def test_the_headers_are_whole_when_the_environ_is_made():
    source = inspect.getsource(wsgi.HttpProtocol.handle_one_request)
    assert source.index("self.parse_request()") < source.index("self.get_environ()")
    assert source.index("self.get_environ()") < source.index("self.handle_one_response()")


def test_a_websocket_message_is_a_list_of_parts():
    message = websocket.RFC6455WebSocket.Message(1, 10)
    message.push(b"a")
    assert (message.data, message.opcode) == ([b"a"], 1)


def test_a_websocket_reads_by_the_method_that_is_overridden():
    assert "self._recv_frame(message=" in inspect.getsource(websocket.RFC6455WebSocket._iter_frames)
    assert websocket.FailedConnectionError(1009, "x").status == 1009


def test_a_green_socket_has_the_plain_one():
    assert "self.fd = fd" in inspect.getsource(greenio.GreenSocket.__init__)


def test_a_session_begins_with_a_connect_event_and_then_is_read():
    source = inspect.getsource(engineio.Server._handle_connect)
    assert source.index("self.sockets[sid] = s") < source.index("_trigger_event('connect'")
    assert source.index("_trigger_event('connect'") < source.index("s.handle_get_request")
    websocket_handler = inspect.getsource(engineio.socket.Socket._websocket_handler)
    assert "self.receive(pkt)" in websocket_handler
    assert "self.receive(pkt)" in inspect.getsource(engineio.socket.Socket.handle_post_request)


def test_the_packets_class_and_its_json_can_be_chosen():
    assert "json" in vars(socketio.packet.Packet)
    assert "serializer" in parameters(socketio.base_server.BaseServer.__init__)
