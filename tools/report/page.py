"""What the sections of the page of `./dev report` share: the measurements, and how blocks are added."""

import itertools
import os

import analysis
import cases
import document as doc
from analysis import Place


def number(value, digits):
    return "–" if value is None else f"{value:.{digits}f}"


def decibels(value):
    return number(value, 1)


def ratio(value):
    return number(value, 2)


def joined(words):
    words = list(words)
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def source_of(entries):
    """Where and when figures were measured: machine, driver, engine, renderers, dates."""
    lines = []
    for where, own in itertools.groupby(sorted(entries, key=where_key), key=where_key):
        own = list(own)
        device, machine, driver, version, engine = where
        renderers = joined(dict.fromkeys(entry["renderer"] for entry in own))
        dates = sorted({entry["where"]["date"] for entry in own})
        size = joined(sorted({f"{entry['size']}²" for entry in own}))
        timed = sorted({entry["timing_size"] for entry in own if entry["timing_size"]})
        if timed:
            size += f" (times {joined(f'{side}²' for side in timed)})"
        kind = " in software" if device == cases.SOFTWARE else ""
        days = " to ".join(dict.fromkeys((dates[0], dates[-1])))
        lines.append(f"{renderers}, {size}, {driver}{kind}, API {version}, {machine}, Godot {engine}, {days}")
    return "`./dev report`: " + "; ".join(lines) + "."


def where_key(entry):
    where = entry["where"]
    return (entry["device"], where["machine"], where["driver"], where["driver_version"], where["engine"])


def entries_of(entries, found):
    """The entries behind verdicts: pictures, and times from the map that is timed."""
    wanted = dict.fromkeys(place for v in found for place in (v["place"], timed_place(v["place"])))
    return [entry for entry in (analysis.find(entries, place) for place in wanted) if entry]


def timed_place(place):
    return Place(place.device, place.renderer, cases.TIMED_MAP, place.material)


def plain(value):
    if isinstance(value, list):
        return " × ".join(map(plain, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


class Page:
    """Collects blocks; figures go to `folder`, which the page reaches as compare/."""

    def __init__(self, folder, entries, report_folder):
        self.folder, self.entries, self.report_folder = folder, entries, report_folder
        self.blocks = []
        self.verdicts = analysis.verdicts(entries)
        self.goals = analysis.goals(entries)
        self.thesis = analysis.thesis(entries)
        first = entries[0]
        self.device, self.renderer = first["device"], first["renderer"]

    def heading(self, text, level=2):
        self.blocks.append(doc.Heading(text, level))

    def text(self, text):
        self.blocks.append(doc.Text(text))

    def items(self, items):
        items = list(items)
        if items:
            self.blocks.append(doc.Items(items))

    def table(self, head, rows, names=1):
        self.blocks.append(doc.Table(head, rows, names))

    def figure(self, name, caption, entries, draw, *arguments):
        draw(*arguments, self.folder / name)
        self.blocks.append(doc.Figure(f"compare/{name}", caption, source_of(entries)))

    def link(self, *parts):
        """The address of a file of docs/report, from the page; None where it does not exist."""
        path = self.report_folder.joinpath(*parts)
        return os.path.relpath(path, self.folder.parent).replace(os.sep, "/") if path.exists() else None

    def of_first(self, map_name=cases.TIMED_MAP):
        """Verdicts of the renderer that measures most."""
        return [v for v in self.verdicts if self.is_first(v["place"]) and v["place"].map == map_name]

    def is_first(self, place):
        return (place.device, place.renderer) == (self.device, self.renderer)
