"""Lists what the class reference (F1) does not describe: class_reference.py FOLDER.

FOLDER holds the XML files that the engine writes by --doctool. The last line is "class reference: N passed, N failed",
counted by classes.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

CLASSES = {
    "LobeBaker",
    "LobeBaseMaterial3D",
    "LobeEnvironment3D",
    "LobeGLTFExtension",
    "LobeImageFile",
    "LobeLight",
    "LobeLightEncoder",
    "LobeLightFilter",
    "LobeMaterial3D",
    "LobeProbe3D",
    "LobeReference",
    "LobeShaderMaterial",
    "LobeTable",
    "LobeTableSet",
    "LobeTask",
}


def is_public(element: ElementTree.Element) -> bool:
    """Scripts that a class preloads are constants of it, of which nobody needs to know."""
    return not element.get("name").startswith("_") and element.get("value") != "<Object>"


def undescribed(document: ElementTree.Element) -> list[str]:
    """What of a class has no description, as "method bake"."""
    missing = [part for part in ("brief_description", "description") if not (document.findtext(part) or "").strip()]
    for kind in ("member", "constant", "method", "signal"):
        for element in filter(is_public, document.iter(kind)):
            text = element.findtext("description") if kind in ("method", "signal") else element.text
            if not (text or "").strip():
                missing.append(f"{kind} {element.get('name')}")
    return missing


def main() -> int:
    documents = [ElementTree.parse(path).getroot() for path in sorted(Path(sys.argv[1]).rglob("Lobe*.xml"))]
    found = {document.get("name"): document for document in documents}
    failed = 0
    for name in sorted(CLASSES):
        missing = undescribed(found[name]) if name in found else ["the class"]
        failed += bool(missing)
        print(f"{name}: {'not described: ' + ', '.join(missing) if missing else 'described'}")
    for name in sorted(found.keys() - CLASSES):
        failed += 1
        print(f"{name}: not known to this test")
    print(f"class reference: {len(CLASSES | found.keys()) - failed} passed, {failed} failed")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
