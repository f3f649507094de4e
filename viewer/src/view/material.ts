// The material of bodies: three's own, with two changes to its shaders.
//
// Normals. A material element moves by P, its normal by the cofactor of P: n ∝ cof(P) N. The library divides by squared
// lengths of columns instead, which is wrong under shear. With P = (a | b | c) the cofactor is (b×c | c×a | a×b).
//
// Octants. The eight octants about the centre of mass, in the axes of the body, differ a little in shade, so that a ball
// can be seen to turn and a shear to shear.

import { MeshLambertMaterial, MeshStandardMaterial } from "three";

const NORMAL_BY_COFACTOR = /* glsl */ `
vec3 transformedNormal = objectNormal;
#ifdef USE_INSTANCING
	mat3 placement = mat3( instanceMatrix );
	transformedNormal = mat3( cross( placement[ 1 ], placement[ 2 ] ), cross( placement[ 2 ], placement[ 0 ] ),
		cross( placement[ 0 ], placement[ 1 ] ) ) * transformedNormal;
#endif
transformedNormal = normalMatrix * transformedNormal;
`;

const OCTANTS = /* glsl */ `
#include <color_fragment>
vec3 fromPlane = clamp( vReference / max( fwidth( vReference ), vec3( 1e-12 ) ), -0.5, 0.5 );
diffuseColor.rgb *= 1.0 + OCTANT_CONTRAST * 8.0 * fromPlane.x * fromPlane.y * fromPlane.z;
`;

type Shader = { vertexShader: string; fragmentShader: string };

function adapt(shader: Shader, contrast: number): void {
  shader.vertexShader = shader.vertexShader
    .replace("#include <common>", "#include <common>\nvarying vec3 vReference;")
    .replace("#include <begin_vertex>", "#include <begin_vertex>\nvReference = position;")
    .replace("#include <defaultnormal_vertex>", NORMAL_BY_COFACTOR);
  shader.fragmentShader = shader.fragmentShader
    .replace(
      "#include <common>",
      `#include <common>\nvarying vec3 vReference;\n#define OCTANT_CONTRAST ${contrast.toFixed(3)}`,
    )
    .replace("#include <color_fragment>", OCTANTS);
}

/** Of bodies as they are. */
export function bodyMaterial(): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ roughness: 0.62, metalness: 0 });
  material.onBeforeCompile = (shader) => adapt(shader, 0.09);
  return material;
}

/** Of bodies at other times. */
export function ghostMaterial(): MeshLambertMaterial {
  const material = new MeshLambertMaterial({ transparent: true, opacity: 0.2, depthWrite: false });
  material.onBeforeCompile = (shader) => adapt(shader, 0);
  return material;
}
