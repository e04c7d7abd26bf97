// The controls above charts: the browser's own, so that keyboards and screen readers know them.
import {h} from "./dom";
import type {Regime} from "./page";

export type Option = [value: string, text: string];

export function select(
  label: string,
  options: Option[],
  value: string,
  onChange: (value: string) => void,
): HTMLElement {
  const box = h("select", {}, ...options.map(([v, text]) => h("option", {value: v}, text)));
  box.value = value;
  box.addEventListener("change", () => onChange(box.value));
  return h("label", {class: "control"}, h("span", {}, label), box);
}

/** One of `words`, by its place. */
export function selectPlace(
  label: string,
  words: string[],
  place: number,
  onChange: (place: number) => void,
): HTMLElement {
  const options = words.map((text, i): Option => [String(i), text]);
  return select(label, options, String(place), (value) => onChange(Number(value)));
}

let groups = 0;

export function radios(
  label: string,
  options: Option[],
  value: string,
  onChange: (value: string) => void,
): HTMLElement {
  const name = `choice-${++groups}`;
  const items = options.map(([v, text]) => {
    const input = h("input", {type: "radio", name, value: v, checked: v === value});
    input.addEventListener("change", () => onChange(v));
    return h("label", {}, input, text);
  });
  return h("fieldset", {class: "control radios"}, h("legend", {}, label), ...items);
}

export const regimes = (value: Regime, onChange: (value: Regime) => void): HTMLElement =>
  radios(
    "Timed",
    [
      ["playback", "playback"],
      ["cold", "cold"],
    ],
    value,
    (chosen) => onChange(chosen as Regime),
  );

/** Any of `options`, at most `most` of them. */
export function checkboxes(
  label: string,
  options: string[],
  chosen: string[],
  most: number,
  onChange: (chosen: string[]) => void,
): HTMLElement {
  const inputs = options.map((name) =>
    h("input", {type: "checkbox", checked: chosen.includes(name)}),
  );
  const update = (): void => {
    const now = options.filter((_, i) => inputs[i].checked);
    inputs.forEach((input) => (input.disabled = now.length >= most && !input.checked));
    onChange(now);
  };
  inputs.forEach((input) => input.addEventListener("change", update));
  const items = options.map((name, i) => h("label", {}, inputs[i], name));
  return h(
    "details",
    {class: "control checkboxes"},
    h("summary", {}, label),
    h("div", {class: "choices"}, ...items),
  );
}

export const controlBar = (...controls: (HTMLElement | null)[]): HTMLElement =>
  h("div", {class: "controls"}, ...controls);
