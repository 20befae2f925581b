"""Builds the documentation site and checks it: see ./dev docs --help."""

import argparse
import json
import os
import shutil
import sys
import tempfile
from pathlib import Path

import classes
import pages
import site_build
from checks import Checks, Finding

ROOT = Path(__file__).resolve().parents[2]
# What tells a folder that this command made from others.
MARK = "search/search_index.json"


def main() -> int:
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--xml", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("--fonts", type=Path, nargs="+", required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()

    found = classes.read([options.xml, ROOT / "addons/lobelight/doc_classes"])
    site, findings = site_build.build(ROOT, found, options.work, options.fonts)
    findings += [Finding("class reference", sentence) for sentence in classes.findings(found)]
    checks = Checks(ROOT)
    for path in [*pages.sources(ROOT), *pages.others(ROOT)]:
        checks.check_page(path)
    checks.check_list_of_pictures()
    if options.check:
        checks.check_navigation(site_build.nav_files(site_build.base_config()["nav"]), site_build.CONFIG_NAME)
    findings += checks.findings
    if site.is_dir():
        findings += site_build.foreign_resources(site)
    if options.check and site.is_dir():
        import browser_check

        findings += browser_check.check(site)
    if (site / MARK).is_file():
        put(site, options.out)
    figures = {
        **checks.counts,
        "classes": len(found),
        "members": classes.count_members(found),
        "bytes": sum(path.stat().st_size for path in options.out.rglob("*") if path.is_file()),
        "findings": [{"place": finding.place, "reason": finding.reason} for finding in findings],
    }
    for finding in findings:
        print(finding)
    if options.json:
        write_json(options.json, figures)
    looked_at = sum(checks.counts.values()) + figures["members"]
    print(
        f"{checks.counts['pages']} pages, {figures['classes']} classes of {figures['members']} members; looked at "
        f"{checks.counts['links']} links, {checks.counts['pictures']} pictures, {checks.counts['commands']} command lines, "
        f"{checks.counts['paths']} paths"
    )
    print(options.out)
    print(f"docs: {looked_at} passed, {len(findings)} failed")
    return 1 if findings else 0


def put(site: Path, out: Path) -> None:
    """Puts the new site in place of the old one."""
    out.parent.mkdir(parents=True, exist_ok=True)
    old = Path(tempfile.mkdtemp(dir=out.parent))
    new = old / "new"
    shutil.copytree(site, new)
    if out.exists():
        out.rename(old / "old")
    new.rename(out)
    shutil.rmtree(old)


def write_json(path: Path, figures: dict) -> None:
    draft = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        draft.write_text(json.dumps(figures, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        draft.rename(path)
    except OSError as error:
        sys.exit(f"lobelight: docs: {path} cannot be written: {error.strerror}")


if __name__ == "__main__":
    sys.exit(main())
