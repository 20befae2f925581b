"""Command lines in pages, ./dev NAME --option …, held against the commands that there are and what their help lists."""

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

LINE = re.compile(r"\./dev\b(?P<rest>(?:\\\n|[^\n])*)")
# Where a command line ends: another command, a comment, or prose.
END = re.compile(r"\s#|&&|;|\s\|\s|\)\s|…")
NAME = re.compile(r"^[a-z][a-z-]*$")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*|(?<![\w-])-[a-z](?![\w-])")
ALWAYS = {"--help", "-h"}
HELP_SECONDS = 120


class Commands:
    """The commands of ./dev in the repository at `root`."""

    def __init__(self, root: Path):
        self.root = root
        self._help: dict[tuple[str, ...], str] = {}

    @staticmethod
    def lines(code: str) -> Iterator[tuple[int, str]]:
        """Where each call begins, and its arguments."""
        for match in LINE.finditer(code):
            rest = match["rest"].replace("\\\n", " ")
            yield match.start(), END.split(rest)[0]

    def problems(self, line: str) -> list[str]:
        words = line.split()
        # "./dev" by itself, or "./dev NAME".
        if not words or words[0].isupper():
            return []
        name = words[0].strip("`.,")
        if name in ("help", *ALWAYS):
            return []
        if not NAME.match(name) or not (self.root / f"tools/commands/{name}.sh").is_file():
            return [f"./dev {name}: there is no such command"]
        call = [name]
        # ./dev bench runtime: a part with a help of its own.
        if len(words) > 1 and NAME.match(words[1]) and (self.root / f"tools/{name}/{words[1]}.sh").is_file():
            call.append(words[1])
        shown = self.help(tuple(call))
        listed = set(OPTION.findall(shown)) | ALWAYS
        found = [
            f"./dev {' '.join(call)} has no option {option}, as its help has it"
            for option in dict.fromkeys(OPTION.findall(line))
            if option not in listed
        ]
        if name == "test":
            line_of_groups = re.search(r"^Groups, all of them if none is named: (.+)$", shown, re.MULTILINE)
            groups = set(line_of_groups[1].split()) if line_of_groups else set()
            # What follows an option is its value.
            pairs = zip(words, words[1:])
            named = (word for before, word in pairs if NAME.match(word) and not before.startswith("--"))
            found += [f"./dev test has no group {word}" for word in named if word not in groups]
        return found

    def help(self, call: tuple[str, ...]) -> str:
        """What the command says of itself; nothing where it does not."""
        if call not in self._help:
            try:
                done = subprocess.run(
                    [self.root / "dev", *call, "--help"], capture_output=True, text=True, timeout=HELP_SECONDS, check=False
                )
                self._help[call] = done.stdout if done.returncode == 0 else ""
            except subprocess.TimeoutExpired:
                self._help[call] = ""
        return self._help[call]
