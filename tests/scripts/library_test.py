"""The installed library: the example of docs/library.md is built against it and run, and other projects can include
Stilb without its flags."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("STILB", PROJECT / "build/release/stilb")).resolve()
EXAMPLE = PROJECT / "examples/library"


def run(*command, **options):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if result.returncode:
        raise AssertionError(f"{command}\n{result.stdout}\n{result.stderr}")
    return result.stdout


class InstalledPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.prefix = Path(cls.folder.name) / "prefix"
        run("cmake", "--install", PROGRAM.parent, "--prefix", cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_example_finds_it_and_measures(self):
        build = Path(self.folder.name) / "example"
        run("cmake", "-S", EXAMPLE, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_CXX_FLAGS=-Wall -Werror")
        run("cmake", "--build", build)
        words = run(build / "example", cwd=build).split()
        value, lower, upper = float(words[1]), float(words[6]), float(words[8])
        self.assertLess(lower, value)
        self.assertLess(value, upper)
        self.assertLess(upper - lower, 0.03 * value)
        self.assertTrue((build / "door.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_shared_library_shows_the_public_interface_alone(self):
        archive, library = self.prefix / "lib/libstilb.a", Path(self.folder.name) / "libstilb.so"
        if not archive.exists():
            (archive,) = self.prefix.glob("lib/*/libstilb.a")
        run("g++", "-shared", "-o", library, "-Wl,--whole-archive", archive, "-Wl,--no-whole-archive")
        symbols = run("nm", "-DC", "--defined-only", library).splitlines()
        own = {match[1] for line in symbols if (match := re.search(r" [TBDR] (stilb::[\w:]+)", line))}
        declared = " ".join(header.read_text() for header in (self.prefix / "include/stilb").glob("*.h"))
        # The headers declare `Data` of their classes, too, without its members.
        hidden = [name for name in own if "::Data" not in name and name.split("::")[-1] not in declared]
        self.assertEqual(hidden, [], "these are not part of the public interface")
        for name in ("stilb::api::measure", "stilb::api::render", "stilb::InputError::InputError"):
            self.assertIn(name, own)

    def test_program_has_manual_and_completions(self):
        self.assertEqual(run(self.prefix / "bin/stilb", "--version"), run(PROGRAM, "--version"))
        bash = (self.prefix / "share/bash-completion/completions/stilb").read_text()
        completed = run("bash", "-c", f"{bash}\nCOMP_WORDS=(stilb measure --fal); COMP_CWORD=2; _stilb; "
                                      "echo ${COMPREPLY[@]}")
        self.assertEqual(completed.split(), ["--falsecolor"])
        self.assertIn("--falsecolor", (self.prefix / "share/zsh/site-functions/_stilb").read_text())
        self.assertIn("-l falsecolor", (self.prefix / "share/fish/vendor_completions.d/stilb.fish").read_text())
        self.assertIn("falsecolor", (self.prefix / "share/man/man1/stilb-measure.1").read_text())

    def test_destdir_is_respected(self):
        destination = Path(self.folder.name) / "destination"
        run("cmake", "--install", PROGRAM.parent, "--prefix", "/usr", env={**os.environ, "DESTDIR": str(destination)})
        for file in ["bin/stilb", "include/stilb/stilb.h", "share/man/man1/stilb.1"]:
            self.assertTrue((destination / "usr" / file).is_file(), file)


class IncludedProject(unittest.TestCase):
    def test_fetch_content_gives_the_library_without_flags(self):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "source"
            source.mkdir()
            (source / "main.cpp").write_text((EXAMPLE / "main.cpp").read_text())
            (source / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES CXX)\ninclude(FetchContent)\n"
                "set(CMAKE_EXPORT_COMPILE_COMMANDS ON)\n"
                f"FetchContent_Declare(stilb SOURCE_DIR {PROJECT})\nFetchContent_MakeAvailable(stilb)\n"
                "add_executable(user main.cpp)\ntarget_link_libraries(user PRIVATE stilb::stilb)\n")
            build = Path(folder) / "build"
            run("cmake", "-S", source, "-B", build)
            commands = json.loads((build / "compile_commands.json").read_text())
            own = [c["command"] for c in commands if c["file"].startswith(str(source))]
            self.assertEqual(len(own), 1)
            self.assertNotRegex(own[0], r"-W|-f|-D|/src\b")
            self.assertFalse(any("-Werror" in c["command"] for c in commands))
            self.assertFalse(any("/cli/" in c["file"] or "/tests/" in c["file"] for c in commands))


if __name__ == "__main__":
    unittest.main()
