// Writes the built page as a C++ source: node embed.mjs FOLDER OUT.cpp
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [folder, out] = process.argv.slice(2);
const END = "stilb_page";
/** C++ promises literals of 65536 characters. */
const MOST = 16000;

function literal(name) {
  const text = readFileSync(join(folder, name), "utf8");
  if (text.includes(`)${END}"`)) throw new Error(`${name} contains the end of a C++ literal`);
  const characters = [...text];
  const pieces = [];
  for (let i = 0; i < characters.length; i += MOST) {
    pieces.push(`    R"${END}(${characters.slice(i, i + MOST).join("")})${END}"sv`);
  }
  return pieces.map((piece, i) => (i + 1 < pieces.length ? piece.slice(0, -2) : piece)).join("\n");
}

writeFileSync(out, `// Generated from web/ by web/embed.mjs.
#include "walk/page.h"

namespace stilb::walk {

using namespace std::string_view_literals;

PageFiles page_files() {
  static constexpr auto html =
${literal("index.html")};
  static constexpr auto script =
${literal("page.js")};
  static constexpr auto style =
${literal("page.css")};
  return {html, script, style};
}

}  // namespace stilb::walk
`);
