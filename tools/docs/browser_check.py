"""Opens every page of the site in Chromium as a phone shows it, and searches it."""

import sys
from pathlib import Path

from playwright.sync_api import TimeoutError as NothingFound

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "web"))

import browser  # noqa: E402

from checks import Finding  # noqa: E402

PHONE = (390, 844)
# How far the page is wider than the window, and what sticks out of it, but what scrolls in a box of its own.
TOO_WIDE = """() => {
  const width = document.documentElement.clientWidth;
  const over = document.scrollingElement.scrollWidth - width;
  if (over <= 0) return null;
  const scrolls = (element) => {
    for (let box = element.parentElement; box && box !== document.body; box = box.parentElement)
      if (getComputedStyle(box).overflowX !== "visible") return true;
    return false;
  };
  const out = [...document.querySelectorAll("body *")].filter(
    (element) => element.getBoundingClientRect().right > width + 1 && !scrolls(element));
  const last = out.at(-1);
  return `${over} pixels too wide at 390: ${last ? last.outerHTML.slice(0, 120) : "the body"}`;
}"""
SEARCHED = "anisotropy"


def check(site: Path, seconds: float = 120) -> list[Finding]:
    """`seconds`: how long a search may take. Both that and opening a page are quick where the machine has nothing else to do."""
    found: list[Finding] = []
    with browser.serve(site) as address, browser.start_browser() as program:
        context = program.new_context(viewport={"width": PHONE[0], "height": PHONE[1]})
        asked: list[str] = []

        def only_here(route):
            if route.request.url.startswith(address):
                route.continue_()
            else:
                asked.append(route.request.url)
                route.abort()

        context.set_default_timeout(120_000)
        context.route("**/*", only_here)
        page = context.new_page()
        said: list[str] = []
        page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: said.append(str(error)))
        for path in sorted(site.rglob("*.html")):
            name = path.relative_to(site).as_posix()
            if name == "404.html":
                continue
            page.goto(address + name, wait_until="load")
            problems = [page.evaluate(TOO_WIDE), *(f"asks another host: {url}" for url in asked), *said]
            found += [Finding(name, " ".join(problem.split())) for problem in problems if problem]
            asked.clear()
            said.clear()
        context.close()
        # From a server, and from a folder.
        for start in (address, f"{site.resolve().as_uri()}/"):
            page = program.new_page()
            page.goto(f"{start}index.html?q={SEARCHED}")
            try:
                page.wait_for_selector(".md-search-result__item", timeout=seconds * 1000, state="attached")
            except NothingFound:
                found.append(Finding("index.html", f"the search finds nothing for '{SEARCHED}' at {start.split(':')[0]}:"))
            page.close()
    return found

