"""Processes of a run: a dead one is told with its log, none outlives the run."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from waiting import holds

from rover_tools.runner import domain as domains
from rover_tools.runner.domain import DomainError, free_domain, reserved_domain
from rover_tools.runner.processes import (
    RESPAWNS,
    WITH_PARENT,
    ProcessDiedError,
    Processes,
)

WAIT = 10.0  # [s]


def wait_for(predicate) -> None:
    assert holds(predicate, WAIT), "it did not happen in time"


def test_a_dead_process_is_told_with_the_end_of_its_log(tmp_path):
    with Processes(tmp_path, {}) as processes:
        code = "import sys; print('the reason'); sys.exit(3)"
        processes.start("worker", [sys.executable, "-c", code])
        wait_for(lambda: processes.ended("worker") is not None)
        with pytest.raises(
            ProcessDiedError, match=r"worker ended with exit code 3[\s\S]*the reason"
        ):
            processes.check()


def test_the_end_of_an_optional_process_is_no_failure(tmp_path):
    with Processes(tmp_path, {}) as processes:
        processes.start("page", [sys.executable, "-c", ""])
        wait_for(lambda: processes.ended("page") is not None)
        with pytest.raises(ProcessDiedError):
            processes.check()
        processes.make_optional("page")
        processes.check()


def test_a_process_that_is_to_be_there_is_started_again(tmp_path, capsys):
    code = "import os, signal; print(os.getpid(), flush=True); signal.pause()"
    log = tmp_path / "worker.log"

    def pids() -> list[int]:
        return [int(line) for line in log.read_text().split()]

    with Processes(tmp_path, {}) as processes:
        processes.start("worker", [sys.executable, "-c", code])
        wait_for(lambda: len(pids()) == 1)
        processes.respawn(["worker"])
        processes.check()
        assert processes.remarks() == {}
        os.kill(pids()[0], signal.SIGKILL)
        wait_for(lambda: processes.ended("worker") is not None)
        processes.check()
        wait_for(lambda: len(pids()) == 2)
        second = pids()[1]
        assert processes.pid("worker") == second
    remark = "worker ended with exit code -9; it is started again"
    assert processes.remarks() == {"remarks": [remark]}
    assert remark in capsys.readouterr().err
    with pytest.raises(ProcessLookupError):
        os.kill(second, 0)


def test_a_process_that_ends_again_and_again_is_told(tmp_path):
    with Processes(tmp_path, {}) as processes:
        processes.start("worker", [sys.executable, "-c", "print('the reason')"])
        processes.respawn(["worker"])
        with pytest.raises(ProcessDiedError, match="the reason"):
            for _ in range(RESPAWNS + 1):
                wait_for(lambda: processes.ended("worker") is not None)
                processes.check()


def test_a_process_is_started_again_as_often_as_it_is_told(tmp_path):
    with Processes(tmp_path, {}) as processes:
        processes.start("worker", [sys.executable, "-c", ""])
        processes.respawn(["worker"], most=1)
        assert processes.respawns() == {}
        wait_for(lambda: processes.ended("worker") is not None)
        processes.check()
        assert processes.respawns() == {"worker": 1}
        wait_for(lambda: processes.ended("worker") is not None)
        with pytest.raises(ProcessDiedError):
            processes.check()


@pytest.mark.skipif(not shutil.which(WITH_PARENT[0]), reason="needs setpriv")
def test_processes_end_with_a_runner_that_is_killed(tmp_path):
    code = (
        "import signal, sys; from pathlib import Path; "
        "from rover_tools.runner.processes import Processes; "
        "processes = Processes(Path(sys.argv[1]), {}); "
        "processes.start('worker', [sys.executable, '-c', 'import os, signal; "
        "print(os.getpid(), flush=True); signal.pause()']); signal.pause()"
    )
    log = tmp_path / "worker.log"
    runner = subprocess.Popen([sys.executable, "-c", code, str(tmp_path)])
    wait_for(lambda: log.is_file() and log.read_text().endswith("\n"))
    runner.kill()
    runner.wait()
    wait_for(lambda: not Path(f"/proc/{int(log.read_text())}").exists())


def test_all_processes_end_with_the_block(tmp_path):
    code = "import os, signal; print(os.getpid(), flush=True); signal.pause()"
    stubborn = "import signal; signal.signal(signal.SIGINT, signal.SIG_IGN); " + code
    log = tmp_path / "worker.log"
    with Processes(tmp_path, {}) as processes:
        processes.stop_seconds = 0.2
        processes.start("worker", [sys.executable, "-c", stubborn])
        wait_for(lambda: log.read_text().endswith("\n"))
        processes.check()
        pid = int(log.read_text())
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_the_environment_is_handed_on(tmp_path):
    with Processes(tmp_path, {"ROS_DOMAIN_ID": "77"}) as processes:
        code = "import os; print(os.environ['ROS_DOMAIN_ID'])"
        processes.start("worker", [sys.executable, "-c", code])
        wait_for(lambda: processes.ended("worker") is not None)
    assert (tmp_path / "worker.log").read_text() == "77\n"


def test_two_runs_have_two_domains(monkeypatch):
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    with reserved_domain() as first, reserved_domain() as second:
        assert first != second


def test_a_chosen_domain_is_kept(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "42")
    with reserved_domain() as domain:
        assert domain == 42


def test_a_chosen_domain_is_free_for_nobody_else_but_may_be_shared(monkeypatch):
    with free_domain() as domain:
        pass
    monkeypatch.setattr(domains, "DOMAINS", range(domain, domain + 1))
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    with reserved_domain() as first, reserved_domain() as second:
        assert first == second == domain
        with pytest.raises(DomainError, match="all DDS domains are in use"), free_domain():
            pass
    with free_domain() as free, reserved_domain() as inside:
        assert free == inside == domain


@pytest.mark.parametrize("text", ["east", "-1", "233"])
def test_a_domain_that_there_is_not_is_one_line(monkeypatch, text):
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    with pytest.raises(DomainError, match=f"ROS_DOMAIN_ID={text} is no domain"), reserved_domain():
        pass
