// The place of the 3D view. Whoever bundles one says so with provideView(); without one, or without
// recordings in the page, there is no section for it, and tables have no buttons that lead there.
import type {Page} from "./page";

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

export type MountView = (place: HTMLElement, page: Page, bytes: ArrayBuffer) => View | null;

let provided: MountView | null = null;
let view: View | null = null;

export function provideView(mount: MountView): void {
  provided = mount;
}

export const canHaveView = (): boolean => provided !== null;
/** Whether a scene can be shown, once the page stands. */
export const canShow = (scene: string): boolean => view?.has(scene) ?? false;

/** @pre canHaveView(); `place` is in the document */
export function mountInto(place: HTMLElement, page: Page, bytes: ArrayBuffer): void {
  view = provided!(place, page, bytes);
}

/**
 * Goes to the 3D view, which shows that contact: the pair, or the first of that kind in the frame.
 * @pre canShow(target.scene)
 */
export function showInView(target: ViewTarget): void {
  view!.show(target);
  document.getElementById("view")?.scrollIntoView({block: "start"});
}
