"""The pictures of a recorded run: found beside its log, and checked before anything starts."""

from __future__ import annotations

import io
from pathlib import Path, PureWindowsPath

from PIL import Image, UnidentifiedImageError

from rover_common.camera import ROVER_CAMERA
from rover_simulator.recordings.skips import Cause, UnusableError

FOLDER = "IMG"
LFS_POINTER = b"version https://git-lfs"
JPEG_START, JPEG_END = b"\xff\xd8", b"\xff\xd9"


def find_picture(path: str, folder: Path) -> Path:
    """The picture that a row of the log names; only the file's name in its path counts.

    Recordings carry the paths of the machine that made them, Windows ones among them. Raises
    UnusableError where there is none, or none that the bridge takes.
    """
    name = PureWindowsPath(path).name  # splits at both kinds of slash
    candidates = (folder / FOLDER / name, folder / name)
    found = next((each for each in candidates if name and _is_file(each)), None)
    if found is None:
        raise UnusableError(Cause.NO_PICTURE, f"'{name[:80]}' neither in {FOLDER} nor beside it")
    _check(found)
    return found


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name that is too long
        return False


def _check(path: Path) -> None:
    content = path.read_bytes()
    if content.startswith(LFS_POINTER):
        raise UnusableError(Cause.POINTER, path.name)
    if not (content.startswith(JPEG_START) and content.endswith(JPEG_END)):
        raise UnusableError(Cause.BROKEN, path.name)
    try:
        with Image.open(io.BytesIO(content)) as image:  # reads no more than the head
            width, height = image.size
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError) as error:
        raise UnusableError(Cause.BROKEN, path.name) from error
    if (width, height) != (ROVER_CAMERA.width, ROVER_CAMERA.height):
        raise UnusableError(Cause.OTHER_SIZE, f"{path.name} has {width} x {height}")
