// The build of the site: a page, its style and its worker as plain files with relative addresses.
//
// Beside them the page expects engine.wasm, gallery.json and hashes.json.

import { defineConfig, type Plugin } from "vite";
import { ownShaders } from "./shaders.ts";

/** Gives the page the name under which a web server finds it. */
function index(): Plugin {
  return {
    name: "page-is-index",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["site.html"];
      if (page?.type !== "asset") throw new Error("no site.html in the bundle");
      delete bundle["site.html"];
      this.emitFile({ type: "asset", fileName: "index.html", source: page.source });
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [ownShaders(), index()],
  worker: { format: "es" },
  build: {
    target: "es2022",
    outDir: "dist-site",
    assetsInlineLimit: 0,
    cssCodeSplit: false,
    modulePreload: false,
    chunkSizeWarningLimit: 1000,
    rollupOptions: { input: "site.html" },
  },
});
