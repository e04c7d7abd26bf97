// Buttons in tables that lead to the 3D view.
import {h} from "./dom";
import type {Cell} from "./table";
import {showInView, type ViewTarget} from "./view_slot";

/** @pre canShow(target.scene) */
export function showCell(target: ViewTarget): Cell {
  const button = h(
    "button",
    {type: "button", class: "show", click: () => showInView(target)},
    "show",
  );
  return {text: "show", node: button};
}
