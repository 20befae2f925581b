"""The marks of Godot's class reference (BBCode) as Markdown."""

import re
from collections.abc import Callable

GODOT_DOCS = "https://docs.godotengine.org/en/4.6"
CODE_BLOCK = re.compile(r"\[(codeblock|gdscript|csharp)([^\]]*)\](.*?)\[/\1\]", re.DOTALL)
CODE = re.compile(r"\[(code|kbd)(?: [^\]]*)?\](.*?)\[/\1\]", re.DOTALL)
URL = re.compile(r"\[url(?:=([^\]]+))?\](.*?)\[/url\]", re.DOTALL)
REFERENCE = re.compile(r"\[(member|method|constant|enum|signal|annotation|theme_item|constructor|operator) ([\w.@/]+)\]")
PARAMETER = re.compile(r"\[param (\w+)\]")
CLASS = re.compile(r"\[(@?[A-Z]\w*|bool|int|float)\]")
PLAIN_TAGS = {"b": "**", "i": "*", "u": "", "s": "~~", "center": "", "lb": "[", "rb": "]", "codeblocks": ""}
# Kept apart from the text until its marks are Markdown's.
HELD = "\ue000{}\ue001"
HELD_PATTERN = re.compile("\ue000(\\d+)\ue001")

# What a reference is called in anchors, here and in Godot's documentation.
KINDS = {"member": "property"}


def anchor(kind: str, name: str) -> str:
    """The anchor of a member, say, on its class's page."""
    return f"{KINDS.get(kind, kind)}-{name.lstrip('@')}"


class Converter:
    """Turns descriptions of `here`, a class, into Markdown. `page_of` gives the page of a class of this project, or ''."""

    def __init__(self, here: str, page_of: Callable[[str], str]):
        self.here = here
        self.page_of = page_of
        self.held: list[str] = []

    def markdown(self, text: str) -> str:
        self.held = []
        text = outdented(text)
        text = CODE_BLOCK.sub(self._code_block, text)
        text = CODE.sub(lambda match: self._hold(code(match[2])), text)
        text = URL.sub(lambda match: self._hold(f"[{match[2]}]({match[1] or match[2]})"), text)
        text = PARAMETER.sub(lambda match: self._hold(code(match[1])), text)
        text = REFERENCE.sub(lambda match: self._hold(self.reference(match[1], match[2])), text)
        text = CLASS.sub(lambda match: self._hold(self.class_link(match[1])), text)
        for tag, mark in PLAIN_TAGS.items():
            text = text.replace(f"[{tag}]", mark).replace(f"[/{tag}]", mark)
        text = text.replace("<", "&lt;").replace("_", "\\_")
        text = paragraphs(text)
        while HELD_PATTERN.search(text):
            text = HELD_PATTERN.sub(lambda match: self.held[int(match[1])], text)
        return text.strip()

    def one_line(self, text: str) -> str:
        """For a cell of a table."""
        return " ".join(self.markdown(text).split()).replace("|", "\\|")

    def _hold(self, text: str) -> str:
        self.held.append(text)
        return HELD.format(len(self.held) - 1)

    def _code_block(self, match: re.Match[str]) -> str:
        language = "csharp" if match[1] == "csharp" or "csharp" in match[2] else "gdscript"
        if "text" in match[2]:
            language = "text"
        return f"\n\n{self._hold(f'```{language}{chr(10)}{outdented(match[3]).strip(chr(10))}{chr(10)}```')}\n\n"

    def reference(self, kind: str, target: str) -> str:
        owner, _, name = target.rpartition(".")
        shown = f"{target}()" if kind == "method" else target
        owner = owner or self.here
        # An enumeration of a class may stand before a constant: Class.Enum.VALUE is not used; Class.VALUE is.
        page = self.page_of(owner)
        if page:
            same = "" if owner == self.here else page
            return f"[`{shown}`]({same}#{anchor(kind, name)})"
        if owner.startswith("@"):
            return code(shown)
        godots = f"class-{owner.lower()}-{KINDS.get(kind, kind)}-{name.lower().replace('_', '-')}"
        return f"[`{shown}`]({GODOT_DOCS}/classes/class_{owner.lower()}.html#{godots})"

    def class_link(self, name: str) -> str:
        page = self.page_of(name)
        if page:
            return f"[{name}]({page})" if name != self.here else f"**{name}**"
        return f"[{name}]({GODOT_DOCS}/classes/class_{name.lower().lstrip('@')}.html)"


def code(text: str) -> str:
    ticks = "``" if "`" in text else "`"
    return f"{ticks}{text}{ticks}"


def paragraphs(text: str) -> str:
    """Lines of a description, and what [br][br] parts, are paragraphs; those that begin with "- " are lists."""
    text = re.sub(r"\s*\[br\]\s*(?=- )|\s*(?:\[br\]\s*){2,}", "\n", text)
    parts = [re.sub(r"\s*\[br\]\s*", "  \n", line.strip()) for line in text.split("\n") if line.strip()]
    out = ""
    for before, part in zip(["", *parts], parts):
        both_items = before.startswith("- ") and part.startswith("- ")
        out += ("\n" if both_items else "\n\n") + part
    return out


def outdented(text: str) -> str:
    """Without the indentation that the XML file has."""
    lines = [line.rstrip() for line in text.strip("\n").split("\n")]
    depth = min((len(line) - len(line.lstrip("\t")) for line in lines if line.strip()), default=0)
    return "\n".join(line[depth:] for line in lines)
