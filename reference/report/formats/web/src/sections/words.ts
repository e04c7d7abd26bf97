// The words that a newcomer needs, at the end of the page.
import {h} from "../dom";
import {kGlossary} from "../glossary";
import type {Section} from "../section";

export const words: Section = {
  id: "words",
  title: "Words used here",
  short: "Words",
  build: () => [
    h(
      "dl",
      {class: "words"},
      ...kGlossary.flatMap(({id, word, meaning}) => [
        h("dt", {id: `word-${id}`}, word),
        h("dd", {}, meaning),
      ]),
    ),
  ],
};
