// Random pairs: what they were, and how the oracle itself did on them.
import {h, p, type Child} from "../dom";
import type {Report} from "../report";
import type {Scene} from "../results";
import type {Section} from "../section";
import {textTable} from "../table";

export function pairsContent(report: Report, scene: Scene): Child[] {
  const own = report.results.report.pairs.find((pairs) => pairs.scene === scene.id);
  return own ? [p(own.sentence), ...textTable(own.table, "Kinds of pairs")] : [];
}

export const pairs: Section = {
  id: "pairs",
  title: "Random pairs",
  build(report) {
    const scenes = report.scenes.filter((scene) => scene.pairs);
    if (scenes.length === 0) return [];
    return [
      p(
        "Pairs of triangles that touch or are apart by rounding, made from a seed. The oracle, which judges everything else, is held " +
          "against rational arithmetic on every one of them.",
      ),
      ...scenes.flatMap((scene) => [h("h3", {}, scene.id), ...pairsContent(report, scene)]),
    ];
  },
};
