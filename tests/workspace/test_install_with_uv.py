"""uv installs from where pip would, with pip's certificates and proxies."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "wheels" / "install_with_uv.py"
spec = importlib.util.spec_from_file_location("install_with_uv", SCRIPT)
assert spec is not None
assert spec.loader is not None
uv = importlib.util.module_from_spec(spec)
spec.loader.exec_module(uv)

LISTING = """\
:env:.index-url='https://env.example/simple'
:env:.retries=''
freeze.timeout='10'
global.cert='/etc/a folder/ca.pem'
global.extra-index-url='https://one.example/simple\\n  https://two.example/simple'
global.index-url='https://global.example/simple'
global.retries='3'
install.find-links='/wheels https://files.example/'
install.index-url='https://install.example/simple'
"""


def test_the_environment_takes_precedence_over_the_command_and_that_over_global():
    settings = uv.pip_settings(LISTING)
    assert settings["index-url"] == "https://env.example/simple"
    without_environment = LISTING.replace(":env:.index-url", "wheel.index-url")
    assert uv.pip_settings(without_environment)["index-url"] == "https://install.example/simple"


def test_an_empty_setting_does_not_count_and_another_commands_neither():
    settings = uv.pip_settings(LISTING)
    assert settings["retries"] == "3"
    assert "timeout" not in settings


def test_indexes_certificates_and_proxies_are_handed_over():
    listing = LISTING + "global.proxy='http://proxy.example:3128'\nglobal.trusted-host='a b'\n"
    assert uv.uv_environment(uv.pip_settings(listing)) == {
        "UV_INDEX_STRATEGY": "unsafe-best-match",
        "UV_DEFAULT_INDEX": "https://env.example/simple",
        "UV_INDEX": "https://one.example/simple https://two.example/simple",
        "UV_FIND_LINKS": "/wheels,https://files.example/",
        "UV_INSECURE_HOST": "a b",
        "SSL_CERT_FILE": "/etc/a folder/ca.pem",
        "HTTP_PROXY": "http://proxy.example:3128",
        "HTTPS_PROXY": "http://proxy.example:3128",
        "UV_HTTP_RETRIES": "3",
    }


def test_without_settings_only_the_rule_is_pips():
    assert uv.uv_environment({}) == {"UV_INDEX_STRATEGY": "unsafe-best-match"}
    assert uv.uv_flags({}) == []


@pytest.mark.parametrize(("value", "given"), [("true", True), ("1", True), ("false", False)])
def test_switches_are_flags(value, given):
    settings = {"no-index": value, "no-cache-dir": value}
    assert uv.uv_flags(settings) == (["--no-index", "--no-cache"] if given else [])


def test_links_are_made_within_one_filesystem_only(tmp_path, monkeypatch):
    cache = tmp_path / "not made yet" / "uv"
    assert uv.link_mode(cache, tmp_path) == "hardlink"
    assert uv.link_mode(Path("/proc/uv"), tmp_path) == "copy"


def test_a_lock_without_uv_is_left_to_pip(tmp_path):
    lock = tmp_path / "requirements.lock"
    lock.write_text("numpy==2.4.6\n")
    assert uv.main(lock) == 1
    assert list(tmp_path.iterdir()) == [lock]


def test_the_locks_pin_uv():
    for name in ("requirements.lock", "requirements-apt.txt"):
        assert "\nuv==" in (SCRIPT.parent / name).read_text()
