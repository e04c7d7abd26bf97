// Every number of every scene; a scene is filled in when it is opened.
import {code, h, p, unfolding, type Child} from "../dom";
import type {Page, Scene, TextTable} from "../page";
import type {Section} from "../section";
import {showCell} from "../showing";
import {left, right, table, textTable} from "../table";
import {canShow} from "../view_slot";

function titled(one: TextTable): Child[] {
  return [h("h4", {}, one.title), ...textTable(one)];
}

function notes({notes: texts}: Scene): Child[] {
  return texts.length > 0
    ? [h("h4", {}, "Notes"), h("ul", {class: "plain"}, ...texts.map((text) => h("li", {}, text)))]
    : [];
}

function disagreements({id, disagreements: own}: Scene): Child[] {
  if (own.length === 0) return [];
  const title = "Disagreements with the truth (first of each kind)";
  const rows = own.map((d) => [
    d.detector,
    d.kind,
    d.level,
    String(d.frame),
    {text: d.case, node: code(d.case)},
    ...(canShow(id)
      ? [showCell({scene: id, detector: d.detector, frame: d.frame, level: d.level, kind: d.kind})]
      : []),
  ]);
  const columns = [
    left("detector"),
    left("kind"),
    left("level"),
    right("frame"),
    left("case"),
    ...(canShow(id) ? [left("in 3D")] : []),
  ];
  return [h("h4", {}, title), table(columns, rows, title)];
}

function columnLegend({result_columns: columns}: Page): HTMLElement {
  return unfolding("How to read the result table", () => [
    h(
      "dl",
      {class: "words"},
      ...columns.flatMap((c) => [h("dt", {}, c.title), h("dd", {}, c.meaning ?? "")]),
    ),
  ]);
}

export const scenes: Section = {
  id: "scenes",
  title: "Every number, scene by scene",
  short: "All numbers",
  build(page) {
    if (page.scenes.length === 0) return [];
    return [
      p(
        "Open a scene for its bodies, results, levels, graded errors, stages, times, work, speed-ups, notes and the first disagreements.",
      ),
      columnLegend(page),
      ...page.scenes.map((scene) =>
        unfolding(
          h("span", {}, h("strong", {}, scene.id), h("span", {class: "aside"}, ` ${scene.title}`)),
          () => [
            p(scene.sentence),
            ...scene.tables.flatMap(titled),
            ...notes(scene),
            ...disagreements(scene),
          ],
          {class: "block", id: `scene-${scene.id}`},
        ),
      ),
    ];
  },
};
