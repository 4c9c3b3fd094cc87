"""Chromium without a screen, driven by its DevTools protocol."""

from __future__ import annotations

import asyncio
import base64
import json
import shutil
import tempfile
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import Any

from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType

EXECUTABLES = ("chromium", "chromium-browser", "google-chrome")
START_SECONDS = 60.0  # [s] for the browser to listen
WAIT = 30.0  # [s] for something to become true on a page
POLL = 0.05  # [s]


def executable() -> str | None:
    """The browser's path, None where there is none."""
    return next((path for path in map(shutil.which, EXECUTABLES) if path), None)


class Page:
    """One tab."""

    def __init__(self, browser: Browser, session: str) -> None:
        self._browser = browser
        self.session = session
        self._loaded = asyncio.Event()
        self.errors: list[str] = []  # exceptions, and what the console calls errors

    async def send(self, method: str, **parameters: Any) -> dict[str, Any]:
        return await self._browser.send(method, parameters, self.session)

    async def evaluate(self, expression: str, timeout: float = WAIT) -> Any:
        """The value of an expression of JavaScript, or of the promise that it is."""
        wanted = {"expression": expression, "awaitPromise": True, "returnByValue": True}
        answer = await self._browser.send("Runtime.evaluate", wanted, self.session, timeout)
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return answer["result"].get("value")

    async def becomes(self, condition: str, timeout: float = WAIT) -> bool:
        """Whether an expression becomes true in time [s], asked in the page itself."""
        return await self.evaluate(
            f"""new Promise((resolve) => {{
              const end = performance.now() + {1000 * timeout};
              const look = () => {{
                if ({condition}) resolve(true);
                else if (performance.now() > end) resolve(false);
                else setTimeout(look, 20);
              }};
              look();
            }})""",
            timeout + WAIT,
        )

    async def text(self, selector: str) -> str:
        return await self.evaluate(f"document.querySelector({json.dumps(selector)}).textContent")

    async def click(self, selector: str) -> None:
        await self.evaluate(f"document.querySelector({json.dumps(selector)}).click()")

    async def open(self, address: str) -> None:
        """Until all of it has loaded."""
        self._loaded.clear()
        await self.send("Page.navigate", url=address)
        await asyncio.wait_for(self._loaded.wait(), WAIT)

    async def show_as(
        self, width: int, height: int, *, scale: float = 1, dark: bool = False
    ) -> None:
        """Size of the window [px], pixels of the screen to one of it, and the colour scheme."""
        await self.send(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=scale, mobile=width < 600,
        )  # fmt: skip
        await self.send("Emulation.setScrollbarsHidden", hidden=True)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        await self.send("Emulation.setEmulatedMedia", features=[scheme])

    async def screenshot(self, path: Path) -> None:
        """The whole page as a PNG, also what lies below the window."""
        answer = await self.send("Page.captureScreenshot", captureBeyondViewport=True)
        path.write_bytes(base64.b64decode(answer["data"]))

    def on_event(self, method: str, parameters: dict[str, Any]) -> None:
        if method == "Page.loadEventFired":
            self._loaded.set()
        elif method == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(parameters["exceptionDetails"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(json.dumps(parameters["entry"]))


class Browser:
    """The connection to the browser: numbered requests, and events of its pages."""

    def __init__(self, socket: ClientWebSocketResponse) -> None:
        self._socket = socket
        self._answers: dict[int, asyncio.Future[dict[str, Any]]] = {}
        self._pages: dict[str, Page] = {}
        self._last = 0
        self.reader = asyncio.create_task(self._read())

    async def send(
        self,
        method: str,
        parameters: dict[str, Any],
        session: str | None = None,
        timeout: float = WAIT,
    ) -> dict[str, Any]:
        self._last += 1
        message = {"id": self._last, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        answer = self._answers[self._last] = asyncio.get_running_loop().create_future()
        await self._socket.send_json(message)
        return await asyncio.wait_for(answer, timeout)

    async def new_page(self) -> Page:
        target = await self.send("Target.createTarget", {"url": "about:blank"})
        attached = await self.send(
            "Target.attachToTarget", {"targetId": target["targetId"], "flatten": True}
        )
        page = self._pages[attached["sessionId"]] = Page(self, attached["sessionId"])
        for domain in ("Page", "Runtime", "Log"):
            await page.send(f"{domain}.enable")
        return page

    async def _read(self) -> None:
        async for message in self._socket:
            if message.type is not WSMsgType.TEXT:
                continue
            data = json.loads(message.data)
            if "id" in data:
                answer = self._answers.pop(data["id"])
                if "error" in data:
                    answer.set_exception(AssertionError(data["error"]))
                else:
                    answer.set_result(data["result"])
            elif data.get("sessionId") in self._pages:
                self._pages[data["sessionId"]].on_event(data["method"], data["params"])


@asynccontextmanager
async def chromium(arguments: Sequence[str] = ()) -> AsyncIterator[Browser]:
    """A browser with a profile of its own and these arguments, until the block ends."""
    path = executable()
    assert path, "no chromium here"
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = await asyncio.create_subprocess_exec(
            path, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
            "--no-first-run", "--disable-background-networking", "--disable-extensions",
            "--remote-debugging-port=0", f"--user-data-dir={profile}", *arguments,
            "about:blank",
            stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.DEVNULL,
        )  # fmt: skip
        try:
            address = await asyncio.wait_for(_address(Path(profile)), START_SECONDS)
            async with (
                ClientSession() as session,
                session.ws_connect(address, max_msg_size=0) as socket,
            ):
                browser = Browser(socket)
                yield browser
                with suppress(ConnectionError, TimeoutError):
                    await browser.send("Browser.close", {})
                browser.reader.cancel()
        finally:
            with suppress(ProcessLookupError):
                process.terminate()
            await process.wait()


async def _address(profile: Path) -> str:
    """Chromium writes the port and the path that it listens on into a file of its profile."""
    file = profile / "DevToolsActivePort"
    while not file.exists() or file.read_text().count("\n") < 1:
        await asyncio.sleep(POLL)
    port, path = file.read_text().split("\n")[:2]
    return f"ws://127.0.0.1:{port}{path}"
