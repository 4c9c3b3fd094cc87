"""The house rules that a machine can check."""

from __future__ import annotations

import ast
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import MISSING, fields
from pathlib import Path

import networkx
import pytest
import yaml

from burger_simulator.config import BurgerConfig, SensorFrameConfig
from rover_bridge.config import BridgeConfig, CameraFrameConfig
from rover_common.frames import BurgerFrameConfig, FrameConfig
from rover_common.input_monitor import InputLimits
from rover_common.ros.lifecycle import LifecycleConfig
from rover_dashboard.config import DashboardConfig
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_heat.node_config import HeatNodeConfig
from rover_navigation.node_config import NavigatorNodeConfig
from rover_perception.config import PerceptionConfig
from rover_recorder.config import RecorderConfig
from rover_simulator.config import SimulatorConfig

grimp = pytest.importorskip("grimp", reason="the lint tools are on the other platform")

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = sorted(path.parent.name for path in ROOT.glob("*/package.xml"))
MODULES = sorted(path for name in PACKAGES for path in (ROOT / name / name).rglob("*.py"))
TESTS = sorted((ROOT / "tests").rglob("*.py"))
FILE_LINES, FUNCTION_LINES = 250, 45
CONFIGS = {
    "bridge_node": (BridgeConfig, InputLimits, LifecycleConfig, CameraFrameConfig),
    "perception_node": (PerceptionConfig, InputLimits, FrameConfig),
    "decision_node": (DecisionConfig, InputLimits, FrameConfig),
    "simulator_node": (SimulatorConfig, LifecycleConfig),
    "dashboard_node": (DashboardConfig,),
    "recorder_node": (RecorderConfig,),
    "heat_node": (HeatNodeConfig, InputLimits, BurgerFrameConfig),
    "burger_node": (BurgerConfig, LifecycleConfig, SensorFrameConfig),
    "navigator_node": (NavigatorNodeConfig, InputLimits, BurgerFrameConfig),
}
FILES = {  # of the others all are in one
    "heat_node": "heat.yaml",
    "burger_node": "burger.yaml",
    "navigator_node": "navigator.yaml",
}
MESSAGE_PACKAGES = {
    "action_msgs", "builtin_interfaces", "diagnostic_msgs", "geometry_msgs", "nav2_msgs",
    "nav_msgs", "rcl_interfaces", "rosgraph_msgs", "rover_interfaces", "sensor_msgs",
    "simulation_interfaces", "std_msgs", "std_srvs", "tf2_msgs", "visualization_msgs",
}  # fmt: skip
# The rosdep key of each library that is imported under another name.
ROSDEP_KEYS = {
    "numpy": "python3-numpy",
    "cv2": "python3-opencv",
    "PIL": "python3-pil",
    "scipy": "python3-scipy",
    "skimage": "python3-skimage",
    "matplotlib": "python3-matplotlib",
    "yaml": "python3-yaml",
    "tqdm": "python3-tqdm",
    "click": "python3-click",
    "dask": "python3-distributed-pip",
    "distributed": "python3-distributed-pip",
    "jinja2": "python3-jinja2",
    "av": "python3-av-pip",
    "networkx": "python3-networkx",
    "tabulate": "python3-tabulate",
    "socketio": "python3-socketio",
    "engineio": "python3-engineio",
    "eventlet": "python3-eventlet",
    "websocket": "python3-websocket",
    "mujoco": "python3-mujoco-core-pip",
    "embreex": "python3-embreex-pip",
    "statemachine": "python3-python-statemachine-pip",
    "aiohttp": "python3-aiohttp",
    "mcap": "python3-mcap-pip",
    "zstandard": "python3-zstandard",
}
WITH_ROSDEP_KEY = set(ROSDEP_KEYS) | MESSAGE_PACKAGES | {"rclpy", "ament_index_python"}


def imports_of(path: Path) -> set[str]:
    """Top-level names of all modules that a file imports."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module.split(".")[0])
    return names


@pytest.mark.parametrize("path", MODULES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_only_nodes_and_conversions_know_ros(path):
    if path.stem in ("node", "conversions") or path.stem.startswith("node_"):
        return
    if path.parent.name == "ros":
        return
    assert not imports_of(path) & (MESSAGE_PACKAGES | {"rclpy"})


@pytest.mark.parametrize(
    "path", [*MODULES, *TESTS], ids=lambda path: f"{path.parent.name}/{path.stem}"
)
def test_files_and_functions_are_short(path):
    text = path.read_text()
    length = len(text.splitlines())
    assert length <= FILE_LINES
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            assert node.end_lineno - node.lineno < FUNCTION_LINES, f"{node.name} is too long"


def test_imports_follow_the_layers():
    """The contracts are in pyproject.toml."""
    program = "from importlinter.cli import lint_imports_command as lint; lint()"
    done = subprocess.run(
        [sys.executable, "-c", program, "--no-cache", "--no-logo"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_circles_between_modules():
    graph = grimp.build_graph(*(p for p in PACKAGES if (ROOT / p / p).is_dir()), cache_dir=None)
    imports = networkx.DiGraph(
        (module, imported)
        for module in graph.modules
        for imported in graph.find_modules_directly_imported_by(module)
    )
    components = networkx.strongly_connected_components(imports)
    assert [sorted(circle) for circle in components if len(circle) > 1] == []


@pytest.mark.parametrize("package", PACKAGES)
def test_package_description(package):
    root = ElementTree.parse(ROOT / package / "package.xml").getroot()
    assert root.get("format") == "3"
    assert root.findtext("name") == package
    assert root.findtext("license") == "Apache-2.0"
    declared = {element.text for element in root if element.tag.endswith("depend")}
    imported = {
        name for path in (ROOT / package / package).rglob("*.py") for name in imports_of(path)
    }
    needed = {name for name in imported if name in WITH_ROSDEP_KEY or name in PACKAGES}
    keys = {ROSDEP_KEYS.get(name, name) for name in needed - {package}}
    assert keys <= declared, f"missing in {package}/package.xml: {sorted(keys - declared)}"


@pytest.mark.parametrize("node", CONFIGS)
def test_the_yaml_lists_every_parameter_with_its_default_and_description(node):
    text = (ROOT / "rover_bringup" / "config" / FILES.get(node, "rover.yaml")).read_text()
    shipped = yaml.safe_load(text)[f"/**/{node}"]["ros__parameters"]
    declared_fields = [field for config in CONFIGS[node] for field in fields(config)]
    declared = {field.name: field.default for field in declared_fields}
    assert MISSING not in declared.values()
    assert shipped == declared
    comments = comments_of(text.split(f"/**/{node}:")[1].split("/**/")[0])
    assert comments == {
        field.name: field.metadata["parameter"].description for field in declared_fields
    }


def comments_of(section: str) -> dict[str, str]:
    """The comment above each parameter of a node's section, joined to one line."""
    comments: dict[str, str] = {}
    above: list[str] = []
    for line in map(str.strip, section.splitlines()):
        if line.startswith("# "):
            above.append(line.removeprefix("# "))
        else:
            comments[line.split(":")[0]] = " ".join(above)
            above = []
    return {name: comment for name, comment in comments.items() if comment}


@pytest.mark.parametrize("arguments", [["check"], ["format", "--check"]], ids=["lint", "format"])
def test_ruff(arguments):
    done = subprocess.run(
        [sys.executable, "-m", "ruff", *arguments, "."], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy():
    done = subprocess.run([sys.executable, "-m", "mypy"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_nothing_names_this_checkout():
    tracked = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split()
    for name in tracked:
        if name.endswith((".py", ".md", ".yaml", ".xml", ".txt", ".sh", ".toml")):
            assert str(ROOT) not in (ROOT / name).read_text(), name
