import pytest

from rossmarie.types import (
    SIGNATURES,
    Array,
    Boolean,
    Box,
    Fault,
    Interval,
    Message,
    Operator,
    OperatorType,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
    apply,
)
from rossmarie.units import DIMENSIONLESS, parse_unit


def quantity(unit: str) -> Quantity:
    return Quantity(parse_unit(unit))


NUMBER = Quantity(DIMENSIONLESS)
UNSTATED = Quantity(None)
FORCE = quantity("N")
FORCES = Vector(FORCE)
LENGTHS = Array(quantity("m"))
BOOLEANS = Array(Boolean())
EVERY_TYPE: list[Type] = [
    Boolean(),
    Text(),
    NUMBER,
    UNSTATED,
    FORCE,
    quantity("degC"),
    FORCES,
    Vector(UNSTATED),
    Quaternion(),
    LENGTHS,
    BOOLEANS,
    Interval(FORCE),
    Box(quantity("m")),
    Message("a/B", {}),
    Unsupported("no"),
]


@pytest.mark.parametrize(
    ("operator", "operands", "result"),
    [
        ("+", (FORCE, quantity("kN")), FORCE),
        ("-", (FORCES, FORCES), FORCES),
        ("*", (FORCE, quantity("m")), quantity("N*m")),
        ("*", (quantity("rad/s"), quantity("m")), quantity("rad*m/s")),
        ("*", (FORCES, NUMBER), FORCES),
        ("*", (NUMBER, FORCES), FORCES),
        ("/", (quantity("m"), quantity("s")), quantity("m/s")),
        ("/", (FORCES, quantity("s")), Vector(quantity("N/s"))),
        ("/", (FORCE, FORCE), NUMBER),
        ("negate", (FORCES,), FORCES),
        ("+", (UNSTATED, NUMBER), UNSTATED),
        ("*", (UNSTATED, NUMBER), UNSTATED),
        ("*", (UNSTATED, FORCE), UNSTATED),
        ("/", (NUMBER, UNSTATED), UNSTATED),
        ("<", (UNSTATED, NUMBER), Boolean()),
        ("<", (UNSTATED, UNSTATED), Boolean()),
        (">=", (quantity("deg"), quantity("rad")), Boolean()),
        ("==", (Text(), Text()), Boolean()),
        ("!=", (Boolean(), Boolean()), Boolean()),
        ("==", (FORCE, FORCE), Boolean()),
        ("<", (LENGTHS, quantity("mm")), BOOLEANS),
        ("in", (LENGTHS, Interval(quantity("m"))), BOOLEANS),
        ("-", (LENGTHS, quantity("m")), LENGTHS),
        ("and", (BOOLEANS, BOOLEANS), BOOLEANS),
        ("not", (BOOLEANS,), BOOLEANS),
        ("abs", (LENGTHS,), LENGTHS),
        ("in", (quantity("deg"), Interval(quantity("rad"))), Boolean()),
        ("in", (Vector(quantity("m")), Box(quantity("mm"))), Boolean()),
        ("or", (Boolean(), Boolean()), Boolean()),
        ("for", (Boolean(), quantity("ms")), Boolean()),
        ("norm", (FORCES,), FORCE),
        ("distance", (FORCES, FORCES), FORCE),
        ("min", (LENGTHS,), quantity("m")),
        ("max", (FORCE, FORCE, quantity("mN")), FORCE),
        ("max", (NUMBER, UNSTATED), UNSTATED),
        ("any", (BOOLEANS,), Boolean()),
        ("count", (BOOLEANS,), NUMBER),
        ("pitch", (Quaternion(),), quantity("rad")),
        ("rate", (quantity("m/s"),), quantity("m/s^2")),
        ("rate", (UNSTATED,), UNSTATED),
        ("rate", (quantity("degC"),), quantity("K/s")),
        ("previous", (FORCES,), FORCES),
        ("age", (Message("a/B", {}),), quantity("s")),
        ("mean", (FORCE, quantity("s")), FORCE),
        ("low_pass", (FORCE, quantity("ms")), FORCE),
        ("changed", (FORCES,), Boolean()),
        ("changed", (Boolean(),), Boolean()),
        ("oscillates", (FORCE, quantity("s")), Boolean()),
        ("oscillates", (FORCE, quantity("ms"), FORCE), Boolean()),
        ("-", (quantity("degC"), quantity("degC")), quantity("K")),
        ("-", (quantity("degC"), quantity("K")), quantity("degC")),
        ("+", (quantity("K"), quantity("degC")), quantity("degC")),
        (">", (quantity("degC"), quantity("K")), Boolean()),
    ],
)
def test_result(operator: str, operands: tuple[Type, ...], result: Type) -> None:
    assert apply(Operator(operator), *operands) == OperatorType(result)


@pytest.mark.parametrize(
    ("operator", "operands", "faults"),
    [
        ("+", (FORCE, quantity("m")), [Fault.UNITS]),
        ("+", (FORCE, NUMBER), [Fault.UNITS]),
        (">", (FORCE, quantity("N/s")), [Fault.UNITS]),
        (">", (quantity("deg"), NUMBER), [Fault.UNITS]),
        (">", (UNSTATED, FORCE), [Fault.UNSTATED_UNIT]),
        ("-", (FORCE, UNSTATED), [Fault.UNSTATED_UNIT]),
        (">", (Vector(quantity("rad/s")), quantity("N*m")), [Fault.VECTOR, Fault.UNITS]),
        (">", (FORCE, FORCES), [Fault.VECTOR]),
        (">", (FORCES, FORCES), [Fault.VECTOR]),
        ("==", (FORCES, FORCES), [Fault.VECTOR]),
        ("+", (FORCES, FORCE), [Fault.VECTOR]),
        ("*", (FORCES, FORCES), [Fault.VECTOR]),
        ("/", (FORCE, FORCES), [Fault.VECTOR]),
        ("abs", (FORCES,), [Fault.VECTOR]),
        ("rate", (FORCES,), [Fault.VECTOR]),
        ("<", (FORCE, Interval(FORCE)), [Fault.RANGE]),
        ("in", (FORCE, FORCE), [Fault.NOT_A_RANGE]),
        ("in", (quantity("m"), FORCE), [Fault.NOT_A_RANGE, Fault.UNITS]),
        ("in", (FORCES, Interval(quantity("m"))), [Fault.VECTOR, Fault.UNITS]),
        ("in", (FORCES, Box(quantity("m"))), [Fault.UNITS]),
        ("in", (quantity("m"), Box(quantity("m"))), [Fault.OPERANDS]),
        ("<", (Boolean(), Boolean()), [Fault.OPERANDS]),
        ("==", (Text(), Boolean()), [Fault.OPERANDS]),
        ("and", (Boolean(), FORCE), [Fault.OPERANDS]),
        ("and", (Unknown(), FORCE), [Fault.OPERANDS]),
        ("for", (Boolean(), NUMBER), [Fault.UNITS]),
        ("for", (FORCE, FORCE), [Fault.OPERANDS, Fault.UNITS]),
        ("any", (LENGTHS,), [Fault.OPERANDS]),
        ("min", (FORCE,), [Fault.OPERANDS]),
        ("min", (FORCE, quantity("m")), [Fault.UNITS]),
        ("norm", (FORCE,), [Fault.OPERANDS]),
        ("roll", (FORCES,), [Fault.OPERANDS]),
        ("mean", (FORCE, quantity("m")), [Fault.UNITS]),
        ("changed", (Text(),), [Fault.OPERANDS]),
        ("oscillates", (FORCE, FORCE, quantity("m")), [Fault.UNITS]),
        ("oscillates", (FORCES, quantity("s")), [Fault.VECTOR]),
        ("<", (LENGTHS, FORCE), [Fault.UNITS]),
        ("<", (LENGTHS, FORCES), [Fault.VECTOR, Fault.UNITS]),
        ("+", (quantity("degC"), quantity("degC")), [Fault.TEMPERATURE]),
        ("*", (quantity("degC"), NUMBER), [Fault.TEMPERATURE]),
        ("negate", (quantity("degC"),), [Fault.TEMPERATURE]),
        ("-", (quantity("K"), quantity("degC")), [Fault.TEMPERATURE]),
        ("norm", (Vector(quantity("degC")),), [Fault.TEMPERATURE]),
    ],
)
def test_faults(operator: str, operands: tuple[Type, ...], faults: list[Fault]) -> None:
    assert apply(Operator(operator), *operands) == OperatorType(Unknown(), tuple(faults))


@pytest.mark.parametrize("operator", Operator)
def test_every_operator_has_an_outcome_for_every_type(operator: Operator) -> None:
    signature = SIGNATURES[operator]
    for count in range(signature.least, (signature.most or 3) + 1):
        for first in EVERY_TYPE:
            for other in EVERY_TYPE:
                outcome = apply(operator, *(first, other, other)[:count])
                assert outcome.type != Unknown() or outcome.faults


@pytest.mark.parametrize("operator", Operator)
def test_unknown_operands_absorb(operator: Operator) -> None:
    operands = (Unknown(),) * SIGNATURES[operator].least
    assert apply(operator, *operands) == OperatorType(Unknown())
    if operator not in (Operator.AND, Operator.OR) and len(operands) > 1:
        others = (Message("a/B", {}),) * (len(operands) - 1)
        assert apply(operator, *others, Unknown()) == OperatorType(Unknown())


def test_the_number_of_operands_is_the_callers_business() -> None:
    with pytest.raises(TypeError):
        apply(Operator.NORM)
    with pytest.raises(TypeError):
        apply(Operator.NORM, FORCES, FORCES)
