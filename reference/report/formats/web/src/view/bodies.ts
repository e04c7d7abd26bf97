// The bodies' surfaces, flat between their vertices as detectors and oracle judge them.
import {BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshLambertMaterial} from "three";
import type {Colours} from "./colours";
import {dispose} from "./dispose";
import type {SceneModel} from "./scene_model";

const kDimmedOpacity = 0.22;

export class Bodies {
  readonly group = new Group();
  private readonly meshes: Mesh<BufferGeometry, MeshLambertMaterial>[];

  constructor(private readonly model: SceneModel) {
    const indices = model.shapes.map((shape) => new BufferAttribute(shape.triangles, 1));
    this.meshes = model.header.bodies.map(({shape}, b) => {
      const geometry = new BufferGeometry();
      geometry.setIndex(indices[shape]);
      geometry.setAttribute(
        "position",
        new BufferAttribute(new Float32Array(3 * model.shapeOf(b).vertices), 3),
      );
      const mesh = new Mesh(
        geometry,
        new MeshLambertMaterial({flatShading: true, side: DoubleSide}),
      );
      mesh.frustumCulled = false; // bounds would have to be found anew in every frame
      return mesh;
    });
    if (this.meshes.length > 0) this.group.add(...this.meshes);
  }

  update(origin: number[]): void {
    this.meshes.forEach((mesh, b) => {
      const positions = mesh.geometry.getAttribute("position") as BufferAttribute;
      const vertices = this.model.verticesOf(b);
      for (let i = 0; i < vertices.length; ++i) positions.array[i] = vertices[i] - origin[i % 3];
      positions.needsUpdate = true;
    });
  }

  paint(colours: Colours): void {
    this.meshes.forEach((mesh, b) => mesh.material.color.copy(colours.body(b)));
  }

  /** Transparent, so that a pair inside of them is seen. */
  dim(dimmed: boolean): void {
    for (const {material} of this.meshes) {
      material.transparent = dimmed;
      material.opacity = dimmed ? kDimmedOpacity : 1;
      material.depthWrite = !dimmed;
      material.needsUpdate = true;
    }
  }

  dispose(): void {
    dispose(this.group);
  }
}
