"""ROSS8xx: files that cannot be read or found, or have too many findings."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class FileUnreadable(Error, code="ROSS801", name="file-unreadable"):
    """A rules file that the operating system cannot open."""

    title = "cannot read `{path}`"
    label = "{reason}"
    path: str
    reason: str

    class CheckPath(Remark):
        says = "check the path and the read permission of the file"

    class NameRules(Remark):
        says = "name one rules file{example}"
        example: str


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

    title = "there is no file `{path}` to import"
    label = "looked for {looked_for}"
    note = "the path of an import is relative to the importing file"
    path: str
    looked_for: str

    class CheckPath(Remark):
        says = "check the path"


class TooManyWarnings(Warning, code="ROSS804", name="too-many-warnings"):
    """The point at which the warnings of a file are cut off."""

    title = "this file has more than {limit} warnings"
    label = "warnings from here on are not shown"
    help = "fix the warnings above; many of the others usually have the same cause"
    limit: int


class OtherGeneration(Error, code="ROSS805", name="other-generation"):
    """A package for one generation of ROS where a package for the other is to be generated."""

    title = "`{folder}` holds a package for {found}, not for {wanted}"
    label = "this line makes the package a package for {found}"
    note = "old files would stay beside the new files, and {wanted} cannot build the old files"
    help = "choose another folder with --out, or remove `{folder}`"
    folder: str
    found: str
    wanted: str


class OtherPackage(Error, code="ROSS806", name="other-package"):
    """A package that was not generated from these rules, in the output folder."""

    title = "`{folder}` holds the package `{package}`, which was not generated from {rules}"
    label = "`build` would replace this package"
    help = "choose another folder with --out: a generated package needs a folder of its own"
    folder: str
    package: str
    rules: str


class MalformedPackageXml(Error, code="ROSS807", name="malformed-package-xml"):
    """A package.xml that is not well-formed XML."""

    title = "this package.xml is not well-formed XML"
    label = "{reason}"
    note = (
        "`build` reads the package.xml in the output folder, and the package.xml of the package "
        "that holds the rules"
    )
    help = "correct the file at this position; `xmllint --noout package.xml` finds the next error"
    reason: str


class BadPackageField(Error, code="ROSS808", name="bad-package-field"):
    """A field of the package of the rules that is not valid in a generated package."""

    title = "the generated package cannot use this `{field}`"
    label = "{form}"
    note = (
        "`build` takes licence, maintainers and version from the package.xml in the folder of the "
        "rules"
    )
    help = (
        "correct the field here; a licence and a maintainer can also be given as options of `build`"
    )
    field: str
    form: str


class RulesAsSystem(Error, code="ROSS811", name="rules-as-system"):
    """A file with rules in the place of a system model."""

    title = "`{path}` is not a system model: it contains rules"
    label = "the first rule"
    note = (
        "a system model declares the topics, types and places of a robot, for several rules files"
    )
    help = "give the system model with --system, and the rules file as RULES"
    path: str


class NotARulesFile(Error, code="ROSS809", name="not-a-rules-file"):
    """A file beside the checked rules that is read as rules, but has another ending."""

    title = "`{path}` is not a rules file: its name does not end in .ross"
    label = "this file is not read"
    note = (
        "the author of an import may lack permission to read the file, so no text of the file is "
        "shown"
    )
    help = "name a file that ends in .ross; a link must point to such a file"
    path: str


class ForeignFile(Error, code="ROSS810", name="foreign-file"):
    """A file of another type in place of rules."""

    title = "`{path}` is {kind}, not a rules file"
    label = "the file begins with this text"
    note = (
        "the file name or the first bytes of the file show the kind; the rest of the file is not "
        "read"
    )
    path: str
    kind: str

    class NameRules(Remark):
        says = (
            "name a rules file, which ends in .ross; if this file contains rules, rename the file"
        )

    class Download(Remark):
        says = (
            "download the file itself, not the page that shows the file: most sites have a `raw` "
            "link"
        )


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
