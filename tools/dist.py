"""Build the distributions of `packages/`, check them, and try them in clean environments.

`make dist` writes wheels and source distributions into `dist/`. Each trial below gets a new
environment for every supported Python on this machine; pip fetches the dependencies of the wheels.
The exit code is 1 if a trial fails.
"""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from packaging.metadata import Metadata

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ROOT / "packages"
OUT = ROOT / "dist"
SUPPORTED = ("3.10", "3.11", "3.12", "3.13", "3.14")
"""The supported versions of Python. Only the versions on this machine are tried."""

_PLACEHOLDER = "rossmarie.example"
"""The address in metadata and READMEs: `.example` is reserved (RFC 2606) and has no owner."""

_MEGABYTE = 1_000_000
_SHOWN = 2000  # characters of the output of a failed command


@dataclass(frozen=True)
class Expected:
    """A command of a trial, the texts that its output must contain, and the exit code."""

    command: str
    texts: Sequence[str] = ()
    code: int = 0


@dataclass(frozen=True)
class Trial:
    """A requirement to install into a clean environment, and commands to run there."""

    requirement: str
    commands: Sequence[Expected]
    oldest: str = SUPPORTED[0]


_ROBOT = "turtlebot4/turtlebot4"
_NO_ERRORS = "no errors in 1 file"
_NOT_ASKED = "warning[ROSS730]"
_LOCATED = """
with open("pick_place/lab.turtle", "a") as scene:
    scene.write('skiros:Product-7 <http://www.opengis.net/ont/geosparql#asWKT> "POINT (0 0)" .')
"""
TRIALS = (
    Trial(
        "rossmarie-common",
        (
            Expected("python -c 'import dslkit.command_line'"),
            Expected("python -c 'import dslkit.campaign'"),
        ),
    ),
    Trial(
        "rossmarie",
        (
            Expected("rossmarie --version", ("rossmarie 0.",)),
            Expected("python -m rossmarie --version", ("rossmarie 0.",)),
            Expected("rossmarie example turtlebot4", (f"wrote {_ROBOT}.mcap", "now try: ")),
            Expected(
                f"rossmarie check {_ROBOT}.ross", (_NOT_ASKED, "pip install 'rossmarie[solver]'")
            ),
            Expected("rossmarie explain ROSS301", ("# ROSS301 unit-mismatch",)),
            Expected("rossmarie example franka"),
            Expected("rossmarie check franka/franka.ross", (_NOT_ASKED,)),
            Expected(f"rossmarie graph {_ROBOT}.ross", ("robot",)),
            Expected(f"rossmarie export {_ROBOT}.ross --out rules.json"),
            Expected(f"rossmarie build {_ROBOT}.ross --out built", ("wrote built/",)),
            Expected(f"rossmarie build {_ROBOT}.ross --out module --target python"),
            Expected(
                f"rossmarie replay {_ROBOT}.ross {_ROBOT}.mcap",
                ("numpy", "pip install 'rossmarie[run]'"),
                code=2,
            ),
            Expected(
                f"rossmarie check --thorough {_ROBOT}.ross",
                ("z3", "pip install 'rossmarie[solver]'"),
                code=2,
            ),
            Expected(f"rossmarie failures {_ROBOT}.ross", ("'rossmarie[solver]'",), code=2),
            Expected(
                f"rossmarie check --skills {_ROBOT}.ross",
                ("pip install 'rossmarie[skills]'",),
                code=2,
            ),
            Expected("python -c 'import rossmarie.gym'", ("pip install 'rossmarie[gym]'",), code=1),
            Expected("python -c 'from rossmarie import load'", ("'rossmarie[run]'",), code=1),
        ),
    ),
    Trial(
        "rossmarie[run,solver]",
        (
            Expected("rossmarie example turtlebot4"),
            Expected(f"rossmarie check {_ROBOT}.ross", (_NO_ERRORS,)),
            Expected(f"rossmarie replay {_ROBOT}.ross {_ROBOT}.mcap --out replayed"),
            Expected(f"rossmarie test {_ROBOT}.ross"),
            Expected(f"rossmarie failures {_ROBOT}.ross"),
        ),
    ),
    Trial(
        "ezskiros",
        (
            Expected("ezskiros --version", ("ezskiros 0.",)),
            Expected("python -m ezskiros --version", ("ezskiros 0.",)),
            Expected("ezskiros example pick_place", ("wrote pick_place/lab.turtle",)),
            Expected("ezskiros check pick_place/skills", ("no errors in 10 files",)),
            Expected("ezskiros show pick_and_place pick_place/skills", ("PickAndPlace",)),
            Expected(
                "ezskiros run pick_and_place pick_place/skills --simulate"
                " --scene pick_place/lab.turtle Object=cable Gripper=gripper PlacingLocation=shelf"
            ),
            Expected(
                "ezskiros migrate pick_place/skills",
                ("libcst", "pip install 'ezskiros[edit]'"),
                code=2,
            ),
            Expected(f"python -c {shlex.quote(_LOCATED)}"),
            Expected(
                "ezskiros check pick_place/lab.turtle --ontology pick_place/ontology",
                ("pip install 'ezskiros[locations]'",),
                code=2,
            ),
            Expected(
                "ezskiros check pick_place/skills --rules a.ross", ("'ezskiros[rules]'",), code=2
            ),
        ),
    ),
    Trial(
        "rossmarie-crosscheck",
        (
            Expected("crosscheck --version", ("crosscheck 0.",)),
            Expected("python -m crosscheck --version", ("crosscheck 0.",)),
            Expected("ezskiros example whiteboard"),
            Expected("crosscheck check whiteboard/whiteboard.ross", (_NO_ERRORS,)),
            Expected("rossmarie check --skills whiteboard/whiteboard.ross", (_NO_ERRORS,)),
        ),
    ),
    Trial(
        "heron-robot",
        (
            Expected("heron --version", ("heron 0.",)),
            Expected("python -m heron --version", ("heron 0.",)),
            Expected(
                "heron learn tree --steps 40000 --out learned",
                ("pip install 'heron-robot[learning]'",),
                code=2,
            ),
        ),
        oldest="3.11",  # MuJoCo has no wheels for older Pythons
    ),
)


def build(out: Path, *, with_sources: bool) -> list[Path]:
    """Build all distributions into an empty folder, without the network."""
    with TemporaryDirectory() as name:
        for project in sorted(PACKAGES.iterdir()):
            # The folders of `packages` are links to the sources; source distributions need files.
            copy = Path(name, project.name)
            shutil.copytree(project, copy, ignore=shutil.ignore_patterns("__pycache__"))
            kinds = () if with_sources else ("--wheel",)
            words = ("-m", "build", "--no-isolation", *kinds, "--outdir", str(out), str(copy))
            _run([sys.executable, *words])
    return sorted(out.iterdir())


def check(files: Sequence[Path]) -> None:
    """Check metadata as PyPI does, and the contents of wheels. Raises `ExceptionGroup` of
    packaging, or ends the run.
    """
    for file in files:
        found = Metadata.from_email(_metadata(file), validate=True)
        if any(_PLACEHOLDER in url for url in (found.project_urls or {}).values()):
            print(f"{file.name}: replace the placeholder {_PLACEHOLDER} before a release")
        if not found.description or found.description_content_type != "text/markdown":
            sys.exit(f"{file.name} has no description in Markdown")
    wheels = [str(each) for each in files if each.suffix == ".whl"]
    _run([str(Path(sys.executable).with_name("check-wheel-contents")), *wheels], folder=ROOT)


def _metadata(file: Path) -> bytes:
    if file.suffix == ".whl":
        with zipfile.ZipFile(file) as wheel:
            (name,) = (each for each in wheel.namelist() if each.endswith(".dist-info/METADATA"))
            return wheel.read(name)
    with tarfile.open(file) as source:
        member = source.extractfile(f"{file.name.removesuffix('.tar.gz')}/PKG-INFO")
        return member.read() if member else b""


def failures(trial: Trial, programs: Path, folder: Path) -> Iterator[str]:
    """Run the commands of a trial in a folder, with the programs of its environment, and yield a
    message for each failure.
    """
    environment = {"PATH": f"{programs}:/usr/bin:/bin", "HOME": str(folder), "LC_ALL": "C.UTF-8"}
    for each in trial.commands:
        words = shlex.split(each.command)
        program = shutil.which(words[0], path=str(programs)) or words[0]
        done = subprocess.run(
            [program, *words[1:]],
            cwd=folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        missing = [text for text in each.texts if text not in done.stdout]
        is_raw = each.command.startswith(programs_of_ours(trial)) and "Traceback" in done.stdout
        if done.returncode != each.code or missing or is_raw:
            yield (
                f"`{each.command}` has exit code {done.returncode}, expected {each.code}; missing "
                f"in the output: {missing}\n{done.stdout[-_SHOWN:]}"
            )


def programs_of_ours(trial: Trial) -> tuple[str, ...]:
    """The programs of this project in a trial. A user never sees a traceback of these programs."""
    words = {each.command.partition(" ")[0] for each in trial.commands}
    return tuple(words - {"python"})


def pythons() -> Mapping[str, Path]:
    """The supported Pythons of this machine by their versions: this Python, the Pythons of pyenv,
    and the Pythons on the PATH.
    """
    kept = [Path(sys.base_prefix, "bin", "python3")]
    kept += sorted(Path.home().glob(".pyenv/versions/*/bin/python"))
    found: dict[str, Path] = {}
    for version in SUPPORTED:
        known = shutil.which(f"python{version}")
        for path in (*kept, *([Path(known)] if known else [])):
            asked = "import ensurepip, sys; print('%d.%d' % sys.version_info[:2])"
            done = subprocess.run([path, "-c", asked], capture_output=True, text=True, check=False)
            if done.stdout.strip() == version:
                found.setdefault(version, path)
    return found


def try_all(files: Sequence[Path], version: str, python: Path) -> bool:
    """Run all trials for one Python; True if no trial fails."""
    is_fine = True
    for trial in TRIALS:
        if _number(version) < _number(trial.oldest):
            print(f"{version}: {trial.requirement} needs Python {trial.oldest}")
            continue
        with TemporaryDirectory() as name:
            folder = Path(name, "work")
            folder.mkdir()
            _run([str(python), "-m", "venv", f"{name}/venv"])
            programs = Path(name, "venv", "bin")
            _install(programs / "python", trial.requirement, files)
            reported = list(failures(trial, programs, folder))
            size = sum(each.stat().st_size for each in programs.parent.rglob("*") if each.is_file())
            state = "as expected" if not reported else f"{len(reported)} NOT AS EXPECTED"
            count = f"{len(trial.commands)} commands, {state}"
            print(f"{version}: {trial.requirement}: {count}; {size / _MEGABYTE:.0f} MB", flush=True)
            print(*reported, sep="\n", end="\n" if reported else "")
            is_fine = is_fine and not reported
    return is_fine


def _install(python: Path, requirement: str, files: Sequence[Path]) -> None:
    quiet = ("--quiet", "--disable-pip-version-check", "--no-compile")
    ours = ("--find-links", str(files[0].parent))
    _run([str(python), "-m", "pip", "install", *quiet, *ours, requirement])


def _number(version: str) -> tuple[int, ...]:
    return tuple(map(int, version.split(".")))


def _run(words: Sequence[str], folder: Path | None = None) -> None:
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{shlex.join(words)} failed:\n{done.stdout}{done.stderr}")


def main() -> None:
    """Build, check and try all distributions."""
    shutil.rmtree(OUT, ignore_errors=True)
    files = build(OUT, with_sources=True)
    check(files)
    print(*(f"wrote {each}" for each in files), sep="\n", flush=True)
    found = pythons()
    results = [try_all(files, version, python) for version, python in found.items()]
    lacking = [version for version in SUPPORTED if version not in found]
    if lacking:
        print(f"not tried, because not on this machine: Python {', '.join(lacking)}")
    sys.exit(not all(results) or not results)


if __name__ == "__main__":
    main()
