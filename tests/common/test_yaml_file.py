"""YAML files of others: one line says what is wrong, and nothing hangs."""

import pytest

from rover_common.yaml_file import MOST_BYTES, YamlFileError, read_yaml

LAUGHS = "a: &a [1, 1]\n" + "".join(
    f"{b}: &{b} [{', '.join(['*' + a] * 9)}]\n"
    for a, b in zip("abcdefghi", "bcdefghij", strict=True)
)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (LAUGHS.encode(), "line 2: an alias"),
        (b"x: .inf\n", "inf is no finite number"),
        (b"x: [1, {y: .nan}]\n", "nan is no finite number"),
        (b"x: " + b"9" * 400 + b"\n", "more than 64 bits"),
        (b"x: " + b"9" * 5000 + b"\n", ""),
        (b"x: " + b"[" * 20_000 + b"\n", ""),
        (b"\x96\xff\x00", "not a text in UTF-8"),
        (b"x: \x00\n", "unacceptable character"),
        (b"x: [1, 2\n", "line 2: "),
        (b"x: !!python/object:os.system 1\n", "line 1: "),
        (b"x: 1\n" * (MOST_BYTES // 5 + 1), "larger than"),
    ],
    ids=[
        "nested aliases", "inf", "nested nan", "long", "too long", "deep", "binary", "nul", "open",
        "object", "large",
    ],
)  # fmt: skip
def test_what_is_no_plain_data_is_one_line(tmp_path, content, reason):
    path = tmp_path / "file.yaml"
    path.write_bytes(content)
    with pytest.raises(YamlFileError, match=rf"file\.yaml: .*{reason}") as caught:
        read_yaml(path)
    assert "\n" not in str(caught.value)


def test_no_file_is_one_line(tmp_path):
    with pytest.raises(YamlFileError, match=r"none\.yaml: No such file"):
        read_yaml(tmp_path / "none.yaml")


def test_a_generated_file_without_its_last_line_break_is_cut(tmp_path):
    path = tmp_path / "file.yaml"
    path.write_text("x: 12\ny: 345")
    assert read_yaml(path) == {"x": 12, "y": 345}  # somebody's editor
    with pytest.raises(YamlFileError, match="cut"):
        read_yaml(path, generated=True)
