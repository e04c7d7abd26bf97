#!/usr/bin/env python3
"""Patched programs of a small project: a header changes for all its users."""

import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import mutant_build
from mutant_build import (DOES_NOT_APPLY, DOES_NOT_COMPILE, Build, Failure, Mutant, Workers,
                          build_program)

FILES = {
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
add_library(parts STATIC core/first.cpp core/second.cpp core/alone.cpp)
target_include_directories(parts PUBLIC ${PROJECT_SOURCE_DIR})
add_executable(program core/main.cpp)
target_link_libraries(program PRIVATE parts)
""",
    "core/value.h": "#pragma once\ninline int value() { return 1; }\n",
    "core/first.cpp": '#include "core/value.h"\nint first() { return value(); }\n',
    "core/second.cpp": '#include "core/value.h"\nint second() { return 10 * value(); }\n',
    "core/alone.cpp": "int alone() { return 1000; }\n",
    "core/main.cpp": """#include <cstdio>
#include "core/value.h"
int first();
int second();
int alone();
int main() { std::printf("%d", first() + second() + 100 * value() + alone()); }
""",
    "core/unused.cpp": "int unused() { return 1; }\n",
}


def patch_of(name, line, new):
    """Replaces one line."""
    lines = FILES[name].splitlines()
    at = lines.index(line) + 1
    return (f"# A mistake.\n--- a/{name}\n+++ b/{name}\n@@ -{at},1 +{at},1 @@\n-{line}\n+{new}\n")


HEADER = patch_of("core/value.h", "inline int value() { return 1; }",
                  "inline int value() { return 2; }")
UNIT = patch_of("core/alone.cpp", "int alone() { return 1000; }", "int alone() { return 5000; }")


class MutantBuild(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = pathlib.Path(folder.name).resolve()
        patch = mock.patch.object(mutant_build, "ROOT", cls.root)
        patch.start()
        cls.addClassCleanup(patch.stop)
        for name, text in FILES.items():
            (cls.root / name).parent.mkdir(exist_ok=True)
            (cls.root / name).write_text(text, encoding="utf-8")
        cls.plain = cls.built("plain", "OFF")
        cls.unity = cls.built("unity", "ON")

    @classmethod
    def built(cls, name, unity):
        folder = cls.root / name
        for command in (["-S", cls.root, "-B", folder, "-G", "Ninja",
                         f"-DCMAKE_UNITY_BUILD={unity}"], ["--build", folder]):
            subprocess.run(["cmake", *command], check=True, capture_output=True)
        return Build(folder, "program")

    def printed(self, build, patch):
        with tempfile.TemporaryDirectory() as folder:
            scratch = pathlib.Path(folder)
            path = scratch / "mistake.patch"
            path.write_text(patch, encoding="utf-8")
            build_program(Mutant(path), build, scratch / "program", scratch, Workers(2))
            return subprocess.run([scratch / "program"], check=True, capture_output=True,
                                  text=True).stdout

    def expect_failure(self, code, text, build, patch):
        with self.assertRaises(Failure) as raised:
            self.printed(build, patch)
        self.assertEqual(raised.exception.code, code)
        self.assertIn(text, str(raised.exception))

    def test_header_changes_for_every_user(self):
        self.assertEqual(self.printed(self.plain, HEADER), "1222")
        self.assertEqual(self.printed(self.unity, HEADER), "1222")

    def test_only_users_are_compiled_again(self):
        self.assertEqual([self.plain.name_of(unit.source)
                          for unit in self.plain.users(["core/alone.cpp"])], ["core/alone.cpp"])
        self.assertEqual(self.printed(self.plain, UNIT), "5111")

    def test_build_stays_as_it_is(self):
        self.printed(self.plain, HEADER)
        done = subprocess.run([self.root / "plain" / "program"], check=True, capture_output=True)
        self.assertEqual(done.stdout, b"1111")
        done = subprocess.run(["cmake", "--build", self.root / "plain"], check=True,
                              capture_output=True, text=True)
        self.assertIn("no work to do", done.stdout)

    def test_unity_files_read_the_patched_source(self):
        self.assertEqual(self.printed(self.unity, UNIT), "5111")

    def test_source_that_was_read_without_the_patch_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "mistake.patch"
            path.write_text(HEADER, encoding="utf-8")
            mutant = Mutant(path)
        rule = f"first.o: core/first.cpp {self.root}/core/value.h"
        self.assertEqual(mutant_build.unpatched(rule, mutant, self.plain), ["core/value.h"])
        rule = "first.o: core/first.cpp /tmp/mutant/core/value.h"
        self.assertEqual(mutant_build.unpatched(rule, mutant, self.plain), [])

    def test_change_of_a_file_that_the_program_does_not_use_is_refused(self):
        self.expect_failure(DOES_NOT_COMPILE, "no unit of program depends on core/unused.cpp",
                            self.plain, patch_of("core/unused.cpp", "int unused() { return 1; }",
                                                 "int unused() { return 2; }"))

    def test_change_that_is_no_cpp_does_not_compile(self):
        self.expect_failure(DOES_NOT_COMPILE, "error", self.plain,
                            UNIT.replace("5000; }", "this is no statement }"))

    def test_patches_that_do_not_apply(self):
        for text, patch in (("FAILED", UNIT.replace("1000", "1001")),
                            ("there is no core/none.cpp", UNIT.replace("alone.cpp", "none.cpp")),
                            ("does not say what is wrong", UNIT.partition("\n")[2]),
                            ("no file is changed", "# A mistake.\n")):
            with self.subTest(text=text):
                self.expect_failure(DOES_NOT_APPLY, text, self.plain, patch)


if __name__ == "__main__":
    unittest.main()
