// A chart that is drawn again when its place gets another width.
//
// Until it is drawn for the width that it has, it says aria-busy: a screen reader then does not tell
// of half a chart, and whoever takes a picture of the page knows when it stands.
import {h} from "./dom";

export interface Chart {
  element: HTMLElement;
  redraw: () => void;
}

/** `draw` makes a chart of a width in pixels; `what` says to a screen reader what it shows. */
export function chart(what: string, draw: (width: number) => Node): Chart {
  const element = h("figure", {
    class: "chart",
    role: "group",
    "aria-label": what,
    "aria-busy": "true",
  });
  let width = 0;
  const redraw = (): void => {
    if (width === 0) return; // folded away, or not yet in the page
    element.replaceChildren(draw(width));
    element.removeAttribute("aria-busy");
  };
  new ResizeObserver(([entry]) => {
    const now = Math.floor(entry.contentRect.width);
    if (now === width) return;
    width = now;
    element.setAttribute("aria-busy", "true");
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
