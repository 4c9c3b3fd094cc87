"""Drivers and simulators as lifecycle nodes (managed nodes) that activate themselves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn

from rover_common.config import parameter
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.parameters import declare_parameters

Step = Callable[[], None]


@dataclass(frozen=True)
class LifecycleConfig:
    """Parameter of every lifecycle node."""

    autostart: bool = parameter(
        True, "configure and activate at the start; false waits for a lifecycle manager"
    )


class ManagedNode(CheckedNode, LifecycleNode):
    """A checked node whose work begins with its activation.

    A subclass has the four steps below, which may raise. With `autostart`, what they raise leaves
    `bring_up`; asked for by a service, it is logged and the transition fails.
    """

    def __init__(self, name: str, **kwargs: Any) -> None:
        super().__init__(name, **kwargs)
        self.active = False
        self._failure: Exception | None = None
        self._autostart = declare_parameters(self, LifecycleConfig).autostart
        self._change_state = self._service_change_state.callback
        self._service_change_state.callback = self._on_change_state

    def configure(self) -> None:
        """Get ready."""

    def activate(self) -> None:
        """Begin to work."""

    def deactivate(self) -> None:
        """Stop working, ready to begin again."""

    def cleanup(self) -> None:
        """Give back what `configure` took."""

    def bring_up(self, prepare: Step) -> None:
        """In a subclass's constructor: prepare, then activate, unless somebody else is to.

        A node that cannot be brought up is destroyed before its context ends, which it must not
        outlive; the error is raised.
        """
        try:
            prepare()
            self._start()
        except BaseException:
            self.destroy_node()
            raise

    def _start(self) -> None:
        for trigger in (self.trigger_configure, self.trigger_activate):
            if not self._autostart or trigger() != TransitionCallbackReturn.SUCCESS:
                break
        if self._failure is not None:
            raise self._failure

    def destroy_node(self) -> None:
        """And what rclpy leaves, which would keep the node in the graph."""
        super().destroy_node()
        self._state_machine.destroy_when_not_in_use()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        return self._do(self.configure, self.active)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        return self._do(self.activate, True)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        return self._do(self.deactivate, False)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        return self._do(self.cleanup, False)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        if self.active:
            self._do(self.deactivate, False)
        return self._do(self.cleanup, False)

    def _do(self, step: Step, active: bool) -> TransitionCallbackReturn:
        try:
            step()
        except Exception as error:
            self._failure = error
            if self.executor is not None:  # a start has its own report
                self.get_logger().error(f"{step.__name__}: {error}")
            return TransitionCallbackReturn.FAILURE
        self.active = active
        return TransitionCallbackReturn.SUCCESS

    def _on_change_state(self, request: Any, response: Any) -> Any:
        """A transition that does not lead from the present state ends rclpy's own callback."""
        try:
            return self._change_state(request, response)
        except RCLError as error:
            self.get_logger().warning(str(error).splitlines()[0])
            response.success = False
            return response
