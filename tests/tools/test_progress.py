"""Progress without a terminal: a line every ten seconds."""

import io
import sys

import pytest
from tqdm import tqdm

from rover_tools.progress import LINE_SECONDS, Progress


@pytest.fixture(autouse=True)
def no_monitor(monkeypatch):
    """The thread of tqdm's monitor would outlive the test."""
    monkeypatch.setattr(tqdm, "monitor_interval", 0)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_without_a_terminal_there_is_a_line_every_ten_seconds(capsys):
    now = [100.0]
    with Progress(900.0, "s", lambda: now[0]) as progress:
        progress.show(1.0, "EXPLORE")
        assert capsys.readouterr().err == ""
        now[0] += LINE_SECONDS
        progress.show(42.0, "EXPLORE")
        progress.show(43.0, "EXPLORE")
        assert capsys.readouterr().err == "EXPLORE 42/900 s\n"
        now[0] += LINE_SECONDS
        progress.show(80.0, "RETURN_HOME")
    assert capsys.readouterr().err == "RETURN_HOME 80/900 s\n"


def test_on_a_terminal_there_is_a_bar(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with Progress(900.0, "s", lambda: 0.0) as progress:
        progress.show(42.0, "EXPLORE")
    assert "EXPLORE 42/900 s" in terminal.getvalue()
