"""The public classes, and what the XML files that the engine writes of them leave undescribed."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

# The public classes, by what they are for.
GROUPS = {
    "Materials": ["LobeMaterial3D", "LobeShaderMaterial", "LobeBaseMaterial3D"],
    "Light": ["LobeEnvironment3D", "LobeProbe3D", "LobeLight"],
    "Nodes of visual shaders": [
        *("VisualShaderNodeLobelightReflection", "VisualShaderNodeLobelightDiffuse", "VisualShaderNodeLobelightSurface"),
        *("VisualShaderNodeLobelightLinear", "VisualShaderNodeLobelightEmission"),
    ],
    "Tables of lobes": ["LobeTable", "LobeTableSet"],
    "Import": ["LobeGLTFExtension"],
    "The native library, for the editor and for tools": [
        *("LobeBaker", "LobeTask", "LobeReference"),
        *("LobeImageFile", "LobeLightFilter", "LobeLightEncoder"),
    ],
}
CLASSES = {name for names in GROUPS.values() for name in names}

def is_public(element: ElementTree.Element) -> bool:
    """Scripts that a class preloads are constants of it, of which nobody needs to know."""
    return not element.get("name", "").startswith("_") and element.get("value") != "<Object>"


def undescribed(document: ElementTree.Element) -> list[str]:
    """What of a class has no description, as "method bake"."""
    missing = [part for part in ("brief_description", "description") if not (document.findtext(part) or "").strip()]
    for kind in ("member", "constant", "method", "signal"):
        for element in filter(is_public, document.iter(kind)):
            if not description(element).strip():
                missing.append(f"{kind} {element.get('name')}")
    return missing


def description(element: ElementTree.Element) -> str:
    """Methods and signals have an element for it."""
    inner = element.find("description")
    return (element.text if inner is None else inner.text) or ""


def read(folders: list[Path]) -> dict[str, ElementTree.Element]:
    """The classes of these folders of XML files by their names; those of a later one win."""
    documents = [ElementTree.parse(path).getroot() for folder in folders for path in sorted(folder.glob("*.xml"))]
    # A base class without a name is left out of the line of classes.
    bases = {document.get("name", ""): document.get("inherits", "") for document in documents}
    for document in documents:
        while "/" in document.get("inherits", ""):
            document.set("inherits", bases.get(document.get("inherits", ""), ""))
    named = {document.get("name", ""): document for document in documents}
    # Scripts without a class_name go by their path.
    return {name: document for name, document in named.items() if "Lobe" in name and "/" not in name}


def findings(found: dict[str, ElementTree.Element]) -> list[str]:
    """Sentences: classes that are missing, unknown, or not described as a whole."""
    sentences = [f"{name}: there is no such class, but tools/docs/classes.py lists it" for name in sorted(CLASSES - found.keys())]
    sentences += [f"{name}: tools/docs/classes.py does not list this class" for name in sorted(found.keys() - CLASSES)]
    for name in sorted(CLASSES & found.keys()):
        missing = undescribed(found[name])
        if missing:
            sentences.append(f"{name}: not described: {', '.join(missing)}")
    return sentences


def count_members(found: dict[str, ElementTree.Element]) -> int:
    kinds = ("member", "constant", "method", "signal")
    return sum(1 for document in found.values() for kind in kinds for _element in filter(is_public, document.iter(kind)))


def line_of(name: str, found: dict[str, ElementTree.Element]) -> list[str]:
    """A class and those of these that it inherits from, the nearest first."""
    line = []
    while name in found:
        line.append(name)
        name = found[name].get("inherits", "")
    return line


def members(found: dict[str, ElementTree.Element]) -> dict[str, dict[str, tuple[str, str]]]:
    """For each class, for each name of a member: the class that has it, and "member", "method", "signal" or "constant"."""
    kinds = ("constant", "signal", "method", "member")
    return {
        name: {
            element.get("name", ""): (owner, kind)
            for owner in reversed(line_of(name, found))
            for kind in kinds
            for element in filter(is_public, found[owner].iter(kind))
        }
        for name in sorted(found)
    }
