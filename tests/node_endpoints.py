"""The topics of a node as a README lists them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from rclpy.qos import QoSProfile
from readme_tables import table

from rover_common.ros import qos

# What rclpy itself adds to a node: always, or with an action server or simulated time.
OF_RCLPY = ("/rosout", "/parameter_events", "/clock")
OF_AN_ACTION = "/_action/"
PROFILES = {name: value for name, value in vars(qos).items() if isinstance(value, QoSProfile)}

Endpoint = tuple[str, str, str]  # topic, `package/Name`, name of the QoS profile


def endpoints(of_node: Iterable[Any]) -> set[Endpoint]:
    """Of a node's publishers or subscriptions, without leading slashes."""
    return {
        (endpoint.topic_name.lstrip("/"), _type_of(endpoint), _profile_of(endpoint))
        for endpoint in of_node
        if _is_of_the_node(endpoint)
    }


def listed(readme: Path, heading: str) -> set[Endpoint]:
    """Those of the table below a heading."""
    return {(row["topic"].lstrip("/"), row["type"], row["QoS"]) for row in table(readme, heading)}


def _is_of_the_node(endpoint: Any) -> bool:
    ours = any(value is endpoint.qos_profile for value in PROFILES.values())
    return ours or not (endpoint.topic_name in OF_RCLPY or OF_AN_ACTION in endpoint.topic_name)


def _type_of(endpoint: Any) -> str:
    kind = endpoint.msg_type
    return f"{kind.__module__.split('.')[0]}/{kind.__name__}"


def _profile_of(endpoint: Any) -> str:
    return next(name for name, value in PROFILES.items() if value is endpoint.qos_profile)
