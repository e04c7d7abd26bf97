// Random pairs: what they were, and how the oracle itself did on them.
import {h, p} from "../dom";
import type {Section} from "../section";
import {textTable} from "../table";

export const pairs: Section = {
  id: "pairs",
  title: "Random pairs",
  build({pairs: scenes}) {
    if (scenes.length === 0) return [];
    return [
      p(
        "Pairs of triangles that touch or are apart by rounding, made from a seed. The oracle, which judges everything else, is held " +
          "against rational arithmetic on every one of them.",
      ),
      ...scenes.flatMap(({scene, table}) => [h("h3", {}, scene), ...textTable(table)]),
    ];
  },
};
