#!/usr/bin/env python3
"""Puts the engine's Android template together from published packages, without Gradle and without an SDK.

build_template.py --packages DIR --app DIR --aapt2 PROGRAM --java HOME --work DIR --out android_release.apk

The engine's library for Android (an AAR with its Java classes and native libraries), the libraries that it needs, and
the app's own sources are what the official template is built from; aapt2 links the resources, D8 makes the bytecode.
Only arm64-v8a is in it. Manifests of the AndroidX libraries are not merged: what they register is not used here.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

PACKAGE = "com.godot.game"
ABI = "arm64-v8a"
# As the engine's own platform/android/java/app/config.gradle has them.
LEAST_SDK = "24"
TARGET_SDK = "36"
BUILD_CONFIG = f"""package {PACKAGE};
public final class BuildConfig {{
  public static final boolean DEBUG = false;
  public static final String APPLICATION_ID = "{PACKAGE}";
  public static final String BUILD_TYPE = "release";
  public static final String FLAVOR = "standard";
  public static final int VERSION_CODE = 1;
  public static final String VERSION_NAME = "1.0";
}}
"""
TIMESTAMP = (1980, 1, 1, 0, 0, 0)


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def one(folder, pattern):
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        sys.exit(f"build_template: {folder}/{pattern}: {len(found)} files, expected one")
    return found[0]


def unpack_libraries(packages, work):
    """Classes of every library below work/jars; returns the unpacked AARs, the engine's being the last."""
    jars = work / "jars"
    jars.mkdir(parents=True)
    tools = ("com.android.tools.r8-", "org.robolectric.android-all-")
    for jar in sorted(packages.glob("*.jar")):
        if not jar.name.startswith(tools):
            shutil.copy(jar, jars)
    folders = []
    for aar in sorted(packages.glob("*.aar"), key=lambda file: (file.name.startswith("org.godotengine"), file.name)):
        folder = work / "aar" / aar.stem
        with zipfile.ZipFile(aar) as archive:
            archive.extractall(folder)
        classes = [folder / "classes.jar", *sorted(folder.glob("libs/*.jar"))]
        for number, jar in enumerate(file for file in classes if file.is_file()):
            shutil.copy(jar, jars / f"{aar.stem}-{number}.jar")
        folders.append(folder)
    return folders


def write_manifest(app, engine, out):
    """The app's manifest with what Gradle would add: package, SDK levels, and the engine's own entries."""
    text = (app / "src/main/AndroidManifest.xml").read_text(encoding="utf-8")
    text = re.sub(r'\s+tools:\w+="[^"]*"', "", text)
    text = re.sub(r'xmlns:tools="[^"]*"', "", text, count=1)
    text = text.replace("<manifest ", f'<manifest package="{PACKAGE}" ', 1)
    text = re.sub(r'android:(name|targetActivity)="\.', rf'android:\1="{PACKAGE}.', text)
    sdk = f'<uses-sdk android:minSdkVersion="{LEAST_SDK}" android:targetSdkVersion="{TARGET_SDK}"/>'
    text = text.replace('android:installLocation="auto" >', f'android:installLocation="auto" >\n{sdk}', 1)
    library = (engine / "AndroidManifest.xml").read_text(encoding="utf-8")
    entries = re.search(r"<application>(.*)</application>", library, re.DOTALL).group(1)
    entries = entries.replace("${applicationId}", PACKAGE)
    factory = 'android:appComponentFactory="androidx.core.app.CoreComponentFactory" android:extractNativeLibs="true"'
    text = text.replace("<application\n", f"<application {factory}\n", 1)
    out.write_text(text.replace("</application>", f"{entries}</application>", 1), encoding="utf-8")


def link_resources(options, folders, work):
    """Compiles all resources and links them into work/base.apk, with R classes below work/generated."""
    compiled = []
    names = set()
    for folder in folders:
        manifest = (folder / "AndroidManifest.xml").read_text(encoding="utf-8")
        names.update(re.findall(r'package="([^"]+)"', manifest)[:1])
        if any((folder / "res").glob("*")):
            compiled.append(work / f"{folder.name}.zip")
            run(options.aapt2, "compile", "--dir", folder / "res", "-o", compiled[-1])
    # The app's own come last, so that they win.
    compiled.append(work / "app.zip")
    run(options.aapt2, "compile", "--dir", options.app / "res", "-o", compiled[-1])
    write_manifest(options.app, folders[-1], work / "AndroidManifest.xml")
    resources = [part for file in compiled for part in ("-R", file)]
    run(
        *[options.aapt2, "link", "-o", work / "base.apk", "-I", one(options.packages, "org.robolectric.android-all-*.jar")],
        *["--manifest", work / "AndroidManifest.xml", "--auto-add-overlay", "--java", work / "generated"],
        *["--min-sdk-version", LEAST_SDK, "--target-sdk-version", TARGET_SDK],
        *["--extra-packages", ":".join(sorted(names)), *resources],
    )


def compile_classes(options, work):
    """The app's sources and the R classes to bytecode, with all libraries, below work/dex."""
    config = work / "generated" / PACKAGE.replace(".", "/") / "BuildConfig.java"
    config.parent.mkdir(parents=True, exist_ok=True)
    config.write_text(BUILD_CONFIG, encoding="utf-8")
    android = one(options.packages, "org.robolectric.android-all-*.jar")
    jars = sorted((work / "jars").glob("*.jar"))
    sources = [*(work / "generated").rglob("*.java"), *(options.app / "src/main/java").rglob("*.java")]
    run(
        *[options.java / "bin/javac", "-nowarn", "--release", "17", "-d", work / "classes"],
        *["-cp", ":".join(map(str, [*jars, android])), *sorted(sources)],
    )
    run(options.java / "bin/jar", "--create", "--file", work / "app.jar", "-C", work / "classes", ".")
    (work / "dex").mkdir()
    r8 = one(options.packages, "com.android.tools.r8-*.jar")
    run(
        *[options.java / "bin/java", "-Xmx2g", "-cp", r8, "com.android.tools.r8.D8", "--release"],
        *["--min-api", LEAST_SDK, "--lib", android, "--output", work / "dex", work / "app.jar", *jars],
    )


def write_template(out, engine, work):
    """Adds bytecode and native libraries to the linked resources."""
    files = [(file.name, file) for file in sorted((work / "dex").glob("classes*.dex"))]
    files += [(f"lib/{ABI}/{file.name}", file) for file in sorted((engine / "jni" / ABI).glob("*.so"))]
    part = out.with_name(out.name + ".part")
    shutil.copy(work / "base.apk", part)
    with zipfile.ZipFile(part, "a", zipfile.ZIP_DEFLATED) as archive:
        for name, file in files:
            entry = zipfile.ZipInfo(name, TIMESTAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, file.read_bytes())
    part.replace(out)


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    for name in ("packages", "app", "aapt2", "java", "work", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    options = parser.parse_args()
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    folders = unpack_libraries(options.packages, options.work)
    print("[1/4] resources", flush=True)
    link_resources(options, folders, options.work)
    print("[2/4] classes", flush=True)
    compile_classes(options, options.work)
    print("[3/4] template", flush=True)
    write_template(options.out, folders[-1], options.work)
    shutil.rmtree(options.work)
    print("[4/4] done", flush=True)


if __name__ == "__main__":
    main()
