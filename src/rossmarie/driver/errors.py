"""ROSS8xx: files that cannot be read or found, or have too many findings."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class FileUnreadable(Error, code="ROSS801", name="file-unreadable"):
    """A rules file that the operating system cannot open."""

    title = "cannot read `{path}`"
    label = "{reason}"
    help = "check the path, and that the file may be read"
    path: str
    reason: str


class NotUtf8(Error, code="ROSS802", name="not-utf8"):
    """A file that is not text in UTF-8."""

    title = "this file is not UTF-8 text"
    label = "byte {byte} cannot be decoded here"
    note = "rules files are plain text in UTF-8; this looks like {guess}"
    help = "save the file as UTF-8, or check that you named the right file"
    byte: str
    guess: str


class ImportNotFound(Error, code="ROSS803", name="import-not-found"):
    """An import of a file that does not exist."""

    title = "no file `{path}` to import"
    label = "looked for {looked_for}"
    note = "the path of an import is relative to the file that imports"
    path: str
    looked_for: str

    class CheckPath(Remark):
        says = "check the path"


class TooManyWarnings(Warning, code="ROSS804", name="too-many-warnings"):
    """The point at which the warnings of a file are cut off."""

    title = "there are more than {limit} warnings in this file"
    label = "none is shown from here on"
    help = "mend what the warnings above say; many of the others usually have the same cause"
    limit: int


class OtherGeneration(Error, code="ROSS805", name="other-generation"):
    """A package for one generation of ROS where a package for the other is to be generated."""

    title = "`{folder}` holds a package for {found}, not for {wanted}"
    label = "this makes it a package for {found}"
    note = "files of the old package would stay beside the new ones, and {wanted} cannot build them"
    help = "choose another folder by --out, or remove `{folder}`"
    folder: str
    found: str
    wanted: str


class OtherPackage(Error, code="ROSS806", name="other-package"):
    """A package that was not generated from these rules, in the output folder."""

    title = "`{folder}` holds the package `{package}`, which was not generated from {rules}"
    label = "this package would be replaced"
    help = "choose another folder by --out: a generated package has a folder of its own"
    folder: str
    package: str
    rules: str


class MalformedPackageXml(Error, code="ROSS807", name="malformed-package-xml"):
    """A package.xml that is not well-formed XML."""

    title = "this package.xml is not well-formed XML"
    label = "{reason}"
    note = "a build reads the package.xml in its folder, and the one of the package of the rules"
    help = "correct the file at this place; `xmllint --noout package.xml` finds the next error"
    reason: str


class BadPackageField(Error, code="ROSS808", name="bad-package-field"):
    """A field of the package of the rules that is not valid in a generated package."""

    title = "the generated package cannot take over this `{field}`"
    label = "{form}"
    note = "licence, maintainers and version come from the package.xml of the folder of the rules"
    help = "correct it here; a licence and a maintainer can also be given as options of `build`"
    field: str
    form: str


class RulesAsSystem(Error, code="ROSS811", name="rules-as-system"):
    """A file with rules in the place of a system model."""

    title = "`{path}` is no system model: it has rules"
    label = "the first one"
    note = (
        "a system model declares the topics, types and places of a robot, for several rules files"
    )
    help = "name the system model by --system, and the rules file as RULES"
    path: str


class NotARulesFile(Error, code="ROSS809", name="not-a-rules-file"):
    """A file beside the checked rules that is read as rules, but has another ending."""

    title = "`{path}` is no rules file: its name does not end in .ross"
    label = "it is not read"
    note = "the author of an import may lack the right to read the file, so no text of it is shown"
    help = "name a file that ends in .ross; a link must lead to such a file"
    path: str


class ForeignFile(Error, code="ROSS810", name="foreign-file"):
    """A file of another type in place of rules."""

    title = "`{path}` is {kind}, not a rules file"
    label = "it begins like this"
    note = "its name says so, or the signs that it begins with; nothing else of it is read"
    path: str
    kind: str

    class NameRules(Remark):
        says = "name a file of rules, which ends in .ross; rules in this file need another name"

    class Download(Remark):
        says = "download the file itself and not the page that shows it: `raw` on most sites"


ALL: tuple[type[Template], ...] = (
    FileUnreadable,
    NotUtf8,
    ImportNotFound,
    TooManyWarnings,
    OtherGeneration,
    OtherPackage,
    MalformedPackageXml,
    BadPackageField,
    NotARulesFile,
    RulesAsSystem,
    ForeignFile,
)
