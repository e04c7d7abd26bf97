import {readPage, readView} from "./data";
import {h, p, type Child} from "./dom";
import type {Page} from "./page";
import type {Section} from "./section";
import {claims} from "./sections/claims";
import {cost} from "./sections/cost";
import {defects} from "./sections/defects";
import {detectors} from "./sections/detectors";
import {drawn} from "./sections/drawn";
import {goals} from "./sections/goals";
import {graded} from "./sections/graded";
import {hard} from "./sections/hard";
import {header} from "./sections/headline";
import {levels} from "./sections/levels";
import {machine} from "./sections/machine";
import {pairs} from "./sections/pairs";
import {paper} from "./sections/paper";
import {scenes} from "./sections/scenes";
import {speedError} from "./sections/speed_error";
import {stages} from "./sections/stages";
import {summary} from "./sections/summary";
import {times} from "./sections/times";
import {view} from "./sections/view";
import {words} from "./sections/words";
import {mountView} from "./view/view";
import {provideView} from "./view_slot";

// The charts that answer first, then the numbers that they come from; the list of words ends the page.
const kSections: Section[] = [
  drawn,
  speedError,
  levels,
  view,
  cost,
  graded,
  times,
  stages,
  summary,
  goals,
  hard,
  defects,
  pairs,
  claims,
  paper,
  scenes,
  detectors,
  machine,
  words,
];

/** Of a run of hard cases alone, these are the answer. */
const ordered = ({scenes: all, drawn: computed}: Page): Section[] =>
  all.length > 0 || computed
    ? kSections
    : [hard, defects, ...kSections.filter((s) => s !== hard && s !== defects)];

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
  show(page, bytes, place);
  document.title = `contactcheck: ${page.title}`;
  addEventListener("hashchange", openTarget);
  openTarget();
}

main().catch((error: unknown) => {
  document.getElementById("report")!.textContent = `This report cannot be shown: ${String(error)}`;
});
