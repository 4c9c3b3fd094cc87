"""The command line as a whole: help, laziness, ranges, hints and exit codes."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator

import click
import pytest

from rover_common.command_line import run_command
from rover_common.errors import RoverError
from rover_tools.cli.help_pages import FOLDER, pages
from rover_tools.cli.main import main, rover
from rover_tools.cli.options import MOST_SEEDS, SeedsType

HEAVY = {"numpy", "cv2", "scipy", "rclpy", "matplotlib", "embreex", "yaml", "tqdm", "dask"}


def commands() -> Iterator[tuple[str, ...]]:
    """Every command and benchmark, by the words that call it."""
    ctx = click.Context(rover)
    for name in rover.list_commands(ctx):
        yield (name,)
        command = rover.get_command(ctx, name)
        if isinstance(command, click.Group):
            yield from ((name, inner) for inner in command.list_commands(ctx))


COMMANDS = list(commands())


@pytest.mark.parametrize("path", COMMANDS, ids="-".join)
def test_each_command_has_help_with_an_example_that_calls_it(path, capsys):
    assert main([*path, "--help"]) == 0
    text = capsys.readouterr().out
    assert f"Usage: rover {' '.join(path)}" in text
    examples = text.split("Examples:\n")[1].split("\n\n")[0]
    assert f"./rover {' '.join(path)}" in examples


def test_the_help_pages_are_those_of_the_commands():
    wanted = pages()
    assert len(wanted) == len(COMMANDS) + 1
    written = {path.stem: path.read_text() for path in FOLDER.glob("*.txt")}
    assert written == wanted, "write them again: python -m rover_tools.cli.help_pages"


@pytest.mark.parametrize("path", [(), *COMMANDS], ids=lambda path: "-".join(path) or "rover")
def test_help_imports_nothing_heavy(path):
    code = (
        "import sys; from rover_tools.cli.main import main; main(sys.argv[1:]); "
        "print(*{name.split('.')[0] for name in sys.modules})"
    )
    arguments = [sys.executable, "-c", code, *path, "--help"]
    done = subprocess.run(arguments, capture_output=True, text=True, check=True)
    assert not HEAVY & set(done.stdout.splitlines()[-1].split())


def test_only_the_called_command_is_imported():
    code = (
        "import sys; from rover_tools.cli.main import main; main(['shell', '--help']); "
        "print(*[name for name in sys.modules if '.commands.' in name])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "rover_tools.cli.commands.shell"


@pytest.mark.parametrize(
    ("line", "range_in_words"),
    [
        ("demo --size 0", "0.2 to 2"),
        ("mission --size -1", "0.2 to 2"),
        ("scoreboard --size nan", "0.2 to 2"),
        ("bench decision --size inf", "0.2 to 2"),
        ("sim --port 80000", "1 to 65535"),
        ("sim --port 0", "1 to 65535"),
        ("sim --fps 0", "above 0, at most 50"),
        ("mission --fps nan", "above 0, at most 50"),
        ("mission --seed -1", "0 or more"),
        ("mission --time-limit 0", "above 0, at most 100000"),
        ("scoreboard --workers 0", "1 to 10000"),
        ("replay . --in-flight 4", "1 to 3"),
        ("bench graph --frames 0", "1 to 100000"),
    ],
)
def test_a_number_out_of_range_is_one_line_with_the_range(line, range_in_words, capsys):
    assert main(line.split()) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert f"is not in the range {range_in_words}." in error
    assert line.split()[-2] in error


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("mision", "did you mean 'mission'?"),
        ("fly", "did you mean 'mission'?"),
        ("benchmark", "did you mean 'bench'?"),
        ("simulate", "did you mean 'sim'?"),
        ("help", "did you mean '--help'?"),
        ("bench percepton", "did you mean 'perception'?"),
        ("mission --sed 3", "did you mean --seed?"),
        ("mission --worlds 1-4", "use scoreboard --worlds 1-4"),
        ("scoreboard --strategy tour", "write --strategies NAMES"),
        ("demo --rate 2", "it is an option of sim"),
        ("mission --way-home dance", "there are breadcrumbs, shortest_path, bearing"),
        ("sim --way-home bearing", "it is an option of demo, mission, scoreboard"),
        ("bench decision --seed 3", "write --seeds N"),
        ("mission --explorer dance", "there are tour, frontier"),
        ("scoreboard --strategies tour+dance", "there are breadcrumbs"),
        ("bench tours --drivers drunk", "'drunk' is not one of steady, rough"),
        ("sim --rate quick", "neither realtime nor fast nor a number above 0"),
        ("mission --params missing.yaml", "File 'missing.yaml' does not exist"),
        ("mission --map rover --world tests", "--map and --world exclude each other"),
    ],
)
def test_what_cannot_be_used_is_one_line_with_a_hint(line, hint, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rover").touch()
    (tmp_path / "tests").mkdir()
    assert main(line.split()) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert hint in error
    assert error.startswith("rover")
    assert "--help)" in error


def test_a_group_without_a_command_says_what_there_is(capsys):
    assert main(["bench"]) == 2
    assert "name one of graph, perception" in capsys.readouterr().err
    assert main([]) == 0
    assert capsys.readouterr().out.startswith("Usage: rover COMMAND")


@pytest.mark.parametrize(
    ("text", "seeds"),
    [("7", (7,)), ("1-4", (1, 2, 3, 4)), ("1,5,9", (1, 5, 9)), ("5-6, 1,5", (5, 6, 1))],
)
def test_seeds(text, seeds):
    assert SeedsType().convert(text, None, None) == seeds


@pytest.mark.parametrize("text", ["", "a", "4-1", "1-", "-3", "1,,2", f"1-{MOST_SEEDS + 1}"])
def test_bad_seeds(text):
    with pytest.raises(click.BadParameter, match=f"'{text.split(',')[-1]}'|''"):
        SeedsType().convert(text, None, None)


# The edge


def raising(error: BaseException) -> click.Command:
    def body() -> None:
        raise error

    return click.Group("program", commands=[click.Command("work", callback=body)])


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (RoverError("no rover"), 1, "program work: no rover\n"),
        (OSError(2, "No such file", "map.png"), 1, "program work: map.png: No such file\n"),
        (OSError(98, "Address in use"), 1, "program work: Address in use\n"),
        (TimeoutError("too late"), 1, "program work: too late\n"),
        (KeyboardInterrupt(), 130, "program work: stopped\n"),
    ],
)
def test_expected_errors_are_one_line_and_an_exit_code(error, code, line, capsys):
    assert run_command(raising(error), "program", ["work"]) == code
    assert capsys.readouterr().err.lstrip("\n") == line


def test_a_defect_keeps_its_traceback():
    with pytest.raises(ZeroDivisionError):
        run_command(raising(ZeroDivisionError()), "program", ["work"])


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_stops_a_command(number, capsys):
    before = signal.getsignal(number)
    work = click.Command("work", callback=lambda: os.kill(os.getpid(), number))
    assert run_command(work, "work", []) == 130
    assert capsys.readouterr().err.lstrip("\n") == "work: stopped\n"
    assert signal.getsignal(number) == before


def test_nohup_is_respected():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        work = click.Command("work", callback=lambda: os.kill(os.getpid(), signal.SIGHUP))
        assert run_command(work, "work", []) == 0
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_command_that_is_not_in_a_package_is_told(capsys):
    assert main(["run", "rover_bridge", "dance"]) == 1
    assert "there is bridge_node" in capsys.readouterr().err
    assert main(["run", "rover_dance", "dance"]) == 1
    assert capsys.readouterr().err == "rover run: no package 'rover_dance'\n"


# Completion

COMPLETE = """
source "$1"
COMP_WORDS=(./rover "${@:2}") COMP_CWORD=$(($# - 1))
complete -p ./rover &>/dev/null || [ "$(complete -p rover)" ] || exit 1
_rover_completion "$PROGRAM"
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.mark.parametrize(
    ("words", "completions"),
    [
        (["sc"], ["scoreboard"]),
        (["bench", "to"], ["tours"]),
        (["mission", "--str"], ["--strategy"]),
    ],
)
def test_bash_completes_commands_and_options(words, completions, tmp_path, capsys):
    assert main(["completion", "bash"]) == 0
    script = tmp_path / "completion.bash"
    script.write_text(capsys.readouterr().out)
    program = tmp_path / "rover"  # called by its path, as ./rover is
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m rover_tools.cli.main "$@"\n')
    program.chmod(0o755)
    done = subprocess.run(
        ["bash", "-c", COMPLETE, "bash", str(script), *words],
        env={**os.environ, "PROGRAM": str(program)}, capture_output=True, text=True,
    )  # fmt: skip
    assert done.stdout.split() == completions, done.stderr


@pytest.mark.parametrize(
    ("shell", "call"), [("zsh", '"${words[1]}"'), ("fish", "(commandline -opc)[1]")]
)
def test_the_other_shells_call_the_program_that_was_typed(shell, call, capsys):
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    assert f"{call})" in script
    assert "$+commands" not in script
