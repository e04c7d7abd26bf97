// What a suite hoped to measure, and what it did.
import {p} from "../dom";
import {number} from "../format";
import type {Goal} from "../results";
import type {Section} from "../section";
import {left, right, table} from "../table";

const unit = (goal: Goal): string => (goal.per ? " us" : "x");

const wanted = (goal: Goal): string =>
  goal.at_least !== undefined
    ? `>= ${number(goal.at_least)}${unit(goal)}`
    : `<= ${number(goal.at_most)}${unit(goal)}`;

function measured(goal: Goal): string {
  if (goal.measured === null) return "-";
  const interval = goal.low === undefined ? "" : ` [${number(goal.low)}, ${number(goal.high)}]`;
  return `${number(goal.measured)}${unit(goal)}${interval}`;
}

export const goals: Section = {
  id: "goals",
  title: "Goals of the suite",
  short: "Goals",
  build(report) {
    const all = report.results.goals ?? [];
    if (all.length === 0) return [];
    const rows = all.map((goal) => [
      goal.goal,
      goal.scene,
      goal.detector,
      wanted(goal),
      measured(goal),
      goal.met === null
        ? {text: `not measured: ${goal.why}`, class: "wrap"}
        : {text: goal.met ? "✓ yes" : "✗ no", class: goal.met ? "good" : "bad"},
    ]);
    return [
      p(
        "Times are medians; a ratio over a detector is its time over that of the detector named, with a 95 % interval.",
      ),
      table(
        [
          left("goal"),
          left("scene"),
          left("detector"),
          right("wanted"),
          right("measured"),
          left("met"),
        ],
        rows,
        "Goals",
      ),
    ];
  },
};
