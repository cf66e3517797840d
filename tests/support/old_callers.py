"""Skills of SkiROS2 that are built on a class with a client, which is none of ROS here."""

from __future__ import annotations

from ezskiros.migrate.module import migrate_text

OLD = """\
from skiros2_skill.core.skill import SkillDescription
from skiros2_common.core.abstract_skill import State
from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_common.core.world_element import Element


class Client:
    asked = []

    def call(self, request, ticks):
        self.asked.append(request)
        self.left = ticks

    def answer(self):
        self.left -= 1
        return self.left <= 0

    def cancel(self):
        self.asked.append("cancelled")


class Caller(PrimitiveBase):
    def onInit(self):
        self.client = self.make_client()
        Client.asked.append("made")

    def onStart(self):
        if self.client is None:
            return self.startError("nobody listens", -101)
        self.client.call(self.what(), self.params["Ticks"].value)
        return True

    def execute(self):
        return self.on_done() if self.client.answer() else State.Running

    def onPreempt(self):
        self.client.cancel()
        return self.fail("cancelled", -1)

    def make_client(self):
        return Client()

    def what(self):
        return ""

    def on_done(self):
        return self.success("done")


class Greet(SkillDescription):
    def createDescription(self):
        self.addParam("Text", "hello", ParamTypes.Required)
        self.addParam("Ticks", 3, ParamTypes.Required)


class greet(Caller):
    def createDescription(self):
        self.setDescription(Greet(), self.__class__.__name__)

    def what(self):
        return self.params["Text"].value

    def on_done(self):
        return self.success("greeted")


class greet_nobody(Caller):
    def createDescription(self):
        self.setDescription(Greet(), self.__class__.__name__)

    def make_client(self):
        return None
"""


def new_callers() -> str:
    """The same, migrated."""
    found = migrate_text("skills.py", OLD)
    assert not found.diagnostics, [each.title for each in found.diagnostics]
    return found.text
