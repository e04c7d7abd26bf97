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

std::string levels_text(const std::vector<Level>& levels) {
  std::string out;
  for (const Level level : levels) out += (out.empty() ? "" : ", ") + quoted(name_of(level));
  return "[" + out + "]";
}

std::string origin_of(const MinimalCase& c) {
  return "contactcheck reduce: scene " + c.scene + ", " + c.place + ", detector " + c.detector +
         (c.library.empty() ? "" : " (" + c.library + ")");
}

}  // namespace

std::string number_text(double value) {
  const std::string decimal = text::shown(value);
  return decimal.size() <= kLongestDecimal ? decimal : suite::hex_float(value);
}

std::string family_text(const MinimalCase& c) {
  const std::string what = described(c.finding) + " by " + c.detector;
  return "{\n  \"id\": " + quoted(c.id) + ",\n  \"title\": " + quoted("Minimal case: " + what) +
         ",\n  \"origin\": " + quoted(origin_of(c)) + ",\n  \"stresses\": " + quoted(what) +
         ",\n  \"parameter\": {\"name\": \"case\", \"values\": [\"1\"]},\n  \"levels\": " +
         levels_text(c.levels) + ",\n  \"bodies\": [\n" + body_text(c.candidate, 0) + ",\n" +
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

}  // namespace contactcheck::reduce
