"""What MkDocs calls while it builds: anchors as on GitHub, equations as MathML, names of classes as links."""

import html
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import latex2mathml.converter  # noqa: E402
import markdown.extensions.toc  # noqa: E402

from bbcode import anchor  # noqa: E402
from markdown_text import slug, unused  # noqa: E402
from pages import NO_TARGET, relative  # noqa: E402

MATHS = re.compile(r'<(?P<tag>span|div) class="arithmatex">(?:\\\(|\\\[)(?P<tex>.*?)(?:\\\)|\\\])</(?P=tag)>', re.DOTALL)
NUMBER = re.compile(r"\s*\\tag\{(?P<number>[^}]*)\}")
# Code that is a class's name, or one with a member's; links and headings are left as they are.
PIECES = re.compile(r"<a\b.*?</a>|<h\d.*?</h\d>|<pre.*?</pre>|<code>(?P<code>[\w.()]+)</code>", re.DOTALL)
PICTURES = re.compile(r'<a\b.*?</a>|<img\b[^>]*\bsrc="(?P<source>[^":]+)"[^>]*>', re.DOTALL)
NOWHERE = re.compile(rf'<a href="{re.escape(NO_TARGET)}">(.*?)</a>', re.DOTALL)
NAME = re.compile(r"(?P<owner>Lobe\w+?)(?:\.(?P<member>\w+)(?P<call>\(\))?)?")


def on_config(config):
    config.mdx_configs.setdefault("toc", {})["slugify"] = slug
    # A heading that is there already gets -1 at GitHub, _1 at Python-Markdown.
    markdown.extensions.toc.unique = _take_unused
    return config


def _take_unused(name, taken, *_separator):
    new = unused(name, taken)
    taken.add(new)
    return new


def on_page_content(content, page, config, files):
    content = NOWHERE.sub(r"\1", content)
    content = MATHS.sub(_mathml, content)
    here = page.file.src_uri
    folder = Path(config.docs_dir, here).parent
    content = PICTURES.sub(lambda match: _with_link(match, folder), content)
    known = {file.name: file.src_uri for file in files.documentation_pages() if file.src_uri.startswith("classes/Lobe")}
    return PIECES.sub(lambda match: _linked(match, here, known, config), content)


def _with_link(match, folder):
    """Figures are drawn for wider windows than a page's column: a click shows them whole. Those that are black on nothing,
    and know no dark scheme, get a ground."""
    source = match["source"]
    if not source:
        return match[0]
    shown = match[0]
    if source.endswith(".svg") and "prefers-color-scheme" not in (folder / source).read_text(encoding="utf-8"):
        shown = shown.replace("<img ", '<img class="on-white" ', 1)
    return f'<a href="{source}">{shown}</a>'


def _mathml(match):
    tex = html.unescape(match["tex"]).strip()
    if match["tag"] != "div":
        return latex2mathml.converter.convert(tex)
    number = NUMBER.search(tex)
    mathml = latex2mathml.converter.convert(NUMBER.sub("", tex), display="block")
    shown = f'<span class="number">({number["number"]})</span>' if number else ""
    return f'<div class="equation">{mathml}{shown}</div>'


def _linked(match, here, known, config):
    name = NAME.fullmatch(match["code"] or "")
    if not name or name["owner"] not in known or known[name["owner"]] == here:
        return match[0]
    owner, fragment = name["owner"], ""
    if name["member"]:
        # The class that it is inherited from, perhaps.
        owner, kind = config.extra["members"].get(owner, {}).get(name["member"], (owner, ""))
        if not kind:
            return match[0]
        fragment = f"#{anchor(kind, name['member'])}"
    page = relative(known[owner].removesuffix(".md") + ".html", here)
    return f'<a href="{page}{fragment}">{match[0]}</a>'
