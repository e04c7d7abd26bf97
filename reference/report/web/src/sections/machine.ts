// Where, with what and how these results were made.
import {code, h, type Child} from "../dom";
import type {Section} from "../section";

export const machine: Section = {
  id: "machine",
  title: "Machine, libraries and command",
  short: "Machine",
  build({results}) {
    const {cpu, cores, isa, os, compiler, build} = results.machine;
    const libraries = Object.entries(results.libraries)
      .map(([name, version]) => `${name} ${version}`)
      .join(", ");
    const facts: [string, Child][] = [
      ["command", code(results.command)],
      ["machine", `${cpu}, ${cores} cores, ${isa}, ${os}`],
      ["built with", `${compiler}, ${build}`],
      ["libraries", libraries],
      ["contactcheck", `${results.version}, schema ${results.schema}`],
    ];
    return [
      h(
        "dl",
        {class: "facts"},
        ...facts.flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]),
      ),
    ];
  },
};
