// The place of the 3D view. Whoever bundles one says so with provideView(); without one, or without
// recordings in the page, there is no section for it, and tables have no buttons that lead there.
import type {Results} from "./results";

export interface ViewTarget {
  scene: string;
  detector?: string;
  frame: number;
  pair?: [number, number, number, number];
  level?: string;
  kind?: "missed" | "spurious";
}

export interface View {
  show(target: ViewTarget): void;
}

export type MountView = (place: HTMLElement, results: Results, bytes: ArrayBuffer) => View | null;

let provided: MountView | null = null;
let view: View | null = null;

export function provideView(mount: MountView): void {
  provided = mount;
}

export const canHaveView = (): boolean => provided !== null;
export const hasView = (): boolean => view !== null;

/** @pre canHaveView(); `place` is in the document */
export function mountInto(place: HTMLElement, results: Results, bytes: ArrayBuffer): void {
  view = provided!(place, results, bytes);
}

/** Goes to the 3D view, which shows that contact. @pre hasView() */
export function showInView(target: ViewTarget): void {
  view!.show(target);
  document.getElementById("view")?.scrollIntoView({block: "start"});
}
