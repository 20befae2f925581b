"""A page as a list of blocks, written as Markdown and as HTML that needs no server.

Texts know `code`, **bold** and [links](address); everything else in them is plain.
"""

import dataclasses
import html
import re


@dataclasses.dataclass
class Heading:
    text: str
    level: int = 2


@dataclasses.dataclass
class Text:
    text: str


@dataclasses.dataclass
class Items:
    items: list[str]


@dataclasses.dataclass
class Table:
    """`rows` of texts; columns after the first `names` ones are numbers."""

    head: list[str]
    rows: list[list[str]]
    names: int = 1


@dataclasses.dataclass
class Figure:
    """A picture's address, relative to the page, what it shows, and where it was measured."""

    path: str
    caption: str
    source: str = ""


@dataclasses.dataclass
class Folded:
    """Blocks behind a line to click on."""

    title: str
    blocks: list


STYLE = """
:root { color-scheme: light dark; }
body { max-width: 76rem; margin: 2rem auto; padding: 0 1rem; font: 16px/1.5 system-ui, sans-serif; }
h1, h2, h3 { line-height: 1.2; margin-top: 2em; }
table { border-collapse: collapse; display: block; overflow-x: auto; font-size: .87rem; }
th, td { padding: .2rem .6rem; border-bottom: 1px solid #8884; text-align: right; white-space: nowrap; }
th { vertical-align: bottom; }
.name { text-align: left; }
figure { margin: 1.5rem 0; }
img { max-width: 100%; height: auto; background: #fff; }
figcaption, .source { font-size: .87rem; opacity: .85; }
code { font-size: .9em; }
summary { cursor: pointer; margin: .5rem 0; }
"""


def cell(text):
    return text.replace("|", "\\|")


def markdown(blocks):
    parts = []
    for block in blocks:
        if isinstance(block, Heading):
            parts.append(f"{'#' * block.level} {block.text}")
        elif isinstance(block, Text):
            parts.append(block.text)
        elif isinstance(block, Items):
            parts.append("\n".join(f"- {item}" for item in block.items))
        elif isinstance(block, Table):
            rule = ["---"] * block.names + ["---:"] * (len(block.head) - block.names)
            parts.append("\n".join(f"| {' | '.join(map(cell, row))} |" for row in (block.head, rule, *block.rows)))
        elif isinstance(block, Figure):
            source = f" {block.source}" if block.source else ""
            parts.append(f"![{block.caption}]({block.path})\n\n*{block.caption}*{source}")
        elif isinstance(block, Folded):
            parts.append(f"<details><summary>{html.escape(block.title)}</summary>\n\n{markdown(block.blocks)}\n</details>")
    return "\n\n".join(parts) + "\n"


def inline(text):
    """HTML of a text."""
    text = html.escape(text, quote=True)
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", text)
    return re.sub(r"\[([^\]]+)\]\(([^)\s]+)\)", r'<a href="\2">\1</a>', text)


def html_table(table):
    def row(cells, tag):
        kinds = [' class="name"' if i < table.names else "" for i in range(len(cells))]
        return "<tr>" + "".join(f"<{tag}{kind}>{inline(c)}</{tag}>" for kind, c in zip(kinds, cells)) + "</tr>"

    body = "\n".join(row(cells, "td") for cells in table.rows)
    return f"<table>\n<thead>{row(table.head, 'th')}</thead>\n<tbody>\n{body}\n</tbody>\n</table>"


def html_blocks(blocks):
    parts = []
    for block in blocks:
        if isinstance(block, Heading):
            parts.append(f"<h{block.level}>{inline(block.text)}</h{block.level}>")
        elif isinstance(block, Text):
            parts.append(f"<p>{inline(block.text)}</p>")
        elif isinstance(block, Items):
            parts.append("<ul>\n" + "\n".join(f"<li>{inline(item)}</li>" for item in block.items) + "\n</ul>")
        elif isinstance(block, Table):
            parts.append(html_table(block))
        elif isinstance(block, Figure):
            picture = f'<img src="{html.escape(block.path)}" alt="{html.escape(block.caption)}" loading="lazy">'
            source = f' <span class="source">{inline(block.source)}</span>' if block.source else ""
            parts.append(f"<figure>{picture}<figcaption>{inline(block.caption)}{source}</figcaption></figure>")
        elif isinstance(block, Folded):
            parts.append(f"<details><summary>{inline(block.title)}</summary>\n{html_blocks(block.blocks)}\n</details>")
    return "\n".join(parts)


def html_page(title, blocks):
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{html.escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        f"{html_blocks(blocks)}\n</body>\n</html>\n"
    )
