// Lattices, FFD-AABBs and bounding spheres of the frame, each built when it is switched on.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshBasicMaterial,
  type Object3D,
  SphereGeometry,
} from "three";
import type {Colours} from "./colours";
import {dispose} from "./dispose";
import type {SceneModel} from "./scene_model";
import type {Sphere} from "./shape";

export const kBounds = ["lattice", "boxes", "spheres1", "spheres2"] as const;
export type BoundsKind = (typeof kBounds)[number];

/** Corners of a hexahedron at both ends of each of its twelve edges. */
export const kEdges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((corner) =>
  [1, 2, 4].filter((bit) => !(corner & bit)).map((bit) => [corner, corner | bit] as const),
);

const kCircleSteps = 48;

function lines(positions: number[], material: LineBasicMaterial): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  const out = new LineSegments(geometry, material);
  out.frustumCulled = false;
  return out;
}

function hexahedra(
  all: Float64Array[],
  origin: number[],
  material: LineBasicMaterial,
): LineSegments {
  const positions: number[] = [];
  for (const corners of all)
    for (const edge of kEdges)
      for (const c of edge)
        for (let k = 0; k < 3; ++k) positions.push(corners[3 * c + k] - origin[k]);
  return lines(positions, material);
}

// Three great circles each: enough to see where a sphere ends, and through it.
function circles(spheres: Sphere[], origin: number[], material: LineBasicMaterial): LineSegments {
  const positions: number[] = [];
  for (const {center, radius} of spheres)
    for (let axis = 0; axis < 3; ++axis)
      for (let step = 0; step < kCircleSteps; ++step)
        for (const end of [step, step + 1]) {
          const angle = (2 * Math.PI * end) / kCircleSteps;
          const point = center.map((value, k) => value - origin[k]);
          point[(axis + 1) % 3] += radius * Math.cos(angle);
          point[(axis + 2) % 3] += radius * Math.sin(angle);
          positions.push(...point);
        }
  return lines(positions, material);
}

function balls(spheres: Sphere[], origin: number[], colours: Colours): InstancedMesh {
  const material = new MeshBasicMaterial({
    color: colours.sphere,
    transparent: true,
    opacity: 0.04,
    depthWrite: false,
    side: DoubleSide,
  });
  const mesh = new InstancedMesh(new SphereGeometry(1, 32, 20), material, spheres.length);
  spheres.forEach(({center, radius}, i) => {
    const at = center.map((value, k) => value - origin[k]);
    mesh.setMatrixAt(
      i,
      new Matrix4().makeScale(radius, radius, radius).setPosition(at[0], at[1], at[2]),
    );
  });
  mesh.frustumCulled = false;
  return mesh;
}

export class Bounds {
  readonly group = new Group();

  constructor(private readonly model: SceneModel) {}

  update(shown: Set<BoundsKind>, origin: number[], colours: Colours): void {
    for (const child of [...this.group.children]) dispose(child);
    for (const kind of kBounds)
      if (shown.has(kind)) this.group.add(this.make(kind, origin, colours));
  }

  dispose(): void {
    dispose(this.group);
  }

  private make(kind: BoundsKind, origin: number[], colours: Colours): Object3D {
    if (kind === "lattice") {
      const all = this.hexahedraOf((shape, nodes, cell) => shape.cellCorners(nodes, cell));
      return hexahedra(
        all,
        origin,
        new LineBasicMaterial({color: colours.line, transparent: true, opacity: 0.55}),
      );
    }
    if (kind === "boxes") {
      const all = this.hexahedraOf((shape, nodes, cell) => shape.boxCorners(nodes, cell));
      return hexahedra(all, origin, new LineBasicMaterial({color: colours.box}));
    }
    const spheres = this.model.header.bodies.flatMap((_, b) =>
      this.model
        .shapeOf(b)
        .spheres(this.model.nodesOf(b), kind === "spheres1" ? 1 : 2, this.model.placement.scale),
    );
    const material = new LineBasicMaterial({
      color: colours.sphere,
      transparent: true,
      opacity: 0.6,
    });
    return new Group().add(circles(spheres, origin, material), balls(spheres, origin, colours));
  }

  private hexahedraOf(
    corners: (
      shape: SceneModel["shapes"][number],
      nodes: Float32Array,
      cell: number,
    ) => Float64Array,
  ): Float64Array[] {
    return this.model.header.bodies.flatMap((_, b) => {
      const shape = this.model.shapeOf(b),
        nodes = this.model.nodesOf(b);
      return Array.from({length: shape.cells}, (_unused, cell) => corners(shape, nodes, cell));
    });
  }
}
