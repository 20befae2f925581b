"""README.md and index.html of `./dev report`."""

import math

import cases
import document as doc
import measurements
import studies
import verdicts
from page import Page

SECTIONS = (
    verdicts.acceptance,
    verdicts.budgets,
    verdicts.fetch_budgets,
    verdicts.rivals_ahead,
    verdicts.time,
    verdicts.pictures,
    verdicts.claim,
    verdicts.fetches,
    studies.tables_size,
    studies.pyramids,
    studies.biases,
    studies.forms,
    studies.changing,
    studies.changing_by_the_clock,
    studies.bake,
    studies.phones,
    studies.reference,
    verdicts.methods,
    verdicts.everything,
    verdicts.links,
)


def summary_of(page):
    """The verdicts as JSON has them."""
    def best(v):
        return [
            {
                "budget": None if math.isinf(budget) else budget,
                "method": point and point.method,
                "psnr": point and point.psnr,
                "time": point and point.time,
            }
            for budget, point in v["best"]
        ]

    def place(p):
        return {"device": p.device, "renderer": p.renderer, "map": p.map, "brdf": p.material[0], "alpha": list(p.material[1])}

    return {
        "verdicts": [{**place(v["place"]), "front": v["front"], "best": best(v)} for v in page.verdicts],
        "goals": [{**row, "place": place(row["place"])} for row in page.goals],
        "thesis": [{**row, "place": place(row["place"])} for row in page.thesis],
    }


def begin_with_a_picture(blocks):
    """The first figure comes right after the title, and what is said in short after that."""
    figure = next((block for block in blocks if isinstance(block, doc.Figure)), None)
    if figure is not None:
        blocks.remove(figure)
        blocks.insert(1, figure)


def write(out, entries, report_folder, left_out, to_come=0):
    """Writes README.md, index.html and the figures; returns the verdicts for --json. `to_come`: cases not measured yet."""
    # Software first: it has the most.
    entries = sorted(entries, key=lambda entry: entry["device"] != cases.SOFTWARE)
    page = Page(out / "compare", entries, report_folder)
    verdicts.introduction(page)
    verdicts.in_short(page, left_out, to_come)
    for section in SECTIONS:
        section(page)
    begin_with_a_picture(page.blocks)
    measurements.write(out / "README.md", doc.markdown(page.blocks))
    measurements.write(out / "index.html", doc.html_page(verdicts.TITLE, page.blocks))
    return summary_of(page)
