"""What the mission says, as messages; stamps are [ns]."""

from __future__ import annotations

from geometry_msgs.msg import Point
from rover_interfaces.msg import HeatSource as HeatSourceMsg
from rover_interfaces.msg import HeatSourceArray, HeatState

from rover_common.frames import FRAMES, Frames
from rover_common.ros.conversions import header_of
from rover_common.types import Run
from rover_heat.types import HeatDecision, HeatSource


def heat_state_of(
    stamp: int, run: Run, decision: HeatDecision, frames: Frames = FRAMES
) -> HeatState:
    progress = decision.progress
    return HeatState(
        header=header_of(stamp, frames.map),
        state=int(decision.state),
        run=run.number,
        state_name=decision.state.name,
        reason=decision.reason,
        elapsed=progress.elapsed,
        explored=progress.explored,
        sources_known=progress.sources_known,
        sources_delivered=progress.sources_delivered,
        payloads=progress.payloads,
        interrupts=progress.interrupts,
        ramp_known=progress.ramp_known,
        ramp_done=progress.ramp_done,
        distance=progress.distance,
    )


def heat_sources_of(
    stamp: int, run: Run, sources: tuple[HeatSource, ...], frames: Frames = FRAMES
) -> HeatSourceArray:
    """All of a run."""
    return HeatSourceArray(
        header=header_of(stamp, frames.map),
        run=run.number,
        sources=[
            HeatSourceMsg(
                id=source.id,
                position=Point(x=source.x, y=source.y, z=0.0),
                covariance=source.covariance,
                side=source.normal,
                observations=source.observations,
                peak=source.peak,
                delivered=source.delivered,
            )
            for source in sources
        ],
    )
