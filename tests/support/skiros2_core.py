# mypy: ignore-errors
"""The core of real SkiROS2 in one process: its loader, its instances, its visitor and its world
model, without a ROS master.

Needs the Python packages of SkiROS2's branch for ROS 1, with those of ROS that they import, and
`ROS_PACKAGE_PATH` for its ontology.
"""

from __future__ import annotations

import os
import uuid
from pathlib import Path


class _Monitor:
    """Tells the interface what has changed: later, as a topic does."""

    def __init__(self):
        self._waiting = []

    def publish(self, message):
        self._waiting.append(message)

    def deliver(self, to):
        messages, self._waiting = self._waiting, []
        for each in messages:
            to(each)


def _server(workspace, scene):
    """The world model server with the ontologies of SkiROS2, and the files of a workspace, without
    its services.
    """
    import rospy
    from skiros2_common.core.world_element import Element
    from skiros2_common.tools.plugin_loader import PluginLoader
    from skiros2_common.tools.time_keeper import TimeKeeper
    from skiros2_world_model.core.world_model import WorldModel
    from skiros2_world_model.ros.world_model_server import WorldModelServer

    rospy.rostime.set_rostime_initialized(True)
    Element._plug_loader, Element._property_reasoner_map = PluginLoader(), {}
    server = object.__new__(WorldModelServer)
    server._verbose, server._times = False, TimeKeeper()
    server._curr_snapshot, server._monitor = uuid.uuid4(), _Monitor()
    server._ontology = WorldModel(False, "scene", server._wm_change_cb)
    server.contexts = {"scene": server._ontology}
    folders = [*os.environ.get("ROS_PACKAGE_PATH", "").split(":")]
    for folder in [*(Path(each) / "skiros2" / "owl" for each in folders), workspace]:
        for path in sorted(folder.rglob("*.owl")) if folder else ():
            server._ontology.load(str(path))
    server._ontology.set_default_prefix("skiros", "http://rvmi.aau.dk/ontologies/skiros.owl#")
    server._ontology.reset()
    if scene:
        server._ontology.workspace = str(workspace)
        server._ontology.load_context(scene)
    server._ontology._bind("", "")
    return server


class Core:
    """SkiROS2 with a robot `cora:Robot` in its world, or with the scene of a workspace."""

    def __init__(self, workspace=None, scene=None):
        from skiros2_common.core.world_element import Element
        from skiros2_skill.core.skill_instanciator import SkillInstanciator
        from skiros2_world_model.ros.world_model_interface import WorldModelInterface

        server = _server(workspace, scene)
        self.wm = object.__new__(WorldModelInterface)
        WorldModelInterface._elements_cache.clear()
        for name, value in {
            "_author_name": "test",
            "_def_prefix": "skiros:",
            "_sub_classes_cache": {},
            "_sub_properties_cache": {},
            "_last_snapshot_id": "",
            "_make_cache": True,
            "_external_monitor_cb": None,
            "_call": lambda service, message: service(message),
            "_ontology_query": server._wo_query_cb,
            "_ontology_modify": server._wo_modify_cb,
            "_set_relations": server._wm_set_rel_cb,
            "_query_relations": server._wm_query_rel_cb,
            "_get": server._wm_get_cb,
            "_modify": server._wm_modify_cb,
        }.items():
            setattr(self.wm, name, value)
        self._monitor = server._monitor
        self.instanciator = SkillInstanciator(self.wm)
        self.robot = None if scene else self.add("cora:Robot", "robot")
        self._element = Element

    def add(self, kind, label=""):
        from skiros2_common.core.world_element import Element

        return self.wm.add_element(Element(kind, label))

    def individuals(self, kind="", label=""):
        from skiros2_common.core.world_element import Element

        return self.wm.resolve_elements(Element(kind, label))

    def labelled(self, kind, label):
        (found,) = self.individuals(kind, label)
        return found

    def load(self, library, *skills):
        """Load skills as the skill manager does at its start."""
        self.instanciator.load_library(library, False)
        for each in skills:
            self.instanciator.add_instance(each)

    def forget(self):
        """Forget all skills."""
        from skiros2_skill.core.skill_instanciator import SkillInstanciator

        self.instanciator = SkillInstanciator(self.wm)

    def run(self, type_name, label, most_ticks=50, **given):
        """Run a task with one skill: its state at the end, and what its nodes have reported."""
        reported, states = [], []
        for state, visitor in self.ticks(type_name, label, most_ticks, **given):
            states.append(state.name)
            for _, each in visitor.snapshot():
                if each["msg"] not in ("", "Start", "End"):
                    reported.append(f"{each['label']} {each['state'].name} {each['msg'].strip()}")
        return states[-1], reported

    def ticks(self, type_name, label, most_ticks, **given):
        """The state after each tick of a task with one skill, and what visits its nodes."""
        from skiros2_common.core.abstract_skill import State
        from skiros2_skill.core.skill import Root, SkillWrapper
        from skiros2_skill.core.visitors import VisitorExecutor

        root = Root("root", self.wm)
        root.addChild(SkillWrapper(f"skiros:{type_name}", label, self.instanciator))
        for key, value in given.items():
            root.last().specifyParamDefault(key, value)
        visitor = VisitorExecutor(self.wm, self.instanciator)
        visitor.setVerbose(False)
        for _ in range(most_ticks):
            self._monitor.deliver(self.wm._monitor_cb)
            state = visitor.traverse(root)
            yield state, visitor
            if state is not State.Running:
                break
