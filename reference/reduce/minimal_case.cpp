#include "reference/reduce/minimal_case.h"

#include <cctype>
#include <nlohmann/json.hpp>

#include "reference/suite/case_file.h"
#include "reference/text/json_value.h"

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
  std::string levels;
  for (const Level level : c.levels)
    levels += (levels.empty() ? "" : ", ") + quoted(name_of(level));
  return "{\n  \"id\": " + quoted(c.id) + ",\n  \"title\": " + quoted("Minimal case: " + what) +
         ",\n  \"origin\": " + quoted(origin) + ",\n  \"stresses\": " + quoted(what) +
         ",\n  \"parameter\": {\"name\": \"case\", \"values\": [\"1\"]},\n  \"levels\": " + "[" +
         levels + "],\n  \"bodies\": [\n" + body_text(c.candidate, 0) + ",\n" +
         body_text(c.candidate, 1) + "\n  ]\n}\n";
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

/// "fcl-obbrss" becomes "FclObbrss".
std::string camel_case(const std::string& text) {
  std::string out;
  bool capital = true;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) == 0 || byte > 127) {
      capital = true;
      continue;
    }
    out += capital ? static_cast<char>(std::toupper(byte)) : c;
    capital = false;
  }
  return out;
}

template <typename Items, typename Text>
std::string array_text(const std::string& element, std::size_t count, const std::string& name,
                       const Items& items, Text&& text_of) {
  std::string out = "  const std::array<std::array<" + element + ", 3>, " + std::to_string(count) +
                    "> " + name + " = {{\n";
  for (const auto& item : items) out += "      {{" + text_of(item) + "}},\n";
  return out + "  }};\n";
}

// "2.0", not "2": pasted into other types than arrays of double, it still gives doubles.
std::string literal(double value) {
  const std::string text = number_text(value);
  return text.find_first_of(".xe") == std::string::npos ? text + ".0" : text;
}

std::string mesh_text(const TriangleMesh& mesh, const std::string& name) {
  return array_text("double", mesh.vertices.size(), name + "_vertices", mesh.vertices,
                    [](const Vec3& v) {
                      return literal(v.x()) + ", " + literal(v.y()) + ", " + literal(v.z());
                    }) +
         array_text("int", mesh.triangles.size(), name + "_triangles", mesh.triangles,
                    [](const Triangle& t) {
                      return std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " +
                             std::to_string(t[2]);
                    });
}

std::string pair_text(const MinimalCase& c, const judge::Disagreement& d) {
  const std::string &first = c.candidate.names[d.pair.body_a],
                    &second = c.candidate.names[d.pair.body_b];
  const std::string a = std::to_string(d.pair.a), b = std::to_string(d.pair.b);
  const auto of_both = [&](const std::string& element) {
    return element + " " + a + " of " + first + " and " + element + " " + b + " of " + second;
  };
  if (d.level == name_of(Level::kTriangle)) return of_both("triangle");
  if (d.level == name_of(Level::kBox)) return of_both("cell");
  if (d.level == name_of(Level::kCell)) return of_both(d.kind == "missed" ? "triangle" : "cell");
  if (d.level == name_of(Level::kNear))
    return "vertex " + a + " of " + first + " and triangle " + b + " of " + second;
  return first + " and " + second;
}

/// What is true of a pair, in the level's words.
std::string truth_text(const std::string& level, bool contact) {
  if (level == name_of(Level::kNear))
    return contact ? "are nearer than the margin" : "are not nearer than the margin";
  if (level == name_of(Level::kBox))
    return contact ? "have mapped boxes that overlap" : "have mapped boxes that do not overlap";
  if (level == name_of(Level::kCell) && !contact) return "hold no pair of triangles that touch";
  return contact ? "share a point" : "share no point";
}

/// What a test of a detector would say, in words that every suite has its own for.
std::string expectation(const Finding& finding) {
  const std::string call =
      "your_detector(first_vertices, first_triangles, second_vertices, second_triangles)";
  if (finding.kind == "error") return "EXPECT_NO_FATAL_FAILURE(" + call + ");";
  return (finding.kind == "missed" ? "EXPECT_TRUE(" : "EXPECT_FALSE(") + call + ");";
}

}  // namespace

CaseAnswers answers_of(const MinimalCase& c, const ProbeVerdict& verdict) {
  if (c.finding.kind == "error")
    return {"any answer, but an answer",
            described(c.finding) + (verdict.message.empty() ? "" : ": " + verdict.message)};
  const judge::Disagreement& d = disagreement_of(verdict, c.finding);
  const results::LevelCounts& counts = verdict.levels.at(*level_from_name(d.level));
  const bool missed = d.kind == "missed";
  return {pair_text(c, d) + " " + truth_text(d.level, missed),
          std::to_string(counts.reported) + (counts.reported == 1 ? " pair" : " pairs") +
              " at level " + d.level + " of " + std::to_string(counts.truth) +
              " true: " + std::to_string(counts.missed) + " missed, " +
              std::to_string(counts.spurious) + " spurious"};
}

std::string printed_test(const MinimalCase& c, const CaseAnswers& answers) {
  return "// " + c.detector + (c.library.empty() ? "" : " (" + c.library + ")") + ": " +
         described(c.finding) + ". From " + c.scene + ", " + c.place + ".\n" + "TEST(" +
         camel_case(c.detector) + ", " +
         camel_case(c.finding.kind + "-" + c.finding.level + "-" + c.scene) + ") {\n" +
         mesh_text(c.candidate.meshes[0], "first") + mesh_text(c.candidate.meshes[1], "second") +
         "  // Exact: " + answers.exact + ".\n" + "  // " + c.detector +
         " answered: " + answers.detector + ".\n" + "  // " + expectation(c.finding) + "\n" + "}\n";
}

}  // namespace contactcheck::reduce
