#!/usr/bin/env python3
"""Serves a folder on this machine: serve.py FOLDER [PORT] [--isolated]."""

import argparse
import contextlib
import functools
import http.server
import signal
import sys

# The engine without threads needs none of these; some hosts send them all the same.
ISOLATION = {"Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp"}


class Handler(http.server.SimpleHTTPRequestHandler):
    # Without its type, browsers do not compile WebAssembly as it comes in.
    extensions_map = {
        **http.server.SimpleHTTPRequestHandler.extensions_map,
        ".wasm": "application/wasm",
        ".js": "text/javascript",
        ".pck": "application/octet-stream",
        ".svg": "image/svg+xml",
    }
    isolated = False

    def end_headers(self):
        if self.isolated:
            for name, value in ISOLATION.items():
                self.send_header(name, value)
        # A folder that is built anew is to be seen.
        self.send_header("Cache-Control", "no-cache")
        super().end_headers()

    def copyfile(self, source, outputfile):
        # A browser may turn to another page before it has all of this one.
        with contextlib.suppress(ConnectionError):
            super().copyfile(source, outputfile)

    def log_message(self, *_arguments):
        pass


def main():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("folder")
    parser.add_argument("port", type=int, nargs="?", default=8060)
    parser.add_argument("--isolated", action="store_true")
    options = parser.parse_args()
    Handler.isolated = options.isolated
    handler = functools.partial(Handler, directory=options.folder)
    # Shells have what they start in the background ignore it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with http.server.ThreadingHTTPServer(("127.0.0.1", options.port), handler) as server:
            print(f"http://localhost:{server.server_address[1]}/ (Ctrl-C ends)", flush=True)
            server.serve_forever()
    except KeyboardInterrupt:
        print()
    except OSError as error:
        sys.exit(f"web: port {options.port} cannot be served: {error.strerror}")


if __name__ == "__main__":
    main()
