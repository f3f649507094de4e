// The materials of bodies: own shaders, small enough to compile fast and to run on a processor.
//
// Normals. A material element moves by P, its normal by the cofactor of P: n ∝ cof(P) N. Libraries divide by squared
// lengths of columns instead, which is wrong under shear. With P = (a | b | c) the cofactor is (b×c | c×a | a×b).
//
// Light. A sky that is bright above and dim below, a key light, and a weak one from the side of the camera.
//
// Octants. The eight octants about the centre of mass, in the axes of the body, differ a little in shade, so that a ball
// can be seen to turn and a shear to shear. Over them lies the pattern of the shape (`view/patterns.ts`).

import { ShaderMaterial, Vector3 } from "three";
import { MARKED, type Pattern } from "./patterns";

const VERTEX = /* glsl */ `
varying vec3 vReference, vNormal, vColor, vView;
void main() {
	mat3 P = mat3( instanceMatrix );
	vReference = position;
	vNormal = mat3( cross( P[ 1 ], P[ 2 ] ), cross( P[ 2 ], P[ 0 ] ), cross( P[ 0 ], P[ 1 ] ) ) * normal;
	vColor = vec3( 1.0 );
	#ifdef USE_INSTANCING_COLOR
		vColor = instanceColor;
	#endif
	vec4 place = modelMatrix * ( instanceMatrix * vec4( position, 1.0 ) );
	vView = cameraPosition - place.xyz;
	gl_Position = projectionMatrix * ( viewMatrix * place );
}`;

/** Takes the place of what a pattern marks. */
const PATTERN = "// pattern";

const FRAGMENT = /* glsl */ `
uniform vec3 up, key, fill, paper;
uniform float sky, opacity, contrast, pale;
varying vec3 vReference, vNormal, vColor, vView;
#ifdef PAINTED
uniform vec3 middle, halfSides;
// An edge a pixel wide.
float within( float inside, vec3 q ) {
	vec3 pixel = fwidth( q );
	float wide = max( max( pixel.x, pixel.y ), max( pixel.z, 1e-6 ) );
	return clamp( 0.5 + inside / wide, 0.0, 1.0 );
}
${PATTERN}
#endif
void main() {
	vec3 n = normalize( gl_FrontFacing ? vNormal : -vNormal );
	vec3 color = vColor;
	#ifndef CROWD
	vec3 fromPlane = clamp( vReference / max( fwidth( vReference ), vec3( 1e-12 ) ), -0.5, 0.5 );
	color *= 1.0 + contrast * 8.0 * fromPlane.x * fromPlane.y * fromPlane.z;
	#ifdef PAINTED
	// What is dark is marked light, what is light dark.
	float ink = dot( color, vec3( 0.21, 0.72, 0.07 ) ) < 0.4 ? 1.0 : 0.0;
	color = mix( color, vec3( ink ), 0.5 * marked( ( vReference - middle ) / max( halfSides, vec3( 1e-12 ) ) ) );
	#endif
	#endif
	vec3 light = sky * mix( vec3( 0.33, 0.34, 0.37 ), vec3( 0.58, 0.59, 0.60 ), 0.5 + 0.5 * dot( n, up ) );
	light += vec3( 0.46, 0.45, 0.42 ) * max( 0.0, 0.15 + 0.85 * dot( n, key ) );
	light += vec3( 0.12, 0.13, 0.15 ) * max( 0.0, dot( n, fill ) );
	#ifdef CROWD
	// Close to the curve of the screen, and without its powers.
	gl_FragColor = vec4( sqrt( color * light ), opacity );
	#else
	vec3 halfway = normalize( key + normalize( vView ) );
	float gloss = 0.08 * pow( max( 0.0, dot( n, halfway ) ), 24.0 );
	gl_FragColor = vec4( color * light + gloss, opacity );
	#include <colorspace_fragment>
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, paper, pale );
}`;

/** Where light comes from, unit vectors; shared by all bodies. */
export const LIGHT = {
  up: { value: new Vector3(0, 0, 1) },
  key: { value: new Vector3(0, 0, 1) },
  fill: { value: new Vector3(0, 0, 1) },
  sky: { value: 1 },
};

/** How pale bodies are, from 0 to 1, and what they fade to; shared by all of them. */
export const PALENESS = { pale: { value: 0 }, paper: { value: new Vector3(1, 1, 1) } };

function material(opacity: number, contrast: number): ShaderMaterial {
  const made = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT });
  made.uniforms = {
    ...LIGHT,
    ...PALENESS,
    opacity: { value: opacity },
    contrast: { value: contrast },
  };
  return made;
}

/** Of bodies as they are, with a pattern; plainer in a crowd. */
export function bodyMaterial(crowd: boolean, { paint, extent }: Pattern): ShaderMaterial {
  const made = material(1, 0.09);
  if (crowd) {
    made.defines = { CROWD: "" };
  } else if (paint !== "plain") {
    made.defines = { PAINTED: "" };
    made.fragmentShader = FRAGMENT.replace(PATTERN, MARKED[paint]);
    made.uniforms.middle = { value: new Vector3(...extent.middle) };
    made.uniforms.halfSides = { value: new Vector3(...extent.half) };
  }
  return made;
}

/** Of bodies at other times. */
export function ghostMaterial(): ShaderMaterial {
  const made = material(0.2, 0);
  made.transparent = true;
  made.depthWrite = false;
  return made;
}

/** Of marks: evenly lit, drawn after the bodies. */
export function markMaterial(): ShaderMaterial {
  const made = material(1, 0);
  made.transparent = true;
  made.uniforms.pale = { value: 0 };
  return made;
}

/** Of bars in a crowd: in plain light, drawn after the bodies, never pale. */
export function barMaterial(): ShaderMaterial {
  const made = markMaterial();
  made.defines = { CROWD: "" };
  return made;
}
