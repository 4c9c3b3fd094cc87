"""./rover on a machine where something is missing: one clear sentence, and nothing half done."""

from __future__ import annotations

import os
import pty
import re
import subprocess

import pytest
from launcher_machine import PYTHON, ROOT, STEPS, Machine

NO_NETWORK = {
    "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
    "PIP_CONFIG_FILE": "/dev/null",
    "PIP_RETRIES": "0",
    "PIP_NO_CACHE_DIR": "1",
}


@pytest.fixture
def machine(tmp_path):
    return Machine(tmp_path)


def test_doctor_on_a_complete_machine(machine):
    done = machine.rover("doctor")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "missing" not in done.stdout
    assert "to do" in done.stdout


@pytest.mark.parametrize(
    ("tool", "sentence"),
    [
        ("c++", "no C++ compiler here; install g++"),
        ("cmake", "no CMake here; install cmake"),
        ("make", "no make here; install make"),
    ],
)
def test_a_missing_tool_is_one_sentence(machine, tool, sentence):
    machine.without(tool)
    doctor = machine.rover("doctor")
    assert doctor.returncode == 1
    assert sentence in doctor.stdout
    build = machine.rover("build")
    assert build.returncode == 1
    assert build.stderr == f"rover: {sentence}\n"
    assert not (machine.root / ".venv").exists()


@pytest.mark.parametrize("python", ["foo", "/bin/false", "/bin/echo", "a b"])
def test_what_is_no_interpreter_is_told(machine, python):
    done = machine.rover("build", PYTHON=python)
    assert done.returncode == 1
    assert done.stderr == (
        f"rover: PYTHON={python} is not an interpreter that runs; "
        "name Python 3.11 or 3.12, or unset PYTHON\n"
    )


def test_a_platform_has_its_own_folder_and_interpreter(machine):
    machine.replace_steps('mkdir -p "$install"')
    path = machine.bin / "python3.12"
    machine.fake(
        "python3.12",
        'case "$2" in *version_info*) echo Python 3.12;; '
        f'*"print(sys.executable)") echo "{path}";; *) exec {PYTHON} "$@";; esac',
    )
    machine.fake("python3", "echo Python 3.11")
    done = machine.rover("build", "--platform", "noble", PYTHON="python3.12")
    assert (machine.root / ".noble" / "install" / ".stamp").exists(), done.stderr
    assert not (machine.root / "install").exists()
    done = machine.rover("build", "--platform=noble", PYTHON="python3")
    assert done.stderr.endswith("; 3.12 is needed\n")


@pytest.mark.parametrize(("given", "named"), [(["plucky"], "plucky"), ([], "none")])
def test_an_unknown_platform_is_told(machine, given, named):
    done = machine.rover("test", "--platform", *given)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith(f"rover: no platform '{named}'")
    assert not (machine.root / "log").exists()


@pytest.mark.parametrize("command", ["run", "shell"])
def test_a_platform_is_chosen_before_the_arguments_of_another_program(machine, command):
    launched = machine.arguments_of(command, "--platform", "noble", "x", "--platform", "y")
    assert launched == [command, "x", "--platform", "y"]


def test_an_interpreter_of_another_version_is_told(machine):
    machine.fake("python3", "echo Python 3.9")
    done = machine.rover("build", PYTHON="python3")
    assert done.returncode == 1
    assert done.stderr == "rover: PYTHON=python3 is Python 3.9; 3.11 or 3.12 is needed\n"


def test_no_interpreter_is_told(machine):
    done = machine.rover("build", PYTHON="")
    assert done.returncode == 1
    assert done.stderr.startswith("rover: no Python 3.11 or 3.12 here; install one")


def test_a_full_disk_is_one_sentence(machine):
    machine.fake("df", "echo head; echo dev 100 90 10 90% /")
    done = machine.rover("build")
    assert done.returncode == 1
    assert done.stderr == "rover: the disk is too full: 10 MB free, 1500 MB are needed\n"


def test_no_network_is_told_and_nothing_counts_as_done(machine):
    done = machine.rover("build", **NO_NETWORK)
    assert done.returncode == 1
    assert "the package index cannot be reached: is there a network?" in done.stderr
    assert "rover: uv does not work here; pip installs instead" in done.stderr
    lines = done.stderr.splitlines()
    assert lines[0].startswith("rover: setting up")
    assert lines[1] == "rover: 1/5 making .venv ..."
    assert "rover: 2/5 installing the libraries into .venv ..." in lines
    assert not (machine.root / ".venv" / ".stamp").exists()
    assert "to do" in machine.rover("doctor").stdout


def test_a_set_up_says_how_far_it_is(machine):
    machine.replace_steps('mkdir -p "$install"')
    said = machine.rover("build").stderr
    assert re.findall(r"^rover: (\d)/5 [^:]*: \d+ s$", said, re.MULTILINE) == list("12345")
    assert re.findall(r"^rover: (\d)/5 .* \.\.\.$", said, re.MULTILINE) == list("12345")


def test_a_set_up_on_a_terminal_shows_a_bar(machine):
    # Each step waits for its progress to be shown.
    machine.replace_steps('mkdir -p "$install"; read -r <&4')
    primary, terminal = pty.openpty()
    reading, writing = os.pipe()
    environment = {"PATH": str(machine.bin), "PYTHON": PYTHON, "HOME": "/nonexistent"}
    command = ["bash", "-c", f'exec "$0" build 4<&{reading}', str(machine.root / "rover")]
    process = subprocess.Popen(command, env=environment, stderr=terminal, pass_fds=[reading])
    os.close(terminal)
    shown = b""
    for number in range(1, len(STEPS) + 1):
        while not re.search(rb"\] %d/5 [^\r]*, \d+ s" % number, shown):
            shown += os.read(primary, 1000)
        os.write(writing, b"go on\n")
    process.wait(60)
    for end in (primary, reading, writing):
        os.close(end)
    bars = re.findall(rb"\r\x1b\[Krover: \[([# ]{24})\] \d/5", shown)
    filled = [bar.count(b"#") for bar in bars]
    assert filled == sorted(filled)
    assert filled[0] == 0 < filled[-1]


def test_leftovers_of_another_environment_do_no_harm(machine):
    done = machine.rover(
        "doctor",
        PYTHONPATH="/elsewhere",
        PYTHONHOME="",
        LD_LIBRARY_PATH="/elsewhere",
        VIRTUAL_ENV="/elsewhere",
        _ROS_WHEELS_BOOTSTRAP_COMPLETE="1",
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_wheels_of_another_checkout_are_no_installation(machine):
    sourced = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": "/elsewhere/.venv"}
    wheels = machine.rover("doctor", _ROS_WHEELS_BOOTSTRAP_COMPLETE="1", **sourced)
    assert "ROS 2 Jazzy from wheels, in .venv" in wheels.stdout
    assert "ROS 2 Jazzy, sourced" in machine.rover("doctor", **sourced).stdout


@pytest.mark.parametrize(
    ("variables", "line"),
    [
        ({"ROS_DOMAIN_ID": "abc"}, "wrong    domain: ROS_DOMAIN_ID=abc is no domain"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}, "wrong    discovery: "),
        ({"ROS_DISTRO": "humble"}, "note     other ROS: ROS humble is sourced"),
        ({"PYTHONPATH": "/elsewhere"}, "note     PYTHONPATH: it holds /elsewhere"),
    ],
)
def test_doctor_names_variables_as_they_were_given(machine, variables, line):
    done = machine.rover("doctor", **variables)
    assert line in done.stdout
    assert done.returncode == line.startswith("wrong")


def test_doctor_tells_a_build_that_is_older_than_its_sources(machine):
    (machine.root / "install").mkdir()
    (machine.root / "install" / ".stamp").write_text("older")
    assert "to do    build: it is older than its sources" in machine.rover("doctor").stdout


@pytest.mark.parametrize(
    ("arguments", "page"),
    [
        ((), "rover"),
        (("--help",), "rover"),
        (("help",), "rover"),
        (("mission", "--help"), "rover-mission"),
        (("mission", "--seed", "3", "-h"), "rover-mission"),
        (("help", "mission"), "rover-mission"),
        (("bench", "--help"), "rover-bench"),
        (("bench", "graph", "--help"), "rover-bench-graph"),
        (("run", "--help"), "rover-run"),
    ],
)
def test_help_needs_no_set_up(machine, arguments, page):
    (machine.bin / "flock").unlink()  # a set-up would need it
    done = machine.rover(*arguments, PYTHON="foo")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == (ROOT / "rover_tools" / "help" / f"{page}.txt").read_text()


def test_help_of_an_executable_is_left_to_it(machine):
    done = machine.rover("run", "rover_bridge", "bridge_node", "--help", PYTHON="foo")
    assert done.returncode == 1
    assert done.stdout == ""


@pytest.mark.parametrize("arguments", [("dance",), ("rover",), ("bench", "dance"), ("--dance",)])
def test_an_unknown_command_sets_nothing_up(machine, arguments):
    done = machine.rover(*arguments)
    assert done.returncode == 2
    assert done.stderr == f"rover: no command '{' '.join(arguments)}' (./rover --help)\n"
    assert not (machine.root / "log").exists()


def test_bench_alone_lists_the_benchmarks(machine):
    done = machine.rover("bench")
    assert (done.returncode, done.stdout) == (2, "")
    assert "perception" in done.stderr


def test_completion_does_not_wait_for_a_set_up(machine):
    done = machine.rover(_ROVER_COMPLETE="bash_complete")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
