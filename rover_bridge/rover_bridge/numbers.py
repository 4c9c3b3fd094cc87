"""Numbers as the simulator writes them, in whatever culture its machine has."""

from __future__ import annotations

import math

from rover_bridge.errors import NotFiniteError, NumberError


def parse_number(text: object) -> float:
    """A finite number from a string with a decimal point or comma, or from a JSON number."""
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise NumberError(f"{text!r:.40} is not a number")
    if isinstance(text, str):
        text = text.strip()
        if "," in text and "." in text:  # one of them groups the thousands: it comes first
            group, mark = (",", ".") if text.rindex(".") > text.rindex(",") else (".", ",")
            text = text.replace(group, "").replace(mark, ".")
        else:
            text = text.replace(",", ".")
    try:
        value = float(text)
    except ValueError:
        raise NumberError(f"{text!r:.40} is not a number") from None
    except OverflowError:  # an integer of more digits than a float has
        raise NotFiniteError("an integer of too many digits") from None
    if not math.isfinite(value):
        raise NotFiniteError(f"{text!r:.40} is not finite")
    return value


def parse_numbers(text: object, count: int) -> list[float]:
    """Exactly `count` numbers separated by `;` or `,`, with a decimal point or comma.

    Where the comma serves as both, each number has two parts.
    """
    if not isinstance(text, str):
        raise NumberError(f"{text!r:.40} is not a list of numbers")
    parts = [part for part in text.split(";" if ";" in text else ",") if part.strip()]
    if ";" not in text and "." not in text and len(parts) == 2 * count:
        parts = [f"{whole}.{digits}" for whole, digits in zip(parts[::2], parts[1::2], strict=True)]
    if count == 1 and len(parts) == 2 and ";" not in text:
        parts = [text]
    if len(parts) != count:
        raise NumberError(f"{text!r:.40} has {len(parts)} numbers, expected {count}")
    return [parse_number(part) for part in parts]
