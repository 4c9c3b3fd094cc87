"""One rock, one entry: lines of sight over time, joined by an information filter.

A track is a point in space. Each line of sight says nothing of how far away it is and much of where
it is across the line, so a few frames from different places find it by triangulation. One from a
single place still has a range, by how high samples are; that height is a property of the rock and
the same in all frames, so it enters once, as the track's prior.

Lines to two rocks cross as well, where there is none. So a rock whose range is not known yet is
followed along its line of sight only, and one is believed only if its lines meet in one point.
"""

from __future__ import annotations

import math

import numpy as np

from rover_common.types import RockTrack
from rover_perception.tracking.rock_detection import MIDDLE_HEIGHT, RockSighting

GATE = 3.0  # standard deviations within which a sighting belongs to a rock
MIN_GATE = 0.5  # [m]; rocks are nowhere nearer to each other than this
# A rock is believed when several frames agree on where it is.
BELIEVED_OBSERVATIONS = 4
# [m] standard deviation in its worst direction. It is stated with care: on generated canyons the
# rocks below were at most 0.42 m off, of those below 1 m two were not within 0.5 m.
BELIEVED_ERROR = 0.8
BELIEVED_MISFIT = 3.0  # standard deviations of chi-square above its mean
# A rock is followed along lines of sight that differ by less than this until it is located so well.
SAME_SIDE = math.cos(math.radians(30.0))
LOCATED_ERROR = 0.4  # [m]
# Errors of one place repeat from frame to frame, so a rock is never known better than this.
LEAST_VARIANCE = 0.1**2  # [m^2]
# A sample's middle is at 0.045 to 0.085 m, more when its lower part is buried in the wall's foot.
HEIGHT_ERROR = 0.025  # [m] of the height of its middle
PLANE = np.array([0.0, 0.0, 1.0, -MIDDLE_HEIGHT]) / HEIGHT_ERROR
PRIOR = np.outer(PLANE, PLANE)  # the quadric of a plane at that height


class _Track:
    """What the lines of sight of one rock say together.

    quadric: (4, 4) of the square distance of a point from all of the lines, in standard deviations:
    for a point p [m] it is (p, 1)' quadric (p, 1). They add up (Garland and Heckbert, 1997).
    """

    def __init__(self, id: int, sighting: RockSighting, stamp: int) -> None:
        across = np.eye(3) - np.outer(sighting.direction, sighting.direction)
        offset = np.column_stack([across, -across @ sighting.origin]) / sighting.error
        self.id = id
        self.quadric = offset.T @ offset
        self.observations = 1
        self.direction = sighting.direction  # of the newest line
        self.last_seen = stamp  # [ns]
        self._solve()

    def join(self, other: _Track) -> None:
        self.quadric = self.quadric + other.quadric
        self.observations += other.observations
        if other.last_seen >= self.last_seen:
            self.direction, self.last_seen = other.direction, other.last_seen
        self._solve()

    def _solve(self) -> None:
        total = self.quadric + PRIOR
        covariance = np.linalg.inv(total[:3, :3])
        point = np.append(-covariance @ total[:3, 3], 1.0)
        misfit = float(point @ total @ point)  # chi-square
        freedom = 2 * self.observations - 2  # two per line and the height, less the point's three
        self.position = point[:2]  # [m] map frame
        self.covariance = covariance[:2, :2] + LEAST_VARIANCE * np.eye(2)  # [m^2]
        self.error = math.sqrt(np.linalg.eigvalsh(self.covariance)[-1])  # [m] where it is largest
        self.fits = misfit <= freedom + BELIEVED_MISFIT * math.sqrt(2 * freedom)

    @property
    def believed(self) -> bool:
        seen = self.observations >= BELIEVED_OBSERVATIONS
        return seen and self.error < BELIEVED_ERROR and self.fits

    def near(self, other: _Track) -> bool:
        """Whether both can be one rock."""
        offset = self.position - other.position
        if np.hypot(*offset) < MIN_GATE:
            return True
        located = min(self.error, other.error) < LOCATED_ERROR
        if not located and self.direction @ other.direction < SAME_SIDE:
            return False
        joint = self.covariance + other.covariance
        return bool(offset @ np.linalg.solve(joint, offset) < GATE**2)


class RockTracks:
    """All rocks seen so far."""

    def __init__(self) -> None:
        self._tracks: list[_Track] = []
        self._next_id = 1
        self._believed: tuple[RockTrack, ...] = ()

    def add(self, sightings: tuple[RockSighting, ...], stamp: int) -> None:
        """Add the sightings of one frame, taken at `stamp` [ns]."""
        for sighting in sightings:
            seen = _Track(self._next_id, sighting, stamp)
            match = self._nearest(seen)
            if match is None:
                self._tracks.append(seen)
                self._next_id += 1
            else:
                match.join(seen)
                self._merge(match)

        self._believed = tuple(_rock(track) for track in self._tracks if track.believed)

    def believed(self) -> tuple[RockTrack, ...]:
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


def _rock(track: _Track) -> RockTrack:
    x, y = track.position
    (xx, xy), (yx, yy) = track.covariance
    covariance = (float(xx), float(xy), float(yx), float(yy))
    return RockTrack(track.id, float(x), float(y), covariance, track.observations, track.last_seen)
