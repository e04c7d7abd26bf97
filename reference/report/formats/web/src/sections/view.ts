// The scenes in 3D, where the page holds their recordings.
import {h} from "../dom";
import type {Section} from "../section";
import {canHaveView, mountInto} from "../view_slot";

export const view: Section = {
  id: "view",
  title: "Scenes in 3D",
  short: "3D view",
  build(page, bytes) {
    if (!bytes || !canHaveView()) return [];
    const place = h("div", {class: "view-place", "aria-busy": "true"});
    // Once it stands in the page and has a size.
    requestAnimationFrame(() => {
      try {
        mountInto(place, page, bytes);
      } catch (error) {
        place.textContent = `The 3D view cannot be shown: ${String(error)}`;
      }
      place.removeAttribute("aria-busy");
    });
    return [place];
  },
};
