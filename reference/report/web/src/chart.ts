// A chart that is drawn again when its place gets another width.
import {h} from "./dom";

export interface Chart {
  element: HTMLElement;
  redraw: () => void;
}

/** `draw` makes a chart of a width in pixels; `what` says to a screen reader what it shows. */
export function chart(what: string, draw: (width: number) => Node): Chart {
  const element = h("figure", {class: "chart", role: "group", "aria-label": what});
  let width = 0;
  const redraw = (): void => {
    if (width > 0) element.replaceChildren(draw(width));
  };
  new ResizeObserver(([entry]) => {
    const now = Math.floor(entry.contentRect.width);
    if (now === width) return;
    width = now;
    // In the next frame: drawing changes heights, which an observer must not do at once.
    requestAnimationFrame(redraw);
  }).observe(element);
  return {element, redraw};
}

export interface LegendEntry {
  text: string;
  /** A small picture, 16 by 12 pixels. */
  swatch: SVGElement;
}

export function legend(entries: LegendEntry[]): HTMLElement {
  return h("ul", {class: "legend"}, ...entries.map(({text, swatch}) => h("li", {}, swatch, text)));
}
