"""The controller of the arm: an action server that carries the block to places and puts it down.

The arm carries stiffly along trajectories, and is compliant while it places. It places at the
expected position of the table. After it has touched the table once, it uses the measured position:
it approaches slowly and lets go as soon as it feels the table.

The speed can be scaled. The arm can be stopped, and can be made gravity-free. The current motion
then waits, and continues from the arm's position.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from heron.goals import ARM, Goal, number_in
from heron.messages import Message
from heron.robot.admittance import Admittance
from heron.robot.arm import Arm
from heron.robot.physics import Floats
from heron.robot.pressing import Pressing
from heron.robot.trajectory import Trajectory, duration_of
from heron.scene.scene import STEP_NS
from heron.topics import ARM_STOP, GRAVITY_FREE, WRENCH, Carrier, NodeParameter

STIFFNESS = "/arm_controller.stiffness"
SPEED_SCALE = "/arm_controller.speed_scale"
PLACE = "place"
RETRACTED = "retracted"
BACKED_OFF = "backed_off"
GRASP = "grasp"
_NEVER = -(10**18)
_GRAVITY = 9.81
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class ArmControllerParameters:
    """Rate in Hz, lengths in m, speeds in m/s, accelerations in m/s^2, times in s, forces in N."""

    rate: float = 125.0
    stiffness: float = 500.0
    carrying_speed: float = 0.5
    carrying_acceleration: float = 1.5
    rescaling: float = 5.0
    """The fastest change of the scale of its speed, per s: it stops within a fifth of a second."""
    speed: float = 0.08
    careful_speed: float = 0.02
    careful_from: float = 0.02
    touch: float = 5.0
    release: float = 6.0
    retraction: float = 0.04
    backing: float = 0.05
    reached: float = 0.005
    payload: float = 0.5
    """The mass of the block (kg). Without the block, its weight is missing in the force reading."""
    patience: float = 3.0
    """For so long it pushes towards a place that it does not reach; then it lets go."""
    stop_timeout: float = 0.25


class ArmController:
    """Goals are `{"pose": "place"}`, `{"pose": "retracted"}`, `{"pose": "backed_off"}` and
    `{"pose": "grasp"}`, and places to carry the block to, with the time limit `seconds`. `places`
    are the positions of the center of the block. `place` is the assumed position on the table.
    `pressings` are goals as well: motions in contact.
    """

    period_ns = STEP_NS

    def __init__(
        self,
        arm: Arm,
        carrier: Carrier,
        places: Mapping[str, Floats],
        parameters: ArmControllerParameters,
        pressings: Mapping[str, Pressing] | None = None,
    ) -> None:
        self._arm = arm
        self._places = places
        self._pressings = pressings or {}
        self._pressing: Pressing | None = None
        self._parameters = parameters
        self._step_s = 1 / parameters.rate
        self._steps = round(1e9 / parameters.rate / STEP_NS)
        self._admittance = Admittance(arm.grasp.copy(), parameters.stiffness)
        self._wanted = self._target = arm.grasp.copy()
        self._force = np.zeros(3)
        self._trajectory: Trajectory | None = None
        self._scale = self._pace = 1.0
        self._stopped_ns = self._loosened_ns = _NEVER
        self._is_loose = False
        self._goal: str | None = None
        self._done: Callable[[bool], None] = _nobody
        self._arrived_ns: int | None = None
        self._felt_height: float | None = None
        self._is_careful = False
        self.has_let_go = False
        self.attempts = 0
        carrier.subscribe(WRENCH, self._feel)
        carrier.subscribe(ARM_STOP, self._stop)
        carrier.subscribe(GRAVITY_FREE, self._loosen)
        carrier.serve(ARM, self)
        carrier.declare(STIFFNESS, NodeParameter(lambda: self._admittance.stiffness, self._soften))
        carrier.declare(SPEED_SCALE, NodeParameter(lambda: self._scale, self.scale_speed))

    # --- goals -------------------------------------------------------------------------------

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """Replace the current goal by a new goal."""
        self.cancel()
        self._goal = str(goal.get("pose"))
        self._done = done
        if self._goal == PLACE and not self.has_let_go:
            self._begin_to_place()
        elif self._goal in (PLACE, RETRACTED):  # a placed block need not be placed again
            self._rise()
        elif self._goal == BACKED_OFF:
            self._back_off()
        elif self._goal == GRASP:
            self._end(is_reached=self._arm.take_hold())
        elif self._goal in self._pressings:
            self._pressing = self._pressings[self._goal]
            self._pressing.begin(self._arm.grasp.copy())
        elif self._goal in self._places:
            self._begin_to_carry(number_in(goal, "seconds"))
        else:
            self._end(is_reached=False)

    def cancel(self) -> None:
        """The goal at hand, if there is one, is given up: the arm stays where it is."""
        self._wanted = self._target = self._arm.grasp.copy()
        self._trajectory = self._pressing = None
        self._end(is_reached=False)

    def lead_up(self, height: float) -> None:
        """The operator leads the stopped arm up by hand, and corrects the target of the block."""
        self._felt_height = height
        place = self._arm.grasp + _UP * self._parameters.retraction
        self._wanted = self._admittance.place = place
        if self._goal == PLACE:
            self._begin_to_place()

    def scale_speed(self, scale: float) -> None:
        """Scale all speeds by this factor (0 to 1), until the next call."""
        self._scale = max(0.0, min(1.0, scale))

    def _begin_to_carry(self, seconds: float = 0.0) -> None:
        """Move there in this time (s), or without a time at the usual speed."""
        found, start = self._parameters, self._arm.grasp
        self._target = self._places[str(self._goal)].copy()
        usual = duration_of(start, self._target, found.carrying_speed, found.carrying_acceleration)
        self._trajectory = Trajectory(start, self._target, seconds or usual)

    def _begin_to_place(self) -> None:
        self.attempts += 1
        self._arrived_ns = None
        self._is_careful = self._felt_height is not None
        self._target = self._places[PLACE].copy()
        if self._felt_height is not None:
            self._target[2] = self._felt_height

    def _rise(self) -> None:
        self._wanted = self._arm.grasp.copy()
        self._target = self._wanted + _UP * self._parameters.retraction

    def _back_off(self) -> None:
        """Move away from the felt force."""
        felt = max(float(np.linalg.norm(self._force)), 1e-9)
        self._wanted = self._arm.grasp.copy()
        self._target = self._wanted + self._force * (self._parameters.backing / felt)

    def _end(self, *, is_reached: bool) -> None:
        done, self._done, self._goal = self._done, _nobody, None
        done(is_reached)

    # --- motion ------------------------------------------------------------------------------

    def tick(self, now_ns: int) -> None:
        """Process one step. The controller decides at its own rate, and the servos continue in
        between.
        """
        if now_ns // STEP_NS % self._steps:
            self._arm.glide()
        else:
            self._control(now_ns)

    def _control(self, now_ns: int) -> None:
        if now_ns - self._loosened_ns <= self._parameters.stop_timeout * 1e9:
            self._is_loose = True
            self._arm.loosen()
            return
        if self._is_loose:
            self._take_up_again()
        is_stopped = now_ns - self._stopped_ns <= self._parameters.stop_timeout * 1e9
        self._change_pace(0.0 if is_stopped else self._scale)
        if self._trajectory is not None:
            self._carry(self._trajectory)
        elif is_stopped:
            self._stay()
        elif self._pressing is not None:
            self._press(self._pressing)
        else:
            self._go_on(now_ns)

    def _change_pace(self, wanted: float) -> None:
        most = self._parameters.rescaling * self._step_s
        self._pace += max(-most, min(most, wanted - self._pace))

    def _take_up_again(self) -> None:
        """Continue from rest at the position to which an operator has guided the arm."""
        self._is_loose = False
        self._pace = 0.0
        self._wanted = self._admittance.place = self._arm.grasp.copy()
        self._admittance.rest()
        if self._trajectory is not None:
            self._begin_to_carry()
        if self._pressing is not None:
            self._pressing.begin(self._arm.grasp.copy())

    def _carry(self, trajectory: Trajectory) -> None:
        """Move stiffly: a compliant motion would come too late."""
        self._wanted = self._admittance.place = trajectory.advance(self._pace * self._step_s)
        self._admittance.rest()
        self._arm.move(self._wanted, self._steps)
        if trajectory.is_over and self._is_there():
            self._trajectory = None
            self._end(is_reached=True)

    def _press(self, pressing: Pressing) -> None:
        """In contact, as that motion wants it."""
        place = pressing.step(self._arm.grasp, self._force, self._step_s, self._pace)
        self._wanted = self._admittance.place = place
        self._admittance.rest()
        self._arm.move(place, self._steps)
        if pressing.is_over:
            self._pressing = None
            self._target = self._arm.grasp.copy()
            self._end(is_reached=True)

    def _stay(self) -> None:
        """Stay at the position to which the arm yielded, or to which an operator guides it by
        hand.
        """
        self._admittance.rest()
        most = self._parameters.speed * self._step_s
        self._arm.move(_towards(self._arm.commanded, self._admittance.place, most))

    def _go_on(self, now_ns: int) -> None:
        """The place that is wanted moves towards the target."""
        self._wanted = _towards(self._wanted, self._target, self._most())
        self._arm.move(self._admittance.step(self._wanted, self._force, self._step_s))
        if self._goal == PLACE and not self.has_let_go:
            self._look_for_table(now_ns)
        elif self._goal is not None and self._is_there():
            self._end(is_reached=True)

    def _most(self) -> float:
        """The longest distance in one period."""
        found = self._parameters
        left = float(np.linalg.norm(self._target - self._wanted))
        is_slow = self._goal == PLACE and self._is_careful and left < found.careful_from
        return (found.careful_speed if is_slow else found.speed) * self._pace * self._step_s

    def _look_for_table(self, now_ns: int) -> None:
        """Move down to the assumed height; or, once the height is known to be wrong, down to the
        contact.
        """
        found = self._parameters
        pushed = float(self._force[2])
        is_reported_to_be_there = np.array_equal(self._wanted, self._target)
        if self._is_careful:
            if pushed > found.release:
                self._let_go()
            elif is_reported_to_be_there:
                self._target = self._target - _UP * (found.careful_speed * self._step_s)
            return
        if pushed > found.touch and self._felt_height is None:
            self._felt_height = float(self._arm.grasp[2])
        if self._arrived_ns is None and is_reported_to_be_there:
            self._arrived_ns = now_ns
        pushing_s = 0.0 if self._arrived_ns is None else (now_ns - self._arrived_ns) * 1e-9
        if self._is_there() or pushing_s > found.patience:
            self._let_go()

    def _let_go(self) -> None:
        self._arm.let_go()
        self.has_let_go = True
        self._rise()

    def _is_there(self) -> bool:
        distance = float(np.linalg.norm(self._arm.grasp - self._target))
        return distance < self._parameters.reached

    # --- what is heard -----------------------------------------------------------------------

    def _feel(self, message: Message) -> None:
        force = message.wrench.force
        missing = _GRAVITY * self._parameters.payload if self.has_let_go else 0.0
        self._force = np.array([force.x, force.y, force.z - missing])

    def _stop(self, message: Message) -> None:
        self._stopped_ns = self._arm.now_ns if message.data else _NEVER

    def _loosen(self, message: Message) -> None:
        self._loosened_ns = self._arm.now_ns if message.data else _NEVER

    def _soften(self, stiffness: float) -> None:
        self._admittance.stiffness = stiffness


def _towards(place: Floats, target: Floats, most: float) -> Floats:
    """A place nearer to the target."""
    offset = target - place
    distance = float(np.linalg.norm(offset))
    return target.copy() if distance <= most else place + offset * (most / distance)


def _nobody(_: bool) -> None:
    """Forget the goal; no client waits for it."""
