// Tables whose cells have a colour for how wrong they are.
import type {HeatCell, HeatTable} from "./page";
import {left, right, table, type Cell} from "./table";

/** The colour says a logarithm, so that one lost contact of 10,000 can be seen. */
function heat(errors: number | undefined, colour: string): Cell["heat"] {
  if (!errors) return undefined;
  const strength = 12 + 48 * Math.min(1, Math.max(0, 1 + Math.log10(errors) / 4));
  return {
    background: `color-mix(in srgb, var(${colour}) ${strength.toFixed(0)}%, var(--surface))`,
    ink: "var(--ink)",
  };
}

const kClasses = {error: "error", aside: "informative"};

function cellOf({text, share, label, kind}: HeatCell, colour: string): Cell {
  return {
    text,
    sort: text === "·" ? 0 : text === "" || kind ? null : undefined, // a dot stands for none
    label,
    class: kind && kClasses[kind],
    heat: heat(share, colour),
  };
}

/** `colour`: a property of the page's colours, "--missed". `what` says to a screen reader what it holds. */
export function heatTable({columns, rows}: HeatTable, colour: string, what: string): HTMLElement {
  const [first, ...others] = columns;
  return table(
    [left(first), ...others.map((title) => right(title))],
    rows.map(([name, ...cells]) => [name.text, ...cells.map((cell) => cellOf(cell, colour))]),
    what,
  );
}
