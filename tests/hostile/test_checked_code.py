"""Code that is checked can neither end a check unnoticed, nor take findings back, nor do
anything to the world.

Each attack is checked by the real command, in a module of its own between two others: `a.py` has
mistakes that have to be reported, and `c.py` has another one.
"""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import sysconfig
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from support import command_line
from support.ontologies import HALL
from support.parts import C_COMPILER, PROC, SECCOMP, needs
from support.skill_files import HEADER, WRONG, skill

FIRST = skill(WRONG) + "skiros.Nonsense\n"
LAST = skill("self.pre_conditions += Place.hasAA(Object)").replace("Skill(", "Last(")


def check(folder: Path, attack: str, *options: str) -> subprocess.CompletedProcess[str]:
    """A check of `a.py`, the attack in `b.py`, and `c.py`; it leaves nothing."""
    own = folder / "own"
    own.mkdir()
    (own / "a.py").write_text(FIRST)
    (own / "b.py").write_text(attack)
    (own / "c.py").write_text(LAST)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    done = command_line.run(
        "ezskiros", "check", "--ontology", HALL, *options, "own", folder=folder, timeout=120
    )
    after = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert after == before
    assert "Traceback" not in done.stdout + done.stderr
    return done


ENDS = {
    "the end by os": ("import os\nos._exit(0)", "EZS003", "it ends the process"),
    "the end by a thread": (
        "import os, _thread, time\n_thread.start_new_thread(os._exit, (0,))\nwhile True: pass",
        "EZS240",
        "with exit code 0",
    ),
    "the end by C": ("import ctypes\nctypes.pythonapi.exit(0)", "EZS240", "with exit code 0"),
    "a daemon": ("import os\nif os.fork():\n    os._exit(0)", "EZS003", "it ends the process"),
    "a daemon in C": (
        "import ctypes\nif ctypes.pythonapi.fork():\n    ctypes.pythonapi._exit(0)",
        "EZS240",
        "with exit code 0",
    ),
    "a crash": ("import ctypes\nctypes.string_at(0)", "EZS240", "SIGSEGV"),
    "an abort": ("import os\nos.abort()", "EZS240", "SIGABRT"),
    "a kill": ("import signal\nsignal.raise_signal(9)", "EZS240", "SIGKILL"),
    "a base exception": ("class E(BaseException): ...\nraise E", "EZS003", "imported: E"),
    "the exit of a generator": ("raise GeneratorExit", "EZS003", "GeneratorExit"),
    "a keyboard": ("raise KeyboardInterrupt", "EZS240", "`KeyboardInterrupt` was raised"),
    "no depth": (
        "import sys\nsys.setrecursionlimit(10 ** 9)\n"
        "def deeper(_): return sorted([1], key=deeper)\ndeeper(0)",
        "EZS240",
        "SIGSEGV",
    ),
    "little depth": ("import sys\nsys.setrecursionlimit(90)", "EZS301", "Place.hasAA"),
    "memory": ("found = [bytes(1 << 30) for _ in range(9)]", "EZS003", "MemoryError"),
    "closed files": ("import os\nos.closerange(0, 1000)", "EZS240", "ended"),
    "a forged report": (
        "import os\nfor file in range(3, 99):\n    try: os.write(file, b'[\"end\", 0]\\n')\n"
        "    except OSError: pass",
        "EZS240",
        "wrote into the report",
    ),
    "a changed function": (
        "from ezskiros import session\nsession.report = lambda found: None",
        "EZS241",
        "`ezskiros.session.report`",
    ),
    "a changed method": (
        "from dslkit.diagnostics import Collector\nCollector.add = lambda self, found: None",
        "EZS241",
        "`dslkit.diagnostics.collector.Collector.add`",
    ),
    "changed code": (
        "from ezskiros import session\n"
        "session.has_reported.__code__ = (lambda span: True).__code__",
        "EZS241",
        "`ezskiros.session.has_reported`",
    ),
    "a built-in function": (
        "import builtins\nbuiltins.sorted = lambda found, **_: []",
        "EZS241",
        "`builtins.sorted`",
    ),
    "a hidden built-in function": (
        "from dslkit.diagnostics import collector\ncollector.tuple = lambda _: ()",
        "EZS241",
        "`dslkit.diagnostics.collector.tuple`",
    ),
}


@pytest.mark.parametrize(("attack", "code", "said"), ENDS.values(), ids=ENDS)
def test_a_check_ends_with_an_error_that_says_why(
    tmp_path: Path, attack: str, code: str, said: str
) -> None:
    done = check(tmp_path, attack)
    assert done.returncode == 1
    assert "skiros.Nonsense" in done.stdout  # found before
    assert f"error[{code}]" in done.stdout
    assert said in done.stdout
    if code == "EZS003":
        assert "Object.hasAA" in done.stdout
        assert "Place.hasAA" in done.stdout
    if code != "EZS301":
        assert " own/b.py:" in done.stdout


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_streams_do_not_matter(tmp_path: Path, closed: str) -> None:
    (tmp_path / "right.py").write_text(skill("self.post_conditions += Place.contain(Object)"))
    (tmp_path / "wrong.py").write_text(FIRST)
    program = Path(sys.executable).with_name("ezskiros")
    for name, code in (("right.py", 0), ("wrong.py", 1)):
        command = f"{program} check --ontology {HALL} {name} {closed}"
        done = subprocess.run(["sh", "-c", command], cwd=tmp_path, capture_output=True, check=False)
        assert done.returncode == code


MEMORY = """\
found, size = [], 1 << 30
while size:
    try:
        found.append(bytes(size))
    except MemoryError:
        size //= 4
"""


@needs(SECCOMP)  # the limit binds on Linux
def test_no_memory_is_no_defect_of_ours(tmp_path: Path) -> None:
    done = check(tmp_path, MEMORY)
    assert done.returncode == 1
    assert "skiros.Nonsense" in done.stdout
    assert "error[EZS240]" in done.stdout


FINDINGS = """\
import gc
from dslkit.diagnostics import Collector
for each in gc.get_objects():
    if isinstance(each, Collector):
        each._found.clear()
"""


def test_findings_cannot_be_taken_back(tmp_path: Path) -> None:
    done = check(
        tmp_path,
        f"{HEADER}\nclass B(SkillDescription):\n    def description(self):\n"
        + "".join(f"        {line}\n" for line in FINDINGS.splitlines()),
    )
    assert done.returncode == 1
    assert "Object.hasAA" in done.stdout
    assert "Place.hasAA" in done.stdout


def test_a_program_reads_the_same_findings(tmp_path: Path) -> None:
    done = check(tmp_path, ENDS["a crash"][0], "--format", "json")
    assert done.returncode == 1
    assert '"code": "EZS240"' in done.stdout
    assert '"files": 3' in done.stdout


HANGS = {
    "an ignored alarm": (
        "import signal\nsignal.signal(signal.SIGALRM, signal.SIG_IGN)\nwhile True: pass",
        "EZS232",
        "does not end within 20 s",
    ),
    "a loop in C": (
        "import collections, itertools\ncollections.deque(itertools.repeat(0), maxlen=0)",
        "EZS240",
        "the code made no progress for 60 s",
    ),
    "a stop": (
        "import signal\nsignal.raise_signal(signal.SIGSTOP)",
        "EZS240",
        "the code made no progress for 60 s",
    ),
}


@pytest.mark.deep
@pytest.mark.parametrize(("attack", "code", "reason"), HANGS.values(), ids=HANGS)
def test_nothing_hangs(tmp_path: Path, attack: str, code: str, reason: str) -> None:
    start = time.monotonic()
    done = check(tmp_path, attack)
    assert done.returncode == 1
    assert f"error[{code}]" in done.stdout
    assert reason in done.stdout
    assert time.monotonic() - start < 100


@needs(PROC)
@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_check_that_is_ended_leaves_no_process(tmp_path: Path, sent: signal.Signals) -> None:
    (tmp_path / "endless.py").write_text(HANGS["an ignored alarm"][0])
    command = [str(Path(sys.executable).with_name("ezskiros")), "check", "endless.py"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE) as process:
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        wait_until(lambda: children.read_text() != "")
        child = Path(f"/proc/{children.read_text().strip()}")
        wait_until(lambda: _ignores_alarms(child))  # it is in the loop
        process.send_signal(sent)
        assert process.wait(60) != 0
    wait_until(lambda: "State:\tZ" in status(child) or status(child) == "")


def _ignores_alarms(process: Path) -> bool:
    found = re.search(r"SigIgn:\s*(\w+)", status(process))
    return found is not None and bool(int(found[1], 16) & 1 << signal.SIGALRM - 1)


def status(process: Path) -> str:
    try:
        return (process / "status").read_text()
    except OSError:
        return ""


def wait_until(is_so: Callable[[], bool]) -> None:
    limit = time.monotonic() + command_line.TIME_LIMIT_S
    while not is_so():
        assert time.monotonic() < limit
        time.sleep(0.05)


MADE = "(__import__('pathlib').Path(__file__).parents[1] / 'made')"
DEEDS = {
    "at the end": f"import atexit\natexit.register(lambda: {MADE}.touch())",
    "by a finalizer": (
        f"import weakref\nclass A: ...\na = A()\nweakref.finalize(a, lambda: {MADE}.touch())\ndel a"
    ),
    "by a finalizer at the end": (
        f"import weakref\nclass A: ...\na = A()\nweakref.finalize(a, lambda: {MADE}.touch())"
    ),
    "by a destructor": (
        f"class A:\n    def __del__(self, path={MADE}): path.touch()\na = A()\ndel a"
    ),
    "by a thread": (
        "import _thread, time\n"
        f"_thread.start_new_thread(lambda: {MADE}.touch(), ())\n"
        "end = time.monotonic() + 1\nwhile time.monotonic() < end: pass"
    ),
    "by C": (
        "import ctypes\nfopen = ctypes.pythonapi.fopen\nfopen.restype = ctypes.c_void_p\n"
        f"fopen(str({MADE}).encode(), b'w')"
    ),
    "by C, to a folder": f"import ctypes\nctypes.pythonapi.mkdir(str({MADE}).encode(), 0o700)",
    "by C, to a mode": ("import ctypes\nctypes.pythonapi.chmod(str(__file__).encode(), 0o777)\n"),
    "by a program in C": (
        f"import ctypes\npath = str({MADE})\nctypes.pythonapi.system(b'touch ' + path.encode())"
    ),
    "by a program": (
        "import _posixsubprocess, os\n"
        f"_posixsubprocess.fork_exec([b'touch', str({MADE}).encode()], [b'/usr/bin/touch'], True,"
        " (), None, None, *[-1] * 6, *os.pipe(), True, False, -1, None, None, None, -1, None, 0)"
    ),
    "by our own code": f"import ezskiros.cli.show as own\nfrom pathlib import Path\n"
    f"own._write({MADE}, 'made')",
}


@needs(SECCOMP)
@pytest.mark.parametrize("attack", DEEDS.values(), ids=DEEDS)
def test_nothing_is_done_to_the_world(tmp_path: Path, attack: str) -> None:
    mode = check(tmp_path, attack), (tmp_path / "own" / "b.py").stat().st_mode
    assert not (tmp_path / "made").exists()
    assert mode[1] & 0o777 != 0o777
    assert mode[0].returncode == 1
    assert "Object.hasAA" in mode[0].stdout
    assert "Place.hasAA" in mode[0].stdout


CONSTRUCTOR = """\
#include <stdio.h>
#include <stdlib.h>
__attribute__((constructor)) static void begin(void) {
    FILE *made = fopen(getenv("MADE"), "w");
    if (made) fclose(made);
}
"""


@needs(SECCOMP)
@needs(C_COMPILER)
def test_a_compiled_library_does_nothing(tmp_path: Path) -> None:
    source = tmp_path / "vendor.c"
    source.write_text(CONSTRUCTOR)
    (tmp_path / "own").mkdir()
    library = tmp_path / "own" / f"vendor{sysconfig.get_config_var('EXT_SUFFIX')}"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=True)
    (tmp_path / "own" / "b.py").write_text("import vendor\n")
    made = tmp_path / "made"
    command = ("ezskiros", "check", "own")
    done = command_line.run(*command, folder=tmp_path, variables={"MADE": str(made)})
    assert done.returncode == 1
    assert "vendor" in done.stdout
    assert not made.exists()


BEHIND = """\
try:
    import vendor
except PermissionError:
    raise OSError("there is no folder for fonts")
"""


@needs(SECCOMP)
@pytest.mark.parametrize("attack", ["import vendor", BEHIND], ids=["itself", "another error"])
def test_what_the_system_refuses_is_reported(tmp_path: Path, attack: str) -> None:
    (tmp_path / "vendor.py").write_text(DEEDS["by a program"])
    (tmp_path / "b.py").write_text(attack)
    done = command_line.run("ezskiros", "check", "b.py", folder=tmp_path)
    assert done.returncode == 1
    assert "error[EZS003]" in done.stdout
    assert "a check writes no files, starts no processes" in done.stdout


OTHERS = {
    "explain": ("explain", "Skill", "own"),
    "show": ("show", "Skill", "own"),
    "show a picture": ("show", "Skill", "--format", "svg", "--out", "picture.svg", "own"),
    "fix": ("check", "--fix", "own"),
    "plan": ("plan", "--goal", "(a b c)", "--scene", "none.turtle", "own"),
    "run": ("run", "--simulate", "Skill", "own"),
}


@pytest.mark.parametrize("words", OTHERS.values(), ids=OTHERS)
def test_other_commands_do_not_succeed_either(tmp_path: Path, words: tuple[str, ...]) -> None:
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "a.py").write_text(skill("pass"))
    (tmp_path / "own" / "b.py").write_text("import ctypes\nctypes.pythonapi.exit(0)")
    done = command_line.run("ezskiros", *words, "--ontology", HALL, folder=tmp_path)
    assert done.returncode in (1, 2)
    assert "error[EZS240]" in done.stdout
    assert not (tmp_path / "picture.svg").exists()
