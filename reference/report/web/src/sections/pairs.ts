// Random pairs: what they were, and how the oracle itself did on them.
import {h, p, type Child} from "../dom";
import {grouped, number, share} from "../format";
import type {Scene} from "../results";
import type {Section} from "../section";
import {left, right, titledTable} from "../table";

export function pairsContent(scene: Scene): Child[] {
  if (!scene.pairs) return [];
  const {count, seed, touching, per_kind, rational} = scene.pairs;
  const wrong = rational.oracle_wrong;
  const rows = Object.entries(per_kind).map(([kind, tally]) => [
    kind,
    String(tally.pairs),
    String(tally.touching),
    number(share(tally.touching, tally.pairs)),
  ]);
  return [
    p(
      `${grouped(count)} pairs, seed ${seed}, ${grouped(touching)} touch; oracle against rational arithmetic: ${grouped(wrong)} wrong` +
        `${wrong === 0 ? "" : ", AN ERROR OF CONTACTCHECK ITSELF"}.`,
    ),
    ...titledTable(
      "Kinds of pairs",
      [left("kind"), right("pairs"), right("touching"), right("share")],
      rows,
    ),
  ];
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
      ...scenes.flatMap((scene) => [h("h3", {}, scene.id), ...pairsContent(scene)]),
    ];
  },
};
