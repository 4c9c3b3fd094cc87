"""Read a YAML file of somebody else: what is not plain data is one line, and never hangs."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import yaml

from rover_common.errors import RoverError

MOST_BYTES = 1_000_000  # a world or a file of parameters has some 10,000


class YamlFileError(RoverError, ValueError):
    """A file holds no YAML that can be used."""


class _PlainLoader(yaml.SafeLoader):
    """Without aliases: a few lines of nested ones are billions of values."""

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.AliasEvent):
            mark = self.peek_event().start_mark
            raise yaml.MarkedYAMLError(
                problem="an alias, which is not read: write the value out", problem_mark=mark
            )
        return super().compose_node(parent, index)


def read_yaml(path: Path, *, generated: bool = False) -> Any:
    """The content of a file, whose numbers are all finite.

    generated: the file was written by a program; without a line break at its end, it was cut.
    Raises YamlFileError, whose text is one line.
    """
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
        if len(content) > MOST_BYTES:
            raise YamlFileError(f"{path}: larger than {MOST_BYTES} bytes")
        text = content.decode()
        if generated and not text.endswith("\n"):
            raise YamlFileError(f"{path}: cut: its last line has no end")
        data = yaml.load(text, _PlainLoader)
        _check_finite(data)
    except YamlFileError:
        raise
    except OSError as error:
        raise YamlFileError(f"{path}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise YamlFileError(f"{path}: not a text in UTF-8") from error
    except RecursionError as error:
        raise YamlFileError(f"{path}: nested too deep") from error
    except (yaml.YAMLError, ValueError) as error:
        raise YamlFileError(f"{path}: {_in_one_line(error)}") from error
    return data


def _check_finite(data: Any) -> None:
    """Raises ValueError for a number that is not finite, or too large for a float."""
    if isinstance(data, dict):
        for key, value in data.items():
            _check_finite(key)
            _check_finite(value)
    elif isinstance(data, list | set):
        for value in data:
            _check_finite(value)
    elif isinstance(data, float) and not math.isfinite(data):
        raise ValueError(f"{data} is no finite number")
    elif isinstance(data, int) and abs(data) >= 2**63:
        raise ValueError("an integer of more than 64 bits")


def _in_one_line(error: Exception) -> str:
    """PyYAML writes several lines, with the file's name in each."""
    if isinstance(error, yaml.MarkedYAMLError) and error.problem_mark is not None:
        return f"line {error.problem_mark.line + 1}: {error.problem}"
    return " ".join(str(error).split())
