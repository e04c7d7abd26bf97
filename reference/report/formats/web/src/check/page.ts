// The page of `contactcheck check`: what was found over the frames, the frames in 3D, and all contacts.
import {chart, legend} from "../chart";
import {h, p, type Child} from "../dom";
import {header} from "../sections/headline";
import {viewPlace} from "../sections/view";
import {square} from "../swatch";
import {left, right, table, withCode} from "../table";
import {canHaveView, canShow, showInView} from "../view_slot";
import type {CheckPage} from "./data";
import {drawDepths, drawPairs} from "./frames_chart";

const kScene = "check";

interface Part {
  id: string;
  title: string;
  content: Child[];
}

function charts({frames, pairs, depths, unknown, steps}: CheckPage): Child[] {
  const out: Child[] = [];
  if (pairs.length > 0 || steps.length > 0)
    out.push(
      h("h3", {}, "Pairs of triangles in contact"),
      chart("Pairs of triangles in contact, by frame", (width) =>
        drawPairs(width, frames, pairs, steps),
      ).element,
      steps.length > 0 && pairs.length > 0
        ? legend([
            {text: "in a frame", swatch: square("var(--spurious)")},
            {text: "only between two frames, or first there", swatch: square("var(--missed)")},
          ])
        : null,
    );
  if (depths.length > 0)
    out.push(
      h("h3", {}, "Depth of the deepest contact"),
      chart("Depth of the deepest contact in millimetres, by frame", (width) =>
        drawDepths(width, frames, depths),
      ).element,
    );
  if (unknown.length > 0)
    out.push(
      p(
        `In ${unknown.length} ${unknown.length === 1 ? "frame" : "frames"} some contact has no depth, for the reason that the list names.`,
      ),
    );
  return out;
}

function list({contacts, more, paths}: CheckPage): Child[] {
  if (contacts.length === 0) return [];
  const rows = contacts.map(({place, words, at}) => [
    {text: place, sort: Number.parseInt(place.replace(/^\D+/, ""), 10)},
    {text: words, class: "wrap left"},
    at === null || !canHaveView()
      ? ""
      : {
          text: "",
          node: h(
            "button",
            {
              type: "button",
              class: "show",
              click: () => canShow(kScene) && showInView({scene: kScene, frame: at}),
            },
            "show",
          ),
        },
  ]);
  return [
    paths && p(`Times of steps are shares of the step, ${paths}.`),
    table(
      [left("where"), left("contact"), left("3D")],
      rows,
      "Contacts, frame by frame and step by step",
    ),
    more > 0 &&
      p(`${more} more ${more === 1 ? "contact is" : "contacts are"} in check.csv and check.json.`),
  ];
}

function bodies({bodies: all}: CheckPage): Child[] {
  const noted = all.some(([, , , notes]) => notes !== "");
  const columns = [left("body"), right("triangles"), left("files"), left("notes")];
  return [
    table(
      columns.slice(0, noted ? 4 : 3),
      all.map(([name, triangles, ...words]) => [
        name,
        triangles,
        ...words.slice(0, noted ? 2 : 1).map((text) => ({text, class: "wrap left"})),
      ]),
      "Bodies",
    ),
  ];
}

function view(page: CheckPage, bytes: ArrayBuffer | null): Child[] {
  if (!bytes || !canHaveView()) return [];
  const context = {
    title: () => page.title,
    cases: new Map<string, string[]>(),
    reduce: () => "",
    chosen: page.view,
  };
  return [page.view_note && p(...withCode(page.view_note)), viewPlace(context, bytes)];
}

export function showCheck(page: CheckPage, bytes: ArrayBuffer | null, place: HTMLElement): void {
  const parts: Part[] = [
    {id: "frames", title: "Over the frames", content: charts(page)},
    {id: "view", title: "In 3D", content: view(page, bytes)},
    {id: "contacts", title: "Contacts", content: list(page)},
    {id: "bodies", title: "Bodies", content: bodies(page)},
  ].filter(({content}) => content.some((child) => child));
  place.replaceChildren(
    header(page),
    h(
      "nav",
      {"aria-label": "Contents"},
      h("ul", {}, ...parts.map(({id, title}) => h("li", {}, h("a", {href: `#${id}`}, title)))),
    ),
    ...parts.map(({id, title, content}) =>
      h(
        "section",
        {id, "aria-labelledby": `${id}-title`},
        h("h2", {id: `${id}-title`}, title),
        ...content,
      ),
    ),
  );
}
