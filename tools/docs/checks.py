"""What is wrong with the pages, found in their sources: links, pictures, commands, paths and the navigation."""

import re
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

import pages
from commands import Commands
from markdown_text import Page, Span

# Folders of the top level, whose paths in a page name files of the repository.
TOP_FOLDERS = (r"\.github", "addons", "bake", "demo", "docs", "gdextension", "tests", "tools")
# A path in code, as far as it is literal, and not the end of a longer one.
LITERAL_PATH = rf"(?P<path>(?:{'|'.join(TOP_FOLDERS)})/[\w./*@+-]*)(?P<after>.?)"
REPOSITORY_PATH = re.compile(rf"(?<![\w/.-])(?:res://)?{LITERAL_PATH}")
RESOURCE_PATH = re.compile(rf"res://{LITERAL_PATH}")
# What follows a path that goes on with something to fill in.
GOES_ON = ("<", "{", "…", "[", "$")
# A command's option before the name of a file that it writes.
WRITTEN = re.compile(r"--(?:out|json|export|pictures)[= ]+(?:res://)?$")
# What commands write, and what users have.
MADE = re.compile(r"(?:^|/)(?:build|bin)(?:/|$)|^addons/(?!lobelight)|\.\.\.")
# brdf_NAME_test.cpp: a place to fill.
PLACE_TO_FILL = re.compile(r"(?<![A-Za-z])(?!(?:README|CHANGELOG|LICENSE|CONTRIBUTING|SECURITY)\b)[A-Z]+(?![A-Za-z])")
PICTURE_SUFFIXES = {".png", ".svg", ".jpg", ".jpeg", ".webp", ".gif", ".mp4", ".webm"}
REPORTS = "docs/report/"
PICTURES = "tools/docs/pictures.txt"


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong, and where."""

    place: str
    reason: str

    def __str__(self) -> str:
        return f"{self.place}: {self.reason}"


class Checks:
    """Checks pages of the repository at `root`. `counts` says how much was looked at."""

    def __init__(self, root: Path):
        self.root = root
        self.counts = {"pages": 0, "links": 0, "pictures": 0, "commands": 0, "paths": 0}
        self.findings: list[Finding] = []
        self._read: dict[Path, Page] = {}
        self._commands = Commands(root)
        self._drawn = drawn(root)

    def page(self, path: Path) -> Page:
        if path not in self._read:
            self._read[path] = Page.read(path)
        return self._read[path]

    def find(self, page: Page, offset: int, reason: str) -> None:
        self.findings.append(Finding(f"{page.path.relative_to(self.root)}:{page.line_of(offset)}", reason))

    def check_page(self, path: Path) -> None:
        page = self.page(path)
        self.counts["pages"] += 1
        for link in page.links():
            self.check_link(page, link)
        # What changed once named files and options of its time.
        if path.name != "CHANGELOG.md":
            for code in [*page.inline_code, *page.blocks]:
                self.check_commands(page, code)
            for code in page.inline_code:
                self.check_paths(page, code, REPOSITORY_PATH)
            for code in page.blocks:
                self.check_paths(page, code, RESOURCE_PATH)
        self.check_report(page)

    def check_link(self, page: Page, link: Span) -> None:
        self.counts["links"] += 1
        if pages.is_foreign(link.text):
            return
        target, _, fragment = link.text.partition("#")
        path = pages.resolved(self.root, page.path, target) if target else page.path
        if not path.is_relative_to(self.root) or not exists(self.root, path):
            self.find(page, link.start, f"{link.text} leads to no file")
        elif fragment and path.suffix == ".md" and fragment not in self.page(path).anchors():
            self.find(page, link.start, f"{link.text}: {path.relative_to(self.root)} has no heading #{fragment}")
        elif path.suffix in PICTURE_SUFFIXES:
            self.check_picture(page, link, path)

    def check_picture(self, page: Page, link: Span, path: Path) -> None:
        """Whoever changes what a picture shows must be able to draw it again."""
        self.counts["pictures"] += 1
        name = path.relative_to(self.root).as_posix()
        folder = f"{path.parent.relative_to(self.root)}/"
        if name.startswith("docs/") and not name.startswith(REPORTS) and not {name, folder} & self._drawn.keys():
            self.find(page, link.start, f"{link.text}: {PICTURES} names no command that draws it")

    def check_list_of_pictures(self) -> None:
        """What it names is there, and so are the commands."""
        for name, (line, command) in self._drawn.items():
            problems = [] if exists(self.root, self.root / name) else [f"{name} is not in the repository"]
            for _start, call in self._commands.lines(command):
                problems += self._commands.problems(call)
            if command.startswith("bash ") and not exists(self.root, self.root / command.split()[1]):
                problems.append(f"{command.split()[1]} is not in the repository")
            self.findings += [Finding(f"{PICTURES}:{line}", problem) for problem in problems]

    def check_commands(self, page: Page, code: Span) -> None:
        for start, line in self._commands.lines(code.text):
            self.counts["commands"] += 1
            for reason in self._commands.problems(line):
                self.find(page, code.start + start, reason)

    def check_paths(self, page: Page, code: Span, pattern: re.Pattern[str]) -> None:
        for match in pattern.finditer(code.text):
            path = match["path"].rstrip(".")
            to_fill = PLACE_TO_FILL.search(path) or match["after"] in GOES_ON
            if to_fill or MADE.search(path) or WRITTEN.search(code.text[: match.start("path")]):
                continue
            self.counts["paths"] += 1
            there = matches(self.root, path) if "*" in path else exists(self.root, self.root / path)
            if not there:
                self.find(page, code.start + match.start(), f"{match['path']} is not in the repository")

    def check_report(self, page: Page) -> None:
        name = page.path.relative_to(self.root).as_posix()
        if name.startswith(REPORTS) and "./dev " not in page.text and "bash tools/" not in page.text:
            self.findings.append(Finding(f"{name}:1", "this report does not say which command writes it"))

    def check_navigation(self, nav: list[str], file: str) -> None:
        """Every page is in the navigation, and what that names is there."""
        for name in nav:
            if not name.startswith("classes/") and name not in self.names_in_site():
                self.findings.append(Finding(file, f"{name} is in the navigation, but there is no such page"))
        for name in sorted(self.names_in_site() - set(nav)):
            self.findings.append(Finding(file, f"{name} is not in the navigation"))

    def names_in_site(self) -> set[str]:
        return {pages.site_path(path.relative_to(self.root).as_posix()) for path in pages.sources(self.root)}


def drawn(root: Path) -> dict[str, tuple[int, str]]:
    """The pictures and folders that PICTURES lists, each with its line and the command that draws it."""
    lines = enumerate((root / PICTURES).read_text(encoding="utf-8").splitlines(), start=1)
    entries = ((number, *line.split(maxsplit=1)) for number, line in lines if line.strip() and not line.startswith("#"))
    return {name: (number, command) for number, name, command in entries}


def matches(root: Path, pattern: str) -> bool:
    """Whether a pattern, as filters of exports have them, fits any file: * stands for folders too."""
    folder = root / pattern[: pattern.index("*")].rpartition("/")[0]
    return any(fnmatchcase(path.relative_to(root).as_posix(), pattern.rstrip("/")) for path in folder.rglob("*"))


def exists(root: Path, path: Path) -> bool:
    """Whether the path is there, written as it is, so that it is found on systems that tell cases apart."""
    if not path.exists():
        return False
    if path == root or not path.is_relative_to(root):
        return True
    return path.name in (entry.name for entry in path.parent.iterdir()) and exists(root, path.parent)
