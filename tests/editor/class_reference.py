"""Lists what the class reference (F1) does not describe: class_reference.py FOLDER.

FOLDER holds the XML files that the engine writes by --doctool. The last line is "class reference: N passed, N failed",
counted by classes.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/docs"))
sys.dont_write_bytecode = True

import classes  # noqa: E402


def main() -> int:
    folder = Path(sys.argv[1])
    found = classes.read([folder, *(path for path in sorted(folder.rglob("*")) if path.is_dir())])
    sentences = classes.findings(found)
    for sentence in sentences:
        print(f"FAILED {sentence}")
    for name in sorted(found):
        if not any(sentence.startswith(f"{name}:") for sentence in sentences):
            print(f"{name}: described")
    print(f"class reference: {len(classes.CLASSES | found.keys()) - len(sentences)} passed, {len(sentences)} failed")
    return 1 if sentences else 0


if __name__ == "__main__":
    sys.exit(main())
