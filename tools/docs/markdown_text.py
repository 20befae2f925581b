"""What the checks and the site need to know of a Markdown page: code, links, headings, and lists as GitHub nests them."""

import re
from dataclasses import dataclass
from pathlib import Path

FENCE = re.compile(r"^(?P<indent>[ >]*)(?P<mark>`{3,}|~{3,})(?P<language>[^`]*)$")
INLINE_CODE = re.compile(r"(?<!`)(?P<mark>`+)(?!`)(?P<code>.+?)(?<!`)(?P=mark)(?!`)", re.DOTALL)
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
HEADING = re.compile(r"^(?P<level>#{1,6})\s+(?P<title>.+?)\s*#*\s*$")
# [text](target "title"), and pictures; what stands before "](" does not matter.
INLINE_LINK = re.compile(r"\]\(\s*<?(?P<target>[^()\s<>]+(?:\([^()\s]*\)[^()\s<>]*)*)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE_LINK = re.compile(r"^ {0,3}\[[^\]]+\]:\s+<?(?P<target>\S+?)>?(?:\s+\"[^\"]*\")?\s*$", re.MULTILINE)
HTML_LINK = re.compile(r"<(?:a|img|source|video)\b[^>]*?\b(?:href|src|srcset|poster)=\"(?P<target>[^\"]+)\"")
HTML_ANCHOR = re.compile(r"<[a-z0-9]+\b[^>]*?\b(?:id|name)=\"([^\"]+)\"")
LIST_ITEM = re.compile(r"^(?P<indent> *)(?P<marker>[-*+]|\d{1,9}[.)])(?P<space> +)(?=\S)")
TABLE_RULE = re.compile(r"^ *\|?(?: *:?-+:? *\|)+ *(?::?-+:?)? *\|? *$")


@dataclass
class Span:
    """A piece of a page: where it begins, and what it says."""

    start: int
    text: str


class Page:
    """A Markdown file. Offsets are those of `text`; in `prose`, code and comments are blanks, so that offsets stay."""

    def __init__(self, path: Path, text: str):
        self.path = path
        self.text = text
        self.blocks: list[Span] = []
        without_blocks = self._blank_fences(text)
        self.inline_code = [Span(match.start("code"), match["code"]) for match in INLINE_CODE.finditer(without_blocks)]
        without_code = INLINE_CODE.sub(lambda match: blank(match[0]), without_blocks)
        self.prose = COMMENT.sub(lambda match: blank(match[0]), without_code)
        # Headings may hold code, and their anchors are made of it too.
        self._without_blocks = without_blocks

    @classmethod
    def read(cls, path: Path) -> "Page":
        return cls(path, path.read_text(encoding="utf-8"))

    def _blank_fences(self, text: str) -> str:
        kept: list[str] = []
        fence = ""
        block = Span(0, "")
        offset = 0
        for line in text.splitlines(keepends=True):
            match = FENCE.match(line.rstrip("\n"))
            if fence:
                closes = match and match["mark"].startswith(fence) and not match["language"].strip()
                if closes:
                    fence = ""
                    self.blocks.append(block)
                else:
                    block.text += line
                kept.append(blank(line))
            elif match:
                fence = match["mark"]
                block = Span(offset + len(line), "")
                kept.append(blank(line))
            else:
                kept.append(line)
            offset += len(line)
        if fence:
            self.blocks.append(block)
        return "".join(kept)

    def line_of(self, offset: int) -> int:
        return self.text.count("\n", 0, offset) + 1

    def links(self) -> list[Span]:
        """The targets of links and pictures, in their order."""
        found = [
            Span(match.start("target"), match["target"])
            for pattern in (INLINE_LINK, REFERENCE_LINK, HTML_LINK)
            for match in pattern.finditer(self.prose)
        ]
        return sorted(found, key=lambda span: span.start)

    def anchors(self) -> set[str]:
        """Where links into the page may go: its headings, as GitHub names them, and what HTML names."""
        found: set[str] = set(HTML_ANCHOR.findall(self.prose))
        for line in self._without_blocks.splitlines():
            match = HEADING.match(line)
            if match:
                found.add(unused(slug(match["title"]), found))
        return found


def blank(text: str) -> str:
    return re.sub(r"[^\n]", " ", text)


def slug(title: str, separator: str = "-") -> str:
    """The anchor that GitHub makes of a heading. (The second argument is one that Python-Markdown passes.)"""
    shown = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", title)
    shown = re.sub(r"<[^>]+>|[*`]|(?<!\w)_|_(?!\w)", "", shown)
    return re.sub(r"[^\w\- ]", "", shown.strip().lower()).replace(" ", separator)


def unused(name: str, taken: set[str]) -> str:
    """`name`, or with the first number that makes it a new one, as GitHub counts."""
    number = 0
    candidate = name
    while candidate in taken:
        number += 1
        candidate = f"{name}-{number}"
    return candidate


def replaced(text: str, spans: list[tuple[Span, str]]) -> str:
    """`text` with each span's text replaced."""
    parts: list[str] = []
    position = 0
    for span, new in spans:
        parts += [text[position : span.start], new]
        position = span.start + len(span.text)
    return "".join([*parts, text[position:]])


def for_python_markdown(text: str) -> str:
    """The same page as Python-Markdown reads it: what is nested in lists is indented by fours, and lists and tables
    begin after an empty line."""
    lines = text.split("\n")
    out: list[str] = []
    contents: list[int] = []  # where the content of each open list item begins
    fence = ""
    shift = 0
    for index, line in enumerate(lines):
        if fence:
            match = FENCE.match(line)
            out.append(line if not line.strip() else shifted(line, shift))
            if match and match["mark"].startswith(fence) and not match["language"].strip():
                fence = ""
            continue
        if not line.strip():
            out.append("")
            continue
        indent = len(line) - len(line.lstrip(" "))
        after_text = bool(out) and bool(out[-1].strip())
        item = LIST_ITEM.match(line)
        fence_match = FENCE.match(line)
        # A line of text that is indented less goes on with the paragraph before it.
        if not after_text or item or fence_match or line.lstrip().startswith(("#", "|", ">")):
            while contents and indent < contents[-1]:
                contents.pop()
        depth = len(contents)
        base = contents[-1] if contents else 0
        new_indent = 4 * depth + max(indent - base, 0)
        begins_list = item and after_text and not was_list(lines, index)
        begins_table = TABLE_RULE.match(lines[index + 1]) and "|" in line if index + 1 < len(lines) else False
        if begins_list or (begins_table and after_text):
            out.append("")
        if fence_match:
            fence = fence_match["mark"]
            shift = new_indent - indent
        out.append(" " * new_indent + line.lstrip(" "))
        if item:
            contents.append(indent + len(item["marker"]) + len(item["space"]))
    return "\n".join(out)


def shifted(line: str, shift: int) -> str:
    if shift >= 0:
        return " " * shift + line
    return line[min(-shift, len(line) - len(line.lstrip(" "))) :]


def was_list(lines: list[str], index: int) -> bool:
    """Whether the text right before this line belongs to a list already."""
    for line in reversed(lines[:index]):
        if not line.strip():
            return False
        if LIST_ITEM.match(line):
            return True
    return False
