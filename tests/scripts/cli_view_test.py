"""stilb view: the server from outside, hostile requests, Ctrl-C, and the page in one file."""

import base64
import gzip
import http.client
import json
import os
import random
import re
import signal
import socket
import struct
import subprocess
import threading
import time
import unittest
from html.parser import HTMLParser
from urllib.parse import urlsplit

from command_line import MOST_SECONDS, PROGRAM, ROOM, CommandLineTest, run


def header_of(container):
    """The JSON header of a container, docs/walk.md."""
    content = gzip.decompress(container)
    magic, version, length = struct.unpack_from("<8sII", content)
    assert (magic, version) == (b"STILBWLK", 1), content[:16]
    return json.loads(content[16:16 + length])


def with_body(solution, body):
    """The solution file with another body and the right size and hash: docs/solution.md."""
    hash_of_body = 0xcbf29ce484222325
    for byte in body:
        hash_of_body = (hash_of_body ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    return solution[:12] + struct.pack("<QQ", 28 + len(body), hash_of_body) + body


class Walk:
    """A running `stilb view`."""

    def __init__(self, *arguments, **options):
        self.process = subprocess.Popen([PROGRAM, "view", *map(str, arguments)], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, **options)
        self.address = self.process.stdout.readline().strip()
        self.hint = self.process.stdout.readline()
        parts = urlsplit(self.address)
        self.host, self.port, self.path = parts.hostname, parts.port, parts.path

    def ask(self, method, path, body=None, headers=None, host=None):
        """Status, headers and body of the answer to a request below the token."""
        connection = http.client.HTTPConnection(self.host, self.port, timeout=MOST_SECONDS)
        connection.putrequest(method, path if path.startswith("/") else self.path + path, skip_host=True,
                              skip_accept_encoding=True)
        connection.putheader("Host", host or f"{self.host}:{self.port}")
        for name, value in (headers or {}).items():
            connection.putheader(name, value)
        if body is not None:
            connection.putheader("Content-Length", len(body))
        connection.endheaders()
        try:
            if body is not None:
                connection.send(body)
        except (BrokenPipeError, ConnectionResetError):
            pass  # refused before it was sent
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer.status, dict(answer.getheaders()), content

    def get(self, path):
        status, _, content = self.ask("GET", path)
        assert status == 200, (path, status, content)
        return content

    def post(self, path, request):
        text = request if isinstance(request, bytes) else json.dumps(request).encode()
        status, _, content = self.ask("POST", path, text, {"Content-Type": "application/json"})
        return status, json.loads(content)

    def state(self):
        return json.loads(self.get("state"))

    def wait_for(self, condition):
        deadline = time.monotonic() + MOST_SECONDS
        while time.monotonic() < deadline:
            state = self.state()
            if condition(state):
                return state
            time.sleep(0.05)
        raise AssertionError(state)

    def end(self):
        """Ctrl-C: exit code, stdout, stderr and seconds."""
        begin = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=MOST_SECONDS)
        return self.process.returncode, out, err, time.monotonic() - begin

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


class References(HTMLParser):
    """What a page refers to."""

    def __init__(self, page):
        super().__init__()
        self.found, self.scripts = [], []
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.found += [value for name, value in attributes.items() if name in ("src", "href", "action", "data")]
        if tag == "script":
            self.scripts.append(attributes)


class ViewTest(CommandLineTest):
    def view(self, *arguments, **options):
        walk = Walk(*arguments, "--no-browser", **options)
        self.addCleanup(walk.close)
        self.assertRegex(walk.address, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$", walk.process.poll())
        return walk

    def finished(self, *arguments):
        walk = self.view(self.scene, "--patch", "1", "--paths", "64", *arguments)
        walk.wait_for(lambda state: state["done"])
        return walk

    def test_the_page_and_its_data(self):
        walk = self.finished()
        state = walk.state()
        self.assertEqual(set(state), {"stage", "share", "scene", "light", "error", "elapsed_s", "done", "message"})
        self.assertEqual((state["stage"], state["share"], state["scene"], state["done"]), ("done", 1, True, True))
        self.assertGreater(state["light"], 0)
        scene, light = header_of(walk.get("scene")), header_of(walk.get("light"))
        self.assertEqual((scene["name"], scene["file"]), ("A room", "room.toml"))
        self.assertEqual([group["name"] for group in scene["groups"]], ["bulb"])
        self.assertEqual((light["version"], light["done"]), (state["light"], True))
        self.assertIn("terms", light["arrays"])
        page = walk.get("").decode()
        self.assertIn('<script type="module" src="./page.js"></script>', page)
        self.assertTrue(all("src" in script for script in References(page).scripts))
        self.assertTrue(walk.get("page.js"))
        self.assertTrue(walk.get("page.css"))
        code, out, _, seconds = walk.end()
        self.assertEqual(code, 0)
        self.assertIn("64 steps", out)
        self.assertLess(seconds, 1)

    def test_a_scene_without_lamps_is_lit_for_a_first_look(self):
        dark = self.write("dark.toml", ROOM[: ROOM.index("[lights.")] + ROOM[ROOM.index("[sensors."):])
        walk = self.view(dark, "--patch", "1", "--paths", "64")
        walk.wait_for(lambda state: state["done"])
        scene, light = header_of(walk.get("scene")), header_of(walk.get("light"))
        self.assertEqual([group["name"] for group in scene["groups"]], ["first look: rooms", "first look: outside"])
        self.assertEqual([light["name"] for light in scene["lights"]], ["bulb 1", "bulb outside", "sky"])
        self.assertEqual([camera["name"] for camera in scene["cameras"]], ["preview"])
        self.assertTrue(light["done"])
        # The wall above the cabinet sees the bulb.
        wall = {"kind": "illuminance", "position": [4, 1.5, 1.2], "normal": [-1, 0, 0]}
        status, answer = walk.post("measure", wall)
        self.assertEqual(status, 200, answer)
        self.assertGreater(answer["value"], 10)
        code, _, messages, _ = walk.end()
        self.assertEqual(code, 0)
        self.assertRegex(messages, r"^warning: the scene has no light: for a first look, a bulb in each room[^\n]*\n$")
        self.expect_wrong_input(["view", dark, "-o", self.folder / "dark.solution"], "no solution to keep")

    def test_light_is_refined_until_ctrl_c(self):
        walk = self.view(self.scene, "--patch", "1")
        first = walk.wait_for(lambda state: state["light"] > 0)
        walk.wait_for(lambda state: state["light"] > first["light"])
        self.assertFalse(walk.state()["done"])
        code, out, _, seconds = walk.end()
        self.assertEqual(code, 3)
        self.assertIn("interrupted", out)
        self.assertIn("-o FILE.solution", walk.hint)
        self.assertLess(seconds, 1)

    def test_the_solution_is_kept_at_ctrl_c(self):
        solution = self.folder / "room.solution"
        walk = self.view(self.scene, "--patch", "1", "-o", solution)
        walk.wait_for(lambda state: state["light"] > 0)
        code, out, _, _ = walk.end()
        self.assertEqual(code, 3)
        self.assertIn("room.solution: the solution", out)
        again = self.view(solution)
        again.wait_for(lambda state: state["done"])
        self.assertIn("terms", header_of(again.get("light"))["arrays"])
        self.assertEqual(again.end()[0], 0)

    def test_measure_here(self):
        walk = self.finished()
        desk = {"kind": "illuminance", "position": [3, 1.5, 0.75], "normal": [0, 0, 1]}
        status, full = walk.post("measure", desk)
        self.assertEqual(status, 200, full)
        self.assertEqual((full["unit"], full["method"]), ("lx", "auto"))
        self.assertLess(full["half_width"], 0.02 * full["value"])
        status, dim = walk.post("measure", {**desk, "factors": {"bulb": 0.25}})
        self.assertAlmostEqual(dim["value"], full["value"] / 4, delta=full["half_width"])
        status, sight = walk.post("measure", {"kind": "luminance", "position": [3, 1, 1], "direction": [0, 1, 0]})
        self.assertEqual((status, sight["unit"]), (200, "cd/m2"))
        self.assertGreater(sight["value"], 0)
        for wrong, part in ((b"", "JSON"), (b"{", "JSON"), (b"[]", "object"), (b"\xff\xfe", "JSON"), ({}, "kind"),
                            ({**desk, "normal": [0, 0, 0]}, "normal"), ({**desk, "normal": [0, 0]}, "normal"),
                            ({**desk, "position": [1, None, 1]}, "position"),
                            (json.dumps(desk).replace("0.75", "1e999").encode(), "JSON"),
                            (json.dumps({**desk, "position": [1, float("nan"), 1]}).encode(), "JSON"),
                            ({**desk, "factors": {"lamp": 1}}, "lamp"), ({**desk, "factors": {"bulb": -1}}, "bulb"),
                            ({**desk, "more": 1}, "more")):
            status, answer = walk.post("measure", wrong)
            self.assertEqual(status, 400, (wrong, answer))
            self.assertIn(part, answer["error"])

    def test_measuring_does_not_delay_ctrl_c(self):
        walk = self.finished()
        dark = {"kind": "illuminance", "position": [0.5, 0.5, 0.5], "normal": [0, 0, 1]}  # inside the cabinet

        def measure():
            try:
                walk.post("measure", dark)
            except (OSError, http.client.HTTPException):
                pass  # the server has ended

        threads = [threading.Thread(target=measure) for _ in range(4)]
        for thread in threads:
            thread.start()
        time.sleep(0.2)
        code, _, _, seconds = walk.end()
        self.assertEqual(code, 0)
        self.assertLess(seconds, 1)
        for thread in threads:
            thread.join()

    def test_placed_sensors(self):
        walk = self.finished()
        placed = {"name": "desk", "type": "illuminance", "position": [1, 2, 0.75], "normal": [0, 0, 1]}
        status, first = walk.post("sensors", {"sensors": [placed, {**placed, "name": "left"}]})
        self.assertEqual((status, first["saved"]), (200, "room-sensors.toml"), first)
        self.assertEqual(walk.post("sensors", {"sensors": [placed]})[1]["saved"], "room-sensors-2.toml")
        self.scene.write_text(ROOM + first["toml"])  # "desk" is taken
        result = run("measure", self.scene, "--json", "--paths", "8192", "--sensor", "desk_2", "--sensor", "left")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("[sensors.left]", (self.folder / "room-sensors.toml").read_text())
        for wrong in ({}, {"sensors": []}, {"sensors": [{**placed, "name": "../x"}]}, {"sensors": [{**placed, "type": "x"}]}):
            self.assertEqual(walk.post("sensors", wrong)[0], 400)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["room-sensors-2.toml", "room-sensors.toml", "room.toml"])

    def test_hostile_requests(self):
        walk = self.finished()
        token = walk.path.strip("/")
        wrong = token[:-1] + ("0" if token[-1] != "0" else "1")
        for path in ("/", "/scene", "/" + token, f"/{wrong}/", f"/{wrong}/scene", walk.path + "../scene",
                     walk.path + "..%2f..%2fetc/passwd", walk.path + "page.html", "/etc/passwd", "//"):
            status, headers, body = walk.ask("GET", path)
            self.assertEqual(status, 404, path)
            self.assertNotIn(token.encode(), body)
            self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        for host in ("evil.example", f"evil.example:{walk.port}", "127.0.0.1", f"127.0.0.1.evil.example:{walk.port}"):
            self.assertEqual(walk.ask("GET", "", host=host)[0], 403, host)
        self.assertEqual(walk.ask("GET", "state", host=f"localhost:{walk.port}")[0], 200)
        self.assertEqual(walk.ask("GET", "state", headers={"Origin": "http://evil.example"})[0], 403)
        large = b"x" * (64 * 1024 + 1)
        self.assertEqual(walk.ask("POST", "measure", large, {"Content-Type": "application/json"})[0], 413)
        self.assertEqual(walk.ask("POST", "measure", b"{}", {"Content-Type": "text/plain"})[0], 415)
        self.assertEqual(walk.ask("POST", "scene", b"{}", {"Content-Type": "application/json"})[0], 405)
        self.assertEqual(walk.ask("DELETE", "scene")[0], 405)
        headers = walk.ask("GET", "")[1]
        self.assertEqual((headers["X-Content-Type-Options"], headers["Cache-Control"], headers["Referrer-Policy"]),
                         ("nosniff", "no-store", "no-referrer"))
        self.assertIn("script-src 'self'", headers["Content-Security-Policy"])
        self.assertNotIn("unsafe", headers["Content-Security-Policy"])

    def test_slow_and_vanished_clients(self):
        walk = self.view(self.scene, "--patch", "1")
        slow = [socket.create_connection((walk.host, walk.port)) for _ in range(20)]
        for connection in slow:
            connection.sendall(b"GET / HT")
        for _ in range(20):
            with socket.create_connection((walk.host, walk.port)) as connection:
                connection.sendall(f"GET {walk.path}page.js HTTP/1.1\r\nHost: {walk.host}:{walk.port}\r\n\r\n".encode())
        begin = time.monotonic()
        first = walk.state()
        self.assertLess(time.monotonic() - begin, 1)
        walk.wait_for(lambda state: state["light"] > first["light"])
        self.assertLess(walk.end()[3], 1)
        for connection in slow:
            connection.close()

    def test_not_reached_from_elsewhere(self):
        walk = self.finished()
        for address in {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)} | {"127.0.0.2"}:
            if address == "127.0.0.1":
                continue
            with self.assertRaises(OSError):
                socket.create_connection((address, walk.port), timeout=5)

    def test_a_port_of_ones_own(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        walk = self.view(self.scene, "--patch", "1", "--port", port)
        self.assertEqual(walk.port, port)
        self.expect_wrong_input(["view", self.scene, "--no-browser", "--port", port], str(port), "in use", "another port")
        self.assertEqual(walk.state()["message"], "")
        for wrong in ("-1", "65536", "x"):
            self.expect_wrong_input(["view", self.scene, "--port", wrong], "--port")

    def test_the_browser_is_opened_without_a_shell(self):
        opened = self.folder / "opened"
        program = self.write("xdg-open", f'#!/bin/sh\necho "$#" "$1" > "{opened}"\nsleep 20\n')
        program.chmod(0o755)
        environment = {**os.environ, "DISPLAY": ":99", "PATH": f"{self.folder}:{os.environ['PATH']}"}
        walk = Walk(self.scene, "--patch", "1", env=environment)
        self.addCleanup(walk.close)
        deadline = time.monotonic() + 10
        while not (opened.exists() and opened.read_text()) and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual(opened.read_text(), f"1 {walk.address}\n")
        self.assertLess(walk.end()[3], 1)  # it does not wait for the browser
        program.unlink()
        for without in ({**environment, "DISPLAY": "", "WAYLAND_DISPLAY": ""}, environment):
            quiet = Walk(self.scene, "--patch", "1", env=without)
            self.addCleanup(quiet.close)
            quiet.wait_for(lambda state: state["light"] > 0)
            self.assertNotIn("xdg-open", quiet.end()[2])

    def test_one_file(self):
        page = self.folder / "walk.html"
        for source in ((self.scene, "--patch", "1", "--paths", "64"), ("room.solution",)):
            if source[0] == "room.solution":
                result = run("solve", self.scene, "--patch", "1", "--paths", "64", "-o", self.folder / "room.solution")
                self.assertEqual(result.returncode, 0, result.stderr)
            result = run("view", *source, "-o", page, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("walk.html: ", result.stdout)
            self.assertNotIn("http://", result.stdout)
            text = page.read_text()
            references = References(text)
            self.assertEqual([found for found in references.found if not found.startswith(("#", "data:"))], [])
            self.assertIn("default-src 'none'", text)
            found = dict(re.findall(r'<script type="application/octet-stream" id="(stilb-\w+)">([^<]*)</script>', text))
            self.assertEqual(set(found), {"stilb-scene", "stilb-light"})
            self.assertEqual(header_of(base64.b64decode(found["stilb-scene"]))["name"], "A room")
            self.assertTrue(header_of(base64.b64decode(found["stilb-light"]))["done"])
        self.assertIn("a page to walk through", run("info", page).stderr)

    def test_hostile_solutions(self):
        solution, bad = self.folder / "room.solution", self.folder / "bad.solution"
        run("solve", self.scene, "--patch", "1", "--paths", "16", "-o", solution)
        content = solution.read_bytes()
        numbers = random.Random(5)
        for _ in range(12):
            body = bytearray(content[28:])
            for value in (struct.pack("<f", numbers.choice((1e30, -1e30, 3e38, 0))), struct.pack("<I", 0xffffffff)):
                offset = 4 * numbers.randrange(40, len(body) // 4)
                body[offset:offset + 4] = value
            bad.write_bytes(with_body(content, bytes(body)))
            result = run("view", bad, "-o", self.folder / "walk.html")
            self.assertIn(result.returncode, (0, 2), result)
            self.assertEqual(result.returncode == 2, result.stderr.startswith("stilb: "))

    def test_no_file_is_lost(self):
        before = self.scene.read_text()
        self.expect_wrong_input(["view", self.scene, "-o", self.scene], "read to compute it")
        mine = self.write("mine.html", "<!doctype html>\n<head>\n<title>Mine</title>\n")
        self.expect_wrong_input(["view", self.scene, "-o", mine], "mine.html", "another kind")
        self.expect_wrong_input(["view", self.scene, "-o", mine.rename(self.folder / "mine.solution")], "another kind")
        self.expect_wrong_input(["view", self.scene, "-o", self.folder / "none/walk.html"], "there is no folder")
        self.expect_wrong_input(["view", self.scene, "-o", "-"], ".html or .solution")
        self.assertEqual(self.scene.read_text(), before)

    def test_what_makes_no_sense(self):
        page = self.folder / "walk.html"
        self.expect_wrong_input(["view", self.scene, "-o", page, "--port", "8000"], "--port", "no effect")
        self.expect_wrong_input(["view", self.scene, "-o", page, "--no-browser"], "--no-browser", "no effect")
        solution = self.folder / "room.solution"
        run("solve", self.scene, "--patch", "1", "--paths", "64", "-o", solution)
        for flags in (["--patch", "1"], ["--degree", "3"], ["--error", "1%"], ["--seed", "2"]):
            self.expect_wrong_input(["view", solution, *flags], flags[0], "no effect")
        self.expect_wrong_input(["view", solution, "-o", self.folder / "other.solution"], "already")
        self.scene.write_text(self.scene.read_text().replace("flux = 1000", "flux = 1001"))
        self.expect_wrong_input(["view", solution], "changed since the scene was solved")
        self.scene.unlink()
        self.expect_wrong_input(["view", solution], "room.toml", "was not found")
        self.expect_wrong_input(["view", self.folder / "none.toml"], "none.toml")
        damaged = self.write("damaged.solution", "")
        damaged.write_bytes(solution.read_bytes()[:-1])
        self.expect_wrong_input(["view", damaged], "damaged.solution", "cut off")


if __name__ == "__main__":
    unittest.main()
