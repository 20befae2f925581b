"""Builds the site by MkDocs, from pages gathered in a folder, and looks at what came of it."""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import yaml

import class_pages
import classes
import pages
from checks import Finding

CONFIG = Path(__file__).with_name("mkdocs.yml")
CONFIG_NAME = "tools/docs/mkdocs.yml"
OWN_FILES = [Path(__file__).with_name(name) for name in ("site.css", "iframe-worker.js")]
LOGO = "addons/lobelight/icons/lobelight.svg"
# What a browser loads by itself from another host. Links that people follow may lead anywhere.
LOADED = re.compile(
    r"<(?:script|img|iframe|source|video|audio|embed)\b[^>]*?\b(?:src|srcset)=\"?(?:https?:)?//[^\">\s]*"
    r"|<link\b(?=[^>]*\brel=\"?(?:stylesheet|preload|preconnect|icon))[^>]*?\bhref=\"?(?:https?:)?//[^\">\s]*"
)
LOADED_BY_STYLE = re.compile(r"(?:@import\s+|url\()\s*[\"']?(?:https?:)?//[^\"')]*")
WARNING = re.compile(r"^(?:WARNING|ERROR)\s+-\s+(?P<text>.*)$")


def version(root: Path) -> str:
    match = re.search(r'^version="([^"]+)"', (root / "addons/lobelight/plugin.cfg").read_text(encoding="utf-8"), re.MULTILINE)
    return match[1] if match else ""


def base_config() -> dict:
    return yaml.safe_load(CONFIG.read_text(encoding="utf-8"))


def nav_files(nav: list) -> list[str]:
    """The files that a navigation names, in their order."""
    found: list[str] = []
    for entry in nav:
        value = next(iter(entry.values())) if isinstance(entry, dict) else entry
        found += nav_files(value) if isinstance(value, list) else [value]
    return found


def filled(nav: list, present: set[str], class_nav: list) -> list:
    """The navigation with the pages of classes in it, and without files and parts that are not there."""
    out = []
    for entry in nav:
        title, value = next(iter(entry.items()))
        if value == f"{class_pages.FOLDER}/":
            out.append({title: class_nav})
        elif isinstance(value, list):
            inner = filled(value, present, class_nav)
            out += [{title: inner}] if inner else []
        elif value in present:
            out.append(entry)
    return out


def build(root: Path, found: dict[str, ElementTree.Element], work: Path, fonts: list[Path]) -> tuple[Path, list[Finding]]:
    """Builds the site below `work`, with these files of a font and its licence; gives its folder and what MkDocs warned of."""
    shutil.rmtree(work, ignore_errors=True)
    docs = work / "pages"
    config = base_config()
    names = set(pages.gather(root, docs, config.get("repo_url", "")))
    class_pages.write(found, docs / class_pages.FOLDER)
    for source in (*OWN_FILES, root / LOGO, *fonts):
        # Debian keeps a package's licence in a file of this name.
        name = "STIXMath-LICENSE.txt" if source.name == "copyright" else source.name
        target = docs / "assets" / name
        target.parent.mkdir(exist_ok=True)
        shutil.copyfile(source, target)
    config["site_name"] = f"{config['site_name']} {version(root)}"
    config["docs_dir"] = str(docs)
    config["site_dir"] = str(work / "site")
    config["hooks"] = [str(Path(__file__).with_name("hooks.py"))]
    config["nav"] = filled(config["nav"], names, class_pages.navigation(found))
    config["extra"] = {**config.get("extra", {}), "members": {name: {member: list(entry) for member, entry in of_class.items()} for name, of_class in classes.members(found).items()}}
    (work / "mkdocs.yml").write_text(yaml.safe_dump(config, sort_keys=False, allow_unicode=True), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--quiet", "--config-file", work / "mkdocs.yml"],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1", "PYTHONDONTWRITEBYTECODE": "1", "SOURCE_DATE_EPOCH": "0"},
    )
    said = [match["text"] for match in map(WARNING.match, (done.stdout + done.stderr).splitlines()) if match]
    if done.returncode != 0 and not said:
        lines = (done.stdout + done.stderr).strip().splitlines()
        said = [lines[-1] if lines else f"MkDocs ended with status {done.returncode}"]
    return work / "site", [Finding("site", text) for text in said]


def foreign_resources(site: Path) -> list[Finding]:
    """Pages and styles that would have a browser ask another host."""
    found = []
    for path in sorted([*site.rglob("*.html"), *site.rglob("*.css")]):
        pattern = LOADED if path.suffix == ".html" else LOADED_BY_STYLE
        for match in pattern.finditer(path.read_text(encoding="utf-8")):
            found.append(Finding(path.relative_to(site).as_posix(), f"loads from another host: {match[0][:120]}"))
    return found
