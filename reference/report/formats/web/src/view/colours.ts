// Colours of the page's style sheet, as three.js wants them.
import {Color} from "three";

export interface Colours {
  background: Color;
  line: Color;
  box: Color;
  sphere: Color;
  true: Color;
  missed: Color;
  spurious: Color;
  /** Of the second element of the pair that was asked for. */
  second: Color;
  body(number: number): Color;
}

// Pale, so that contacts stand out; neighbours in the list differ in hue and lightness.
const kHues = [215, 40, 150, 330, 265, 95];

export function readColours(place: HTMLElement): Colours {
  const style = getComputedStyle(place);
  const color = (name: string): Color => new Color(style.getPropertyValue(name).trim());
  const background = color("--view-background");
  const dark = background.getHSL({h: 0, s: 0, l: 0}).l < 0.5;
  return {
    background,
    line: color("--view-lattice"),
    box: color("--view-box"),
    sphere: color("--view-sphere"),
    true: color("--view-true"),
    missed: color("--view-missed"),
    spurious: color("--view-spurious"),
    second: color("--view-second"),
    body: (number) => {
      const lightness = (dark ? 0.42 : 0.66) + (number % 2 ? -0.06 : 0.03);
      return new Color().setHSL(kHues[number % kHues.length] / 360, 0.16, lightness);
    },
  };
}

/** Calls when the page turns dark or light, by its own switch or the system's. */
export function onColoursChange(call: () => void): void {
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", call);
  new MutationObserver(call).observe(document.documentElement, {
    attributes: true,
    attributeFilter: ["data-theme"],
  });
}
