// How large errors are: depths, normals, distances of spurious pairs, hover.
import {chart} from "../chart";
import {controlBar, select} from "../controls";
import {h, p, type Child} from "../dom";
import {listed} from "../format";
import {term} from "../glossary";
import type {Report} from "../report";
import type {Scene} from "../results";
import {chosenScenes, sceneOptions} from "../scene_choice";
import type {Section} from "../section";
import {kQuantities, spreadOf, type Quantity, type Spread} from "../spreads";
import {hasTurnedNormals, kTurnedNormals} from "./claims";
import {drawSpreads} from "./graded_chart";

// Whose largest error is 0 would be a row of nothing.
function picture(title: string, all: Spread[], quantity: Quantity): Child[] {
  if (all.length === 0) return [];
  const shown = all.filter(({max}) => max > 0),
    exact = all.filter(({max}) => max === 0);
  const names = exact.map(({detector}) => detector);
  return [
    h("h3", {}, title),
    shown.length > 0 && chart(title, (width) => drawSpreads(width, shown, quantity)).element,
    exact.length > 0 && h("p", {class: "note"}, `Always 0: ${listed(names)}.`),
  ];
}

// The errors of one detector that stand out, and are no surprise to whoever knows it.
function normalNote(report: Report): Child[] {
  if (!hasTurnedNormals(report)) return [];
  return [
    h(
      "p",
      {class: "note"},
      h("a", {href: `#${kTurnedNormals}`}, "Why normals of bullet-vf are 180 degrees off"),
      ".",
    ),
  ];
}

function pictures(report: Report, scenes: Scene[]): Child[] {
  return kQuantities.flatMap((quantity) => {
    const all = report.detectors
      .map((name) => spreadOf(report, name, scenes, quantity))
      .filter((spread) => spread !== null);
    const note = quantity.title === "Normal" && all.length > 0 ? normalNote(report) : [];
    if (!quantity.byKind) return [...picture(quantity.title, all, quantity), ...note];
    return [...new Set(all.map((spread) => spread.kind))].flatMap((kind) =>
      picture(
        `${quantity.title}, ${kind}`,
        all.filter((spread) => spread.kind === kind),
        quantity,
      ),
    );
  });
}

// A note on the height of bars where there are any.
function words(report: Report): Child[] {
  const bars = report.results.runs.some(
    (run) =>
      run.geometry?.depth_error_histogram?.length ||
      run.geometry?.normal_error_deg_histogram?.length ||
      run.geometry?.spurious_distance_histogram?.length,
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
  build(report) {
    if (
      !report.results.runs.some((run) => run.status === "ok" && kQuantities.some(({of}) => of(run)))
    )
      return [];
    const options = sceneOptions(report),
      place = h("div");
    const update = (value: string): void => {
      const shown = pictures(report, chosenScenes(report, value)).filter(
        (child) => child,
      ) as Node[];
      place.replaceChildren(...(shown.length > 0 ? shown : [p("Nothing was judged here.")]));
    };
    update(options[0][0]);
    return [...words(report), controlBar(select("Scenes", options, options[0][0], update)), place];
  },
};
