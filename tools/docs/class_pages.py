"""The class reference as Markdown: one page a class, and one that lists them."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import classes
from bbcode import GODOT_DOCS, Converter, anchor, code

# Members that are described one by one, and their headings.
SECTIONS = {
    "member": ("members/member", "Properties"),
    "method": ("methods/method", "Methods"),
    "signal": ("signals/signal", "Signals"),
}
FOLDER = "classes"


class ClassPage:
    """Writes the page of one class."""

    def __init__(self, name: str, found: dict[str, ElementTree.Element]):
        self.document = found[name]
        self.name = name
        self.found = found
        self.convert = Converter(self.name, self.page_of)

    def page_of(self, name: str) -> str:
        return f"{name}.md" if name in self.found else ""

    def markdown(self) -> str:
        parts = [f"# {self.name}", self.lineage(), self.text("brief_description"), self.text("description")]
        for kind in SECTIONS:
            parts += self.section(kind)
        parts += self.constants()
        return "\n\n".join(filter(None, parts)) + "\n"

    def lineage(self) -> str:
        inherits = self.document.get("inherits")
        return f"Inherits {self.convert.class_link(inherits)}." if inherits else ""

    def text(self, part: str) -> str:
        return self.convert.markdown(self.document.findtext(part) or "")

    def type_link(self, name: str | None, enum: str | None = None) -> str:
        """A type as a link: Class, Array of a class, or an enumeration, Class.Enum."""
        if enum:
            return self.convert.reference("enum", enum)
        if not name or name == "void":
            return "void"
        if name == "Variant" or name.endswith("*"):
            return code(name)
        element = name.removesuffix("[]")
        if name.startswith("Array[") or element != name:
            element = name[6:-1] if name.startswith("Array[") else element
            return f"Array[{self.convert.class_link(element)}]"
        return self.convert.class_link(name)

    def section(self, kind: str) -> list[str]:
        elements = elements_of(self.document, kind)
        inherited = [base for base in classes.line_of(self.name, self.found)[1:] if elements_of(self.found[base], kind)]
        if not elements and not inherited:
            return []
        parts = [f"## {SECTIONS[kind][1]}"]
        if len(elements) > 3:
            parts.append(links_to(elements, kind, ""))
        for base in inherited:
            page = self.page_of(base)
            parts.append(f"From [{base}]({page}): {links_to(elements_of(self.found[base], kind), kind, page)}")
        for element in elements:
            name = element.get("name", "")
            parts.append(f"### {name} {{#{anchor(kind, name)}}}")
            parts.append(self.signature(kind, element))
            parts.append(self.convert.markdown(classes.description(element)))
        return parts

    def signature(self, kind: str, element: ElementTree.Element) -> str:
        name = element.get("name", "")
        if kind == "member":
            kind_of_value = self.type_link(element.get("type"), element.get("enum"))
            default = self.name_of_value(element.get("enum"), element.get("default"))
            return f"Type: {kind_of_value}" + (f", default: {code(default)}" if default is not None else "")
        parameters = [
            f"{parameter.get('name')}: {plain_type(parameter)}"
            + (f" = {parameter.get('default')}" if parameter.get("default") is not None else "")
            for parameter in element.findall("param")
        ]
        if kind == "signal":
            return fenced(f"signal {name}({', '.join(parameters)})")
        words = (element.get("qualifiers") or "").split()
        before = "static " if "static" in words else ""
        if "vararg" in words:
            parameters.append("...")
        result = element.find("return")
        returned = plain_type(result) if result is not None else "void"
        return fenced(f"{before}func {name}({', '.join(parameters)}) -> {returned}")

    def name_of_value(self, enum: str | None, value: str | None) -> str | None:
        """Of an enumeration of these classes, the constant; else the value itself."""
        for document in self.found.values():
            for constant in document.findall("constants/constant"):
                if enum and constant.get("value") == value:
                    if enum in (constant.get("enum"), f"{document.get('name')}.{constant.get('enum')}"):
                        return constant.get("name")
        return value

    def constants(self) -> list[str]:
        elements = list(filter(classes.is_public, self.document.findall("constants/constant")))
        if not elements:
            return []
        parts = []
        for enum in dict.fromkeys(element.get("enum") for element in elements):
            if enum:
                short = enum.rpartition(".")[2]
                title = f"Enumeration {short}" + (f" {{#{anchor('enum', short)}}}")
            else:
                title = "Constants"
            rows = [
                f"| <span id=\"{anchor('constant', element.get('name', ''))}\"></span>`{element.get('name')}` | "
                f"{code(element.get('value', ''))} | {self.convert.one_line(classes.description(element))} |"
                for element in elements
                if element.get("enum") == enum
            ]
            parts += [f"## {title}", "\n".join(["| Name | Value | |", "| --- | --- | --- |", *rows])]
        return parts


def elements_of(document: ElementTree.Element, kind: str) -> list[ElementTree.Element]:
    """The public members of a kind, by their names."""
    found = filter(classes.is_public, document.findall(SECTIONS[kind][0]))
    return sorted(found, key=lambda element: element.get("name", ""))


def links_to(elements: list[ElementTree.Element], kind: str, page: str) -> str:
    return " · ".join(f"[`{element.get('name')}`]({page}#{anchor(kind, element.get('name', ''))})" for element in elements)


def plain_type(element: ElementTree.Element) -> str:
    name = element.get("enum") or element.get("type") or "Variant"
    return f"Array[{name[:-2]}]" if name.endswith("[]") else name


def fenced(text: str) -> str:
    return f"``` {{ .gdscript .no-copy }}\n{text}\n```"


def index(found: dict[str, ElementTree.Element]) -> str:
    known = set(found)
    parts = [
        "# Class reference",
        "Made of the comments in the sources, as the editor shows them (F1). Links to classes of Godot go to "
        f"[its documentation]({GODOT_DOCS}/classes/).",
    ]
    for title, names in classes.GROUPS.items():
        rows = []
        for name in names:
            if name in found:
                brief = Converter(name, lambda other: f"{other}.md" if other in known else "").one_line(
                    found[name].findtext("brief_description") or ""
                )
                rows.append(f"| [{name}]({name}.md) | {brief} |")
        parts += [f"## {title}", "\n".join(["| Class | |", "| --- | --- |", *rows])]
    return "\n\n".join(parts) + "\n"


def write(found: dict[str, ElementTree.Element], folder: Path) -> list[Path]:
    """Writes the pages to a folder; gives them, the index first."""
    folder.mkdir(parents=True)
    pages = [folder / "index.md"]
    pages[0].write_text(index(found), encoding="utf-8")
    for names in classes.GROUPS.values():
        for name in names:
            if name in found:
                pages.append(folder / f"{name}.md")
                pages[-1].write_text(ClassPage(name, found).markdown(), encoding="utf-8")
    return pages


def navigation(found: dict[str, ElementTree.Element]) -> list:
    """The pages of classes as MkDocs takes them in its navigation."""
    groups = {title: [f"{FOLDER}/{name}.md" for name in names if name in found] for title, names in classes.GROUPS.items()}
    return [f"{FOLDER}/index.md", *({title: names} for title, names in groups.items() if names)]
