"""Services of the missions' nodes, called from the server's thread."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from typing import Any

from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from std_srvs.srv import Trigger

from rover_dashboard.protocol import Answer, Value
from rover_decision.types import Request

DECISION, HEAT_NODE = "decision_node", "heat_node"
PATIENCE = 5.0  # [s] of wall time for an answer
DISCOVERY = 2.0  # [s] for a service to be found


class Requests:
    """The clients; an answer that does not come is an Answer as well."""

    def __init__(self, node: Node) -> None:
        self._triggers = {
            (owner, request.value): node.create_client(Trigger, f"{owner}/{request.value}")
            for owner in (DECISION, HEAT_NODE)
            for request in Request
            if not (owner == HEAT_NODE and request is Request.RETURN_HOME)
        }
        self._get = node.create_client(GetParameters, f"{DECISION}/get_parameters")
        self._set = node.create_client(SetParameters, f"{DECISION}/set_parameters")

    async def request(self, owner: str, name: str) -> Answer:
        """Ask the mission of a node for something by its name."""
        client = self._triggers.get((owner, name))
        if client is None:
            return Answer(False, f"{name}: {owner} does not offer it")
        response = await _call(client, Trigger.Request())
        if response is None:
            return Answer(False, f"{name}: no answer from {owner}")
        refused = "" if response.success else "not possible now; "
        return Answer(response.success, f"{refused}{response.message}")

    async def set_parameter(self, name: str, value: Value) -> Answer:
        message = Parameter(name, value=value).to_parameter_msg()
        response = await _call(self._set, SetParameters.Request(parameters=[message]))
        if response is None:
            return Answer(False, f"{name}: no answer from {DECISION}")
        (result,) = response.results
        return Answer(result.successful, result.reason or f"{name} is {value}")

    async def parameters(self, names: Iterable[str]) -> dict[str, Any] | None:
        """Their values, None when they do not come."""
        names = list(names)
        response = await _call(self._get, GetParameters.Request(names=names))
        if response is None or len(response.values) != len(names):
            return None
        values = map(parameter_value_to_python, response.values)
        return dict(zip(names, values, strict=True))


async def _call(client: Client, request: Any) -> Any:
    """The response, None when there is none within PATIENCE; rclpy answers in its own thread."""
    loop = asyncio.get_running_loop()
    found_by = loop.time() + DISCOVERY
    while not client.service_is_ready():  # each service is found by itself, some later than others
        if loop.time() > found_by:
            return None
        await asyncio.sleep(0.05)
    arrived: asyncio.Future[Any] = loop.create_future()

    def settle(response: Any) -> None:
        if not arrived.done():
            arrived.set_result(response)

    future = client.call_async(request)
    future.add_done_callback(lambda done: loop.call_soon_threadsafe(settle, done.result()))
    try:
        return await asyncio.wait_for(arrived, PATIENCE)
    except TimeoutError:
        client.remove_pending_request(future)
        return None
