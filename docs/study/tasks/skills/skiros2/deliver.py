"""Skills of a robot that delivers what its gripper holds."""

from skiros2_common.core.params import ParamTypes
from skiros2_common.core.primitive import PrimitiveBase
from skiros2_common.core.world_element import Element
from skiros2_skill.core.skill import SerialStar, SkillBase, SkillDescription


class Drive(SkillDescription):
    """Drives the robot to another place."""

    def createDescription(self):
        self.addParam("Robot", Element("cora:Robot"), ParamTypes.Required)
        self.addParam("Start", Element("skiros:Location"), ParamTypes.Inferred)
        self.addParam("Target", Element("skiros:Location"), ParamTypes.Required)
        self.addPreCondition(self.getRelationCond("AtStart", "skiros:at", "Robot", "Start", True))
        self.addPostCondition(self.getRelationCond("AtTarget", "skiros:at", "Robot", "Target", True))
        self.addPostCondition(self.getRelationCond("Left", "skiros:at", "Robot", "Start", False))


class drive(PrimitiveBase):
    """Drives at once: this is a simulation."""

    def createDescription(self):
        self.setDescription(Drive(), self.__class__.__name__)

    def execute(self):
        return self.success("at %s" % self.params["Target"].value)


class Release(SkillDescription):
    """Opens the gripper above a place. Force is in N."""

    def createDescription(self):
        self.addParam("Robot", Element("cora:Robot"), ParamTypes.Inferred)
        self.addParam("Gripper", Element("rparts:GripperEffector"), ParamTypes.Required)
        self.addParam("Object", Element("skiros:Product"), ParamTypes.Inferred)
        self.addParam("Place", Element("skiros:Location"), ParamTypes.Required)
        self.addParam("Force", 2.0, ParamTypes.Required)
        self.addPreCondition(self.getRelationCond("AtPlace", "skiros:at", "Robot", "Place", True))
        self.addPreCondition(self.getRelationCond("Holds", "skiros:contain", "Gripper", "Object", True))
        self.addPostCondition(self.getRelationCond("Empty", "skiros:contain", "Gripper", "Object", False))
        self.addPostCondition(self.getRelationCond("Placed", "skiros:contain", "Place", "Object", True))


class release(PrimitiveBase):
    """Releases at once: this is a simulation."""

    def createDescription(self):
        self.setDescription(Release(), self.__class__.__name__)

    def execute(self):
        return self.success("%s is released" % self.params["Object"].value)


class Deliver(SkillDescription):
    """Brings what the gripper holds to a shelf."""

    def createDescription(self):
        self.addParam("Robot", Element("cora:Robot"), ParamTypes.Required)
        self.addParam("Start", Element("skiros:Location"), ParamTypes.Inferred)
        self.addParam("Gripper", Element("rparts:GripperEffector"), ParamTypes.Required)
        self.addParam("Object", Element("skiros:Product"), ParamTypes.Inferred)
        self.addParam("Shelf", Element("skiros:Location"), ParamTypes.Required)
        self.addParam("Grip", 2.0, ParamTypes.Required)
        self.addPreCondition(self.getRelationCond("AtStart", "skiros:at", "Robot", "Start", True))
        self.addPreCondition(self.getRelationCond("Holding", "skiros:contain", "Gripper", "Object", True))
        self.addPostCondition(self.getRelationCond("AtShelf", "skiros:at", "Robot", "Shelf", True))
        self.addPostCondition(self.getRelationCond("OnShelf", "skiros:contain", "Shelf", "Object", True))


class deliver(SkillBase):
    """Drives first and then releases."""

    def createDescription(self):
        self.setDescription(Deliver(), self.__class__.__name__)

    def expand(self, skill):
        skill.setProcessor(SerialStar())
        skill(
            self.skill("Drive", "", remap={"Target": "Shelf"}),
            self.skill("Release", "", remap={"Place": "Shelf", "Force": "Grip"}),
        )
