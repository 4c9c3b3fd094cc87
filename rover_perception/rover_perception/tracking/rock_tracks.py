"""RockTrack tracks: lines of sight of several frames, fused by an information filter.

A track is a point in space. A line of sight locates the rock across the line but not along it, so
frames from different positions locate it by triangulation. From a single position the range follows
from the height of samples. That height is a property of the rock and the same in all frames, so it
enters once, as the track's prior.

Lines to two different rocks intersect as well, where there is no rock. Therefore a track whose
range is still unknown is only associated along its line of sight, and a track is confirmed only
when its lines meet in one point.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rover_common.types import RockTrack
from rover_perception.tracking.rock_detection import MIDDLE_HEIGHT, RockSighting

GATE = 3.0  # standard deviations within which a sighting is associated with a track
MIN_GATE = 0.5  # [m]; no two rocks are closer to each other than this
# A track is confirmed when several frames agree on its position.
CONFIRMED_OBSERVATIONS = 4
# [m] standard deviation in the worst direction. It is conservative: on generated canyons, tracks
# below it were at most 0.42 m off; two of those below 1 m were more than 0.5 m off.
CONFIRMED_ERROR = 0.8
CONFIRMED_MISFIT = 3.0  # standard deviations of chi-square above its mean
# Until a track is located to LOCATED_ERROR, only lines of sight within this angle are associated.
SAME_SIDE = math.cos(math.radians(30.0))
LOCATED_ERROR = 0.4  # [m]
# Errors at one position repeat from frame to frame, so they set a lower bound on the variance.
LEAST_VARIANCE = 0.1**2  # [m^2]
# A sample's middle is at 0.045 to 0.085 m, more when its lower part is buried in a wall's base.
HEIGHT_ERROR = 0.025  # [m] of the height of its middle
PLANE = np.array([0.0, 0.0, 1.0, -MIDDLE_HEIGHT]) / HEIGHT_ERROR
PRIOR = np.outer(PLANE, PLANE)  # the quadric of a plane at that height


class Track:
    """One rock: what its lines of sight say together.

    quadric: (4, 4) of the squared distance of a point from all lines, in standard deviations: for a
    point p [m] it is (p, 1)' quadric (p, 1). Quadrics add up (Garland and Heckbert, 1997).
    """

    def __init__(self, id: int, sighting: RockSighting, stamp: int) -> None:
        """A tentative track of one sighting, seen at `stamp` [ns]."""
        across = np.eye(3) - np.outer(sighting.direction, sighting.direction)
        offset = np.column_stack([across, -across @ sighting.origin]) / sighting.error
        self.id = id
        self.quadric = offset.T @ offset
        self.observations = 1
        self.direction = sighting.direction  # of the newest line
        self.last_seen = stamp  # [ns]
        self._solve()

    def join(self, other: Track) -> None:
        """Add all lines of another track."""
        self.quadric = self.quadric + other.quadric
        self.observations += other.observations
        if other.last_seen >= self.last_seen:
            self.direction, self.last_seen = other.direction, other.last_seen
        self._solve()

    def memory(self) -> dict[str, Any]:
        """What it is made of, for JSON."""
        return {
            "id": self.id,
            "quadric": self.quadric.tolist(),
            "observations": self.observations,
            "direction": self.direction.tolist(),
            "last_seen": self.last_seen,
        }

    @classmethod
    def of_memory(cls, memory: dict[str, Any]) -> Track:
        """The inverse of `memory`."""
        track = cls.__new__(cls)
        track.id = int(memory["id"])
        track.quadric = np.array(memory["quadric"], float).reshape(4, 4)
        track.observations = int(memory["observations"])
        track.direction = np.array(memory["direction"], float).reshape(3)
        track.last_seen = int(memory["last_seen"])
        track._solve()
        return track

    def _solve(self) -> None:
        total = self.quadric + PRIOR
        covariance = np.linalg.inv(total[:3, :3])
        point = np.append(-covariance @ total[:3, 3], 1.0)
        misfit = float(point @ total @ point)  # chi-square
        freedom = 2 * self.observations - 2  # two per line, one for the height, less three unknowns
        self.position = point[:2]  # [m] map frame
        self.covariance = covariance[:2, :2] + LEAST_VARIANCE * np.eye(2)  # [m^2]
        self.error = math.sqrt(
            np.linalg.eigvalsh(self.covariance)[-1]
        )  # [m] in the worst direction
        self.fits = misfit <= freedom + CONFIRMED_MISFIT * math.sqrt(2 * freedom)

    @property
    def confirmed(self) -> bool:
        """Whether enough lines agree on the position; a tentative track is not reported."""
        enough = self.observations >= CONFIRMED_OBSERVATIONS
        return enough and self.error < CONFIRMED_ERROR and self.fits

    def near(self, other: Track) -> bool:
        """Whether both can be the same rock."""
        offset = self.position - other.position
        if np.hypot(*offset) < MIN_GATE:
            return True
        located = min(self.error, other.error) < LOCATED_ERROR
        if not located and self.direction @ other.direction < SAME_SIDE:
            return False
        joint = self.covariance + other.covariance
        return bool(offset @ np.linalg.solve(joint, offset) < GATE**2)

    def report(self) -> RockTrack:
        """The track as it is reported."""
        x, y = self.position.tolist()
        (xx, xy), (yx, yy) = self.covariance.tolist()
        return RockTrack(self.id, x, y, (xx, xy, yx, yy), self.observations, self.last_seen)


class RockTracks:
    """The tracks of one run, tentative and confirmed."""

    def __init__(self) -> None:
        self.tracks: list[Track] = []
        self._next_id = 1
        self._confirmed: tuple[RockTrack, ...] = ()

    def add(self, sightings: tuple[RockSighting, ...], stamp: int) -> None:
        """Associate the sightings of one frame, taken at `stamp` [ns], with tracks."""
        for sighting in sightings:
            new = Track(self._next_id, sighting, stamp)
            match = self._nearest(new)
            if match is None:
                self.tracks.append(new)
                self._next_id += 1
            else:
                match.join(new)
                self._merge(match)
        if sightings:
            self._report()

    def memory(self) -> dict[str, Any]:
        """All tracks, for JSON."""
        return {"next_id": self._next_id, "tracks": [track.memory() for track in self.tracks]}

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        tracks = [Track.of_memory(track) for track in memory["tracks"]]
        self._next_id, self.tracks = int(memory["next_id"]), tracks
        self._report()

    def confirmed(self) -> tuple[RockTrack, ...]:
        """The rocks that enough frames agree on."""
        return self._confirmed

    def _report(self) -> None:
        self._confirmed = tuple(track.report() for track in self.tracks if track.confirmed)

    def _nearest(self, new: Track) -> Track | None:
        near = [track for track in self.tracks if track.near(new)]
        return min(near, key=lambda track: np.hypot(*(track.position - new.position)), default=None)

    def _merge(self, updated: Track) -> None:
        """Join the tracks that the better position shows to be the same rock."""
        for track in [track for track in self.tracks if track is not updated]:
            if track.near(updated):
                first, second = sorted((track, updated), key=lambda track: track.id)
                first.join(second)
                self.tracks.remove(second)
                updated = first
