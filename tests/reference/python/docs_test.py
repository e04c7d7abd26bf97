"""Docstrings: every example gives what it says, and everything public has one."""

import doctest
import inspect
import pathlib

import contactcheck


def test_examples_in_docstrings():
    found = doctest.testmod(contactcheck)
    assert found.failed == 0 and found.attempted > 20


def test_examples_on_the_page():
    page = pathlib.Path(__file__).parents[3] / "reference" / "python" / "README.md"
    found = doctest.testfile(str(page), module_relative=False)
    assert found.failed == 0 and found.attempted > 10


def test_everything_public_has_a_docstring():
    for name in contactcheck.__all__:
        thing = getattr(contactcheck, name)
        if name != "__version__":
            assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            for member, value in inspect.getmembers(thing):
                if not member.startswith("_") and member not in ("index", "count"):
                    assert inspect.getdoc(value), f"{name}.{member}"


def test_exceptions_say_what_they_are():
    assert issubclass(contactcheck.InputError, ValueError)
    assert issubclass(contactcheck.RefusedInput, ValueError)
    assert issubclass(contactcheck.Unavailable, RuntimeError)
