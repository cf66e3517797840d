"""The semantics of what is asked of all elements of an array (S23 to S25), or of a list (S51 to
S53), beside numbers that a monitor keeps (S74), as C.
"""

from __future__ import annotations

from dataclasses import dataclass

from rossmarie.ir import model as ir
from rossmarie.verification import formulas


@dataclass(frozen=True)
class AllOf:
    """The elements of an array, or of the list of up to `most` that has these columns; with
    `is_beside`, numbers stand beside them.
    """

    columns: tuple[int, ...]
    most: int | None
    is_beside: bool

    @property
    def parameters(self) -> str:
        """The parameters of a function of all of them."""
        columns = (f"const double *a{each}" for each in self.columns)
        return ", ".join([*self._memory("const monitor *m"), *columns, "size_t n"])

    def element(self, place: str) -> str:
        """The arguments that one of them is."""
        columns = (f"a{each}[{place}]" for each in self.columns)
        return ", ".join([*self._memory("m"), *columns])

    def _memory(self, name: str) -> list[str]:
        return [name] if self.is_beside else []

    def first(self, value: str) -> str:
        """The result before any element: a value, or unknown if nothing is known of them."""
        is_unknown = "n == 0" if self.most is None else f"n > {self.most}"
        return f"{is_unknown} ? NAN : {value}"

    def loop(self, start: int = 0) -> str:
        """The head of a loop over all of them, `i`; it is not entered if there are too many."""
        end = "n" if self.most is None else f"(n > {self.most} ? 0 : n)"
        return f"for (size_t i = {start}; i < {end}; i++)"


def folded(index: int, folding: ir.Folding, element: int, all_of: AllOf) -> str:
    """The function that means the least or greatest of a number."""
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
    """The function that means for how many a proposition holds."""
    value = f"spec_element_is_{element}({all_of.element('i')})"
    return (
        f"static double spec_fold_{index}({all_of.parameters})\n{{\n"
        f"    double found = {all_of.first('0.0')};\n"
        f"    {all_of.loop()}\n"
        f"        found = {value} == UNKNOWN ? NAN : {value} == TRUE ? found + 1.0 : found;\n"
        f"    return found;\n}}\n"
    )


def quantified(index: int, node: ir.Quantified, all_of: AllOf) -> str:
    """The function that means whether a proposition holds for some, or for all, as a number."""
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
