"""Runs the study kit: `python docs/study/study.py --help`."""

from study_kit.cli import app

if __name__ == "__main__":
    app()
