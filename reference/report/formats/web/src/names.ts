// Names beside the points of a chart, none over another name or a point. One that finds no room is
// left out; the tip of its point still says it.
import * as Plot from "@observablehq/plot";

interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

// Of the charts' font, pixels.
const kLetter = 6.4,
  kHeight = 13,
  kMarker = 6,
  kGap = 3;

const overlap = (a: Box, b: Box): boolean =>
  a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

// Beside is read most easily, then above and below, then further away.
function* placesOf(x: number, y: number, width: number): Generator<Box> {
  const box = (left: number, top: number): Box => ({x: left, y: top, width, height: kHeight});
  const far = kMarker + kGap;
  yield box(x + far, y - kHeight / 2);
  yield box(x - far - width, y - kHeight / 2);
  for (let away = 0; away <= 3 * kHeight; away += kHeight / 2)
    for (const part of [0.5, 0.1, 0.9]) {
      yield box(x - part * width, y - far - away - kHeight);
      yield box(x - part * width, y + far + away);
    }
}

/** A text mark that names `points`, the most important first. */
export function names<Point>(
  points: Point[],
  x: keyof Point & string,
  y: keyof Point & string,
  text: keyof Point & string,
): Plot.Markish {
  return Plot.text(
    points,
    Plot.initializer(
      {
        x,
        y,
        text,
        textAnchor: "start",
        fill: "currentColor",
        stroke: "var(--surface)",
        strokeWidth: 4,
        className: "names",
      },
      (
        data,
        _facets,
        channels,
        scales,
        {width, height, marginLeft, marginRight, marginTop, marginBottom},
      ) => {
        const at = (channel: "x" | "y"): number[] =>
          Array.from(channels[channel]!.value as number[], (value) =>
            Number((scales[channel] as (value: number) => number)(value)),
          );
        const across = at("x"),
          down = at("y");
        const taken = across.map(
          (left, i): Box => ({
            x: left - kMarker,
            y: down[i] - kMarker,
            width: 2 * kMarker,
            height: 2 * kMarker,
          }),
        );
        const inside = (box: Box): boolean =>
          box.x >= marginLeft &&
          box.x + box.width <= width - marginRight + 20 &&
          box.y >= marginTop - 24 &&
          box.y + box.height <= height - marginBottom;
        const left: number[] = [],
          middle: number[] = [],
          shown: number[] = [];
        points.forEach((point, i) => {
          const length = kLetter * String(point[text]).length;
          for (const box of placesOf(across[i], down[i], length)) {
            if (!inside(box) || taken.some((other) => overlap(box, other))) continue;
            taken.push(box);
            [left[i], middle[i]] = [box.x, box.y + kHeight / 2];
            shown.push(i);
            break;
          }
        });
        return {data, facets: [shown], channels: {x: {value: left}, y: {value: middle}}};
      },
    ),
  );
}
