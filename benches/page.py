#!/usr/bin/env python3
"""Times the pages in Chromium: `python3 benches/page.py SITE [DATABASE]`, SITE as site/build.py makes it.

The verdict of graph.html from a server that compresses, at 10 Mbit/s and 20 ms; and the overview of a database, which
benches/database.py can write, from the disk. Seconds, the median of five loads and one overview."""

import functools
import http.server
import pathlib
import statistics
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "site"))
from chromium import Chromium  # noqa: E402


class Compressed(http.server.SimpleHTTPRequestHandler):
    """Sends the compressed copy of a file where there is one, in one piece."""

    protocol_version, wbufsize, disable_nagle_algorithm = "HTTP/1.1", 1 << 22, True
    log_message = lambda *_: None

    def do_GET(self):
        path = pathlib.Path(self.translate_path(self.path))
        copies = [(path.with_name(path.name + ending), name) for ending, name in ((".br", "br"), (".gz", "gzip"), ("", "identity"))]
        copy, encoding = next((one for one in copies if one[0].exists()), (None, None))
        content = copy.read_bytes() if copy else b""
        self.send_response(200 if copy else 404)
        if copy:
            self.send_header("Content-Encoding", encoding)
            self.send_header("Content-Type", self.guess_type(path))
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)


def verdict(address):
    browser = Chromium()
    browser.call("Network.setCacheDisabled", cacheDisabled=True)
    browser.call("Network.emulateNetworkConditions", offline=False, latency=20, downloadThroughput=10e6 / 8, uploadThroughput=10e6 / 8)
    begin = time.monotonic()
    browser.call("Page.navigate", url=f"{address}/graph.html#DFw")
    browser.wait("document.querySelector('#verdict .badge')?.textContent")
    browser.process.kill()
    return time.monotonic() - begin


def overview(site, database):
    browser = Chromium()
    browser.open(site / "photographs.html")
    page = browser.call("DOM.getDocument")["root"]["nodeId"]
    field = browser.call("DOM.querySelector", nodeId=page, selector="#files")["nodeId"]
    browser.call("DOM.setFileInputFiles", nodeId=field, files=[str(database)])
    told = browser.wait("document.getElementById('told').dataset.done && document.getElementById('status').textContent", 300)
    browser.process.kill()
    return told


def main(site, database=None):
    site = pathlib.Path(site).resolve()
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Compressed, directory=site)) as server:
        server.handle_error = lambda *_: None  # A browser that is closed breaks its connection.
        threading.Thread(target=server.serve_forever, daemon=True).start()
        times = [verdict(f"http://127.0.0.1:{server.server_port}") for _ in range(5)]
        print(f"verdict: {statistics.median(times):.2f} s")
        server.shutdown()
    if database:
        print(f"overview: {overview(site, pathlib.Path(database).resolve())}")


main(*sys.argv[1:])
