// The scenes in 3D, where the page holds their recordings.
import {h} from "../dom";
import type {Page} from "../page";
import type {Section} from "../section";
import {canHaveView, mountInto, type ViewContext} from "../view_slot";

function contextOf({scenes, families, detectors, reduce, out}: Page): ViewContext {
  return {
    title: (scene) => [...scenes, ...families].find(({id}) => id === scene)?.title ?? scene,
    cases: new Map(families.map(({id, values}) => [id, values])),
    reduce(detector, recording) {
      const words = reduce[detectors.indexOf(detector)];
      return words && `contactcheck reduce ${out}/recordings/${recording} ${words}`;
    },
  };
}

/** The place of the view, which is drawn once it stands in the page and has a size. */
export function viewPlace(context: ViewContext, bytes: ArrayBuffer): HTMLElement {
  const place = h("div", {class: "view-place", "aria-busy": "true"});
  requestAnimationFrame(() => {
    try {
      mountInto(place, context, bytes);
    } catch (error) {
      place.textContent = `The 3D view cannot be shown: ${String(error)}`;
    }
    place.removeAttribute("aria-busy");
  });
  return place;
}

export const view: Section = {
  id: "view",
  title: "Scenes in 3D",
  short: "3D view",
  build(page, bytes) {
    return bytes && canHaveView() ? [viewPlace(contextOf(page), bytes)] : [];
  },
};
