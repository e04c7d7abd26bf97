#include "reference/plugin/pipe_messages.h"

#include <bit>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/types/check.h"
#include "reference/text/printable.h"

namespace contactcheck::plugin {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestShownLine = 80;  // bytes

// All numbers of the protocol are little-endian, and arrays are sent as they lie in memory.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Vec3) == 3 * sizeof(double));

template <typename T>
void append(std::span<const T> items, std::string& out) {
  out.append(reinterpret_cast<const char*>(items.data()), items.size_bytes());
}
template <typename T>
void append(const std::vector<T>& items, std::string& out) {
  append(std::span<const T>(items), out);
}

// The line is put before the bytes that it announces.
std::string message(Json line, const std::string& payload = "") {
  if (!payload.empty()) line["bytes"] = payload.size();
  return line.dump() + "\n" + payload;
}

Json lattice_json(const BodyShape& shape) {
  if (!shape.lattice) return nullptr;
  return {{"nodes", shape.lattice->nodes.size()},
          {"cells", shape.lattice->cells.size()},
          {"labels", shape.embedding.label_cells.size()}};
}

void append_lattice(const BodyShape& shape, std::string& out) {
  append(shape.lattice->rest_nodes(), out);
  append(shape.lattice->cell_nodes, out);
  append(shape.embedding.home_cell, out);
  append(shape.embedding.local, out);
  append(shape.embedding.label_begin, out);
  append(shape.embedding.label_cells, out);
}

// What a command prints for people lands among its messages: then that is what has to be said.
[[noreturn]] void refuse_words(const std::string& line, const std::string& from,
                               const char* message) {
  throw InputError(from + " wrote \"" + text::printable_line(line, kLongestShownLine) +
                   "\" where its message \"" + message +
                   "\" was due; standard output is for messages alone, what it prints for people "
                   "belongs on standard error");
}

text::JsonValue parsed(const std::string& line, const std::string& from, const char* message) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string::npos || line[begin] != '{') refuse_words(line, from, message);
  return text::parse_json(line, from);
}

}  // namespace

std::string hello_message() { return message({{"message", "hello"}, {"protocol", kPipeProtocol}}); }

std::string prepare_message(const std::vector<Body>& bodies, const Options& options) {
  Json list = Json::array();
  std::string payload;
  for (const Body& body : bodies) {
    const TriangleMesh& mesh = body.shape->mesh;
    list.push_back({{"name", body.name},
                    {"vertices", mesh.vertices.size()},
                    {"triangles", mesh.triangles.size()},
                    {"lattice", lattice_json(*body.shape)}});
    append(mesh.vertices, payload);
    append(mesh.triangles, payload);
    if (body.shape->lattice) append_lattice(*body.shape, payload);
  }
  return message({{"message", "prepare"}, {"options", Json(options)}, {"bodies", list}}, payload);
}

std::string frame_message(const Frame& frame, const Declaration& needs) {
  std::string payload;
  for (const BodyState& body : frame.bodies) {
    if (needs.needs_vertices) append(body.vertices, payload);
    if (needs.needs_nodes) append(body.nodes, payload);
  }
  return message({{"message", "frame"}, {"index", frame.index}, {"time", frame.time}}, payload);
}

std::string query_message(Question question) {
  return message({{"message", "query"}, {"question", name_of(question)}});
}

Reply::Reply(const std::string& line, std::string from, const char* message)
    : from_(std::move(from)), value_(parsed(line, from_, message)) {
  require_message(message);
}

void Reply::require_message(const char* message) const {
  const std::string kind = root().at("message").text();
  if (kind != "error" && kind != "refused") {
    if (kind != message) root().at("message").refuse("\"" + std::string(message) + "\"");
    return;
  }
  const std::string text = root().at("text").text();
  if (kind == "refused") throw RefusedInput(text);
  throw std::runtime_error(text);
}

std::optional<double> Reply::reported_ns() const {
  if (!root().has("ms")) return std::nullopt;
  return 1e6 * root().at("ms").number({0.0, false, 1e9});
}

std::size_t Reply::bytes() const {
  return root().has("bytes") ? root().at("bytes").whole(0, kLargestAnswer) : 0;
}

}  // namespace contactcheck::plugin
