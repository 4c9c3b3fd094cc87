"""install_with_uv.py LOCK: install a lock file into the environment whose Python runs this.

uv is itself a package of the lock; pip installs it. uv does not read pip's configuration: what that
says about indexes, certificates and proxies is handed over. Exit code 1 where uv cannot be had.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check")
SECTIONS = ("global", "install", ":env:")  # pip's; later ones take precedence
# pip's option, uv's variables, what separates several values there
HANDED_OVER = (
    ("index-url", ("UV_DEFAULT_INDEX",), None),
    ("extra-index-url", ("UV_INDEX",), " "),
    ("find-links", ("UV_FIND_LINKS",), ","),
    ("trusted-host", ("UV_INSECURE_HOST",), " "),
    ("cert", ("SSL_CERT_FILE",), None),
    ("client-cert", ("SSL_CLIENT_CERT",), None),
    ("proxy", ("HTTP_PROXY", "HTTPS_PROXY"), None),
    ("default-timeout", ("UV_HTTP_TIMEOUT",), None),
    ("timeout", ("UV_HTTP_TIMEOUT",), None),
    ("retries", ("UV_HTTP_RETRIES",), None),
)
TRUE = ("1", "true", "yes", "on")


def pip_settings(listing: str) -> dict[str, str]:
    """The options that `pip config list` prints, by name, as they hold for `pip install`."""
    found: dict[str, dict[str, str]] = {section: {} for section in SECTIONS}
    for line in listing.splitlines():
        section, _, rest = line.partition(".")
        name, _, value = rest.partition("=")
        if section in found:
            found[section][name] = str(ast.literal_eval(value))
    return {name: value for options in found.values() for name, value in options.items() if value}


def uv_environment(settings: Mapping[str, str]) -> dict[str, str]:
    """The same settings as variables that uv reads."""
    # uv's own rule takes the first index that has a package; pip the best of all indexes.
    variables = {"UV_INDEX_STRATEGY": "unsafe-best-match"}
    for option, names, separator in HANDED_OVER:
        if option in settings:
            value = settings[option]
            text = value if separator is None else separator.join(value.split())
            variables |= dict.fromkeys(names, text)
    return variables


def uv_flags(settings: Mapping[str, str]) -> list[str]:
    """The settings that uv takes as flags alone."""
    names = {"no-index": "--no-index", "no-cache-dir": "--no-cache"}
    return [flag for name, flag in names.items() if settings.get(name, "").lower() in TRUE]


def link_mode(cache: Path, environment: Path) -> str:
    """Hard links save time and disk, and are possible within one filesystem only."""
    existing = next(folder for folder in (cache, *cache.parents) if folder.exists())
    return "hardlink" if existing.stat().st_dev == environment.stat().st_dev else "copy"


def output_of(*command: str) -> str:
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout


def main(lock: Path) -> int:
    """Returns the exit code."""
    pinned = re.search(r"^uv==\S+", lock.read_text(), re.MULTILINE)
    if pinned is None:
        return 1
    uv = str(Path(sys.prefix) / "bin" / "uv")
    settings = pip_settings(output_of(*PIP, "config", "list"))
    install = (*PIP, "install", "--no-input", "--no-compile", "--no-deps")
    subprocess.run([*install, pinned[0]], check=True)
    # What the user has set for uv itself takes precedence.
    environment = {**uv_environment(settings), **os.environ, "VIRTUAL_ENV": sys.prefix}
    cache = Path(output_of(uv, "cache", "dir").strip())
    environment.setdefault("UV_LINK_MODE", link_mode(cache, Path(sys.prefix)))
    command = [uv, "pip", "install", "--no-deps", *uv_flags(settings), "-r", str(lock)]
    return subprocess.run(command, env=environment).returncode


if __name__ == "__main__":
    try:
        sys.exit(main(Path(sys.argv[1])))
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"uv cannot be used: {error}")
