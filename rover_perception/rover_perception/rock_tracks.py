"""One rock, one entry: lines of sight over time, joined by an information filter.

A track is a point in space. Each line of sight says nothing of how far away it is and much of where
it is across the line, so a few frames from different places find it by triangulation. One from a
single place still has a range, by how high samples are; that height is a property of the rock and
the same in all frames, so it enters once, as the track's prior.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.dataflow import Rock
from rover_perception.rock_detection import MIDDLE_HEIGHT, RockSighting

GATE = 3.0  # standard deviations within which a sighting belongs to a rock
MIN_GATE = 0.5  # [m]; rocks are nowhere nearer to each other than this
# A rock is believed when several frames agree on where it is.
BELIEVED_OBSERVATIONS = 4
BELIEVED_ERROR = 0.5  # [m] standard deviation in its worst direction
# Errors of one place repeat from frame to frame, so a rock is never known better than this.
LEAST_VARIANCE = 0.1**2  # [m^2]
# A sample's middle is at 0.045 to 0.085 m, more when its lower part is buried in the wall's foot.
HEIGHT_ERROR = 0.025  # [m] of the height of its middle
PRIOR = np.diag([0.0, 0.0, 1.0 / HEIGHT_ERROR**2])
PRIOR_VECTOR = PRIOR @ (0.0, 0.0, MIDDLE_HEIGHT)


@dataclass
class _Track:
    id: int
    information: NDArray[np.floating]  # (3, 3) [1/m^2] of the lines of sight, without the prior
    vector: NDArray[np.floating]  # (3,) information times position
    observations: int
    last_seen: int  # [ns]

    @classmethod
    def of(cls, id: int, sighting: RockSighting, stamp: int) -> _Track:
        across = np.eye(3) - np.outer(sighting.direction, sighting.direction)
        information = across / sighting.error**2
        return cls(id, information, information @ sighting.origin, 1, stamp)

    @property
    def position(self) -> NDArray[np.floating]:
        """(2,) [m] map frame."""
        return np.linalg.solve(self.information + PRIOR, self.vector + PRIOR_VECTOR)[:2]

    @property
    def covariance(self) -> NDArray[np.floating]:
        """(2, 2) [m^2]"""
        return np.linalg.inv(self.information + PRIOR)[:2, :2] + LEAST_VARIANCE * np.eye(2)

    def join(self, other: _Track) -> None:
        self.information = self.information + other.information
        self.vector = self.vector + other.vector
        self.observations += other.observations
        self.last_seen = max(self.last_seen, other.last_seen)

    def near(self, other: _Track) -> bool:
        """Whether both can be one rock."""
        offset = self.position - other.position
        if np.hypot(*offset) < MIN_GATE:
            return True
        joint = self.covariance + other.covariance
        return bool(offset @ np.linalg.solve(joint, offset) < GATE**2)


class RockTracks:
    """All rocks seen so far."""

    def __init__(self) -> None:
        self._tracks: list[_Track] = []
        self._next_id = 1
        self._believed: tuple[Rock, ...] = ()

    def add(self, sightings: tuple[RockSighting, ...], stamp: int) -> None:
        """Add the sightings of one frame, taken at `stamp` [ns]."""
        for sighting in sightings:
            seen = _Track.of(self._next_id, sighting, stamp)
            match = self._nearest(seen)
            if match is None:
                self._tracks.append(seen)
                self._next_id += 1
            else:
                match.join(seen)
                self._merge(match)

        self._believed = tuple(_rock(track) for track in self._tracks if _is_believed(track))

    def believed(self) -> tuple[Rock, ...]:
        """The rocks that enough frames agree on."""
        return self._believed

    def _nearest(self, seen: _Track) -> _Track | None:
        near = [track for track in self._tracks if track.near(seen)]
        return min(
            near, key=lambda track: np.hypot(*(track.position - seen.position)), default=None
        )

    def _merge(self, grown: _Track) -> None:
        """Join the tracks that a better position has shown to be the same rock."""
        for track in [t for t in self._tracks if t is not grown]:
            if track.near(grown):
                first, second = sorted((track, grown), key=lambda t: t.id)
                first.join(second)
                self._tracks.remove(second)
                grown = first


def _is_believed(track: _Track) -> bool:
    worst = float(np.linalg.eigvalsh(track.covariance)[-1])
    return track.observations >= BELIEVED_OBSERVATIONS and worst < BELIEVED_ERROR**2


def _rock(track: _Track) -> Rock:
    x, y = track.position
    (xx, xy), (yx, yy) = track.covariance
    covariance = (float(xx), float(xy), float(yx), float(yy))
    return Rock(track.id, float(x), float(y), covariance, track.observations, track.last_seen)
