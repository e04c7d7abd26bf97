// The missed and spurious pairs of a detector: one click leads to a pair.
import {h} from "../dom";
import type {Kind, ListedPair, SceneHeader} from "./types";

const kPage = 100;

export const kSymbol: Record<Kind, string> = {missed: "✕", spurious: "□"};

type Names = (body: number) => string;

function element(body: number, number: number, what: string, names: Names): string {
  return number < 0 ? names(body) : `${names(body)} ${what} ${number}`;
}

/** "left triangle 12", "right triangle 7" */
export function pairWords({pair, elements}: ListedPair, names: Names): [string, string] {
  const [first, second] = elements;
  return [element(pair[0], pair[1], first, names), element(pair[2], pair[3], second, names)];
}

export class PairTable {
  readonly element: HTMLElement;
  private readonly body = h("tbody");
  private readonly more = h("button", {
    type: "button",
    class: "view-more",
    click: () => this.grow(),
  });
  private readonly caption = h("caption");
  private rows: HTMLTableRowElement[] = [];
  private pairs: ListedPair[] = [];
  private names: Names = String;

  constructor(private readonly onPair: (pair: ListedPair) => void) {
    const head = h("tr", {}, ...["", "frame", "pair"].map((text) => h("th", {scope: "col"}, text)));
    this.element = h(
      "div",
      {class: "view-table", tabindex: 0, role: "region", "aria-label": "Missed and spurious pairs"},
      h("table", {}, this.caption, h("thead", {}, head), this.body),
      this.more,
    );
  }

  fill(scene: SceneHeader, pairs: ListedPair[], caption: string): void {
    this.pairs = pairs;
    this.names = (body) => scene.bodies[body].name;
    this.caption.textContent = caption;
    this.rows = [];
    this.body.replaceChildren();
    this.grow();
  }

  /** Marks the row of that pair, or none. */
  select(chosen: ListedPair | null): void {
    const at = chosen ? this.pairs.indexOf(chosen) : -1;
    while (at >= this.rows.length && this.rows.length < this.pairs.length) this.grow();
    this.rows.forEach((row, i) => row.toggleAttribute("data-chosen", i === at));
    if (at >= 0) this.bringIntoView(this.rows[at]);
  }

  // Within the table alone: the page stays where it is.
  private bringIntoView(row: HTMLElement): void {
    const {top, bottom} = this.element.getBoundingClientRect(),
      at = row.getBoundingClientRect();
    if (at.top < top || at.bottom > bottom)
      this.element.scrollTop += at.top - top - 0.5 * (bottom - top);
  }

  private grow(): void {
    const next = this.pairs
      .slice(this.rows.length, this.rows.length + kPage)
      .map((pair) => this.row(pair));
    this.rows.push(...next);
    this.body.append(...next);
    const rest = this.pairs.length - this.rows.length;
    this.more.hidden = rest === 0;
    this.more.textContent = `${Math.min(rest, kPage)} more of ${rest}`;
  }

  private row(pair: ListedPair): HTMLTableRowElement {
    const [one, other] = pairWords(pair, this.names);
    const button = h(
      "button",
      {
        type: "button",
        "aria-label": `Show the ${pair.kind} pair ${one}, ${other} in frame ${pair.frame}`,
        click: () => this.onPair(pair),
      },
      h(
        "span",
        {class: `view-symbol view-${pair.kind}`, "aria-hidden": "true"},
        kSymbol[pair.kind],
      ),
      ` ${pair.kind}`,
    );
    return h(
      "tr",
      {},
      h("td", {}, button),
      h("td", {class: "view-number"}, String(pair.frame)),
      h("td", {}, one, h("br"), other),
    );
  }
}
