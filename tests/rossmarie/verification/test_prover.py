"""The evaluation of CBMC's answers, here from a script that prints given answers."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import pytest

from rossmarie.verification.check import Check
from rossmarie.verification.harness import Harness
from rossmarie.verification.prover import ProofOutcome, ProofVerdict, Prover

OBLIGATIONS = ("check_it.assertion.1", "check_it.overflow.1")
SUCCESS = [{"cProverStatus": "success"}]
FAILURE = [{"cProverStatus": "failure"}]
ERROR = [{"cProverStatus": "error"}]
FAILED = [
    {"result": [{"status": "FAILURE", "description": "it is right"}]},
    {"cProverStatus": "failure"},
]
UNKNOWN = [
    {"result": [{"status": "UNKNOWN", "description": "it is right"}]},
    {"cProverStatus": "success"},
]

CBMC = """\
#!/bin/sh
case "$*" in
*--show-properties*) echo '{listed}' ;;
*--boolector*) echo '{bits}' ;;
*--stop-on-fail*) echo '{whole}' ;;
*--no-unwinding-assertions*) echo '{smt}' ;;
*--external-sat-solver* | *--smt2*) echo '{single}' ;;
*) echo '{own}' ;;
esac
"""


@pytest.mark.parametrize(
    ("whole", "own", "single", "expected"),
    [
        (SUCCESS, ERROR, ERROR, ProofVerdict.PROVED),
        (FAILURE, FAILED, SUCCESS, ProofVerdict.REFUTED),
        (FAILURE, SUCCESS, SUCCESS, ProofVerdict.REFUTED),
        (FAILURE, ERROR, SUCCESS, ProofVerdict.REFUTED),
        (ERROR, SUCCESS, SUCCESS, ProofVerdict.PROVED),
        (ERROR, SUCCESS, ERROR, ProofVerdict.UNDECIDED),
        (ERROR, SUCCESS, FAILED, ProofVerdict.REFUTED),
        (UNKNOWN, SUCCESS, ERROR, ProofVerdict.UNDECIDED),
        ([], SUCCESS, [], ProofVerdict.UNDECIDED),
        ([*SUCCESS, *ERROR], SUCCESS, ERROR, ProofVerdict.UNDECIDED),
    ],
)
def test_only_a_plain_success_is_a_proof(
    whole: Sequence[object],
    own: Sequence[object],
    single: Sequence[object],
    expected: ProofVerdict,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    outcome = answered(tmp_path, monkeypatch, whole=whole, own=own, single=single, smt=single)
    assert outcome.verdict is expected


@pytest.mark.parametrize(
    ("bits", "expected"),
    [
        (SUCCESS, ProofVerdict.PROVED),
        (ERROR, ProofVerdict.UNDECIDED),
        (UNKNOWN, ProofVerdict.UNDECIDED),
        ([], ProofVerdict.UNDECIDED),
    ],
)
def test_a_proof_about_any_arithmetic_is_enough(
    bits: Sequence[object],
    expected: ProofVerdict,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    outcome = answered(
        tmp_path, monkeypatch, bits=bits, whole=ERROR, own=ERROR, single=ERROR, smt=ERROR
    )
    assert outcome.verdict is expected


def test_that_loops_end_is_shown_as_well(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = answered(tmp_path, monkeypatch, whole=ERROR, own=ERROR, single=ERROR, smt=SUCCESS)
    assert outcome.verdict is ProofVerdict.UNDECIDED


def test_a_single_obligation_is_left_to_z3(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    answers = {"whole": ERROR, "own": ERROR, "single": ERROR, "smt": SUCCESS}
    outcome = answered(tmp_path, monkeypatch, OBLIGATIONS[:1], **answers)
    assert outcome.reasons == ("no answer within 10 s: check_it.assertion.1",)  # that loops end


def test_what_does_not_hold_is_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    outcome = answered(tmp_path, monkeypatch, whole=FAILURE, own=FAILED, single=ERROR, smt=ERROR)
    assert outcome.reasons == ("it is right",)


def answered(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    obligations: Sequence[str] = OBLIGATIONS,
    **answers: Sequence[object],
) -> ProofOutcome:
    """The outcome of one check if CBMC gives these answers; `bits` are those of Bitwuzla."""
    answers.setdefault("bits", ERROR)
    programs = folder / "bin"
    programs.mkdir()
    texts = {name: json.dumps(answer) for name, answer in answers.items()}
    for name in ("goto-cc", "goto-instrument"):
        (programs / name).write_text("#!/bin/sh\n")
    listed = json.dumps([{"properties": [{"name": name} for name in obligations]}])
    (programs / "cbmc").write_text(CBMC.format(listed=listed, **texts))
    for script in programs.iterdir():
        script.chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}:/usr/bin:/bin")
    prover = Prover()
    with prover.workshop() as workshop:
        program = Harness("", (), passes=1)
        prover.compile(workshop, program)
        return prover.run(program, Check("it", "it is asked"), workshop, 10)


def test_the_z3_of_the_python_package_is_asked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, version in (("package", "5.4.0"), ("system", "4.13.3")):
        script = tmp_path / name / "z3"
        script.parent.mkdir()
        script.write_text(f"#!/bin/sh\necho Z3 version {version}\n")
        script.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path / 'system'}:/usr/bin:/bin")
    monkeypatch.setattr("rossmarie.verification.prover._SCRIPTS", str(tmp_path / "package"))
    assert Prover().version("z3") == "5.4.0"
    (tmp_path / "package" / "z3").unlink()
    assert Prover().version("z3") == "4.13.3"
