"""The evaluation: all arms of the experiments on many seeds, with rows, statistics and a page."""

from heron.evaluation.episodes import keys_of, row_of, sources
from heron.evaluation.folder import PAGE, Folder, write_page
from heron.evaluation.page import Results, page_of
from heron.evaluation.rows import EpisodeRow, StudyRow, read_rows, write_rows

__all__ = [
    "PAGE",
    "EpisodeRow",
    "Folder",
    "Results",
    "StudyRow",
    "keys_of",
    "page_of",
    "read_rows",
    "row_of",
    "sources",
    "write_page",
    "write_rows",
]
