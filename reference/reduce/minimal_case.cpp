#include "reference/reduce/minimal_case.h"

#include <cctype>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/oracle/exact_tests.h"
#include "reference/suite/case_file.h"
#include "reference/text/counted.h"
#include "reference/text/json_field.h"
#include "reference/text/json_value.h"
#include "reference/text/lists.h"

namespace contactcheck::reduce {
namespace {

constexpr std::size_t kLongestDecimal = 9, kLongestId = 64;

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A JSON number, or a text where the number is hexadecimal.
std::string json_number(double value) {
  const std::string text = number_text(value);
  return text.find('x') == std::string::npos ? text : "\"" + text + "\"";
}

template <typename Items, typename Text>
std::string lines_of(const Items& items, const std::string& indent, Text&& text_of) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? indent : ",\n" + indent) + text_of(item);
  return out;
}

std::string vertex_text(const Vec3& v) {
  return "[" + json_number(v.x()) + ", " + json_number(v.y()) + ", " + json_number(v.z()) + "]";
}

std::string triangle_text(const Triangle& t) {
  return "[" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) +
         "]";
}

std::string body_text(const CaseCandidate& candidate, std::size_t m) {
  const TriangleMesh& mesh = candidate.meshes[m];
  return "    {\n      \"name\": " + quoted(candidate.names[m]) +
         ",\n      \"mesh\": {\n        \"vertices\": [\n" +
         lines_of(mesh.vertices, "          ", vertex_text) +
         "\n        ],\n        \"triangles\": [\n" +
         lines_of(mesh.triangles, "          ", triangle_text) + "\n        ]\n      }" +
         (candidate.on_nodes ? ",\n      \"lattice\": \"nodes\"\n    }" : "\n    }");
}

}  // namespace

std::string number_text(double value) {
  const std::string decimal = text::shown(value);
  return decimal.size() <= kLongestDecimal ? decimal : suite::hex_float(value);
}

std::string family_text(const MinimalCase& c) {
  const std::string what = described(c.finding) + " by " + c.detector;
  const std::string origin = "contactcheck reduce: scene " + c.scene +
                             (c.drawn.empty() ? "" : " (" + c.drawn + ")") + ", " + c.place +
                             ", detector " + c.detector +
                             (c.library.empty() ? "" : " (" + c.library + ")");
  std::string bodies, levels;
  for (std::size_t m = 0; m < c.candidate.meshes.size(); ++m)
    bodies += (m > 0 ? ",\n" : "") + body_text(c.candidate, m);
  for (const Level level : c.levels)
    levels += (levels.empty() ? "" : ", ") + quoted(name_of(level));
  return "{\n  \"id\": " + quoted(c.id) + ",\n  \"title\": " + quoted("Minimal case: " + what) +
         ",\n  \"origin\": " + quoted(origin) + ",\n  \"stresses\": " + quoted(what) +
         ",\n  \"parameter\": {\"name\": \"case\", \"values\": [\"1\"]},\n  \"levels\": " + "[" +
         levels + "],\n  \"bodies\": [\n" + bodies + "\n  ]\n}\n";
}

std::string id_from(const std::string& words) {
  std::string out;
  for (const char c : words) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    const char next = kept ? c : '-';
    if (next == '-' && (out.empty() || out.back() == '-')) continue;
    out += next;
  }
  return out.substr(0, kLongestId);
}

namespace {

/// The words of `text`, in ASCII letters and digits.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = std::isalnum(byte) != 0 && byte < 128;
    if (kept) out.back() += c;
    if (!kept && !out.back().empty()) out.emplace_back();
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

/// "fcl-obbrss" becomes "FclObbrss".
std::string camel_case(const std::string& text) {
  std::string out;
  for (std::string word : words_of(text)) {
    word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    out += word;
  }
  return out;
}

/// "fcl-obbrss" becomes "fcl_obbrss".
std::string snake_case(const std::string& text) {
  std::string out;
  for (const std::string& word : words_of(text)) out += (out.empty() ? "" : "_") + word;
  return out;
}

// "2.0", not "2": pasted into other types than arrays of double, it still gives doubles.
std::string literal(double value, TestLanguage language) {
  // Others read no hexadecimal fractions; their decimals are exact.
  const bool hexadecimal = language == TestLanguage::kCpp || language == TestLanguage::kC;
  const std::string text = hexadecimal ? number_text(value) : text::shown(value);
  return text.find_first_of(".xe") == std::string::npos ? text + ".0" : text;
}

/// Vertices and triangles of one mesh as two arrays.
std::string mesh_text(const TriangleMesh& mesh, const std::string& name, TestLanguage language) {
  const auto array = [&](const std::string& element, const std::string& what, const auto& items,
                         const auto& text_of) {
    const std::string count = std::to_string(items.size());
    std::string open, row[2], close;
    switch (language) {
      case TestLanguage::kCpp:
        open = "  const std::array<std::array<" + element + ", 3>, " + count + "> " + name + what +
               " = {{\n";
        row[0] = "      {{", row[1] = "}},\n", close = "  }};\n";
        break;
      case TestLanguage::kC:
        open = "  const " + element + " " + name + what + "[" + count + "][3] = {\n";
        row[0] = "      {", row[1] = "},\n", close = "  };\n";
        break;
      case TestLanguage::kJavaScript:
        open = "  const " + name + what + " = [\n";
        row[0] = "      [", row[1] = "],\n", close = "  ];\n";
        break;
      case TestLanguage::kPython:
        open = "    " + name + what + " = [\n";
        row[0] = "        [", row[1] = "],\n", close = "    ]\n";
        break;
    }
    for (const auto& item : items)
      open +=
          row[0] + text_of(item[0]) + ", " + text_of(item[1]) + ", " + text_of(item[2]) + row[1];
    return open + close;
  };
  return array("double", "vertices", mesh.vertices,
               [&](double x) { return literal(x, language); }) +
         array("int", "triangles", mesh.triangles,
               [](std::uint32_t v) { return std::to_string(v); });
}

std::string pair_text(const MinimalCase& c, const judge::Disagreement& d) {
  const std::string &first = c.candidate.names[d.pair.body_a],
                    &second = c.candidate.names[d.pair.body_b];
  const std::string a = std::to_string(d.pair.a), b = std::to_string(d.pair.b);
  const auto of_both = [&](const std::string& element) {
    return element + " " + a + " of " + first + " and " + element + " " + b + " of " + second;
  };
  const auto [kind, other] = judge::elements_of(d.level, d.kind);
  if (kind == Element::kTriangle) return of_both("triangle");
  if (kind == Element::kCell) return of_both("cell");
  if (other == Element::kTriangle)
    return "vertex " + a + " of " + first + " and triangle " + b + " of " + second;
  return first == second ? first : first + " and " + second;
}

/// What is true of a pair, in the level's words.
std::string truth_text(const std::string& level, bool contact) {
  if (level == name_of(Level::kNear) || level == name_of(Level::kSelfNear))
    return contact ? "are nearer than the margin" : "are not nearer than the margin";
  if (level == name_of(Level::kBox))
    return contact ? "have mapped boxes that overlap" : "have mapped boxes that do not overlap";
  if ((level == name_of(Level::kCell) || level == name_of(Level::kSelfCell)) && !contact)
    return "hold no pair of triangles that touch";
  if (level == name_of(Level::kSelfVertex) || level == name_of(Level::kSelfEdge)) {
    const std::string shared = level == name_of(Level::kSelfEdge) ? "edge" : "corner";
    return contact ? "share more than their common " + shared
                   : "share their common " + shared + " alone";
  }
  if (level == name_of(Level::kSelfBody))
    return contact ? "touches itself" : "does not touch itself";
  return contact ? "share a point" : "share no point";
}

/// Which edges of the one triangle meet the other: "edge 3-4 of left meets triangle 0 of right".
std::string crossing_text(const MinimalCase& c, const ElementPair& pair) {
  const std::uint32_t bodies[] = {pair.body_a, pair.body_b}, triangles[] = {pair.a, pair.b};
  std::string out;
  for (std::size_t side = 0; side < 2; ++side) {
    const TriangleMesh &one = c.candidate.meshes[bodies[side]],
                       &other = c.candidate.meshes[bodies[1 - side]];
    const Triangle &edges_of = one.triangles[triangles[side]],
                   &face = other.triangles[triangles[1 - side]];
    const oracle::TriangleCorners corners = {other.vertices[face[0]], other.vertices[face[1]],
                                             other.vertices[face[2]]};
    std::vector<std::string> edges;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = edges_of[k], to = edges_of[(k + 1) % 3];
      if (oracle::segment_meets_triangle({one.vertices[from], one.vertices[to]}, corners))
        edges.push_back(std::to_string(from) + "-" + std::to_string(to));
    }
    if (edges.empty()) continue;
    out += std::string(out.empty() ? ": " : "; ") + (edges.size() == 1 ? "edge " : "edges ") +
           text::joined(edges) + " of " + c.candidate.names[bodies[side]] +
           (edges.size() == 1 ? " meets" : " meet") + " triangle " +
           std::to_string(triangles[1 - side]) + " of " + c.candidate.names[bodies[1 - side]];
  }
  return out;
}

/// What a mesh is called in a test: nothing, "first", "second"; one of more than two "body0".
std::string mesh_name(std::size_t mesh, std::size_t meshes) {
  if (meshes == 1) return "";
  return meshes == 2 ? (mesh == 0 ? "first" : "second") : "body" + std::to_string(mesh);
}

/// The same in front of "vertices" and "triangles".
std::string prefix(std::size_t mesh, std::size_t meshes) {
  return meshes == 1 ? "" : mesh_name(mesh, meshes) + "_";
}

/// The line that fails. `your_detector` is what the reader has to write: of more than two meshes it
/// is asked for two; for a pair of triangles it is asked for that pair, since one of several pairs
/// of the same bodies can be wrong.
std::string expectation(const Finding& finding, const CaseAnswers& answers, std::size_t meshes,
                        TestLanguage language) {
  std::vector<std::string> words;
  for (std::size_t m = 0; m < meshes; ++m)
    for (const char* const what : {"vertices", "triangles"})
      words.push_back(prefix(m, meshes) + what);
  const auto add = [&](const std::pair<std::uint32_t, std::uint32_t>& pair) {
    words.push_back(std::to_string(pair.first));
    words.push_back(std::to_string(pair.second));
  };
  if (meshes > 2 && answers.bodies) add(*answers.bodies);
  if (answers.triangles) add(*answers.triangles);
  const std::string call = "your_detector(" + text::joined(words) + ")";
  const bool contact = finding.kind == "missed";
  if (language == TestLanguage::kCpp) {
    if (finding.kind == "error") return "EXPECT_NO_THROW(" + call + ");";
    return (contact ? "EXPECT_TRUE(" : "EXPECT_FALSE(") + call + ");";
  }
  if (language == TestLanguage::kPython)
    return finding.kind == "error" ? call : (contact ? "assert " : "assert not ") + call;
  if (language == TestLanguage::kJavaScript)
    return finding.kind == "error" ? call + ";"
                                   : (contact ? "assert.ok(" : "assert.ok(!") + call + ");";
  return finding.kind == "error" ? call + ";" : (contact ? "assert(" : "assert(!") + call + ");";
}

/// What `your_detector` has to tell.
std::string contract(const Finding& finding, const CaseAnswers& answers, std::size_t meshes) {
  if (finding.kind == "error") return "your_detector: answers, whatever it says";
  const std::string asked = "your_detector: does it report ";
  const std::string one = mesh_name(answers.bodies->first, meshes),
                    other = mesh_name(answers.bodies->second, meshes);
  const bool same = answers.bodies->first == answers.bodies->second;
  if (!answers.triangles) {
    if (meshes > 2)
      return asked + "a contact of " + one + (same ? " with itself?" : " and " + other + "?");
    return asked + (same ? "a contact of the mesh with itself?" : "a contact of the two?");
  }
  const std::string first = std::to_string(answers.triangles->first),
                    second = std::to_string(answers.triangles->second);
  if (same)
    return asked + "triangles " + first + " and " + second +
           (meshes > 2 ? " of " + one + "?" : "?");
  return asked + "triangle " + first + " of " + one + " with triangle " + second + " of " + other +
         "?";
}

}  // namespace

CaseAnswers answers_of(const MinimalCase& c, const ProbeVerdict& verdict) {
  if (c.finding.kind == "error")
    return {"any answer, but an answer",
            described(c.finding) + (verdict.message.empty() ? "" : ": " + verdict.message)};
  const judge::Disagreement& d = disagreement_of(verdict, c.finding);
  const results::LevelCounts& counts = verdict.levels.at(*level_from_name(d.level));
  const bool missed = d.kind == "missed";
  // Neighbours have a corner or an edge in common anyhow.
  const bool triangles = d.level == name_of(Level::kTriangle) || d.level == name_of(Level::kCell) ||
                         d.level == name_of(Level::kSelf);
  CaseAnswers out;
  out.exact = pair_text(c, d) + " " + truth_text(d.level, missed) +
              (missed && triangles ? crossing_text(c, d.pair) : "");
  out.detector = text::counted(counts.reported, "pair") + " at level " + d.level + " of " +
                 std::to_string(counts.truth) + " true: " + std::to_string(counts.missed) +
                 " missed, " + std::to_string(counts.spurious) + " spurious";
  out.bodies = {d.pair.body_a, d.pair.body_b};
  if (judge::elements_of(d.level, d.kind).first == Element::kTriangle)
    out.triangles = {d.pair.a, d.pair.b};
  return out;
}

std::string printed_test(const MinimalCase& c, const CaseAnswers& answers, TestLanguage language) {
  const std::string words = c.finding.kind + "-" + c.finding.level + "-" + c.scene;
  const bool python = language == TestLanguage::kPython;
  const std::string comment = python ? "# " : "// ", indent = python ? "    " : "  ";
  const std::string function = "test_" + snake_case(c.detector + "-" + words);
  std::string head, end = "}\n";
  switch (language) {
    case TestLanguage::kCpp:
      head = "TEST(" + camel_case(c.detector) + ", " + camel_case(words) + ") {\n";
      break;
    case TestLanguage::kC:
      head = "#include <assert.h>\nvoid " + function + "(void) {\n";
      break;
    case TestLanguage::kJavaScript:
      head =
          "import assert from \"node:assert/strict\";\nimport test from \"node:test\";\n\ntest(\"" +
          function + "\", () => {\n";
      end = "});\n";
      break;
    case TestLanguage::kPython:
      head = "def " + function + "():\n";
      end = "\n\nif __name__ == \"__main__\":\n    " + function + "()\n";
      break;
  }
  const std::vector<std::string>& names = c.candidate.names;
  const std::size_t count = names.size();
  std::vector<std::string> whose;  // where the names of the test are not the scene's
  std::string meshes;
  for (std::size_t m = 0; m < count; ++m) {
    if (count > 1 && names[0] != "first") whose.push_back(mesh_name(m, count) + " is " + names[m]);
    meshes += mesh_text(c.candidate.meshes[m], prefix(m, count), language);
  }
  return comment + c.detector + (c.library.empty() ? "" : " (" + c.library + ")") + ": " +
         described(c.finding) + ". From " + c.scene + ", " + c.place + ".\n" + head +
         (whose.empty() ? "" : indent + comment + text::joined(whose) + ".\n") + meshes + indent +
         comment + "Exact: " + answers.exact + ".\n" + indent + comment + c.detector +
         " answered: " + answers.detector + ".\n" + indent + comment +
         contract(c.finding, answers, count) + "\n" + indent +
         expectation(c.finding, answers, count, language) + "\n" + end;
}

}  // namespace contactcheck::reduce
