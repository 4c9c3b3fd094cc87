"""What a node says in /diagnostics: its counters, troubles and inputs, and its team's health.

Names are those of diagnostic_updater: `/bridge_node` is the node, `/bridge_node: cmd_drive` a part.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.subscription import Subscription

from rover_common.health import Finding, Level, TeamHealth
from rover_common.input_monitor import Input, InputMonitor, InputReport
from rover_common.ros import qos
from rover_common.ros.checked_node import CheckedNode
from rover_common.tick_times import TickTimes

PERIOD = 0.25  # [s] between two reports
PEERS = "peers"  # the part that says who is not connected
TEAM_STATUS = "rover"  # the name of the team's status


def input_of(name: str, subscription: Subscription, source: str, pause: float = 0.0) -> Input:
    """A topic that this node hears; the last two as of an Input."""
    return Input(name, source, lambda: subscription.get_publisher_count() > 0, pause)


class NodeDiagnostics:
    """Publishes the node's counters, troubles and inputs, and whether its peers are connected.

    `peers` maps a peer's name to a function that tells whether it is connected; until all are, the
    level is WARN. `counts` is the node's own: count events with `diagnostics.counts["name"] += 1`.
    It is that of a CheckedNode, whose refused messages are drops of its inputs. Other troubles are
    set by name, and taken away with an empty text. `before_report` is called with the time [s] of
    the steady clock before the inputs are judged. `state` is what the node does, in a word; work
    within `with diagnostics.ticks:` is measured.
    """

    def __init__(
        self,
        node: Node,
        peers: Mapping[str, Callable[[], bool]],
        inputs: InputMonitor | None = None,
        before_report: Callable[[float], None] = lambda now: None,
    ) -> None:
        self.counts: Counter[str] = node.counts if isinstance(node, CheckedNode) else Counter()
        if isinstance(node, CheckedNode) and inputs is not None:
            node.on_refused = partial(_drop, inputs)
        self.state = ""
        self.ticks = TickTimes()
        self._tick_texts: dict[str, str] = {}  # of the last report with a tick
        self._node = node
        self._peers = dict(peers)
        self._inputs = inputs
        self._before_report = before_report
        self._team: TeamDiagnostics | None = None
        self._warnings: dict[str, str] = {}
        self._errors: dict[str, str] = {}
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
        # Wall time: it must go on while the simulated clock stands still.
        self._timer = node.create_timer(
            PERIOD, self._report, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )

    def join(self, team: Sequence[str], silent_age: float) -> None:
        """Hear the other nodes of this team, and speak for it when it is this node's turn.

        silent_age: [s] without a report after which a node is silent.
        """
        self._team = TeamDiagnostics(self._node, team, silent_age)

    def set_warning(self, name: str, text: str) -> None:
        """Something that a person should know; an empty text ends it."""
        self._warnings[name] = text

    def set_error(self, name: str, text: str) -> None:
        """Something that keeps the node from its work; an empty text ends it."""
        self._errors[name] = text

    def _report(self) -> None:
        now = time.monotonic()
        self._before_report(now)
        inputs = [] if self._inputs is None else self._inputs.reports(now)
        message = DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        own = self._findings()
        name = self._node.get_fully_qualified_name()
        message.status = [
            self._summary([*own, *(each.finding for each in inputs)]),
            *(_status(f"{name}: {each.name}", each.level, each.text) for each in own),
            *(_input_status(name, each) for each in inputs),
        ]
        if self._team is not None:
            message.status += self._team.status(now)
        self._publisher.publish(message)

    def _findings(self) -> list[Finding]:
        missing = [name for name, connected in self._peers.items() if not connected()]
        waiting = f"waiting for {', '.join(missing)}" if missing else ""
        return [
            *(_trouble(name, Level.ERROR, text) for name, text in self._errors.items()),
            *(_trouble(name, Level.WARN, text) for name, text in self._warnings.items()),
            _trouble(PEERS, Level.WARN, waiting),
        ]

    def _summary(self, findings: Sequence[Finding]) -> DiagnosticStatus:
        """The node's own status: the worst level, the worst text first."""
        troubles = sorted(
            (each for each in findings if each.level > Level.OK), key=lambda each: -each.level
        )
        own = (*self._errors, *self._warnings, PEERS)
        texts = [t.text if t.name in own else f"{t.name}: {t.text}" for t in troubles]
        status = _status(
            self._node.get_fully_qualified_name(),
            max((each.level for each in troubles), default=Level.OK),
            "; ".join(texts) or "connected",
        )
        values = {**self.counts, **self._tick_values()}
        if self.state:
            values["state"] = self.state
        status.values = [KeyValue(key=k, value=str(v)) for k, v in sorted(values.items())]
        return status

    def _tick_values(self) -> dict[str, str]:
        if (taken := self.ticks.take()) is not None:
            mean, longest = (f"{1e3 * each:.1f}" for each in taken)
            self._tick_texts = {"tick time [ms]": mean, "longest tick [ms]": longest}
        return self._tick_texts


class TeamDiagnostics:
    """The health of a team, of which each node hears and the first that is not silent speaks."""

    def __init__(self, node: Node, team: Sequence[str], silent_age: float) -> None:
        space = node.get_namespace().rstrip("/")
        self._me = node.get_fully_qualified_name()
        self._name = f"{space}/{TEAM_STATUS}"
        self._health = TeamHealth([f"{space}/{name}" for name in team], silent_age)
        node.create_subscription(
            DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS
        )

    def status(self, now: float) -> list[DiagnosticStatus]:
        """That of the team, if this node speaks for it."""
        if self._health.speaker(now) != self._me:
            return []
        health = self._health.state(now)
        return [_status(self._name, health.level, health.text.removeprefix("/"))]

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        now, name = time.monotonic(), ""
        findings: list[Finding] = []
        for status in message.status:
            node, _, part = status.name.partition(": ")
            name = name or node
            if part and node == name:
                findings.append(_finding_of(part, status, name))
        self._health.hear(name, findings, now)


def _drop(inputs: InputMonitor, topic: str, why: str) -> None:
    if topic in inputs.names:
        inputs.drop(topic, time.monotonic(), why)


def _trouble(name: str, level: Level, text: str) -> Finding:
    return Finding(name, level if text else Level.OK, text)


def _status(name: str, level: Level, text: str) -> DiagnosticStatus:
    return DiagnosticStatus(level=bytes([level]), name=name, message=text)


def _input_status(node: str, report: InputReport) -> DiagnosticStatus:
    finding = report.finding
    status = _status(f"{node}: {finding.name}", finding.level, finding.text)
    values = {
        "source": finding.source,
        "age [s]": "" if report.age is None else f"{report.age:.2f}",
        "rate [1/s]": f"{report.rate:.1f}",
        "received": report.received,
        "dropped": report.dropped,
    }
    status.values = [KeyValue(key=key, value=str(value)) for key, value in values.items()]
    return status


def _finding_of(part: str, status: DiagnosticStatus, node: str) -> Finding:
    source = next((pair.value for pair in status.values if pair.key == "source"), "")
    space = node.rpartition("/")[0]
    level = Level(min(status.level[0], Level.ERROR))  # others may have more
    return Finding(part, level, status.message, f"{space}/{source}" if source else "")
