"""The text of .ross files: the grammar, the tree, the parser and the formatter.

`parse` turns any text into an `ast.Module` and never fails. `format_module` turns a module without
syntax errors into its canonical text.
"""

from rossmarie.syntax import ast
from rossmarie.syntax.format import format_module
from rossmarie.syntax.limits import MAXIMUM_FILE_SIZE
from rossmarie.syntax.parse import parse
from rossmarie.syntax.walk import children, walk

__all__ = ["MAXIMUM_FILE_SIZE", "ast", "children", "format_module", "parse", "walk"]
