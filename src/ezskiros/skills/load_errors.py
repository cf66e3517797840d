"""EZS0xx: files of skills that cannot be loaded; EZS23x: what modules do when they are imported."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoFile(Error, code="EZS001", name="no-file"):
    """A path that leads nowhere."""

    title = "there is no file {path}"
    path: str

    class NoModule(Remark):
        says = (
            "no module of this name is found either: install it, or run this in the folder that "
            "it is in"
        )


class NoPython(Error, code="EZS002", name="no-python"):
    """A file that Python does not understand."""

    title = "this is not Python: {said}"
    note = "the skills of this file are not checked"
    said: str

    class Encoding(Remark):
        says = (
            "save the file in UTF-8, or say what it is in by its first line: `# -*- coding: "
            "latin-1 -*-`"
        )


class ModuleFailed(Error, code="EZS003", name="module-failed"):
    """A module that cannot be imported."""

    title = "the module cannot be imported: {exception}"
    label = "{said}"
    note = "the skills of this file are not checked"
    exception: str
    said: str

    class Refused(Remark):
        says = (
            "a check changes no file, starts no process and uses no network: import what does in "
            "the methods that use it"
        )

    class Star(Remark):
        says = "`{module}` is not installed, and gives no names to `import *`: import them by name"
        module: str


class StandIn(Warning, code="EZS004", name="stand-in"):
    """An import that is not installed."""

    title = "`{module}` is not installed: a stand-in takes its place"
    label = "what it does is not checked"
    help = "skills are checked without ROS and without drivers; install it if the check needs it"
    module: str


class NoSkills(Warning, code="EZS005", name="no-skills"):
    """Files without a skill."""

    title = "no skill is defined in {path}"
    help = "a skill is a class that inherits `ezskiros.SkillDescription`"
    path: str


class ImportSideEffect(Warning, code="EZS231", name="import-side-effect"):
    """A module that does something when it is imported."""

    title = "the module {deed} when it is imported"
    label = "not done: a check does nothing to the world"
    help = "let the implementation of the skill do this when it runs"
    deed: str


class EndlessImport(Error, code="EZS232", name="endless-import"):
    """A module whose import takes too long."""

    title = "the import of the module does not end within {seconds:g} s"
    label = "it was here when its time was over"
    note = "the skills of this file are not checked"
    help = "define classes and functions in a module, and let the implementation do what takes long"
    seconds: float


class ClientStandIn(Warning, code="EZS233", name="client-stand-in"):
    """An import that talks to ROS."""

    title = "`{module}` talks to ROS: a stand-in takes its place"
    label = "what it does is not checked"
    help = "import it in the implementation, where it is used: skills are checked without ROS"
    module: str


ALL: tuple[type[Template], ...] = (
    NoFile,
    NoPython,
    ModuleFailed,
    StandIn,
    NoSkills,
    ImportSideEffect,
    EndlessImport,
    ClientStandIn,
)
