// Elements by name. Names of scenes and detectors are untrusted: children that are texts become text
// nodes, and nothing in this page is parsed as HTML but the pictures that the program drew, in which
// it has escaped them.

export type Child = Node | string | null | undefined | false;
type Value = string | number | boolean | null | undefined | ((event: Event) => void);

function setAttribute(element: Element, name: string, value: Value): void {
  if (typeof value === "function") element.addEventListener(name, value);
  else if (value === true) element.setAttribute(name, "");
  else if (value !== false && value !== null && value !== undefined)
    element.setAttribute(name, String(value));
}

/** A function as value listens to the event of that name; false, null and undefined are left out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) setAttribute(element, name, value);
  for (const child of children) if (child) element.append(child);
  return element;
}

export function s<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) setAttribute(element, name, value);
  for (const child of children) if (child) element.append(child);
  return element;
}

export const p = (...children: Child[]): HTMLElement => h("p", {}, ...children);
export const code = (text: string): HTMLElement => h("code", {}, text);

/** Closed at first; `build` is called when it is opened, so that what nobody reads costs nothing. */
export function unfolding(
  summary: Child,
  build: () => Child[],
  attributes: Record<string, Value> = {},
) {
  const details = h("details", attributes, h("summary", {}, summary));
  details.addEventListener("toggle", () => {
    if (details.open && details.childElementCount === 1)
      for (const child of build()) if (child) details.append(child);
  });
  return details;
}

/** A picture that the program drew, with colours of this page; a shadow root keeps its style its own. */
export function drawn(svg: string, click?: (event: MouseEvent) => void): HTMLElement {
  const place = h("div"),
    root = place.attachShadow({mode: "open"});
  root.innerHTML = svg;
  if (click) root.addEventListener("click", (event) => click(event as MouseEvent));
  return place;
}
