// The place of the 3D view. Whoever bundles one says so with provideView(); without one, or without
// recordings in the page, there is no section for it, and tables have no buttons that lead there.

/** What the page knows of the scenes, and the bytes do not hold. */
export interface ViewContext {
  title(scene: string): string;
  /** The value of each frame, of scenes whose frames are cases and no moments. */
  cases: Map<string, string[]>;
  /** The command that shrinks a pair, but for its level and kind; "" for a transient detector. */
  reduce(detector: string, recording: string): string;
  /**
   * Of frames that `contactcheck check` has chosen out of many: what each is called, and what is said
   * of it.
   */
  chosen?: {names: string[]; words: string[][]};
}

export interface ViewTarget {
  scene: string;
  detector?: string;
  frame: number;
  pair?: [number, number, number, number];
  level?: string;
  kind?: "missed" | "spurious";
}

export interface View {
  /** Whether it holds the scene: some are left out. */
  has(scene: string): boolean;
  show(target: ViewTarget): void;
}

export type MountView = (
  place: HTMLElement,
  context: ViewContext,
  bytes: ArrayBuffer,
) => View | null;

let provided: MountView | null = null;
let view: View | null = null;

export function provideView(mount: MountView): void {
  provided = mount;
}

export const canHaveView = (): boolean => provided !== null;
/** Whether a scene can be shown, once the page stands. */
export const canShow = (scene: string): boolean => view?.has(scene) ?? false;

/** @pre canHaveView(); `place` is in the document */
export function mountInto(place: HTMLElement, context: ViewContext, bytes: ArrayBuffer): void {
  view = provided!(place, context, bytes);
}

/**
 * Goes to the 3D view, which shows that contact: the pair, or the first of that kind in the frame.
 * @pre canShow(target.scene)
 */
export function showInView(target: ViewTarget): void {
  view!.show(target);
  document.getElementById("view")?.scrollIntoView({block: "start"});
}
