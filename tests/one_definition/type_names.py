#!/usr/bin/env python3
"""Does every type of core and reference have a name of its own?

Two types of one name in one namespace, each in a header of its own layer, compile and link; then the
linker takes the destructor of one for both (the C++ standard's one-definition rule, which no compiler
checks across files). Prints each such name with its headers; exit code 1 when there is one."""
import collections
import pathlib
import re
import sys

NAMESPACE = re.compile(r"namespace ([\w:]*) ?\{")
TYPE = re.compile(r"(?:struct|class|enum class|enum|union) (\w+)(?: final)?\s*(?::[^:]|\{|$)")


def types_in(text):
    """Names in full of the types that are defined at the level of a namespace (never indented here)."""
    open_namespaces = []
    for line in text.splitlines():
        if found := NAMESPACE.match(line):
            open_namespaces.append(found[1])
        elif line.startswith("}  // namespace"):
            open_namespaces.pop()
        elif found := TYPE.match(line):
            yield "::".join([*open_namespaces, found[1]])


def headers(root):
    for folder in ("core", "reference"):
        # What Highway compiles once for each instruction set has a namespace for each.
        yield from (h for h in (root / folder).rglob("*.h") if not h.name.endswith("-inl.h"))


def main():
    root = pathlib.Path(sys.argv[1])
    places = collections.defaultdict(set)
    for header in headers(root):
        for name in types_in(header.read_text(encoding="utf-8")):
            places[name].add(str(header.relative_to(root)))
    if len(places) < 100:
        sys.exit(f"only {len(places)} types found in {root}: this check reads the headers no more")
    twice = {name: sorted(where) for name, where in places.items() if len(where) > 1}
    for name, where in sorted(twice.items()):
        print(f"{name}: {', '.join(where)}")
    return 1 if twice else 0


if __name__ == "__main__":
    sys.exit(main())
