// The map of a field: a plane of colours through the bodies, seen through whatever stands before it.
//
// A texel is a point of the grid, and the colours between points are those in between. The range of colours is that of
// the maps known so far, so that colours keep their meaning from sample to sample. Towards zero they fade, and
// where there is little mass: where nothing is, there is no colour.

import {
  DataTexture,
  DoubleSide,
  LinearFilter,
  Matrix4,
  Mesh,
  PlaneGeometry,
  RGBAFormat,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import { type FieldMap, type Fields, unitsOf } from "../data/fields";
import type { Vec3 } from "../data/header";
import { between, type Rgb, TWO_SIDED, VIRIDIS } from "../math/colors";
import type { Scale } from "./coloring";

/** A sign with less than this part of the range is scatter about zero. */
const SMALLEST_SIDE = 0.1;
/** How much of a pixel is the map's. */
const OPACITY = 0.74;
/** Numbers below this part of the largest are fainter the smaller they are, and so is where the density is. */
const FAINT = 0.3;
/** Colours of a scale. */
const STOPS = 40;

const VERTEX = /* glsl */ `
uniform vec2 margin;
varying vec2 vPlace;
void main() {
	vec2 place = position.xy + 0.5;
	vPlace = mix( margin, 1.0 - margin, place );
	gl_Position = projectionMatrix * ( modelViewMatrix * vec4( place, 0.0, 1.0 ) );
}`;

const FRAGMENT = /* glsl */ `
uniform sampler2D map;
uniform float opacity;
varying vec2 vPlace;
void main() {
	vec4 found = texture2D( map, vPlace );
	gl_FragColor = vec4( found.rgb, opacity * found.a );
}`;

/** A range of colours: symmetric about zero where both signs count. */
export function evened([low, high]: [number, number]): [number, number] {
  const most = Math.max(high, -low);
  if (low < 0 && high > 0 && Math.min(high, -low) > SMALLEST_SIDE * most) return [-most, most];
  return high - low > 1e-9 * most ? [low, high] : [low - 0.5 * most, high + 0.5 * most];
}

/** The colours along a range. */
export function colorsAlong([low, high]: [number, number]): Rgb[] {
  return low === -high ? TWO_SIDED : VIRIDIS;
}

/** The texels of numbers where there is a density, in any unit; none where there is no number. */
export function texelsOf(
  values: Float32Array,
  range: [number, number],
  density: Float32Array = values.map(() => 1),
): Uint8Array {
  const texels = new Uint8Array(4 * values.length);
  const [low, high] = range;
  const most = Math.max(high, -low);
  const densest = density.reduce((most, each) => Math.max(most, each), 0);
  const colors = colorsAlong(range);
  values.forEach((value, k) => {
    const isNumber = Number.isFinite(value);
    const known = isNumber ? value : 0;
    const color = between(colors, (known - low) / (high - low));
    const clear = Math.min(Math.abs(known) / most, densest > 0 ? density[k] / densest : 1);
    const shown = isNumber ? Math.min(1, clear / FAINT) : 0;
    texels.set(
      [...color, shown].map((part) => Math.round(255 * part)),
      4 * k,
    );
  });
  return texels;
}

/** The colours of a range as a CSS gradient. */
export function gradientOf([low, high]: [number, number]): string {
  const along = Float32Array.from({ length: STOPS }, (_, k) => low + ((high - low) * k) / (STOPS - 1));
  const texels = texelsOf(along, [low, high]);
  const stops = Array.from(along, (_, k) => {
    const [r, g, b, shown] = texels.subarray(4 * k, 4 * k + 4);
    return `rgb(${r} ${g} ${b} / ${(shown / 255).toFixed(2)})`;
  });
  return `linear-gradient(to right, ${stops.join(", ")})`;
}

/** What is drawn, and by which it is known again. */
interface Drawn {
  map: FieldMap;
  key: string;
  low: number;
  high: number;
}

export class FieldLayer {
  readonly mesh: Mesh;
  /** What of the last frame is drawn. */
  scale: Scale | null = null;
  private readonly material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { map: { value: null }, margin: { value: new Vector2() }, opacity: { value: OPACITY } },
    transparent: true,
    depthTest: false,
    depthWrite: false,
    side: DoubleSide,
  });
  private texture: DataTexture | null = null;
  private drawn: Drawn | null = null;

  constructor(private readonly fields: Fields | null) {
    this.mesh = new Mesh(new PlaneGeometry(1, 1), this.material);
    this.mesh.matrixAutoUpdate = false;
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = 3;
  }

  /** Shows the map of a sample, or the one before while it is on its way, lest a picture that plays flickers. */
  place(row: number): void {
    const { fields } = this;
    const found = fields?.shown ? fields.at(row) : null;
    const map = found ?? (fields?.shown && fields.isLoading ? (this.drawn?.map ?? null) : null);
    const known = map && fields ? fields.range(fields.key) : null;
    this.mesh.visible = known !== null;
    this.scale = null;
    if (!fields || !map || !known) return;
    const index = Math.max(
      0,
      map.fields.findIndex(({ key }) => key === fields.key),
    );
    const [low, high] = evened(known);
    const field = map.fields[index];
    this.scale = { title: titleOf(field.name), units: unitsOf(field), low, high };
    const { drawn } = this;
    if (drawn?.map === map && drawn.key === fields.key && drawn.low === low && drawn.high === high) return;
    this.drawn = { map, key: fields.key, low, high };
    const density = map.values[map.fields.findIndex(({ key }) => key === "density")];
    this.draw(map, texelsOf(map.values[index], [low, high], density));
  }

  private draw({ counts, origin, across, up }: FieldMap, texels: Uint8Array): void {
    const { material, mesh } = this;
    this.texture?.dispose();
    this.texture = new DataTexture(texels, counts[0], counts[1], RGBAFormat);
    this.texture.magFilter = this.texture.minFilter = LinearFilter;
    this.texture.needsUpdate = true;
    material.uniforms.map.value = this.texture;
    material.uniforms.margin.value.set(0.5 / counts[0], 0.5 / counts[1]);
    const [x, y] = [vector(across), vector(up)];
    mesh.matrix = new Matrix4().makeBasis(x, y, x.clone().cross(y).normalize()).setPosition(vector(origin));
    mesh.matrixWorldNeedsUpdate = true;
  }

  dispose(): void {
    this.texture?.dispose();
    this.material.dispose();
    this.mesh.geometry.dispose();
  }
}

function titleOf(name: string): string {
  return name.charAt(0).toUpperCase() + name.slice(1);
}

function vector(parts: Vec3): Vector3 {
  return new Vector3(...parts);
}
