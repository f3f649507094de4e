// How much may be drawn. A processor that stands in for a graphics card pays for every pixel; so does an old phone.

import type { WebGLRenderer } from "three";

export interface Quality {
  pixelRatio: number;
  antialias: boolean;
  shadows: boolean;
  shadowMap: number;
  /** Triangles of all bodies together. */
  triangles: number;
}

const FULL: Quality = {
  pixelRatio: 2,
  antialias: true,
  shadows: true,
  shadowMap: 2048,
  triangles: 3_000_000,
};
const MODEST: Quality = {
  pixelRatio: 1,
  antialias: true,
  shadows: true,
  shadowMap: 1024,
  triangles: 150_000,
};

/** Names of renderers that compute on the processor. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** What suits the machine behind a context. */
export function qualityFor(context: WebGLRenderingContext | WebGL2RenderingContext): Quality {
  return isSoftware(context) ? { ...MODEST } : { ...FULL };
}

function isSoftware(context: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  return typeof name === "string" && SOFTWARE.test(name);
}

/** Frames slower than this while playing [ms] cost pixels. */
const SLOW_MS = 50;

/** Watches how long frames take while playing and gives up pixels, then shadows, where they take long. */
export class Thrift {
  private slow = 0;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly quality: Quality,
  ) {}

  /** After a frame that took so long [ms]; returns whether something was given up. */
  saw(frame: number): boolean {
    this.slow = frame > SLOW_MS ? this.slow + 1 : Math.max(0, this.slow - 1);
    if (this.slow < 8) return false;
    this.slow = 0;
    const { quality, renderer } = this;
    if (quality.pixelRatio > 0.75) {
      quality.pixelRatio = Math.max(0.75, quality.pixelRatio / 1.5);
      renderer.setPixelRatio(Math.min(quality.pixelRatio, devicePixelRatio));
      return true;
    }
    if (quality.shadows) {
      quality.shadows = false;
      return true;
    }
    return false;
  }
}
