// The frames of a scene: a slider, a strip that says where something was missed or made up, and play.
import {h, s} from "../dom";
import type {DetectorContacts, SceneHeader} from "./types";

const kCaseStep = 700; // ms: each case is a picture of its own
const kShortestStep = 40; // ms: no faster than a software renderer draws

const kStripHeight = 22;

export interface FrameWords {
  /** The value of each frame, where frames are cases and no moments. */
  cases?: string[];
  /** What each is called, where they are some of many. */
  names?: string[];
}

export class FrameBar {
  readonly element: HTMLElement;
  private readonly slider = h("input", {
    type: "range",
    min: 0,
    step: 1,
    value: 0,
    "aria-label": "Frame",
  });
  private readonly strip = s("svg", {
    class: "view-strip",
    "aria-hidden": "true",
    preserveAspectRatio: "none",
  });
  private readonly text = h("output", {class: "view-frame"});
  private readonly play = h(
    "button",
    {type: "button", "aria-label": "Play", click: () => this.toggle()},
    "▶",
  );
  private scene: SceneHeader | null = null;
  private words: FrameWords = {};
  private timer: number | undefined;

  constructor(private readonly onFrame: (frame: number) => void) {
    this.slider.addEventListener("input", () => {
      this.stop();
      onFrame(Number(this.slider.value));
    });
    this.element = h(
      "div",
      {class: "view-frames"},
      this.play,
      h("div", {class: "view-slider"}, this.strip, this.slider),
      this.text,
    );
  }

  fill(scene: SceneHeader, detector: DetectorContacts | undefined, words: FrameWords): void {
    this.scene = scene;
    this.words = words;
    this.slider.max = String(scene.frames - 1);
    this.play.disabled = scene.frames < 2;
    this.strip.setAttribute("viewBox", `0 0 ${Math.max(1, scene.frames)} ${kStripHeight}`);
    this.strip.replaceChildren(...this.bars(scene, detector));
  }

  set frame(frame: number) {
    this.slider.value = String(frame);
    const {frames, time_step} = this.scene!,
      {cases, names} = this.words;
    const value = cases?.[frame];
    const words =
      names?.[frame] ??
      `${cases ? "case" : "frame"} ${frame} of 0 to ${frames - 1}${value === undefined ? "" : `, value ${value}`}`;
    this.slider.setAttribute("aria-valuetext", words);
    this.text.textContent =
      time_step > 0 && !cases && !names ? `${words}, ${(frame * time_step).toFixed(2)} s` : words;
  }

  stop(): void {
    window.clearTimeout(this.timer);
    this.timer = undefined;
    this.play.textContent = "▶";
    this.play.setAttribute("aria-label", "Play");
  }

  private toggle(): void {
    if (this.timer !== undefined) return this.stop();
    this.play.textContent = "❚❚";
    this.play.setAttribute("aria-label", "Pause");
    this.step();
  }

  private step(): void {
    const {frames, time_step} = this.scene!,
      {cases, names} = this.words,
      pause = cases || names ? kCaseStep : Math.max(kShortestStep, 1000 * time_step);
    this.onFrame((Number(this.slider.value) + 1) % frames);
    this.timer = window.setTimeout(() => this.step(), pause);
  }

  // True contacts below, missed and spurious ones above; heights by the largest count of the scene.
  private bars(scene: SceneHeader, detector: DetectorContacts | undefined): SVGRectElement[] {
    const most = Math.max(
      1,
      ...scene.truth.map(({count}) => count),
      ...(detector?.frames ?? []).flatMap(({missed, spurious}) => [missed.count, spurious.count]),
    );
    const bar = (
      kind: string,
      frame: number,
      count: number,
      at: number,
      width: number,
    ): SVGRectElement => {
      const height = count === 0 ? 0 : 3 + (kStripHeight - 3) * Math.sqrt(count / most);
      return s("rect", {
        class: `view-fill-${kind}`,
        x: frame + at,
        y: kStripHeight - height,
        width,
        height,
      });
    };
    return [
      ...scene.truth.map(({frame, count}) => bar("true", frame, count, 0.02, 0.94)),
      ...(detector?.frames ?? []).flatMap(({frame, missed, spurious}) => [
        bar("missed", frame, missed.count, 0.06, 0.4),
        bar("spurious", frame, spurious.count, 0.52, 0.4),
      ]),
    ];
  }
}
