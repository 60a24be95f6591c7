"""The documents: links lead somewhere, named files exist, examples are what the program reads and writes.

The program is $STILB, or build/release/stilb.
"""

import json
import os
import re
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("STILB", ROOT / "build/release/stilb"))
MADE = {"build", "out"}  # not documents, and not to be found before they are made

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
SOURCE = r"(?<![\w/.*-])((?:[\w-]+/)*[\w-]+\.(?:h|cpp|ts|mjs|css|cmake))\b"
COMMENT = re.compile(r"//.*")
NAMED_PATH = re.compile(r"`((?:src|tests|docs|scenes|scripts|fuzz|benchmarks)/[\w./*-]*)`")


def pages():
    return [page for page in sorted(ROOT.rglob("*.md")) if not MADE & set(page.relative_to(ROOT).parts)]


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def prose(page):
    return re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    """As GitHub makes them of headings."""
    titles = re.findall(r"^#+ +(.*)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def keys(document, path=""):
    """The paths of all keys; lists count as their elements."""
    if isinstance(document, list):
        return set().union(*(keys(element, path) for element in document))
    if not isinstance(document, dict):
        return set()
    return set().union(*({f"{path}.{key}"} | keys(value, f"{path}.{key}") for key, value in document.items()))


class LinkTest(unittest.TestCase):
    def test_the_pages_are_found(self):
        self.assertTrue({ROOT / "README.md", ROOT / "docs/README.md", ROOT / "docs/methods/auto.md"} <= set(pages()))

    def test_links_lead_somewhere(self):
        for page in pages():
            for link in LINK.findall(prose(page)):
                if re.match(r"[a-z]+:", link):
                    continue
                with self.subTest(page=page.relative_to(ROOT), link=link):
                    file, _, anchor = link.partition("#")
                    target = (page.parent / file).resolve() if file else page
                    self.assertTrue(target.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(target))

    def test_every_document_is_linked_from_the_index(self):
        index = ROOT / "docs/README.md"
        linked = {(index.parent / link.partition("#")[0]).resolve() for link in LINK.findall(prose(index))}
        self.assertEqual({page for page in pages() if page.is_relative_to(index.parent)} - linked, {index})

    def test_named_files_exist(self):
        for page in pages():
            for name in NAMED_PATH.findall(prose(page)):
                if "NAME" in name:  # stands for any
                    continue
                with self.subTest(page=page.relative_to(ROOT), name=name):
                    self.assertTrue(any(ROOT.glob(name.rstrip("/"))))


class SourcesTest(unittest.TestCase):
    """Source files that documents and comments name."""

    FOLDERS = ("src", "include", "tests", "benchmarks", "experiments", "fuzz", "examples", "python", "web", "cmake")
    # Of other programs, or made by commands.
    FOREIGN = {"base/bxdf.h", "base/camera.h", "base/film.h", "base/light.h", "base/material.h", "bxdfs.cpp", "bxdfs.h",
               "cameras.cpp", "cameras.h", "cpu/integrators.cpp", "cpu/integrators.h", "emitter.h", "film.cpp", "film.h",
               "wavefront/integrator.cpp"}

    @classmethod
    def setUpClass(cls):
        cls.files = {file.relative_to(ROOT).as_posix() for folder in cls.FOLDERS for file in (ROOT / folder).rglob("*.*")}
        # The ends of their paths, from "name.h" on.
        cls.ends = {"/".join(parts[i:]) for parts in (file.split("/") for file in cls.files) for i in range(len(parts))}

    def require_known(self, text, place):
        for name in re.findall(SOURCE, text):
            is_placeholder = Path(name).name.partition(".")[0].isupper() or "NAME" in name
            if not is_placeholder and name not in self.FOREIGN:
                with self.subTest(place=place, name=name):
                    self.assertTrue(name in self.ends, "there is no such file")

    def test_documents(self):
        for page in pages():
            if page.name != "CHANGELOG.md":  # tells of what was
                for span in re.findall(r"`[^`\n]+`", prose(page)):
                    self.require_known(span, page.relative_to(ROOT))

    def test_comments(self):
        comments = 0
        for file in self.files:
            if Path(file).suffix in (".h", ".cpp", ".ts", ".mjs") and not MADE & set(Path(file).parts):
                for comment in COMMENT.findall((ROOT / file).read_text()):
                    comments += 1
                    self.require_known(comment, file)
        self.assertGreater(comments, 5000, "the comments are found")


@unittest.skipUnless(PROGRAM.exists(), f"{PROGRAM} is not built")
class ExampleTest(unittest.TestCase):
    def stilb(self, *arguments):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_scenes_are_read_without_warnings(self):
        """The first example of a page is a scene; the others are additions to it."""
        for page in ("README.md", "docs/scene-format.md"):
            scene, *additions = blocks(ROOT / page, "toml")
            for addition in ["", *additions]:
                with self.subTest(page=page, addition=addition), tempfile.TemporaryDirectory() as folder:
                    file = Path(folder) / "room.toml"
                    file.write_text(scene + addition)
                    self.assertEqual(self.stilb("info", file, "--json")["warnings"], [])

    def test_the_options_of_runs_are_those_of_the_program(self):
        """Documented, taken from the scene file, and flags with the same names."""
        section = (ROOT / "docs/scene-format.md").read_text().split("## `[run]`")[1]
        documented = re.findall(r"^\| `(\w+)` \|", section.split("Without `error`")[0], re.MULTILINE)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "room.toml"
            file.write_text("[run]\nnothing = 1\n")
            refusal = subprocess.run([PROGRAM, "info", file], capture_output=True, text=True).stderr
        self.assertEqual(re.findall(r"\w+", refusal.split("Allowed: ")[1]), documented)
        text = "".join(subprocess.run([PROGRAM, *words], capture_output=True, text=True).stdout
                       for words in (["measure", "--help"], ["help", "patches"]))
        for key in documented:
            if key != "maintenance":
                self.assertIn(f"  --{key.replace('_', '-')} ", text)

    def test_the_readme_shows_the_simple_room(self):
        (scene,) = blocks(ROOT / "README.md", "toml")
        self.assertEqual(tomllib.loads(scene), tomllib.loads((ROOT / "scenes/simple/room.toml").read_text()))

    def test_the_page_of_the_json_has_its_keys(self):
        example, patches = blocks(ROOT / "docs/json.md", "json")
        room = ROOT / "scenes/simple/room.toml"
        result = self.stilb("measure", room, "--json", "--paths", 64)
        self.assertEqual(keys(json.loads(example)), keys(result))
        result = self.stilb("measure", room, "--json", "--method", "ray-bundle", "--patch", 1, "--paths", 64)
        self.assertEqual(keys(json.loads(patches)), keys(result["patches"]))


class LibraryTest(unittest.TestCase):
    def test_the_example_is_the_one_that_is_built(self):
        page, example = ROOT / "docs/library.md", ROOT / "examples/library"
        self.assertEqual(blocks(page, "cpp"), [(example / "main.cpp").read_text()])
        self.assertEqual(blocks(page, "cmake"), [(example / "CMakeLists.txt").read_text()])


if __name__ == "__main__":
    unittest.main()
