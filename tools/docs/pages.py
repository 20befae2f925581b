"""Gathers the pages of the site: docs/ as it lies in the repository, and files of the repository's top level."""

import shutil
from pathlib import Path

from markdown_text import Page, Span, for_python_markdown, replaced

# Where files outside docs/ stand in the site.
BESIDE = {
    "CHANGELOG.md": "changelog.md",
    "CODE_OF_CONDUCT.md": "code-of-conduct.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
}
# Below docs/, but no pages: texts for the Asset Store, and a report's page that the site makes itself.
LEFT_OUT = ("docs/listing/", "docs/report/index.html")
HOME = "docs/index.md"


def is_foreign(target: str) -> bool:
    return target.startswith(("http://", "https://", "mailto:", "//", "data:"))


def sources(root: Path) -> list[Path]:
    """The Markdown files of the site, in the repository."""
    found = [path for path in sorted((root / "docs").rglob("*.md")) if not left_out(path.relative_to(root).as_posix())]
    return found + [root / name for name in BESIDE if (root / name).is_file()]


def others(root: Path) -> list[Path]:
    """Markdown files that the site has not, but that people read in the repository."""
    patterns = ("*.md", ".github/**/*.md", "addons/lobelight/**/*.md", "docs/listing/*.md")
    return sorted({path for pattern in patterns for path in root.glob(pattern)} - set(sources(root)))


def left_out(name: str) -> bool:
    return name.startswith(LEFT_OUT)


def site_path(name: str) -> str:
    """Where a file of the repository stands in the site, or ''."""
    if name in BESIDE:
        return BESIDE[name]
    if name == "README.md":
        return "index.md"
    return name.removeprefix("docs/") if name.startswith("docs/") and not left_out(name) else ""


def resolved(root: Path, page: Path, target: str) -> Path:
    """What a relative link of a page names; a folder stands for its README.md, as on GitHub."""
    path = Path(*_normal((page.parent.relative_to(root) / target).parts))
    whole = root / path
    return whole / "README.md" if (whole / "README.md").is_file() else whole


def _normal(parts: tuple[str, ...]) -> list[str]:
    out: list[str] = []
    for part in parts:
        if part == ".." and out and out[-1] != "..":
            out.pop()
        elif part != ".":
            out.append(part)
    return out


def gather(root: Path, folder: Path, repository: str) -> list[str]:
    """Copies pages and pictures to a folder, links turned to where they stand there; gives the pages' names."""
    names = []
    pages = sources(root)
    if not (root / HOME).is_file():
        pages.append(root / "README.md")
    for path in pages:
        name = site_path(path.relative_to(root).as_posix())
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        page = Page.read(path)
        target.write_text(for_python_markdown(with_links_of_site(root, page, name, repository)), encoding="utf-8")
        names.append(name)
        for file in linked_files(root, page):
            copy = folder / site_path(file.relative_to(root).as_posix())
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)
    return names


def linked_files(root: Path, page: Page) -> list[Path]:
    """Pictures and data below docs/ that a page shows or names."""
    targets = (link.text.partition("#")[0] for link in page.links() if not is_foreign(link.text))
    files = (resolved(root, page.path, target) for target in targets if target)
    inside = (file for file in files if file.is_file() and file.is_relative_to(root / "docs") and file.suffix != ".md")
    return [file for file in inside if site_path(file.relative_to(root).as_posix())]


def with_links_of_site(root: Path, page: Page, name: str, repository: str) -> str:
    """The page's text with relative links as they are at `name` in the site. What is not in the site is linked at
    `repository`, or not at all where that is empty."""
    changed: list[tuple[Span, str]] = []
    for link in page.links():
        target, hash_mark, fragment = link.text.partition("#")
        if is_foreign(link.text) or not target:
            continue
        path = resolved(root, page.path, target)
        if not path.is_relative_to(root):
            continue
        in_repository = path.relative_to(root).as_posix()
        there = site_path(in_repository)
        other_home = in_repository == "README.md" and fragment and (root / HOME).is_file()
        if there and path.is_file() and not other_home:
            new = relative(there, name) + hash_mark + fragment
        elif repository:
            new = f"{repository}/blob/main/{in_repository}{hash_mark}{fragment}"
        else:
            new = NO_TARGET
        if new != link.text:
            changed.append((link, new))
    return replaced(page.text, changed)


# What hooks.py takes for a link to nowhere, and shows as text.
NO_TARGET = "https://not-in-the-site.invalid/"


def relative(target: str, page: str) -> str:
    here, there = Path(page).parent.parts, Path(target).parts
    same = 0
    while same < min(len(here), len(there) - 1) and here[same] == there[same]:
        same += 1
    return "/".join([".."] * (len(here) - same) + list(there[same:]))
