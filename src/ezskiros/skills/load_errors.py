"""EZS0xx: skill files that cannot be loaded; EZS23x: side effects of imports."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class NoFile(Error, code="EZS001", name="no-file"):
    """A path that does not exist."""

    title = "there is no file {path}"
    path: str

    class NoModule(Remark):
        says = (
            "no module has this name either: install the module, or run the command in its folder"
        )


class NoPython(Error, code="EZS002", name="no-python"):
    """A file with a Python syntax error or another encoding."""

    title = "this is not valid Python: {said}"
    note = "the skills of this file are not checked"
    said: str

    class Encoding(Remark):
        says = (
            "save the file as UTF-8, or declare its encoding in the first line: `# -*- coding: "
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
            "a check writes no files, starts no processes and uses no network: move imports "
            "that do so into the methods that use them"
        )

    class Star(Remark):
        says = "`{module}` is not installed, so `import *` defines no names: import them one by one"
        module: str


class StandIn(Warning, code="EZS004", name="stand-in"):
    """An imported module that is not installed."""

    title = "`{module}` is not installed and is replaced by a stand-in"
    label = "calls of this module are not checked"
    help = "a check needs neither ROS nor drivers; install the module if the check needs it"
    module: str


class NoSkills(Warning, code="EZS005", name="no-skills"):
    """A path without skills."""

    title = "{path} defines no skill"
    help = "a skill is a class that inherits from `ezskiros.SkillDescription`"
    path: str


class ImportSideEffect(Warning, code="EZS231", name="import-side-effect"):
    """A module with a side effect when it is imported."""

    title = "the module {deed} when it is imported"
    label = "skipped: a check has no side effects"
    help = "move this call into the implementation of the skill, such as `onStart`"
    deed: str


class EndlessImport(Error, code="EZS232", name="endless-import"):
    """A module whose import takes too long."""

    title = "the import of the module does not end within {seconds:g} s"
    label = "the import was still running here"
    note = "the skills of this file are not checked"
    help = "move the slow call into the implementation of the skill"
    seconds: float


class ClientStandIn(Warning, code="EZS233", name="client-stand-in"):
    """An imported module that talks to ROS."""

    title = "`{module}` talks to ROS and is replaced by a stand-in"
    label = "calls of this module are not checked"
    help = "import the module in the implementation that uses it: a check runs without ROS"
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
