"""Names of the bridge's counters in /diagnostics; those of defects in a telemetry are in errors."""

from __future__ import annotations

from enum import StrEnum


class Counter(StrEnum):
    """Counts events of the node, but for `RUNS`, which is a number."""

    CONNECTIONS = "connections"  # clients that have connected
    CONNECTIONS_REFUSED = "connections_refused"  # connections, requests and sessions
    TAKEOVERS = "takeovers"  # active clients that another one replaced
    PROTOCOL_ERRORS = "protocol_errors"  # messages that are no packet of either protocol
    TELEMETRIES = "telemetries"  # decoded and published
    RUNS = "runs"  # number of the present run

    # How a telemetry was answered
    ANSWERED = "answered"  # with the decision on it
    DEADLINE_MISSED = "deadline_missed"  # with the brake: no decision in time
    SECOND_CLIENT = "second_client"  # with the brake: another client is active
    INACTIVE = "inactive"  # with the brake: the node is not active
    OVERLOADED = "overloaded"  # with the brake: too many requests are pending
    UNCONFIRMED = "unconfirmed"  # with the brake: it contradicts those before it
    FAILED = "failed"  # with the brake: the node could not handle it, which is a defect of the node
    PICKUP_SENT = "pickup_sent"  # with a pickup
    PICKUP_REFUSED = "pickup_refused"  # with the brake: nothing in reach, or the rover moves
    PICKUP_ALREADY_RUNNING = "pickup_already_running"  # with the brake

    COMMANDS_LATE = "commands_late"  # for a telemetry that had its answer already
