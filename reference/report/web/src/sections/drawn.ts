// Scenes drawn from a seed: who is wrong, how fast each detector is, and what decides.
import {h, p, type Child} from "../dom";
import type {TextTable} from "../page";
import type {Section} from "../section";
import {textTable, withCode} from "../table";

const titled = (one: TextTable): Child[] =>
  one.rows.length > 0 ? [h("h3", {}, one.title), ...textTable(one)] : [];

function whatDecides(sentences: string[]): Child[] {
  if (sentences.length === 0) return [];
  return [
    h("h3", {}, "What decides"),
    h("ul", {class: "plain"}, ...sentences.map((text) => h("li", {}, ...withCode(text)))),
  ];
}

export const drawn: Section = {
  id: "drawn",
  title: "Drawn scenes",
  build({drawn: computed}) {
    if (!computed) return [];
    return [
      p(computed.text),
      ...computed.accuracy.flatMap(titled),
      ...titled(computed.wrong),
      ...computed.speedups.flatMap(titled),
      ...whatDecides(computed.decides),
      ...titled(computed.correlations),
    ];
  },
};
