// The build emits exactly index.html, page.js and page.css: the program serves or inlines these three files.
import { defineConfig } from "vite";

// The program replaces both tags by the files' contents, so each stands alone on its line and has no more
// attributes than needed.
function plainTags() {
  return {
    name: "plain-tags",
    transformIndexHtml: {
      order: "post",
      handler: (html) =>
        html
          .replaceAll(" crossorigin", "")
          .replace(/[ \t]*(<script type="module"[^>]*><\/script>|<link rel="stylesheet"[^>]*>)\s*/g, "\n$1\n")
          .replace(/\n{2,}/g, "\n"),
    },
  };
}

// Inside of an inline script, these would end it or change how HTML reads it.
function inlineable() {
  return {
    name: "inlineable",
    generateBundle(_, bundle) {
      for (const file of Object.values(bundle)) {
        if (file.type === "chunk" && /<\/script|<!--/i.test(file.code)) {
          this.error(`${file.fileName} contains a tag that no inline script may contain`);
        }
      }
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [plainTags(), inlineable()],
  build: {
    target: "es2022",
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 2000,
    rollupOptions: {
      output: {
        entryFileNames: "page.js",
        assetFileNames: "page[extname]",
        inlineDynamicImports: true,
      },
    },
  },
});
