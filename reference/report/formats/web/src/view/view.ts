// The 3D view: any scene of the report, frame by frame, with the contacts that a detector missed or
// made up. It draws from the container alone, which was made from recordings and contacts files.
import {code, h} from "../dom";
import type {ViewContext} from "../view_slot";
import {Bodies} from "./bodies";
import {Bounds, kBounds} from "./bounds";
import {type Colours, onColoursChange, readColours} from "./colours";
import {Container} from "./container";
import {dispose} from "./dispose";
import {FrameBar} from "./frame_bar";
import {makeMarks, type MarkKind} from "./marks";
import {PairTable, pairWords} from "./pair_table";
import {mostInteresting, Panel} from "./panel";
import {
  centroid,
  kTrianglePair,
  listedPairs,
  type PairGeometry,
  reach,
  SceneModel,
} from "./scene_model";
import {kOverview, makeStage, type Stage} from "./stage";
import {Vector3} from "three";
import type {Elements, Kind, ListedPair, Pair, View, ViewState, ViewTarget} from "./types";

export type {ListedPair, View, ViewState, ViewTarget} from "./types";

// A pair is shown with its surroundings: this many times its own size.
const kPairMargin = 3.2;
// Where a pair has no size (a vertex), and so that no camera goes closer than it could see.
const kSmallestShare = 1e-6,
  kVertexShare = 0.04;

const same = (a: Pair, b: Pair): boolean => a.every((value, i) => value === b[i]);

class SceneViewer implements View {
  private readonly canvas = h("canvas", {class: "view-canvas", tabindex: 0, role: "img"});
  private readonly message = h("p", {class: "view-message", "aria-live": "polite"});
  private readonly table = new PairTable((pair) => this.show(pair));
  private readonly frames = new FrameBar((frame) => this.goTo(frame));
  private readonly panel: Panel;
  private readonly stage: Stage | null;
  private colours: Colours;
  private model: SceneModel;
  private bodies: Bodies;
  private bounds: Bounds;
  private marks: ReturnType<typeof makeMarks>[] = [];
  private detector = "";
  private pairs: ListedPair[] = [];
  private chosen: ListedPair | null = null;
  private started = false;

  constructor(
    private readonly place: HTMLElement,
    private readonly context: ViewContext,
    private readonly container: Container,
  ) {
    this.panel = new Panel(container.scenes, context, {
      scene: (id) => this.show({scene: id, frame: busiestFrame(container, id)}),
      detector: (name) =>
        this.show({scene: this.model.header.id, frame: this.model.frame, detector: name}),
      layers: () => this.redraw(),
      overview: () => this.overview(),
    });
    place.classList.add("view3d");
    place.replaceChildren(...this.layout());
    this.colours = readColours(place);
    this.stage = makeStage(this.canvas, () => this.publish());
    if (!this.stage) this.canvas.replaceWith(noWebGl());
    this.model = new SceneModel(container, container.scenes[0]);
    this.bodies = new Bodies(this.model);
    this.bounds = new Bounds(this.model);
    onColoursChange(() => this.repaint());
    this.show({
      scene: container.scenes[0].id,
      frame: busiestFrame(container, container.scenes[0].id),
    });
    this.repaint();
  }

  show(target: ViewTarget): void {
    this.frames.stop();
    const fresh = this.enter(target.scene) || !this.started;
    this.started = true;
    this.choose(target.detector ?? (fresh ? mostInteresting(this.model.header) : this.detector));
    this.model.frame = Math.min(Math.max(0, target.frame), this.model.header.frames - 1);
    this.chosen = this.find(target);
    if (this.chosen) this.lookAtPair(this.chosen);
    else if (fresh) this.lookAtScene(kOverview);
    this.refresh();
  }

  has(scene: string): boolean {
    return this.container.scenes.some(({id}) => id === scene);
  }

  missedPairs(scene: string, detector?: string): ListedPair[] {
    const header = this.container.scenes.find(({id}) => id === scene);
    return header ? listedPairs(header, detector) : [];
  }

  state(): ViewState {
    const {origin, scale} = this.model.placement;
    const target = this.stage?.target() ?? [0, 0, 0];
    return {
      scene: this.model.header.id,
      detector: this.detector,
      frame: this.model.frame,
      frames: this.model.header.frames,
      pair: this.chosen?.pair ?? null,
      target: [0, 1, 2].map((k) => origin[k] + scale * target[k]) as [number, number, number],
      distance: scale * (this.stage?.distance() ?? 0),
      drawn: this.stage?.drawn ?? 0,
    };
  }

  private layout(): HTMLElement[] {
    const help =
      "Turn with the mouse, one finger or the arrow keys; zoom with + and -, two fingers or, " +
      "once the picture has been clicked, the wheel; move it with the right button.";
    return [
      this.panel.element,
      h(
        "div",
        {class: "view-stage"},
        h("div", {class: "view-picture"}, this.canvas),
        this.frames.element,
        this.message,
        h("p", {class: "view-help"}, help),
        ...leftOut(this.container),
      ),
      this.table.element,
    ];
  }

  /** @returns whether the scene is another one than before */
  private enter(id: string): boolean {
    if (this.model.header.id === id) return false;
    const header = this.container.scenes.find((scene) => scene.id === id);
    if (!header) throw new Error(`the 3D view has no scene "${id}"`);
    this.bodies.dispose();
    this.bounds.dispose();
    this.model = new SceneModel(this.container, header);
    this.bodies = new Bodies(this.model);
    this.bounds = new Bounds(this.model);
    this.bodies.paint(this.colours);
    return true;
  }

  private choose(detector: string): void {
    this.detector = detector;
    const {header} = this.model;
    this.panel.show(header, detector);
    const {cases, chosen} = this.context;
    this.frames.fill(header, this.model.detector(detector), {
      cases: cases.get(header.id),
      names: chosen?.names,
    });
    this.pairs = detector === "" ? [] : listedPairs(header, detector);
    this.table.element.hidden = this.pairs.length === 0;
    this.table.fill(header, this.pairs, `Missed and spurious pairs of ${detector}`);
  }

  private goTo(frame: number): void {
    this.model.frame = frame;
    if (this.chosen && this.chosen.frame !== frame) this.chosen = null;
    this.refresh();
  }

  private overview(): void {
    this.chosen = null;
    this.lookAtScene(kOverview);
    this.refresh();
  }

  private find({frame, kind, pair}: ViewTarget): ListedPair | null {
    if (!pair && !kind) return null;
    return (
      this.pairs.find(
        (listed) =>
          listed.frame === frame &&
          (!pair || same(listed.pair, pair)) &&
          (!kind || listed.kind === kind),
      ) ?? null
    );
  }

  private lookAtScene(direction: Vector3): void {
    if (!this.stage) return;
    const {center, radius} = this.model.extent();
    this.stage.radius = radius;
    this.stage.look(center, 0.85 * radius, direction);
  }

  private lookAtPair({pair, elements}: ListedPair): void {
    if (!this.stage) return;
    const geometry = this.model.geometry(pair, elements),
      center = centroid(geometry);
    const {radius} = this.model.extent();
    const size = reach(geometry, center);
    this.stage.radius = radius;
    const wanted = size > 0 ? kPairMargin * size : kVertexShare * radius;
    this.stage.look(
      center,
      Math.max(wanted, kSmallestShare * radius),
      viewingDirection(geometry, this.stage.direction()),
    );
  }

  // Everything that follows from scene, frame, pair and detector.
  private refresh(): void {
    this.frames.frame = this.model.frame;
    this.table.select(this.chosen);
    this.message.replaceChildren(...this.words());
    this.canvas.setAttribute(
      "aria-label",
      `3D view of ${this.model.header.id}, frame ${this.model.frame}`,
    );
    this.publish();
    this.redraw();
  }

  private redraw(): void {
    if (!this.stage) return;
    const {shown} = this.panel;
    this.bodies.update(this.stage.origin);
    this.bodies.dim(this.chosen !== null);
    this.bodies.group.visible = shown.has("bodies");
    this.bounds.update(
      new Set(kBounds.filter((kind) => shown.has(kind))),
      this.stage.origin,
      this.colours,
    );
    this.marks.forEach(dispose);
    this.marks = this.makeMarks(this.stage.origin);
    this.stage.content.add(this.bodies.group, this.bounds.group, ...this.marks);
    this.stage.invalidate();
  }

  private makeMarks(origin: number[]): ReturnType<typeof makeMarks>[] {
    const elements: Record<MarkKind, Elements> = {
      true: kTrianglePair,
      missed: kTrianglePair,
      spurious: kTrianglePair,
      ...this.model.detector(this.detector)?.elements,
    };
    const {chosen} = this,
      drawn = new Set<string>();
    const missed = this.model.differences(this.detector, "missed"),
      keys = new Set(missed.map(String));
    const make = (kind: MarkKind, pairs: Pair[]) =>
      makeMarks(
        pairs.map((pair) => this.model.geometry(pair, elements[kind])),
        origin,
        {kind, color: this.colours[kind], selected: false, dimmed: chosen !== null},
        drawn,
      );
    const others = (kind: Kind, pairs: Pair[]): Pair[] =>
      pairs.filter((pair) => !(chosen && chosen.kind === kind && same(chosen.pair, pair)));
    // Boxes about a missed pair would hide it.
    const spurious =
      chosen?.kind === "missed"
        ? []
        : others("spurious", this.model.differences(this.detector, "spurious"));
    // A missed pair is drawn as that alone. Pairs of other levels are no pairs of triangles.
    const trianglesMissed = elements.missed[0] === "triangle";
    const truth = this.model.truth().filter((pair) => !trianglesMissed || !keys.has(String(pair)));
    const {shown} = this.panel;
    return [
      // what matters most first: it takes the faces that others share with it
      ...(chosen ? this.chosenMarks(chosen, origin, drawn) : []),
      ...(shown.has("missed") ? [make("missed", others("missed", missed))] : []),
      ...(shown.has("spurious") ? [make("spurious", spurious)] : []),
      ...(shown.has("true") ? [make("true", truth)] : []),
    ];
  }

  // Its two elements have two colours; the second is drawn first, since no face is drawn twice.
  private chosenMarks(
    {pair, elements, kind}: ListedPair,
    origin: number[],
    drawn: Set<string>,
  ): ReturnType<typeof makeMarks>[] {
    const whole = this.model.geometry(pair, elements);
    const second = {
      triangles: whole.triangles.slice(-1),
      boxes: whole.boxes.slice(-1),
      points: [],
    };
    const style = {kind, selected: true, dimmed: false};
    const hasSecond = second.triangles.length + second.boxes.length > 0;
    return [
      ...(hasSecond
        ? [makeMarks([second], origin, {...style, color: this.colours.second, second: true}, drawn)]
        : []),
      makeMarks([whole], origin, {...style, color: this.colours[kind]}, drawn),
    ];
  }

  private words(): (Node | string)[] {
    const {frame, header} = this.model,
      place = this.context.cases.has(header.id) ? "case" : "frame";
    const cut = this.model.shapes.some((shape) => shape.cut)
      ? " The scene is too large for this page: only surfaces near its contacts are drawn."
      : "";
    const said = this.context.chosen?.words[frame];
    if (said) return [h("span", {}, ...said.map((text) => h("span", {class: "line"}, text))), cut];
    const start = `${place[0].toUpperCase()}${place.slice(1)} ${frame}`;
    if (this.chosen) {
      const [one, other] = pairWords(this.chosen, (body) => header.bodies[body].name);
      const {kind, level} = this.chosen;
      const cannotBeReduced =
        level === "vertex" || level === "containment" || level.startsWith("impact");
      const command =
        !cannotBeReduced && this.context.reduce(this.detector, `${header.id}.ccr@${frame}`);
      return [
        `${this.detector}, ${place} ${frame}, ${kind}: `,
        h("strong", {class: `view-${kind}`}, one),
        " and ",
        h("strong", {class: "view-second"}, other),
        ".",
        ...(command ? [code(`${command} --level ${level} --kind ${kind}`)] : []),
      ];
    }
    if (header.detectors.length === 0 && header.truth.length === 0)
      return [`${start}. The results list no contacts of this scene one by one.`];
    const truth = header.truth.find((entry) => entry.frame === frame)?.count ?? 0;
    const found = this.model.detector(this.detector)?.frames.find((entry) => entry.frame === frame);
    const differs =
      this.detector === ""
        ? ""
        : `; ${this.detector} misses ${found?.missed.count ?? 0} and makes up ${found?.spurious.count ?? 0}`;
    const listed = found
      ? [found.missed, found.spurious].some(({count, pairs}) => count > pairs.length / 4)
      : false;
    return [
      `${start}: ${truth} ${truth === 1 ? "pair of triangles touches" : "pairs of triangles touch"}${differs}${listed ? " (the first of them are drawn)" : ""}.`,
      cut,
    ];
  }

  private repaint(): void {
    this.colours = readColours(this.place);
    if (!this.stage) return;
    this.stage.background = this.colours.background;
    this.bodies.paint(this.colours);
    this.redraw();
  }

  // For tests and scripts that take pictures.
  private publish(): void {
    const {scene, frame, pair, target, drawn} = this.state();
    Object.assign(this.place.dataset, {
      scene,
      frame,
      pair: pair?.join(" ") ?? "",
      target: target.join(" "),
      drawn,
    });
  }
}

/** Where most is to be seen: most misses, then most contacts; the earliest such frame. */
function busiestFrame(container: Container, id: string): number {
  const scene = container.scenes.find((entry) => entry.id === id)!;
  const rank = new Array<number>(scene.frames).fill(0);
  for (const {frame, count} of scene.truth) rank[frame] += count;
  const differences =
    scene.detectors.find(({detector}) => detector === mostInteresting(scene))?.frames ?? [];
  for (const {frame, missed, spurious} of differences)
    rank[frame] += 1e6 * missed.count + spurious.count;
  return rank.reduce((best, value, frame) => (value > rank[best] ? frame : best), 0);
}

/** From the side that most of the pair's triangles face, near to where the camera was. */
function viewingDirection({triangles}: PairGeometry, before: Vector3): Vector3 {
  const out = new Vector3();
  for (const t of triangles) {
    const a = new Vector3(t[0], t[1], t[2]);
    const normal = new Vector3(t[3], t[4], t[5])
      .sub(a)
      .cross(new Vector3(t[6], t[7], t[8]).sub(a))
      .normalize();
    out.addScaledVector(normal, normal.dot(before) < 0 ? -1 : 1);
  }
  // Somewhat towards the old direction: never edge-on for both, and less of a jump.
  return out.lengthSq() > 0 ? out.normalize().addScaledVector(before, 0.5).normalize() : before;
}

function noWebGl(): HTMLElement {
  return h(
    "p",
    {class: "view-none"},
    "This browser gives no WebGL 2, which the 3D view needs; the list of pairs and everything else in this report work without it.",
  );
}

function leftOut({leftOut: scenes}: Container): HTMLElement[] {
  if (scenes.length === 0) return [];
  return [
    h(
      "details",
      {class: "view-left-out"},
      h(
        "summary",
        {},
        `Not in this view: ${scenes.length} ${scenes.length === 1 ? "scene" : "scenes"}`,
      ),
      h("ul", {}, ...scenes.map(({scene, why}) => h("li", {}, `${scene}: ${why}`))),
    ),
  ];
}

/**
 * Fills `place` with the view. `bytes`: the container of reference/report/formats/view_bytes.h.
 * @returns null when none of its scenes could be taken in; `place` then says why
 * @throws Error when the bytes are damaged
 */
export function mountView(
  place: HTMLElement,
  context: ViewContext,
  bytes: ArrayBuffer,
): View | null {
  const container = new Container(bytes);
  if (container.scenes.length === 0) {
    place.replaceChildren(...leftOut(container));
    return null;
  }
  const view = new SceneViewer(place, context, container);
  (window as unknown as {contactcheckView: View}).contactcheckView = view;
  return view;
}
