// Reads the container of reference/report/formats/view_bytes.h. Arrays are views into it: nothing is copied.
import type {ArrayReference, Numbers, SceneHeader} from "./types";

const kMagic = "CCVIEW1\n";

export interface LeftOut {
  scene: string;
  why: string;
}

export class Container {
  readonly scenes: SceneHeader[];
  readonly leftOut: LeftOut[];
  private readonly arrays: number;

  /** @throws Error when the bytes are no such container */
  constructor(private readonly bytes: ArrayBuffer) {
    const text = new TextDecoder();
    const start = kMagic.length + 4;
    if (bytes.byteLength < start || text.decode(bytes.slice(0, kMagic.length)) !== kMagic)
      throw new Error("the 3D view's data are damaged");
    const size = new DataView(bytes).getUint32(kMagic.length, true);
    const header = JSON.parse(text.decode(new Uint8Array(bytes, start, size)));
    this.scenes = header.scenes;
    this.leftOut = header.left_out;
    this.arrays = start + size;
  }

  /** @pre the machine is little-endian, as all that run a browser are */
  array(scene: SceneHeader, {type, at, count}: ArrayReference): Numbers {
    const start = this.arrays + scene.base + at;
    if (type === "f32") return new Float32Array(this.bytes, start, count);
    if (type === "u16") return new Uint16Array(this.bytes, start, count);
    return new Uint32Array(this.bytes, start, count);
  }
}
