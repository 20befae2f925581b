#!/usr/bin/env python3
"""Fetches the packages of artefacts.txt with Maven, as its settings have it, and compares their checksums.

fetch_artefacts.py DIRECTORY. LOBELIGHT_MAVEN_SETTINGS names another settings.xml, with a mirror for instance.
"""

import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

LIST = pathlib.Path(__file__).with_name("artefacts.txt")
PLUGIN = ("org.apache.maven.plugins", "maven-dependency-plugin", "3.8.1")


def read_list():
    """Pairs of a SHA-256 and (group, artefact, version, type)."""
    lines = [line.split() for line in LIST.read_text(encoding="utf-8").splitlines()]
    return [(digest, tuple(name.split(":"))) for digest, name in lines]


def file_name(artefact):
    group, name, version, kind = artefact
    return f"{group}.{name}-{version}.{kind}"


def project(artefacts, target):
    """A pom.xml whose dependency:copy puts the artefacts, and nothing that they depend on, into target."""

    def coordinates(parts):
        names = ("groupId", "artifactId", "version", "type")
        return "".join(f"<{name}>{part}</{name}>" for name, part in zip(names, parts))

    items = "".join(f"<artifactItem>{coordinates(artefact)}</artifactItem>" for artefact in artefacts)
    configuration = f"<outputDirectory>{target}</outputDirectory><prependGroupId>true</prependGroupId>"
    return (
        "<project><modelVersion>4.0.0</modelVersion>"
        f"{coordinates(('lobelight', 'artefacts', '1'))}<packaging>pom</packaging><build><plugins><plugin>"
        f"{coordinates(PLUGIN)}<configuration>{configuration}<artifactItems>{items}</artifactItems></configuration>"
        "</plugin></plugins></build></project>"
    )


def main():
    target = pathlib.Path(sys.argv[1]).resolve()
    wanted = read_list()
    settings = os.environ.get("LOBELIGHT_MAVEN_SETTINGS")
    with tempfile.TemporaryDirectory() as folder:
        pom = pathlib.Path(folder, "pom.xml")
        pom.write_text(project([artefact for _digest, artefact in wanted], target), encoding="utf-8")
        command = ["mvn", "--batch-mode", "--file", pom, f"-Dmaven.repo.local={folder}/repository"]
        command += ["--settings", settings] if settings else []
        subprocess.run([*command, ":".join(PLUGIN) + ":copy"], check=True)
    for digest, artefact in wanted:
        file = target / file_name(artefact)
        if hashlib.sha256(file.read_bytes()).hexdigest() != digest:
            shutil.rmtree(target)
            sys.exit(f"fetch_artefacts: {':'.join(artefact)}: not the file whose SHA-256 is {digest}")


if __name__ == "__main__":
    main()
