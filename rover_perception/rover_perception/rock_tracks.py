"""One rock, one entry: sightings over time, joined by an information filter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.dataflow import Rock
from rover_perception.rock_detection import RockSighting

GATE = 3.0  # standard deviations within which a sighting belongs to a rock
MIN_GATE = 0.5  # [m]; rocks are nowhere nearer to each other than this
# A rock is believed when several frames agree on where it is.
BELIEVED_OBSERVATIONS = 4
BELIEVED_ERROR = 0.5  # [m] standard deviation in its worst direction
# Errors of one place repeat from frame to frame, so a rock is never known better than this.
LEAST_VARIANCE = 0.1**2  # [m^2]


@dataclass
class _Track:
    id: int
    information: NDArray[np.floating]  # (2, 2) [1/m^2]
    vector: NDArray[np.floating]  # (2,) information times position
    observations: int
    last_seen: int  # [ns]

    @property
    def position(self) -> NDArray[np.floating]:
        return np.linalg.solve(self.information, self.vector)

    @property
    def covariance(self) -> NDArray[np.floating]:
        return np.linalg.inv(self.information) + LEAST_VARIANCE * np.eye(2)

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

    def add(self, sightings: tuple[RockSighting, ...], stamp: int) -> None:
        """Add the sightings of one frame, taken at `stamp` [ns]."""
        for sighting in sightings:
            information = np.linalg.inv(sighting.covariance)
            position = np.array([sighting.x, sighting.y])
            seen = _Track(self._next_id, information, information @ position, 1, stamp)
            match = self._nearest(seen)
            if match is None:
                self._tracks.append(seen)
                self._next_id += 1
            else:
                match.join(seen)
                self._merge(match)

    def believed(self) -> tuple[Rock, ...]:
        """The rocks that enough frames agree on."""
        return tuple(_rock(track) for track in self._tracks if _is_believed(track))

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
