// Tables in a box of their own, which scrolls where the window is narrow. Headings sort.
import {code, h, type Child} from "./dom";
import {meaningOf} from "./glossary";
import type {TextTable} from "./page";

interface Column {
  title: string;
  left?: boolean;
  /** For the legend of words. */
  meaning?: string;
  /** Its cells are "yes", "no", or say why neither. */
  verdict?: boolean;
}

export interface Cell {
  text: string;
  /** Shown instead of the text. */
  node?: Node;
  /** What sorting goes by instead of the text. */
  sort?: number | null;
  class?: string;
  /** Background and ink, of heat tables. */
  heat?: {background: string; ink: string};
  /** Shown when the pointer rests on the cell. */
  label?: string;
}

type Row = (string | Cell)[];

const cellOf = (cell: string | Cell): Cell => (typeof cell === "string" ? {text: cell} : cell);

// "1.39 to 9.13x" sorts as 1.39; words sort behind numbers.
function sortKey(cell: Cell): number | string {
  if (cell.sort !== undefined) return cell.sort ?? Infinity;
  const value = Number.parseFloat(cell.text.replaceAll(",", ""));
  return Number.isNaN(value) ? cell.text : value;
}

function compare(a: number | string, b: number | string): number {
  if (typeof a === "number" && typeof b === "number") return a - b;
  if (typeof a === "string" && typeof b === "string") return a.localeCompare(b);
  return typeof a === "number" ? -1 : 1;
}

function tableCell(cell: Cell, column: Column, first: boolean): HTMLElement {
  const attributes = {
    class: [column.left ? "left" : "", cell.class ?? ""].join(" ").trim() || null,
    title: cell.label,
  };
  const element = first
    ? h("th", {scope: "row", ...attributes}, cell.node ?? cell.text)
    : h("td", attributes, cell.node ?? cell.text);
  if (cell.heat) {
    element.style.background = cell.heat.background;
    element.style.color = cell.heat.ink;
  }
  return element;
}

function sortBy(body: HTMLElement, heads: HTMLElement[], index: number, rows: Row[]): void {
  const down = heads[index].getAttribute("aria-sort") === "ascending";
  heads.forEach((head) => head.removeAttribute("aria-sort"));
  heads[index].setAttribute("aria-sort", down ? "descending" : "ascending");
  const lines = [...body.children];
  const keys = rows.map((row) => sortKey(cellOf(row[index])));
  const number = new Map(lines.map((line) => [line, Number((line as HTMLElement).dataset.row)]));
  lines.sort((a, b) => compare(keys[number.get(a)!], keys[number.get(b)!]) * (down ? -1 : 1));
  body.append(...lines);
}

function headLine(
  columns: Column[],
  sort: (heads: HTMLElement[], index: number) => void,
): HTMLElement {
  const heads: HTMLElement[] = columns.map((column, i) => {
    const button = h("button", {type: "button", click: () => sort(heads, i)}, column.title);
    return h(
      "th",
      {
        scope: "col",
        class: column.left ? "left" : null,
        title: column.meaning ?? meaningOf(column.title),
      },
      button,
    );
  });
  return h("tr", {}, ...heads);
}

/** `what` says to a screen reader what the table holds. */
export function table(columns: Column[], rows: Row[], what: string): HTMLElement {
  const body = h("tbody");
  rows.forEach((row, r) => {
    const cells = row.map((cell, i) => tableCell(cellOf(cell), columns[i], i === 0));
    body.append(h("tr", {"data-row": r}, ...cells));
  });
  const head = headLine(columns, (heads, index) => sortBy(body, heads, index, rows));
  return h(
    "div",
    {class: "scroll", role: "region", tabindex: 0, "aria-label": what},
    h("table", {}, h("thead", {}, head), body),
  );
}

const kLong = 24; // letters
const kFailed = new Set(["error", "absent", "refused"]);

// A run that did not end well: its status and a message, and nothing else.
const isFailed = (row: string[]): boolean => kFailed.has(row[1]) && row.slice(3).every((t) => !t);

const kVerdicts: Record<string, Cell> = {
  yes: {text: "✓ yes", class: "good"},
  no: {text: "✗ no", class: "bad"},
};

function textCell(text: string, i: number, failed: boolean, column?: Column): Cell | string {
  if (column?.verdict) return kVerdicts[text] ?? {text, class: "wrap"};
  if (failed && i === 1) return {text, class: "error"};
  if (text.length > kLong || (failed && i === 2)) return {text, class: "wrap left"};
  return text;
}

/** Long cells in several lines; verdicts, and the status of a run that did not end well, stand out. */
export const textRow = (row: string[], columns: Column[]): Row => {
  const failed = row.length > 3 && isFailed(row);
  return row.map((text, i) => textCell(text, i, failed, columns[i]));
};

/** What the program wrote: code out of its backticks, long cells in several lines. */
export function textTable({title, text, columns, rows}: TextTable, what = title): Child[] {
  if (rows.length === 0) return [];
  return [
    text && h("p", {}, ...withCode(text)),
    table(
      columns,
      rows.map((row) => textRow(row, columns)),
      what.replaceAll("`", "") || text,
    ),
  ];
}

export const withCode = (text: string): Child[] =>
  text.split("`").map((part, i) => (i % 2 === 1 ? code(part) : part));

export const left = (title: string, meaning?: string): Column => ({title, left: true, meaning});
export const right = (title: string, meaning?: string): Column => ({title, meaning});
