"""Who may connect: origins, the token, and settings that are none."""

import socket

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_bridge.access import Access, AccessError, Request

PAGE = "http://robot:8000"


@pytest.mark.parametrize(
    "request_",
    [
        Request(),
        Request(origin="http://127.0.0.1:4567"),
        Request(origin="http://localhost:4567"),
        Request(origin="http://[::1]:4567", address="::1"),
        Request(origin="http://192.0.2.7:4567", address="::ffff:192.0.2.7"),
        Request(origin=f"http://{socket.gethostname()}:4567", address="192.0.2.7"),
        Request(origin="http://192.0.2.7", address="192.0.2.7", port=80),
        Request(fetch_site="same-origin"),
        Request(origin=PAGE),
    ],
)
def test_programs_and_allowed_pages_are_accepted(request_):
    assert Access(f"http://other:1 {PAGE}").refusal(request_) == ""


@pytest.mark.parametrize(
    "request_",
    [
        Request(origin="http://evil.example"),
        Request(origin="http://evil.example:4567"),  # its name may point to this machine
        Request(origin="http://127.0.0.1:8080"),
        Request(origin="https://127.0.0.1:4567"),
        Request(origin="http://127.0.0.1:4567/page"),
        Request(origin="http://localhost:4567", address="192.0.2.7"),
        Request(origin="http://127.0.0.1.evil.example:4567"),
        Request(origin="http://user@127.0.0.1.evil:4567"),
        Request(origin="null"),
        Request(origin="http://127.0.0.1:99999"),
        Request(origin="*"),
        Request(origin=PAGE + "1"),
        Request(fetch_site="cross-site"),
        Request(fetch_site="same-site"),
    ],
)
def test_other_pages_are_refused_and_told_why(request_):
    assert request_.origin[:100] in Access(PAGE).refusal(request_) != ""


@given(st.text(max_size=60))
def test_no_origin_by_chance_is_accepted(origin):
    assert (Access().refusal(Request(origin=origin)) == "") == (origin == "")


@pytest.mark.parametrize("origins", ["*", "http://*", "robot:8000", "http://robot/page", "null"])
def test_an_origin_that_is_none_is_an_error(origins):
    with pytest.raises(AccessError, match="allowed_origins"):
        Access(origins)


@pytest.mark.parametrize("token", ["a b", "a&b", "ä", "a\nb"])
def test_a_token_that_a_query_cannot_carry_is_an_error(token):
    with pytest.raises(AccessError, match="token"):
        Access(token=token)


def test_the_token_is_asked_for():
    access = Access(token="secret-1")
    assert access.refusal(Request(query="EIO=4&token=secret-1")) == ""
    assert access.refusal(Request(authorization="Bearer secret-1")) == ""
    for shown in ("", "token=", "token=secret-2", "token=secret-11", "tokens=secret-1"):
        assert "token" in access.refusal(Request(query=shown))
    assert "secret" not in access.refusal(Request())
