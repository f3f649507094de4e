// A step of the build: of the shaders of three.js, those of materials that the page uses.
//
// three.js brings shaders of all its materials as strings, which nothing shakes off; most of them are light.

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";

const LIBRARY = /\/three\/build\/three\.module\.js$/;

/** Empties the shaders that no material of the page includes. */
export function ownShaders(): Plugin {
  return {
    name: "own-shaders",
    enforce: "pre",
    transform(code, id) {
      return LIBRARY.test(id) ? { code: withoutUnused(code, pageSources()), map: null } : undefined;
    },
  };
}

function pageSources(): string {
  const folder = join(import.meta.dirname, "src");
  return readdirSync(folder, { encoding: "utf8", recursive: true })
    .filter((path) => path.endsWith(".ts"))
    .map((path) => readFileSync(join(folder, path), "utf8"))
    .join("\n");
}

/**
 * The library without the strings of shaders that `page` does not reach.
 *
 * Reached are the shaders of materials that the page names, what the renderer and shaders of the page take by name,
 * and whatever these include.
 */
export function withoutUnused(library: string, page: string): string {
  const strings = entries(library, /^(?:var|const) (\w[\w$]*) = (".*");$/gm);
  const chunks = entries(between(library, "const ShaderChunk = {", "};"), /^\t(\w+): ([\w$]+),?$/gm);
  const shaders = entries(between(library, "const shaderIDs = {", "};"), /(\w+): '(\w+)'/g);
  const included = (text: string): string[] => found(text, /#include <(\w+)>/g);

  const waiting = [...included(page), ...found(library, /ShaderChunk\[ '(\w+)' \]/g)];
  const table = library.slice(library.indexOf("const ShaderLib = {"));
  for (const [material, shader] of shaders) {
    if (!new RegExp(`\\b${material}\\b`).test(page)) continue;
    const both = `(?:\\t|ShaderLib\\.)${shader}(?:: | = )\\{[^]*?ShaderChunk\\.(\\w+)[^]*?ShaderChunk\\.(\\w+)`;
    const named = table.match(new RegExp(both));
    if (!named) throw new Error(`three.js has no shaders of ${material}`);
    waiting.push(named[1]!, named[2]!);
  }
  const kept = new Set<string>();
  for (let name = waiting.pop(); name !== undefined; name = waiting.pop()) {
    const variable = chunks.get(name);
    if (variable === undefined || !strings.has(variable)) throw new Error(`three.js has no shader ${name}`);
    if (!kept.has(variable)) waiting.push(...included(strings.get(variable)!));
    kept.add(variable);
  }
  const unused = new Set([...chunks.values()].filter((variable) => !kept.has(variable)));
  return library.replace(/^((?:var|const) (\w[\w$]*) = )".*";$/gm, (line, start, variable) =>
    unused.has(variable) ? `${start}"";` : line,
  );
}

function entries(text: string, pattern: RegExp): Map<string, string> {
  return new Map([...text.matchAll(pattern)].map((match) => [match[1]!, match[2]!]));
}

function found(text: string, pattern: RegExp): string[] {
  return [...text.matchAll(pattern)].map((match) => match[1]!);
}

function between(text: string, start: string, end: string): string {
  const from = text.indexOf(start);
  const to = text.indexOf(end, from);
  if (from < 0 || to < 0) throw new Error(`three.js has no "${start.trim()}"`);
  return text.slice(from + start.length, to);
}
