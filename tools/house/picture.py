"""docs/pictures/architecture.svg: the boxes of boxes.json, and the arrows between them as the files have them.

A box has the files of its patterns (* stays in a folder, ** does not) that no box before it has; it lies at a column and a row.
An arrow goes from who knows to who is known. Arrows that follow from two others are left out. Dashed arrows are of files that
are loaded when they are wanted, by their paths. Numbers are the ways of lobe_path.txt and light_path.txt, box by box.
"""

import json
from html import escape

from dependencies import House
from references import matches

WIDTH, HEIGHT = 190, 54
STEP_X, STEP_Y = 226, 108
LEFT, TOP = 34, 32
STYLE = """
  .lobelight-text { font: 12.5px system-ui, sans-serif; fill: #1f2328 }
  .lobelight-title { font-weight: 600; font-size: 14px }
  .lobelight-region { fill: #6e778118; stroke: none }
  .lobelight-box { fill: #ffffff; stroke: #6e7781 }
  .lobelight-arrow { fill: none; stroke: #57606a; stroke-width: 1.4 }
  .lobelight-loads { stroke-dasharray: 5 4 }
  .lobelight-head { fill: #57606a }
  .lobelight-lobe { fill: #bc4c00 }
  .lobelight-light { fill: #0969da }
  .lobelight-number { font: 600 10.5px system-ui, sans-serif; fill: #ffffff; text-anchor: middle }
  @media (prefers-color-scheme: dark) {
    .lobelight-text { fill: #e6edf3 }
    .lobelight-box { fill: #161b22; stroke: #8d96a0 }
    .lobelight-arrow { stroke: #9198a1 }
    .lobelight-head { fill: #9198a1 }
    .lobelight-region { fill: #8d96a022 }
  }
"""


class Boxes:
    """The boxes by name, in which of them a file is, and who knows whom."""

    def __init__(self, text: str, house: House):
        described = json.loads(text)
        self.regions: list[dict] = described["regions"]
        self.boxes: dict[str, dict] = {box["name"]: box for box in described["boxes"]}
        self.of: dict[str, str] = {}
        for path in house.files:
            for name, box in self.boxes.items():
                if path not in self.of and any(matches(path, pattern) for pattern in box["files"]):
                    self.of[path] = name
        self.empty = [name for name in self.boxes if name not in self.of.values()]
        self.knows = self._between(house.needs)
        self.loads = self._between(house.loads)

    def _between(self, relation: dict[str, dict[str, int]]) -> dict[str, dict[str, str]]:
        """For each box the others that its files have the relation to, each with one place as an example."""
        found: dict[str, dict[str, str]] = {name: {} for name in self.boxes}
        for path, others in relation.items():
            for other, line in others.items():
                one, two = self.of.get(path), self.of.get(other)
                if one and two and one != two:
                    found[one].setdefault(two, f"{path}:{line}")
        return found

    def outside(self, house: House, prefix: str) -> list[str]:
        """Files below a folder that are in no box."""
        return [path for path in house.files if path.startswith(prefix) and path not in self.of]


def reach(knows: dict[str, dict[str, str]], start: str) -> set[str]:
    found: set[str] = set()
    queue = list(knows[start])
    while queue:
        name = queue.pop()
        if name not in found:
            found.add(name)
            queue += knows[name]
    return found


def reduce(knows: dict[str, dict[str, str]]) -> list[tuple[str, str]]:
    """The arrows that do not follow from others."""
    far = {name: reach(knows, name) for name in knows}
    return [(one, two) for one in knows for two in knows[one] if not any(two in far[via] for via in knows[one] if via != two)]


def draw(boxes: Boxes, ways: dict[str, list[str]]) -> str:
    """The picture; `ways` are the files of each way, by its name."""
    columns = max(box["place"][0] for box in boxes.boxes.values()) + 1
    rows = max(box["place"][1] for box in boxes.boxes.values()) + 1
    width, height = 2 * LEFT + (columns - 1) * STEP_X + WIDTH, TOP + rows * STEP_Y + 56
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" aria-labelledby="lobelight-about">',
        '<title id="lobelight-about">Who knows whom, and the ways of a lobe and of light</title>',
        f"<style>{STYLE}</style>",
        (
            '<defs><marker id="lobelight-head" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8" orient="auto">'
            '<path class="lobelight-head" d="M0 0 L10 5 L0 10 z"/></marker></defs>'
        ),
    ]
    for region in boxes.regions:
        (left, right), (top, bottom) = region["columns"], region["rows"]
        x, y = LEFT + left * STEP_X - 16, TOP + top * STEP_Y - 18
        size = (right - left) * STEP_X + WIDTH + 32, (bottom - top) * STEP_Y + HEIGHT + 48
        parts.append(f'<rect class="lobelight-region" x="{x}" y="{y}" width="{size[0]}" height="{size[1]}" rx="8"/>')
        parts.append(f'<text class="lobelight-text" x="{x + 12}" y="{y + size[1] - 9}">{escape(region["title"])}</text>')
    solid = reduce(boxes.knows)
    dashed = [(one, two) for one, two in reduce(boxes.loads) if two not in boxes.knows[one]]
    for (one, two), kind in [*((arrow, "") for arrow in solid), *((arrow, " lobelight-loads") for arrow in dashed)]:
        parts.append(
            f'<path class="lobelight-arrow{kind}" d="{_curve(boxes.boxes[one]["place"], boxes.boxes[two]["place"], bool(kind))}" '
            'marker-end="url(#lobelight-head)"/>'
        )
    for name, box in boxes.boxes.items():
        x, y = _corner(box["place"])
        parts.append(f'<rect class="lobelight-box" x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" rx="6"/>')
        parts.append(f'<text class="lobelight-text lobelight-title" x="{x + 10}" y="{y + 22}">{escape(box["title"])}</text>')
        parts.append(f'<text class="lobelight-text" x="{x + 10}" y="{y + 42}">{escape(box["says"])}</text>')
        at = x + WIDTH - 12
        for way, files in ways.items():
            order = list(dict.fromkeys(boxes.of[file] for file in files if file in boxes.of))
            if name in order:
                parts.append(f'<circle class="lobelight-{way}" cx="{at}" cy="{y + 1}" r="10"/>')
                parts.append(f'<text class="lobelight-number" x="{at}" y="{y + 5}">{order.index(name) + 1}</text>')
                at -= 23
    parts += _legend(LEFT, TOP + rows * STEP_Y + 12)
    return "\n".join([*parts, "</svg>", ""])


def _corner(place: list[int]) -> tuple[int, int]:
    return LEFT + place[0] * STEP_X, TOP + place[1] * STEP_Y


def _curve(one: list[int], two: list[int], beside: bool) -> str:
    """From the edge of a box to that of another; dashed ones a little beside."""
    (x0, y0), (x1, y1) = _corner(one), _corner(two)
    side = (two[0] > one[0]) - (two[0] < one[0])
    start, end = x0 + (WIDTH if side > 0 else 0), x1 + (0 if side > 0 else WIDTH)
    if one[1] == two[1]:
        return f"M{start} {y0 + HEIGHT // 2} L{end} {y1 + HEIGHT // 2}"
    down = two[1] > one[1]
    if side and abs(two[1] - one[1]) > 1:
        # Along the gap between two columns.
        gap, turn = start + side * (STEP_X - WIDTH) // 2, 10 if down else -10
        y0, y1 = y0 + HEIGHT * 2 // 3, y1 + HEIGHT // 2
        return f"M{start} {y0} H{gap - 10 * side} Q{gap} {y0} {gap} {y0 + turn} V{y1 - turn} Q{gap} {y1} {gap + 10 * side} {y1} H{end}"
    aside = 26 if beside else 0
    x0, x1 = x0 + WIDTH // 2 + 34 * side + aside, x1 + WIDTH // 2 - 34 * side + aside
    y0, y1, bend = (y0 + HEIGHT, y1, 46) if down else (y0, y1 + HEIGHT, -46)
    return f"M{x0} {y0} L{x1} {y1}" if x0 == x1 else f"M{x0} {y0} C{x0} {y0 + bend} {x1} {y1 - bend} {x1} {y1}"


def _legend(x: int, y: int) -> list[str]:
    lines = [
        ("lobelight-lobe", 0, "the way of a lobe, from recipe to pixel"),
        ("lobelight-light", 330, "the way of light, from sky to pixel"),
    ]
    parts = []
    for kind, offset, text in lines:
        parts.append(f'<circle class="{kind}" cx="{x + offset + 10}" cy="{y}" r="10"/>')
        parts.append(f'<text class="lobelight-text" x="{x + offset + 28}" y="{y + 5}">{text}</text>')
    for kind, offset, text in (("", 0, "knows"), (" lobelight-loads", 330, "loads when it is wanted; exports may lack it")):
        parts.append(
            f'<path class="lobelight-arrow{kind}" d="M{x + offset} {y + 30} L{x + offset + 50} {y + 30}" '
            'marker-end="url(#lobelight-head)"/>'
        )
        parts.append(f'<text class="lobelight-text" x="{x + offset + 60}" y="{y + 35}">{text}</text>')
    return parts
