// The small pictures of legends.
import {s} from "./dom";

const picture = (...children: SVGElement[]): SVGSVGElement =>
  s("svg", {width: 20, height: 12, viewBox: "0 0 20 12", "aria-hidden": "true"}, ...children);

export const square = (colour: string): SVGSVGElement =>
  picture(s("rect", {x: 4, y: 0, width: 12, height: 12, rx: 2, fill: colour}));

export const stroke = (colour: string, dash: string): SVGSVGElement =>
  picture(
    s("line", {
      x1: 0,
      y1: 6,
      x2: 20,
      y2: 6,
      stroke: colour,
      "stroke-width": 2.5,
      "stroke-dasharray": dash,
    }),
  );

/** A path about (0, 0), as d3 draws symbols. */
export const symbol = (path: string, colour = "currentColor"): SVGSVGElement =>
  picture(s("path", {d: path, transform: "translate(10 6)", fill: colour}));
