// How large errors are: depths, normals, distances of spurious pairs, hover.
import {chart} from "../chart";
import {controlBar, selectPlace} from "../controls";
import {h, p, type Child} from "../dom";
import {term} from "../glossary";
import {groupColour} from "../groups";
import type {ErrorChart, Page} from "../page";
import type {Section} from "../section";
import {drawErrors} from "./graded_chart";
import {tablesOf} from "./text";

/** The place of the claim about Bullet's normals, where the results have it. */
const kTurnedNormals = "turned-normals";

function picture(page: Page, errors: ErrorChart): Child[] {
  const colour = ({detector}: {detector: string}): string => groupColour(page, detector);
  const {title, rows, truth, always_zero} = errors;
  return [
    h("h3", {}, title),
    truth && p(truth),
    rows.length > 0 && chart(title, (width) => drawErrors(width, errors, colour)).element,
    always_zero && h("p", {class: "note"}, always_zero),
  ];
}

// The errors of one detector that stand out, and are no surprise to whoever knows it.
function normalNote(page: Page): Child[] {
  if (!tablesOf(page, "claims").some(({id}) => id === kTurnedNormals)) return [];
  return [
    h(
      "p",
      {class: "note"},
      h("a", {href: `#${kTurnedNormals}`}, "Why normals of bullet-vf are 180 degrees off"),
      ".",
    ),
  ];
}

const pictures = (page: Page, charts: ErrorChart[]): Child[] =>
  charts.flatMap((errors) => [
    ...picture(page, errors),
    ...(errors.title === "Normal" ? normalNote(page) : []),
  ]);

// A note on the height of bars where there are any.
function words(computed: ErrorChart[][]): Child[] {
  const bars = computed.some((charts) =>
    charts.some(({rows}) => rows.some(([, , , , , , bins]) => bins.length > 0)),
  );
  return [
    p(
      "How far what detectors report is from what is exactly there, in ",
      term("depth", "depth and normal"),
      ", distance and ",
      term("hover"),
      ": ●\u00a0mean, ◆\u00a095 % are below, ┃\u00a0largest. Over several scenes the 95 % and the largest are those of the worst scene. " +
        "Depths come in two kinds that do not compare: of vertices inside a solid (vertex-surface) and of convex pieces (convex-pair).",
    ),
    bars &&
      p(
        "Bars say which share of a detector's errors is of which size; their height grows with the square root, so that rare " +
          "errors are seen, too. Lengths below a micrometre share the first bar. Of hover every episode is a line of its own.",
      ),
  ];
}

export const graded: Section = {
  id: "graded",
  title: "How large the errors are",
  short: "Error sizes",
  build(page) {
    const {choices, graded: computed} = page,
      place = h("div");
    if (computed.every((charts) => charts.length === 0)) return [];
    const update = (choice: number): void => {
      const shown = pictures(page, computed[choice]).filter((child) => child) as Node[];
      place.replaceChildren(...(shown.length > 0 ? shown : [p("Nothing was judged here.")]));
    };
    update(0);
    return [...words(computed), controlBar(selectPlace("Scenes", choices, 0, update)), place];
  },
};
