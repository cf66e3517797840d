"""Build the documentation site: `build/site/VERSION`, and a page that leads to the newest version.

A build replaces only its own version. The folder keeps the other versions, and the menu in the
header of each page offers all versions.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from packaging.version import Version
from pages import Pages, navigation

PROJECT = Path(__file__).resolve().parents[2]
SETTINGS = Path(__file__).with_name("mkdocs.yml")
EXTRAS = {"site.css": "assets/site.css", "search-from-disk.js": "assets/iframe-worker.js"}
"""Files beside this one, and their places in the site."""
VERSION = re.compile(r"\d+\.\d+")
LEADS = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Documentation</title>
<meta http-equiv="refresh" content="0; url={version}/index.html"></head>
<body><a href="{version}/index.html">Documentation of version {version}</a></body></html>
"""


def version_of(project: Path) -> str:
    """The version of a project as the site names it: `0.1` for `0.1.3`."""
    text = (project / "pyproject.toml").read_text(encoding="utf-8")
    found = re.search(r'^version = "(.+)"', text, re.MULTILINE)
    assert found is not None, "pyproject.toml has no version"
    version = Version(found[1])
    return f"{version.major}.{version.minor}"


def versions_in(folder: Path) -> list[str]:
    """The versions in a folder of sites, the newest first."""
    names = [path.name for path in folder.iterdir() if VERSION.fullmatch(path.name)]
    return sorted(names, key=Version, reverse=True)


def write_settings(work: Path, pages: Pages) -> Path:
    """Write the settings of this build: the common settings and the navigation."""
    settings = work / "mkdocs.yml"
    contents = (PROJECT / "docs" / "README.md").read_text(encoding="utf-8")
    common = os.path.relpath(SETTINGS, work)
    chosen = {"INHERIT": common, "docs_dir": "pages", "nav": navigation(pages, contents)}
    settings.write_text(json.dumps(chosen, indent=1), encoding="utf-8")  # JSON is YAML
    return settings


def build(out: Path) -> Path:
    """Build the site of this version into a folder of sites; return the first page.

    Ends the program if the generator finds a broken link or another fault.
    """
    work = PROJECT / "build" / "website" if out == PROJECT / "build" / "site" else out / ".work"
    pages = Pages(PROJECT, work / "pages")
    pages.write()
    for name, place in EXTRAS.items():
        (work / "pages" / place).parent.mkdir(exist_ok=True)
        shutil.copyfile(Path(__file__).with_name(name), work / "pages" / place)
    version = version_of(PROJECT)
    # With `--quiet`, the generator would ignore `--strict`.
    done = subprocess.run(
        [
            *(sys.executable, "-m", "mkdocs", "build", "--strict", "--clean"),
            *("--config-file", write_settings(work, pages), "--site-dir", out / version),
        ],
        stderr=subprocess.PIPE,
        text=True,
        check=False,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
    )
    if done.returncode:
        sys.exit(f"{done.stderr}\nthe site was not built")
    names = versions_in(out)
    offered = [{"version": name, "title": name, "aliases": []} for name in names]
    (out / "versions.json").write_text(json.dumps(offered), encoding="utf-8")
    (out / "index.html").write_text(LEADS.format(version=names[0]), encoding="utf-8")
    return out / "index.html"


def main() -> None:
    """Build the site and print its location."""
    parser = argparse.ArgumentParser(description="Build the documentation site.")
    parser.add_argument("--out", type=Path, default=PROJECT / "build" / "site")
    out = parser.parse_args().out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    first = build(out)
    server = f"{Path(sys.executable).name} -m http.server --directory {out}"
    sys.stdout.write(f"the site:  open {first} in a browser, or serve it:\n           {server}\n")


if __name__ == "__main__":
    main()
