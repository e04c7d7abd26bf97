import {showCheck} from "./check/page";
import {readPage, readView} from "./data";
import {h, p, type Child} from "./dom";
import type {Page} from "./page";
import type {Section} from "./section";
import {cost} from "./sections/cost";
import {graded} from "./sections/graded";
import {hard} from "./sections/hard";
import {header} from "./sections/headline";
import {levels} from "./sections/levels";
import {paper} from "./sections/paper";
import {scenes} from "./sections/scenes";
import {speedError} from "./sections/speed_error";
import {stages} from "./sections/stages";
import {summary} from "./sections/summary";
import {textSection} from "./sections/text";
import {times} from "./sections/times";
import {view} from "./sections/view";
import {words} from "./sections/words";
import {mountView} from "./view/view";
import {provideView} from "./view_slot";

// Those with charts and controls of their own.
const kDrawn: Section[] = [
  speedError,
  levels,
  view,
  cost,
  graded,
  times,
  stages,
  summary,
  hard,
  paper,
  scenes,
  words,
];

const kOthers = "others";

// The charts that answer first, then the numbers that they come from; the list of words ends the page.
const kOrder =
  "drawn speed-error levels view cost graded times stages summary goals hard defects pairs claims others " +
  "paper scenes detectors machine words";

// For a run of hard cases only, these are the answer.
const kHardFirst = `hard defects ${kOrder.replace("hard defects ", "")}`;

/** In order; a section of the report that the order does not name stands among the others. */
function ordered(page: Page): Section[] {
  const all = new Map(page.sections.map((one) => [one.id, textSection(one)]));
  for (const section of kDrawn) all.set(section.id, section);
  const hardAlone = page.scenes.length === 0 && !all.has("drawn");
  const order = (hardAlone ? kHardFirst : kOrder).split(" ");
  return order.flatMap((id) =>
    id === kOthers
      ? [...all.values()].filter((section) => !order.includes(section.id))
      : (all.get(id) ?? []),
  );
}

function navigation(sections: Section[]): HTMLElement {
  const links = sections.map(({id, short, title}) =>
    h("li", {}, h("a", {href: `#${id}`}, short ?? title)),
  );
  return h("nav", {"aria-label": "Contents"}, h("ul", {}, ...links));
}

// One part that cannot be shown (results of another version, or written by hand) takes no other along.
function contentOf(section: Section, page: Page, bytes: ArrayBuffer | null): Child[] {
  try {
    return section.build(page, bytes);
  } catch (error) {
    return [p(`This part cannot be shown: ${String(error)}`)];
  }
}

function sectionElement({id, title}: Section, content: Child[]): HTMLElement {
  return h(
    "section",
    {id, "aria-labelledby": `${id}-title`},
    h("h2", {id: `${id}-title`}, title),
    ...content,
  );
}

/** A link to something inside a closed part opens that. */
function openTarget(): void {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target instanceof HTMLDetailsElement) target.open = true;
}

function show(page: Page, bytes: ArrayBuffer | null, place: HTMLElement): void {
  const filled = ordered(page)
    .map((section) => ({section, content: contentOf(section, page, bytes)}))
    .filter(({content}) => content.some((child) => child));
  place.replaceChildren(
    header(page),
    navigation(filled.map(({section}) => section)),
    ...filled.map(({section, content}) => sectionElement(section, content)),
  );
}

async function main(): Promise<void> {
  provideView(mountView);
  const page = await readPage(),
    bytes = await readView();
  const place = document.getElementById("report")!;
  if ("frames" in page) showCheck(page, bytes, place);
  else show(page, bytes, place);
  document.title = `contactcheck: ${page.title}`;
  addEventListener("hashchange", openTarget);
  openTarget();
}

main().catch((error: unknown) => {
  document.getElementById("report")!.textContent = `This report cannot be shown: ${String(error)}`;
});
