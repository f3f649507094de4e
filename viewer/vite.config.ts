// The build: one HTML file with script and style inlined, so that it works from a disk and can be mailed.
// The tests: `unit` runs in Node, `browser` drives Chromium over the built page, `site` over a built site.

import { createHash } from "node:crypto";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";
import { ownShaders } from "./shaders.ts";

/** Where the program puts the data of a report; it must stand once in the page, before the script. */
const PLACEHOLDER = "<!--gyration-data-->";
/** Stands in the policy of the page for the hash of its script: no other script runs, whatever is in the data. */
const SCRIPT_HASH = "sha256-of-the-script";

/** Moves the bundled script and style into the page and drops their files. */
function inlined(): Plugin {
  return {
    name: "inline-everything",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("no index.html in the bundle");
      let scripts = "";
      let styles = "";
      for (const [name, file] of Object.entries(bundle)) {
        if (file === page) continue;
        if (file.type === "chunk") scripts += file.code;
        else if (name.endsWith(".css")) styles += file.source.toString();
        else throw new Error(`${name} cannot be inlined`);
        delete bundle[name];
      }
      // What would end a script element early must not stand in it.
      const script = scripts.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
      const bare = page.source
        .toString()
        .replace(/\s*<script[^>]*src=[^>]*><\/script>/g, "")
        .replace(/\s*<link[^>]*rel="(stylesheet|modulepreload)"[^>]*>/g, "");
      const hash = createHash("sha256").update(script).digest("base64");
      if (bare.split(SCRIPT_HASH).length !== 2)
        throw new Error("the hash of the script must stand once in the policy of the page");
      const html = bare
        .replace(SCRIPT_HASH, `sha256-${hash}`)
        .replace("</head>", () => `<style>${styles}</style></head>`)
        .replace("</body>", () => `<script type="module">${script}</script></body>`);
      if (html.split(PLACEHOLDER).length !== 2)
        throw new Error("the placeholder must stand once in the page");
      page.source = html;
    },
  };
}

export default defineConfig({
  plugins: [ownShaders(), inlined()],
  build: { target: "es2022", assetsInlineLimit: 1_000_000, cssCodeSplit: false, modulePreload: false },
  test: {
    projects: [
      { test: { name: "unit", include: ["tests/unit/**/*.test.ts"] } },
      {
        test: {
          name: "browser",
          include: ["tests/browser/**/*.test.ts"],
          testTimeout: 120_000,
          hookTimeout: 300_000,
          fileParallelism: false,
          // What a page comes to is waited for as long on a machine that does other work as on one that does none.
          expect: { poll: { timeout: 60_000 } },
        },
      },
      {
        test: {
          name: "site",
          include: ["tests/site/**/*.test.ts"],
          testTimeout: 120_000,
          hookTimeout: 60_000,
          expect: { poll: { timeout: 60_000 } },
        },
      },
    ],
  },
});
