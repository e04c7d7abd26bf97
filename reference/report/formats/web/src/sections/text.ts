// A section of texts and tables alone, as the other reports have it.
import {drawn, h, p, type Child} from "../dom";
import type {Block, Page, TextSection} from "../page";
import type {Section} from "../section";
import {textTable, withCode} from "../table";

export const list = (texts: string[]): HTMLElement =>
  h("ul", {class: "plain"}, ...texts.map((text) => h("li", {}, ...withCode(text))));

function shown(block: Block, section: string): Child[] {
  if ("text" in block) return [p(...withCode(block.text))];
  if ("heading" in block) return [h("h3", {}, ...withCode(block.heading))];
  if ("items" in block) return [list(block.items)];
  if ("picture" in block) {
    const label = {role: "region", tabindex: 0, "aria-label": block.what};
    const figure = h("figure", {class: "chart"}, drawn(block.picture));
    return [h("div", {class: "scroll", ...label}, figure)];
  }
  const {id, title} = block.table;
  return [
    title && h("h3", {id}, ...withCode(title)),
    ...textTable(block.table, title || block.table.text || section),
  ];
}

export const textSection = ({id, title, short, blocks}: TextSection): Section => ({
  id,
  title,
  short,
  build: () => blocks.flatMap((block) => shown(block, title)),
});

/** The tables of a section; none where it has nothing to say. */
export const tablesOf = ({sections}: Page, id: string) =>
  sections
    .filter((section) => section.id === id)
    .flatMap(({blocks}) => blocks.flatMap((block) => ("table" in block ? [block.table] : [])));
