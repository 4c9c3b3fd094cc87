"""Rendered images: sky above, bright sand below, dark walls between, as measured."""

import math

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.sensors.shading import sky_colors
from rover_simulator.world.generator import generate_world
from rover_simulator.world.terrain import COUNT, SAMPLE_GROUND, SPACING, Terrain
from rover_simulator.world.wall_profile import height_at, spread_at
from rover_simulator.world.world import World

HALL = np.zeros((200, 200), bool)
HALL[60:141, 60:141] = True
START = Pose(100, 100, 0)


@pytest.fixture(scope="module")
def terrain() -> Terrain:
    return Terrain.of(HALL, relief=np.ones((COUNT, COUNT)))


@pytest.fixture(scope="module")
def renderer(terrain: Terrain) -> Renderer:
    return Renderer(World("hall", HALL, np.array([[103.0, 100.0]]), START), terrain)


@pytest.mark.parametrize("yaw_deg", range(-180, 180, 60))
def test_sky_above_walls_above_sand(renderer, yaw_deg):
    image = renderer.render(Pose(100, 100, math.radians(yaw_deg))).image.astype(int)
    red, warmth = image[..., 0], image[..., 0] - image[..., 2]
    assert ((red[:8] > 96) & (red[:8] < 190) & (warmth[:8] < 25)).all()
    assert np.median(red[70:78]) < 90
    assert np.median(red[100:]) > 190


def test_the_nose_down_shows_the_horizon_higher(renderer):
    def horizon(pose: Pose) -> int:
        red = renderer.render(pose).image[:, 40, 0]
        return int(np.argmax(red > 190))

    level, down = horizon(START), horizon(Pose(100, 100, 0, pitch=math.radians(5)))
    assert level - down == pytest.approx(10, abs=1.5)  # 2 pixels a degree


@pytest.mark.parametrize(
    ("bearing_deg", "color"),
    # From the sun's azimuth: the sand in front of the wheels, by the direction of the view.
    [(155, (252, 245, 234)), (75, (233, 214, 200)), (-60, (233, 214, 200))],
)
def test_lit_sand_by_the_angle_to_the_sun(renderer, bearing_deg, color):
    pose = Pose(100, 90, math.radians(300 + bearing_deg))
    sand = renderer.render(pose).image[120:150, 140:180]
    assert sand.mean(axis=(0, 1)) == pytest.approx(color, abs=12)


@pytest.mark.parametrize(
    ("elevation_deg", "red"), [(14, 157), (18, 145), (22, 135), (34, 118)]
)  # means over all azimuths that recordings show
def test_sky_darkens_upward(elevation_deg, red):
    azimuth = np.radians(np.arange(0, 360, 5.0))
    elevation = math.radians(elevation_deg)
    level = np.stack([np.cos(azimuth), np.sin(azimuth)]) * math.cos(elevation)
    rays = np.vstack([level, np.full(len(azimuth), math.sin(elevation))])
    assert sky_colors(rays.astype(np.float32))[0].mean() == pytest.approx(red, abs=8)


def test_a_wall_hides_nothing_from_inside(renderer, terrain):
    inside = Pose(144.0, 100.0, math.pi)  # three metres into the hall's east wall, looking back
    assert terrain.height_at(np.array([143.6]), np.array([100.0]))[0] > 3.0
    out = renderer.render(inside).image.astype(int)
    before = renderer.render(Pose(140.0, 100.0, math.pi)).image.astype(int)
    # what is far away looks the same from in there, and where the floor ends below is sky
    assert np.abs(out[:76] - before[:76]).mean() < 12.0
    red, blue = out[-20:, :, 0], out[-20:, :, 2]
    assert ((red > 96) & (red < 190) & (red - blue < 25)).all()
    sand = out[82:88, 140:180, 0]
    assert np.median(sand) > 190


def test_a_sample_shows_yellow_and_is_counted(renderer):
    rendering = renderer.render(Pose(101.5, 100, 0))
    image = rendering.image.astype(int)
    yellow = (image[..., 0] - image[..., 2] > 100).sum()
    assert rendering.sample_pixels[0] == yellow > 50


def test_rays_to_the_bare_floor_need_no_search(renderer, monkeypatch):
    pose = Pose(110, 95, 0.4, 0.02, -0.01)
    short = renderer.render(pose).image.astype(int)
    monkeypatch.setattr(renderer._scene, "_bare_radius", lambda origin: 0.0)
    assert np.abs(short - renderer.render(pose).image).max() <= 1


def test_objects_are_traced_in_every_column_that_shows_them(terrain, monkeypatch):
    ground = HALL.copy()
    ground[100, 104] = False  # a boulder
    renderer = Renderer(World("objects", ground, np.array([[98.0, 99.0]]), START), terrain)
    random = np.random.default_rng(0)
    poses = [
        Pose(x - away * math.cos(yaw), y - away * math.sin(yaw), yaw + aside, pitch, roll)
        for x, y in ((104.5, 100.5), (98.0, 99.0))
        for away in (0.2, 0.8, 5.0)
        for yaw in (-2.0, 0.5)
        for aside in (-0.9, 0.0, 0.9)
        for pitch, roll in random.normal(0.0, 0.1, (1, 2))
    ]
    quick = [renderer.render(pose) for pose in poses]
    monkeypatch.setattr(renderer._scene, "_columns_with_objects", lambda *_: np.ones(320, bool))
    for pose, rendering in zip(poses, quick, strict=True):
        assert np.array_equal(rendering.image, renderer.render(pose).image)


def test_heights_follow_the_profile_and_the_seed():
    beyond = np.array([0.5, 1.0, 3.0, 10.0])
    assert height_at(beyond) == pytest.approx([0.26, 1.02, 6.1, 18.7])
    canyon = generate_world(4).navigable
    medians = Terrain.of(canyon, relief=np.ones((COUNT, COUNT))).heights
    drawn = Terrain.of(canyon, 7).heights
    walls = medians > 5.0
    spread = np.log(drawn[walls] / medians[walls])
    assert abs(np.median(spread)) < 0.15
    assert spread.std() == pytest.approx(spread_at(np.array(9.0)), abs=0.08)
    assert (drawn[medians == 0.0] == 0.0).all()
    assert (drawn == Terrain.of(canyon, 7).heights).all()
    assert (drawn != Terrain.of(canyon, 8).heights).any()


def test_the_height_at_one_point_is_that_of_many_to_the_bit():
    terrain = Terrain.of(HALL, 3)
    x, y = np.random.default_rng(0).uniform(-1.0, 201.0, (2, 2000))
    x[:500], y[:500] = np.round(x[:500]), np.round(y[:500] / SPACING) * SPACING  # grid lines
    heights = terrain.height_at(x, y)
    assert (heights > 0.0).sum() > 1000
    assert [terrain.height_at_point(*point) for point in zip(x, y, strict=True)] == heights.tolist()


def test_samples_stand_where_the_ground_is_low_and_show():
    sample = np.array([[141.9, 101.3]])  # at the base of the hall's east wall
    plain = Terrain.of(HALL, 3)
    low = Terrain.of(HALL, 3, samples=sample)
    assert plain.height_at(sample[:, 0], sample[:, 1]) > 0.2
    assert low.height_at(sample[:, 0], sample[:, 1]) <= SAMPLE_GROUND
    at = np.arange(COUNT) * SPACING
    away = np.hypot(*np.meshgrid(at - sample[0, 0], at - sample[0, 1]))
    assert (low.heights <= plain.heights).all()
    assert (low.heights == plain.heights)[away > 2.0].all()
    world = World("hall", HALL, sample, START)
    seen = Renderer(world, low).render(Pose(138.5, 101.3, 0.0))
    assert seen.sample_pixels[0] >= 4


def test_skylines_are_round():
    """Neighbouring heights differ by slopes, not by noise."""
    heights = Terrain.of(HALL, 3).heights.astype(float)
    far = heights[:100]  # the plateau, more than 20 m from the floor
    assert np.abs(np.diff(far, axis=1)).max() < 0.39 * 2.0
    assert np.abs(np.diff(far, 2, axis=1)).mean() < 0.05
