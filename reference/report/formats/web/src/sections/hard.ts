// The hard cases: who is right in how many, and from which value of its parameter on each goes wrong.
import {drawn, h, p, unfolding, type Child} from "../dom";
import {heatTable} from "../heat_table";
import type {Hard, WrongFamily} from "../page";
import type {Section} from "../section";
import {showCell} from "../showing";
import {left, table, textRow, textTable, type Cell} from "../table";
import {canShow, showInView} from "../view_slot";

function picture({id, picture: svg}: WrongFamily): HTMLElement {
  return drawn(svg, (event) => {
    const square = (event.target as Element).closest<SVGElement>("[data-frame]");
    if (!square || !canShow(id)) return;
    const {detector, frame} = square.dataset;
    showInView({scene: id, detector, frame: Number(frame)});
  });
}

// To where each goes wrong first, or to the case without an answer.
function wrongTable({id, table: {columns, rows}, shown}: WrongFamily): HTMLElement {
  const shows = canShow(id);
  const showing = (row: number): Cell[] => {
    const target = shown[row];
    if (!shows) return [];
    return [target ? showCell({scene: id, ...target}) : {text: "-"}];
  };
  return table(
    [...columns, ...(shows ? [left("in 3D")] : [])],
    rows.map((row, i) => [...textRow(row, columns), ...showing(i)]),
    `Errors in ${id}`,
  );
}

function familyDetails(family: WrongFamily): HTMLElement {
  const {id, title, aside, sentence} = family;
  const words = h("span", {class: "aside"}, ` ${title}: ${aside}`);
  return unfolding(
    h("span", {}, h("strong", {}, id), words),
    () => [
      p(sentence),
      h(
        "div",
        {class: "scroll", role: "region", tabindex: 0, "aria-label": `Case by case, ${id}`},
        h("figure", {class: "chart"}, picture(family)),
      ),
      wrongTable(family),
    ],
    {class: "block", id: `family-${id}`},
  );
}

function whereTheyGoWrong({matrix, families}: Hard): Child[] {
  if (families.length === 0) return [p("No detector goes wrong in any family.")];
  return [
    h("h3", {}, "Cases wrong, by family"),
    p("Only families and detectors with an error; a dot means that all cases are right."),
    heatTable(matrix, "--red", "Cases that each detector gets wrong, by family"),
    h("h3", {}, "Where they go wrong"),
    p(
      "One square per case: a triangle pointing down in its upper half for a share missed, one pointing up in its " +
        "lower half for a share spurious; the fuller the colour the larger. A cross is an error, a dashed square a case without an answer.",
    ),
    ...families.map(familyDetails),
  ];
}

export const hard: Section = {
  id: "hard",
  title: "Hard cases",
  build({hard: computed}) {
    if (!computed) return [];
    return [
      p("Families of cases made to be hard, each with a parameter that makes it harder."),
      ...textTable(computed.sums, "Hard cases per detector"),
      ...computed.ranges.flatMap((range) => [h("h3", {}, range.title), ...textTable(range)]),
      ...whereTheyGoWrong(computed),
    ];
  },
};
