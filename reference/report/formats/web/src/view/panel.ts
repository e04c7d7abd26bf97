// What is shown: scene, detector, and the layers, with the legend of the marks.
import {h} from "../dom";
import {type BoundsKind, kBounds} from "./bounds";
import type {MarkKind} from "./marks";
import type {ViewContext} from "../view_slot";
import type {DetectorContacts, SceneHeader} from "./types";

export type Layer = "bodies" | BoundsKind | MarkKind;

const kLabels: Record<Layer, string> = {
  bodies: "bodies",
  lattice: "lattice",
  boxes: "FFD-AABBs",
  spheres1: "spheres, level 1",
  spheres2: "spheres, level 2",
  true: "true contacts",
  missed: "missed",
  spurious: "spurious",
};
const kMarks: [MarkKind, string][] = [
  ["true", "●"],
  ["missed", "✕"],
  ["spurious", "□"],
];

export interface PanelEvents {
  scene(id: string): void;
  detector(name: string): void;
  layers(): void;
  overview(): void;
}

const sum = (contacts: DetectorContacts, kind: "missed" | "spurious"): number =>
  contacts.frames.reduce((total, frame) => total + frame[kind].count, 0);

function detectorWords(contacts: DetectorContacts): string {
  const missed = sum(contacts, "missed"),
    spurious = sum(contacts, "spurious");
  if (missed + spurious === 0) return `${contacts.detector}: all right`;
  return `${contacts.detector}: ${missed} missed, ${spurious} spurious (${contacts.level})`;
}

export class Panel {
  readonly element: HTMLElement;
  readonly shown = new Set<Layer>(["bodies", "true", "missed", "spurious"]);
  private readonly scenes = h("select", {"data-control": "scene"});
  private readonly detectors = h("select", {"data-control": "detector"});
  private readonly ofLattice: HTMLInputElement[] = [];

  constructor(scenes: SceneHeader[], {title, chosen}: ViewContext, events: PanelEvents) {
    this.scenes.append(...scenes.map(({id}) => h("option", {value: id, title: title(id)}, id)));
    this.scenes.addEventListener("change", () => events.scene(this.scenes.value));
    this.detectors.addEventListener("change", () => events.detector(this.detectors.value));
    // Chosen frames are of one scene, and of no detector that could be wrong.
    const marks = kMarks
      .slice(0, chosen ? 1 : undefined)
      .map(([kind, symbol]) =>
        this.box(
          kind,
          events,
          h("span", {class: `view-symbol view-${kind}`, "aria-hidden": "true"}, symbol),
          chosen ? "contacts" : undefined,
        ),
      );
    this.element = h(
      "div",
      {class: "view-panel"},
      ...(chosen
        ? []
        : [
            h("label", {}, h("span", {}, "Scene"), this.scenes),
            h("label", {}, h("span", {}, "Contacts of"), this.detectors),
          ]),
      h("fieldset", {}, h("legend", {}, "Contacts"), ...marks),
      h(
        "fieldset",
        {},
        h("legend", {}, "Show"),
        this.box("bodies", events),
        ...(chosen ? [] : kBounds.map((kind) => this.box(kind, events))),
      ),
      h("button", {type: "button", click: () => events.overview()}, "Whole scene"),
    );
  }

  show(scene: SceneHeader, detector: string): void {
    this.scenes.value = scene.id;
    const options = scene.detectors.map((contacts) =>
      h("option", {value: contacts.detector}, detectorWords(contacts)),
    );
    this.detectors.replaceChildren(h("option", {value: ""}, "the truth alone"), ...options);
    this.detectors.value = detector;
    const lattice = scene.shapes.some((shape) => shape.lattice);
    for (const input of this.ofLattice) input.disabled = !lattice;
  }

  private box(
    layer: Layer,
    events: PanelEvents,
    symbol?: Node,
    label = kLabels[layer],
  ): HTMLElement {
    const input = h("input", {
      type: "checkbox",
      checked: this.shown.has(layer),
      "data-layer": layer,
    });
    if ((kBounds as readonly string[]).includes(layer)) this.ofLattice.push(input);
    input.addEventListener("change", () => {
      if (input.checked) this.shown.add(layer);
      else this.shown.delete(layer);
      events.layers();
    });
    return h("label", {}, input, symbol ?? null, ` ${label}`);
  }
}

/** The detector that has most to show: most missed pairs, then most spurious ones; "" for none. */
export function mostInteresting(scene: SceneHeader): string {
  const rank = (contacts: DetectorContacts): number =>
    1e6 * sum(contacts, "missed") + sum(contacts, "spurious");
  const best = scene.detectors.reduce<DetectorContacts | null>(
    (found, contacts) => (!found || rank(contacts) > rank(found) ? contacts : found),
    null,
  );
  return best && rank(best) > 0 ? best.detector : "";
}
