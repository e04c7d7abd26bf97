import {Mesh, type Object3D} from "three";

/** Takes an object out of the scene and frees what it has on the graphics card. */
export function dispose(object: Object3D): void {
  object.removeFromParent();
  object.traverse((part) => {
    const {geometry, material} = part as Mesh;
    geometry?.dispose();
    for (const one of Array.isArray(material) ? material : [material]) one?.dispose();
    if ("dispose" in part && typeof part.dispose === "function") part.dispose();
  });
}
