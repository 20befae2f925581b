"""The folder that ./dev web makes: what is in it, how large, how it is served, and what is said where something is wrong."""

import contextlib
import hashlib
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/web"))

import site_folder  # noqa: E402

SERVE = ROOT / "tools/web/serve.py"
# A browser loads these; the engine's .js loads the worklets by the names that they have.
FILES = ["index.html", "page.js", "page.css", "index.js", "index.wasm", "index.pck", "lobelight.svg", "demo.png"]
FILES += ["licences.txt", "index.audio.worklet.js", "index.audio.position.worklet.js"]


def pinned():
    """SHA-256 by file of the template, as the set-up takes them."""
    text = (ROOT / "tools/setup/web_template.txt").read_text(encoding="utf-8")
    return {name.split("/")[-1]: digest for digest, name in re.findall(r"^([0-9a-f]{64})  (\S+)$", text, re.MULTILINE)}


@contextlib.contextmanager
def served(folder, *options):
    """The folder at a free port; yields the server's process, the port, and a function from a path to (status, headers,
    body)."""
    command = [sys.executable, SERVE, folder, "0", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as server:
        port = int(re.match(r"http://localhost:(\d+)/", server.stdout.readline())[1])

        def get(path):
            connection = http.client.HTTPConnection("localhost", port, timeout=10)
            connection.request("GET", path)
            response = connection.getresponse()
            body = response.read()
            connection.close()
            return response.status, response.headers, body

        try:
            yield server, port, get
        finally:
            if server.poll() is None:
                server.kill()


class FolderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(sys.argv[1])
        cls.report = cls.folder.parent / "web.json"
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.built = subprocess.run(
            ["bash", ROOT / "tools/commands/web.sh", "--out", cls.folder, "--json", cls.report],
            stdout=subprocess.PIPE,
            text=True,
        )

    def test_the_command_ends_well_and_says_what_the_folder_weighs(self):
        self.assertEqual(0, self.built.returncode)
        self.assertRegex(self.built.stdout, r"(?m)^pack +\d+ +\d+$")

    def test_the_folder_has_what_a_browser_loads_and_nothing_else(self):
        self.assertEqual(sorted(FILES), sorted(file.name for file in self.folder.iterdir()))
        page = (self.folder / "index.html").read_text(encoding="utf-8")
        for name in re.findall(r'(?:src|href)="([^"#]+)"', page):
            self.assertIn(name, FILES)
        for word in ("http:", "https:", "//"):
            self.assertNotIn(word, page, "the page loads something of another host")

    def test_the_engine_is_the_pinned_one(self):
        for name in site_folder.TEMPLATE_FILES:
            digest = hashlib.sha256((self.folder / name).read_bytes()).hexdigest()
            self.assertEqual(pinned()[name], digest, name)

    def test_the_page_knows_how_many_bytes_come(self):
        page = (self.folder / "index.html").read_text(encoding="utf-8")
        sizes = json.loads(re.search(r'type="application/json">(.*?)</script>', page)[1])
        self.assertEqual({"index.wasm", "index.pck"}, set(sizes))
        for name, size in sizes.items():
            self.assertEqual((self.folder / name).stat().st_size, size)

    def test_the_page_says_what_a_browser_lacks(self):
        script = (self.folder / "page.js").read_text(encoding="utf-8")
        for word in ("WebAssembly", "WebGL 2", "EXT_color_buffer_float", "EXT_color_buffer_half_float", "JavaScript"):
            self.assertIn(word, script + (self.folder / "index.html").read_text(encoding="utf-8"))
        self.assertIn("touch-action: none", (self.folder / "page.css").read_text(encoding="utf-8"))

    def test_the_pack_is_small_and_every_file_has_a_reason(self):
        told = json.loads(self.report.read_text(encoding="utf-8"))
        self.assertEqual((self.folder / "index.pck").stat().st_size, told["pack"])
        self.assertLessEqual(told["pack"], 5_000_000)
        self.assertEqual(site_folder.MOST_PACK_BYTES, told["pack_limit"])
        for entry in told["pack_files"]:
            self.assertTrue(entry["why"], entry["path"])
        # The table of files and the padding between them are all that is not a file's.
        files = sum(entry["bytes"] for entry in told["pack_files"])
        self.assertLess(0, told["pack"] - files)
        self.assertLess(told["pack"] - files, 50_000)
        self.assertLess(told["pack_gzip"], told["pack"])

    def test_the_pack_has_the_demo_and_panoramas_for_pages(self):
        sizes = {entry["path"]: entry["bytes"] for entry in json.loads(self.report.read_text(encoding="utf-8"))["pack_files"]}
        for name in ("demo/demo.tscn", "demo/environments/sunset.exr", "addons/lobelight/tables/ggx_8.res"):
            self.assertIn(name, sizes)
        for name in ("demo/environments/sunset.exr", "demo/environments/hall.exr"):
            self.assertLess(sizes[name], 600_000)
        # Its meshes are built where it runs.
        self.assertLess(sizes["demo/demo.tscn"], 30_000)
        for unwanted in ("tests/", "tools/", "docs/", "demo/commands/", "demo/engine_light/", "addons/lobelight/editor/"):
            self.assertEqual([], [name for name in sizes if name.startswith(unwanted)])

    def test_the_licences_of_all_parts_are_there(self):
        text = (self.folder / "licences.txt").read_text(encoding="utf-8")
        for word in ("Lobelight contributors", "Godot Engine contributors", "FreeType", "zlib"):
            self.assertIn(word, text)

    def test_a_pack_too_large_is_refused_and_the_limit_named(self):
        most = site_folder.MOST_PACK_BYTES
        self.assertIn(f"{most + 1} bytes, but a page should load {most}", site_folder.judge({"pack": most + 1}))
        self.assertEqual("", site_folder.judge({"pack": most}))


class ServerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        for name in ("index.html", "index.wasm", "index.js", "index.pck"):
            (cls.folder / name).write_text(name, encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_types_are_those_that_browsers_ask_for(self):
        with served(self.folder) as (_server, _port, get):
            for path, kind in (("/", "text/html"), ("/index.wasm", "application/wasm"), ("/index.js", "text/javascript")):
                status, headers, body = get(path)
                self.assertEqual((200, kind), (status, headers.get_content_type()))
                self.assertEqual(path[1:] or "index.html", body.decode())
            self.assertEqual(404, get("/absent")[0])

    def test_cross_origin_headers_are_sent_where_they_are_asked_for(self):
        names = ("Cross-Origin-Opener-Policy", "Cross-Origin-Embedder-Policy")
        with served(self.folder) as (_server, _port, get):
            self.assertEqual([None, None], [get("/")[1][name] for name in names])
        with served(self.folder, "--isolated") as (_server, _port, get):
            self.assertEqual(["same-origin", "require-corp"], [get("/")[1][name] for name in names])

    def test_ctrl_c_ends_it_quietly(self):
        with served(self.folder) as (server, _port, _get):
            server.send_signal(signal.SIGINT)
            self.assertEqual(0, server.wait(timeout=10))
            self.assertEqual("", server.stderr.read())

    def test_a_port_that_is_taken_is_named(self):
        with served(self.folder) as (_server, port, _get):
            run = subprocess.run([sys.executable, SERVE, self.folder, str(port)], stderr=subprocess.PIPE, text=True)
            self.assertEqual(1, run.returncode)
            self.assertRegex(run.stderr, rf"^web: port {port} cannot be served: .+\n$")


class TemplateTest(unittest.TestCase):
    def test_another_package_than_the_pinned_one_is_refused(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "bin").mkdir()
            npm = folder / "bin/npm"
            npm.write_text('#!/bin/sh\ntar --create --gzip --file "${2%@*}-${2#*@}.tgz" --directory / --files-from /dev/null\n')
            npm.chmod(0o755)
            environment = dict(os.environ, PATH=f"{folder / 'bin'}:{os.environ['PATH']}", LOBELIGHT_CACHE=str(folder / "cache"))
            target = folder / "template"
            run = subprocess.run(
                ["bash", ROOT / "tools/setup/web_template.sh", target], env=environment, stderr=subprocess.PIPE, text=True
            )
            self.assertNotEqual(0, run.returncode)
            self.assertIn(".tgz: FAILED", run.stderr)
            self.assertFalse(target.exists())


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: web_test.py FOLDER, where the page is made")
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=1).result
    failed = len(result.failures) + len(result.errors)
    print(f"web: {result.testsRun - failed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
