"""The semantics, as C, of results over all elements of an array (S23 to S25) or of a list (S51 to
S53), also together with numbers that the monitor keeps (S74).
"""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.ir import model as ir
from rossmarie.verification import formulas


@dataclass(frozen=True)
class AllOf:
    """The elements of an array, or of a list of up to `most` elements with these columns. With
    `is_beside`, the results also use numbers of the monitor.
    """

    columns: tuple[int, ...]
    most: int | None
    is_beside: bool

    @property
    def parameters(self) -> str:
        """The parameters of a function over all elements."""
        columns = (f"const double *a{each}" for each in self.columns)
        return ", ".join([*self._memory("const monitor *m"), *columns, "size_t n"])

    def element(self, place: str) -> str:
        """The arguments that stand for one element."""
        columns = (f"a{each}[{place}]" for each in self.columns)
        return ", ".join([*self._memory("m"), *columns])

    def _memory(self, name: str) -> list[str]:
        return [name] if self.is_beside else []

    def first(self, value: str) -> str:
        """The result before the first element: a value, or unknown if the elements give no
        result.
        """
        is_unknown = "n == 0" if self.most is None else f"n > {self.most}"
        return f"{is_unknown} ? NAN : {value}"

    def loop(self, start: int = 0) -> str:
        """The head of a loop over all elements, with index `i`. The loop is empty if there are too
        many.
        """
        end = "n" if self.most is None else f"(n > {self.most} ? 0 : n)"
        return f"for (size_t i = {start}; i < {end}; i++)"


def folded(index: int, folding: ir.Folding, element: int, all_of: AllOf) -> str:
    """The C function that defines the least or greatest value of a number."""
    combine = formulas.name(folding.function, 2)
    number = f"spec_element_{element}({all_of.element('i')})"
    start = f"spec_element_{element}({all_of.element('0')})"
    if all_of.most is not None:
        start = "INFINITY" if folding is ir.Folding.MINIMUM else "(-INFINITY)"
    return (
        f"static double spec_fold_{index}({all_of.parameters})\n{{\n"
        f"    double found = {all_of.first(start)};\n"
        f"    {all_of.loop(0 if all_of.most is not None else 1)}\n"
        f"        found = {combine}(found, {number});\n"
        f"    return found;\n}}\n"
    )


def counted(index: int, element: int, all_of: AllOf) -> str:
    """The C function that defines the number of elements for which a proposition holds."""
    value = f"spec_element_is_{element}({all_of.element('i')})"
    return (
        f"static double spec_fold_{index}({all_of.parameters})\n{{\n"
        f"    double found = {all_of.first('0.0')};\n"
        f"    {all_of.loop()}\n"
        f"        found = {value} == UNKNOWN ? NAN : {value} == TRUE ? found + 1.0 : found;\n"
        f"    return found;\n}}\n"
    )


def quantified(index: int, node: ir.Quantified, all_of: AllOf) -> str:
    """The C function that defines whether a proposition holds for some, or for all, elements. Its
    result is a number: 1, 0 or NAN.
    """
    word, start = ("or", "FALSE") if node.quantifier is ir.Quantifier.ANY else ("and", "TRUE")
    is_unknown = "n == 0" if all_of.most is None else f"n > {all_of.most}"
    proposition = f"spec_element_is_{node.element}({all_of.element('i')})"
    return (
        f"static double spec_quantified_{index}({all_of.parameters})\n{{\n"
        f"    unsigned found = {is_unknown} ? UNKNOWN : {start};\n"
        f"    {all_of.loop()}\n"
        f"        found = spec_{word}(found, {proposition});\n"
        f"    return found == UNKNOWN ? NAN : found == TRUE ? 1.0 : 0.0;\n}}\n"
    )
