"""Judges mutants of the product by the tests in Python, too: those of the changed folders that ctest
knows, with the patched program in place of the built one.

Apart from product_verdict.py, whose contents are in every kept verdict's key: more tests can only catch
more mutants, so a verdict of before holds.
"""

import json
import os
import pathlib
import re
import subprocess

import product_verdict
from mutant_build import ROOT, build_program


def tests_in_python(build_folder, files):
    """(command, environment) of every entry of pytest in the tests' folders of these files."""
    done = subprocess.run(["ctest", "--test-dir", build_folder, "--show-only=json-v1"],
                          capture_output=True, text=True, check=True)
    folders = {str(build_folder / "tests" / pathlib.PurePath(name).parent) for name in files}
    for test in json.loads(done.stdout)["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test["properties"]}
        if properties.get("WORKING_DIRECTORY") in folders and "pytest" in test.get("command", []):
            words = [word for word in test["command"] if not word.startswith("--junitxml")]
            yield words, dict(entry.split("=", 1) for entry in properties["ENVIRONMENT"])


def failed_test(words, environment, program, workers):
    """The first one that fails, or nothing."""
    try:
        done = workers.run([*words, "-x"], cwd=ROOT, timeout=product_verdict.SECONDS,
                           env={**os.environ, **environment, "CONTACTCHECK_PROGRAM": str(program)})
    except subprocess.TimeoutExpired:
        return f"{words[-1]} does not end within {product_verdict.SECONDS} s"
    failed = re.search(r"^(?:FAILED|ERROR) \S*?([^/\s]+)(?: - |$)", done.stdout, re.MULTILINE)
    if done.returncode != 0:
        return failed.group(1) if failed else f"{pathlib.Path(words[-1]).name} ends with {done.returncode}"
    return ""


class ProductJudge(product_verdict.ProductJudge):
    def _by_tests(self, mutant, workers, folder):
        return (super()._by_tests(mutant, workers, folder)
                or self._by_tests_in_python(mutant, workers, folder))

    def _by_tests_in_python(self, mutant, workers, folder):
        program = None
        for words, environment in tests_in_python(self.folder, mutant.files):
            if failed_test(words, environment, self.folder / "contactcheck", workers):
                continue  # says nothing of the mutant
            if program is None:
                scratch = folder / "python"
                scratch.mkdir()
                program = scratch / "contactcheck"
                build_program(mutant, self.build, program, scratch, workers, product_verdict.QUICK_FLAGS)
            failed = failed_test(words, environment, program, workers)
            if failed:
                return failed
        return ""
