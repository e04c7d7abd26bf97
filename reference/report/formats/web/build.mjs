// Bundles the page and writes it as C++: node build.mjs OUT.cpp [PAGE.html]
// The page is one file that asks nothing of the network: scripts, styles and notices are inside.
import {readFileSync, writeFileSync} from "node:fs";
import {build} from "esbuild";

const [outCpp, outPage] = process.argv.slice(2);

async function bundled(entry) {
  const result = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    legalComments: "inline",
    format: "iife",
    target: ["es2022"],
    charset: "utf8",
    logLevel: "warning",
  });
  // Inside <script> and <style> only the end tag has a meaning.
  return result.outputFiles[0].text.trim().replaceAll("</script", "<\\/script");
}

function page(template, script, style) {
  return template.replace("/*style*/", () => style).replace("/*script*/", () => script);
}

// String literals have a largest length; neighbours are joined by the compiler, which may warn of
// the length of the whole.
function cppLiteral(text) {
  const bytes = Buffer.from(text, "utf8"),
    lines = [];
  for (let start = 0; start < bytes.length; start += 8000) {
    let line = "";
    for (const byte of bytes.subarray(start, start + 8000)) line += cppCharacter(byte);
    lines.push(`"${line}"`);
  }
  return lines.join("\n    ");
}

function cppCharacter(byte) {
  const character = String.fromCharCode(byte);
  if (character === '"' || character === "\\" || character === "?") return "\\" + character;
  if (byte >= 32 && byte < 127) return character;
  return "\\" + byte.toString(8).padStart(3, "0"); // three octal digits end by themselves
}

const html = page(
  readFileSync("template.html", "utf8"),
  await bundled("src/main.ts"),
  await bundled("src/style.css"),
);
writeFileSync(
  outCpp,
  `#include "reference/report/formats/web/report_template.h"

#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Woverlength-strings"
#endif

namespace contactcheck::report {

const std::string_view kReportTemplate(
    ${cppLiteral(html)},
    ${Buffer.byteLength(html)});

}  // namespace contactcheck::report
`,
);
if (outPage) writeFileSync(outPage, html);
