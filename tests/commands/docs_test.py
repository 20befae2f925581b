"""What ./dev docs finds in pages, and what it makes of them: a small repository with one thing wrong at a time.

The last line is "docs: N passed, N failed".
"""

import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/docs"))
sys.dont_write_bytecode = True

import browser_check  # noqa: E402
import class_pages  # noqa: E402
import classes  # noqa: E402
import site_build  # noqa: E402
from bbcode import Converter  # noqa: E402
from checks import Checks  # noqa: E402
from markdown_text import Page, for_python_markdown  # noqa: E402

BAKE = """#!/usr/bin/env bash
echo "usage: ./dev bake --lobes N [--out X]"
"""
GOOD_PAGE = """# First page

[Second](second.md#what-it-costs-and-why), [itself](#first-page), [the folder](more), [elsewhere](https://example.org/x#y).
![A picture](pictures/drawn.png)

`./dev bake --lobes 8 --out X.res` and `./dev bake --help`; `tools/draw.sh`, `res://addons/lobelight/x.gd`, `addons/*/x.gd`,
`res://scenes/of_a_user.tscn`, `build/docs`.

```sh
./dev bake \\
  --lobes 8   # --no-option in a comment
cp a.tres res://addons/lobelight/x.gd
[no link](nowhere.md)
```
"""


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def repository(folder: Path, page: str) -> Path:
    """A repository whose page docs/first.md is `page`."""
    write(folder / "dev", '#!/usr/bin/env bash\nexec bash "$(dirname "$0")/tools/commands/$1.sh" "${@:2}"\n')
    (folder / "dev").chmod(0o755)
    write(folder / "tools/commands/bake.sh", BAKE)
    write(folder / "tools/commands/test.sh", 'echo "usage: ./dev test [GROUP…]"\necho "Groups, all of them if none is named: lint cpp"\n')
    write(folder / "tools/draw.sh", "")
    write(folder / "tools/docs/pictures.txt", "# A comment.\ndocs/pictures/drawn.png  bash tools/draw.sh\n")
    write(folder / "addons/lobelight/x.gd", "")
    write(folder / "docs/second.md", "# Second\n\n## What it costs, and `why`\n\n## Again\n\n## Again\n")
    write(folder / "docs/more/README.md", "# More\n")
    write(folder / "docs/pictures/drawn.png", "")
    write(folder / "docs/pictures/by_hand.png", "")
    write(folder / "docs/first.md", page)
    return folder


def found_in(page: str, name: str = "docs/first.md") -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        root = repository(Path(folder), GOOD_PAGE)
        write(root / name, page)
        checks = Checks(root)
        checks.check_page(root / name)
        return [str(finding) for finding in checks.findings]


# A page with one thing wrong, and all that is to be said of it.
BAD_PAGES = {
    "a dead link": ("# A\n\n[x](gone.md)\n", ["docs/first.md:3: gone.md leads to no file"]),
    "a link in other letters": ("[x](Second.md)\n", ["docs/first.md:1: Second.md leads to no file"]),
    "a dead anchor": (
        "\n[x](second.md#costs)\n",
        ["docs/first.md:2: second.md#costs: docs/second.md has no heading #costs"],
    ),
    "a dead anchor of the page itself": ("# A\n[x](#b)\n", ["docs/first.md:2: #b: docs/first.md has no heading #b"]),
    "a third heading of one name": (
        "[x](second.md#again-1) [x](second.md#again-2)\n",
        ["docs/first.md:1: second.md#again-2: docs/second.md has no heading #again-2"],
    ),
    "a dead link by reference": ("[x][y]\n\n[y]: gone.md\n", ["docs/first.md:3: gone.md leads to no file"]),
    "a missing picture": ("![x](pictures/gone.png)\n", ["docs/first.md:1: pictures/gone.png leads to no file"]),
    "a missing picture in HTML": ('<img src="gone.png">\n', ["docs/first.md:1: gone.png leads to no file"]),
    "a picture that no command draws": (
        "![x](pictures/by_hand.png)\n",
        ["docs/first.md:1: pictures/by_hand.png: tools/docs/pictures.txt names no command that draws it"],
    ),
    "a command that is not there": ("a\n`./dev cook`\n", ["docs/first.md:2: ./dev cook: there is no such command"]),
    "an option that is not there": (
        "```sh\n./dev bake --lobes 2 \\\n  --colour red\n```\n",
        ["docs/first.md:2: ./dev bake has no option --colour, as its help has it"],
    ),
    "a group that is not there": ("`./dev test cpp shader`\n", ["docs/first.md:1: ./dev test has no group shader"]),
    "a path that is not there": (
        "`tools/paint.sh` and `bash tools/draw.sh`\n",
        ["docs/first.md:1: tools/paint.sh is not in the repository"],
    ),
    "a resource that is not there": (
        "```\nload('res://addons/lobelight/y.gd')\n```\n",
        ["docs/first.md:2: addons/lobelight/y.gd is not in the repository"],
    ),
}


def test_bad_pages() -> list[str]:
    problems = []
    for name, (page, expected) in BAD_PAGES.items():
        found = found_in(page)
        if found != expected:
            problems.append(f"{name}: found {found}")
    return problems


def test_good_page() -> list[str]:
    return found_in(GOOD_PAGE)


def test_report_without_command() -> list[str]:
    expected = ["docs/report/x/README.md:1: this report does not say which command writes it"]
    found = found_in("# Times\n", "docs/report/x/README.md")
    return [] if found == expected and not found_in("`./dev bake`\n", "docs/report/x/README.md") else [f"found {found}"]


def test_list_of_pictures() -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        root = repository(Path(folder), GOOD_PAGE)
        write(root / "tools/docs/pictures.txt", "docs/pictures/gone.png ./dev bake --size 3\ndocs/more/ bash tools/paint.sh\n")
        checks = Checks(root)
        checks.check_list_of_pictures()
        found = [str(finding) for finding in checks.findings]
    expected = [
        "tools/docs/pictures.txt:1: docs/pictures/gone.png is not in the repository",
        "tools/docs/pictures.txt:1: ./dev bake has no option --size, as its help has it",
        "tools/docs/pictures.txt:2: tools/paint.sh is not in the repository",
    ]
    return [] if found == expected else [f"found {found}"]


def test_navigation() -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        checks = Checks(repository(Path(folder), GOOD_PAGE))
        checks.check_navigation(["first.md", "third.md", "more/README.md", "classes/"], "nav.yml")
        found = [str(finding) for finding in checks.findings]
    expected = [
        "nav.yml: third.md is in the navigation, but there is no such page",
        "nav.yml: second.md is not in the navigation",
    ]
    return [] if found == expected else [f"found {found}"]


CLASS = """<class name="{name}" inherits="Node3D"><brief_description>Short.</brief_description>
<description>Long, by [member size].</description>
<methods><method name="turn"><return type="void" /><description>{method}</description></method>
<method name="_process"><return type="void" /><description></description></method></methods>
<members><member name="size" type="int" default="3">A size.</member></members>
<signals><signal name="rebuilt"><description>It is new.</description></signal></signals>
<constants><constant name="SKY" value="0" enum="Lobe.Source">{constant}</constant>
<constant name="Helper" value="&lt;Object&gt;"></constant></constants></class>"""


def a_class(name: str, method: str = "Turns.", constant: str = "The sky.") -> ElementTree.Element:
    return ElementTree.fromstring(CLASS.format(name=name, method=method, constant=constant))


def test_undescribed() -> list[str]:
    found = {name: a_class(name) for name in classes.CLASSES}
    problems = [f"a described class: {sentence}" for sentence in classes.findings(found)]
    found["LobeTable"] = a_class("LobeTable", method=" ", constant="")
    found["LobeNew"] = a_class("LobeNew")
    del found["LobeBaker"]
    said = classes.findings(found)
    expected = [
        "LobeBaker: there is no such class, but tools/docs/classes.py lists it",
        "LobeNew: tools/docs/classes.py does not list this class",
        "LobeTable: not described: constant SKY, method turn",
    ]
    return problems + ([] if said == expected else [f"found {said}"])


def test_class_page() -> list[str]:
    """What a class inherits from another one is on its page, and values have their names."""
    derived = ElementTree.fromstring(
        """<class name="LobeTable" inherits="LobeTask"><brief_description>Short.</brief_description>
        <methods><method name="mix" qualifiers="static"><return type="LobeTask[]" /><param index="0" name="by" type="float"
        default="0.5" /><description>Mixes.</description></method></methods>
        <members><member name="source" type="int" enum="LobeTask.Source" default="0">Whence.</member></members></class>"""
    )
    base = a_class("LobeTask")
    base.find("constants/constant").set("enum", "Source")
    page = class_pages.ClassPage("LobeTable", {"LobeTable": derived, "LobeTask": base}).markdown()
    wanted = [
        "# LobeTable\n\nInherits [LobeTask](LobeTask.md).\n\nShort.",
        "From [LobeTask](LobeTask.md): [`size`](LobeTask.md#property-size)",
        "Type: [`LobeTask.Source`](LobeTask.md#enum-Source), default: `SKY`\n\nWhence.",
        "static func mix(by: float = 0.5) -> Array[LobeTask]",
        "From [LobeTask](LobeTask.md): [`turn`](LobeTask.md#method-turn)",
        "## Signals\n\nFrom [LobeTask](LobeTask.md): [`rebuilt`](LobeTask.md#signal-rebuilt)",
    ]
    problems = [f"there is not {text!r}" for text in wanted if text not in page]
    return problems + (["it shows what is not public"] if "_process" in page or "Helper" in page else [])


def test_bbcode() -> list[str]:
    convert = Converter("LobeTable", lambda name: f"{name}.md" if name.startswith("Lobe") else "").markdown
    pairs = {
        "[b]Units.[/b] a_b < [code]c_d < e[/code]": "**Units.** a\\_b &lt; `c_d < e`",
        "One.[br][br]Two[br]lines": "One.\n\nTwo  \nlines",
        "A:[br]- b[br]- c": "A:\n\n- b\n- c",
        "\n\t\tOne.\n\t\tTwo.\n\t": "One.\n\nTwo.",
        "[LobeLight], [Node3D], [int], [Vector2]s": (
            "[LobeLight](LobeLight.md), [Node3D](https://docs.godotengine.org/en/4.6/classes/class_node3d.html), "
            "[int](https://docs.godotengine.org/en/4.6/classes/class_int.html), "
            "[Vector2](https://docs.godotengine.org/en/4.6/classes/class_vector2.html)s"
        ),
        "[method bake] of [method LobeTask.start]": "[`bake()`](#method-bake) of [`LobeTask.start()`](LobeTask.md#method-start)",
        "[member Node3D.rotation_edit_mode]": (
            "[`Node3D.rotation_edit_mode`](https://docs.godotengine.org/en/4.6/classes/class_node3d.html"
            "#class-node3d-property-rotation-edit-mode)"
        ),
        "[param a_b] is [code][0, 1][/code]": "`a_b` is `[0, 1]`",
        "[codeblock]\nvar a := b[0]\n[/codeblock]": "```gdscript\nvar a := b[0]\n```",
    }
    return [f"{text!r} became {convert(text)!r}" for text, expected in pairs.items() if convert(text) != expected]


def test_lists() -> list[str]:
    page = "Text:\n- one\n  goes on\n  - inside\n- two\n\n1. a\n\n   ```sh\n   - no item\n   ```\n2. b\n| x |\n| --- |\n| y |\n"
    expected = (
        "Text:\n\n- one\n    goes on\n    - inside\n- two\n\n1. a\n\n    ```sh\n    - no item\n    ```\n2. b\n\n| x |\n| --- |\n| y |\n"
    )
    became = for_python_markdown(page)
    return [] if became == expected else [f"became {became!r}"]


def test_code_is_no_prose() -> list[str]:
    page = Page(Path("x.md"), "`[a](b)` [`c`](d) ```\n\n~~~\n[e](f)\n~~~\n<!-- [g](h) -->\n")
    targets = [link.text for link in page.links()]
    return [] if targets == ["d"] else [f"found {targets}"]


HOME = """# Home

Light is $L_o = \\frac{1}{2} x$, `LobeTable.size` of [first](first.md), [a tool](../tools/draw.sh), `LobeTable.colour`.

$$
\\mathbf{a} \\cdot b
$$
"""


def test_site() -> list[str]:
    """From a repository to pages: what is missing in the navigation does no harm."""
    with tempfile.TemporaryDirectory() as folder:
        root = repository(Path(folder) / "repository", GOOD_PAGE)
        write(root / "docs/index.md", HOME)
        write(root / "addons/lobelight/plugin.cfg", 'version="1.2.3"\n')
        write(root / site_build.LOGO, "<svg xmlns='http://www.w3.org/2000/svg'/>")
        site, findings = site_build.build(root, {"LobeTable": a_class("LobeTable")}, Path(folder) / "work", [])
        problems = [str(finding) for finding in [*findings, *site_build.foreign_resources(site)]]
        home = (site / "index.html").read_text(encoding="utf-8")
        table = (site / "classes/LobeTable.html").read_text(encoding="utf-8")
        write(site / "bad.html", '<script src="https://example.org/x.js"></script><a href="https://example.org">x</a>')
        write(site / "bad.css", "@font-face { src: url(https://example.org/x.woff2); }")
        loads = [finding.place for finding in site_build.foreign_resources(site)]
    wanted = {
        "the version": "Lobelight 1.2.3" in home,
        "an equation": '<math xmlns="http://www.w3.org/1998/Math/MathML" display="inline">' in home,
        "an equation of its own": 'display="block"' in home and "\\mathbf" not in home,
        "a link to a member": '<a href="classes/LobeTable.html#property-size"><code>LobeTable.size</code></a>' in home,
        "no link to a member that is not there": "<code>LobeTable.colour</code></a>" not in home,
        "no link to a file outside the site": "a tool" in home and "draw.sh" not in home and ".invalid" not in home,
        "a page of a class": 'id="property-size"' in table and "default: <code>3</code>" in table,
        "both that load from elsewhere": loads == ["bad.css", "bad.html"],
    }
    return problems + [f"there is not {name}" for name, there in wanted.items() if not there]


def test_in_a_browser() -> list[str]:
    """Pages too wide for a phone, and a site that has no search."""
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder) / "fits.html", "<body><div style='overflow-x: auto'><p style='width: 900px'>x</p></div>")
        write(Path(folder) / "wide.html", "<body style='margin: 0'><p id='long' style='width: 600px'>x</p>")
        write(Path(folder) / "asks.html", "<img src='http://198.51.100.1/x.png'>")
        write(Path(folder) / "index.html", "<link rel='icon' href='data:,'><p>x</p>")
        found = [str(finding) for finding in browser_check.check(Path(folder), seconds=1)]
    wanted = [
        "asks.html: asks another host: http://198.51.100.1/x.png",
        'wide.html: 210 pixels too wide at 390: <p id="long"',
        f"index.html: the search finds nothing for '{browser_check.SEARCHED}' at http:",
        f"index.html: the search finds nothing for '{browser_check.SEARCHED}' at file:",
    ]
    problems = [f"not found: {text}" for text in wanted if not any(line.startswith(text) for line in found)]
    return problems + [f"found: {line}" for line in found if line.startswith("fits.html")]


TESTS: dict[str, Callable[[], list[str]]] = {
    "bad pages": test_bad_pages,
    "a good page": test_good_page,
    "a report without a command": test_report_without_command,
    "the list of pictures": test_list_of_pictures,
    "the navigation": test_navigation,
    "members without description": test_undescribed,
    "the page of a class": test_class_page,
    "BBCode": test_bbcode,
    "lists": test_lists,
    "links in code": test_code_is_no_prose,
    "a site": test_site,
    "in a browser": test_in_a_browser,
}


def main() -> int:
    failed = 0
    for name, test in TESTS.items():
        problems = test()
        failed += bool(problems)
        print(f"{name}: {'FAILED, ' + '; '.join(problems) if problems else 'passed'}")
    print(f"docs: {len(TESTS) - failed} passed, {failed} failed")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
