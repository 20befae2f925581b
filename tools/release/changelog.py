"""CHANGELOG.md, whose form is Keep a Changelog's."""

import datetime
import re

HEADING = re.compile(r"^## \[([^\]]+)\](?: - (\S+))?\s*$", re.MULTILINE)


class ChangelogError(Exception):
    """Says in one sentence what is wrong with CHANGELOG.md."""


def sections(text):
    """(date or None, lines below the heading) by version, "Unreleased" being one."""
    found = {}
    headings = list(HEADING.finditer(text))
    for number, heading in enumerate(headings):
        end = headings[number + 1].start() if number + 1 < len(headings) else len(text)
        if heading[1] in found:
            raise ChangelogError(f"CHANGELOG.md: there are two sections [{heading[1]}]")
        # Links at the file's end belong to no section.
        body = re.sub(r"^\[[^\]]+\]: \S+$", "", text[heading.end() : end], flags=re.MULTILINE)
        found[heading[1]] = (heading[2], body.strip())
    return found


def section(text, version):
    """The date and the lines of a released version; raises ChangelogError if they are not as they should be."""
    found = sections(text)
    if "Unreleased" not in found:
        raise ChangelogError('CHANGELOG.md: there is no section "## [Unreleased]" for what comes next')
    if version not in found:
        raise ChangelogError(f'CHANGELOG.md: there is no section "## [{version}] - DATE" for the version of plugin.cfg')
    date, body = found[version]
    try:
        datetime.datetime.strptime(date or "", "%Y-%m-%d")
    except ValueError:
        raise ChangelogError(f'CHANGELOG.md: the section [{version}] has the date "{date or ""}", not one like 2026-01-31') from None
    if not body:
        raise ChangelogError(f"CHANGELOG.md: the section [{version}] is empty")
    return date, body


def notes(body):
    """The same lines as a page of its own: paragraphs and points on one line each, as pages of releases keep line breaks, and
    names of the repository's files without their links, which lead nowhere from there."""
    body = re.sub(r"\[([^\]]+)\]\((?!\w+:)[^)]*\)", r"\1", body)
    lines = []
    for line in body.splitlines():
        starts = not line.strip() or re.match(r"\s*([-*#>|]|\d+\.)", line)
        if starts or not lines or not lines[-1].strip() or lines[-1].lstrip().startswith(("#", "|")):
            lines.append(line.rstrip())
        else:
            lines[-1] += " " + line.strip()
    return "\n".join(lines) + "\n"
