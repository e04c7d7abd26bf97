#include "reference/plugin/pipe_messages.h"

#include <bit>
#include <cstring>
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

text::JsonValue parsed(const std::string& line, const std::string& from, const char* message) {
  const std::size_t begin = line.find_first_not_of(" \t");
  // What a command prints for people is among its messages.
  if (begin == std::string::npos || line[begin] != '{')
    throw InputError(from + " wrote \"" + text::printable_line(line, kLongestShownLine) +
                     "\" where its message \"" + message +
                     "\" was due; standard output is for messages alone, what it prints for people "
                     "belongs on standard error");
  return text::parse_json(line, from);
}

}  // namespace

std::string hello_message() { return message({{"message", "hello"}, {"protocol", kPipeProtocol}}); }

std::string prepare_message(const std::vector<Body>& bodies, const Options& options) {
  Json list = Json::array();
  std::string payload;
  for (const Body& body : bodies) {
    const TriangleMesh& mesh = body.shape->mesh;
    append(mesh.vertices, payload);
    append(body.shape->linked(), payload);
    Json lattice_json;  // null without a lattice
    if (body.shape->lattice) {
      const Lattice& lattice = *body.shape->lattice;
      const Embedding& embedding = body.shape->embedding;
      lattice_json = {{"nodes", lattice.nodes.size()},
                      {"cells", lattice.cells.size()},
                      {"labels", embedding.label_cells.size()}};
      append(lattice.rest_nodes(), payload);
      append(lattice.cell_nodes, payload);
      append(embedding.home_cell, payload);
      append(embedding.local, payload);
      append(embedding.label_begin, payload);
      append(embedding.label_cells, payload);
    }
    list.push_back({{"name", body.name},
                    {"vertices", mesh.vertices.size()},
                    {"triangles", mesh.triangles.size()},
                    {"lattice", lattice_json}});
  }
  return message({{"message", "prepare"}, {"options", Json(options)}, {"bodies", list}}, payload);
}

namespace {

void append(const Frame& frame, const Declaration& needs, std::string& out) {
  for (const BodyState& body : frame.bodies) {
    if (needs.needs_vertices) append(body.vertices, out);
    if (needs.needs_nodes) append(body.nodes, out);
  }
}

}  // namespace

std::string step_message(const Step& step, const Declaration& needs) {
  std::string payload;
  append(step.start, needs, payload);
  append(step.end, needs, payload);
  return message({{"message", "step"},
                  {"index", step.index()},
                  {"start_time", step.start.time},
                  {"end_time", step.end.time}},
                 payload);
}

std::string frame_message(const Frame& frame, const Declaration& needs) {
  std::string payload;
  append(frame, needs, payload);
  return message({{"message", "frame"}, {"index", frame.index}, {"time", frame.time}}, payload);
}

std::string query_message(Question question) {
  return message({{"message", "query"}, {"question", name_of(question)}});
}

std::string impact_message(const ImpactQuery& query) {
  std::string payload;
  append(std::span<const Vec3>(query.start), payload);
  append(std::span<const Vec3>(query.end), payload);
  return message({{"message", "impact"}, {"kind", name_of(query.kind)}}, payload);
}

// NaN has no place in JSON; a time beyond [0, 1] is judged as an error.
ReportedImpact read_impact(const Reply& reply) {
  const text::JsonField root = reply.root();
  root.no_misspelt_keys({"message", "contact", "time", "tolerance"});
  ReportedImpact out;
  out.contact = root.at("contact").boolean();
  if (root.has("time")) out.time = root.at("time").number();
  if (root.has("tolerance")) out.tolerance = root.at("tolerance").number();
  return out;
}

Reply::Reply(const std::string& line, std::string from, const char* message)
    : from_(std::move(from)), value_(parsed(line, from_, message)) {
  const std::string kind = root().at("message").text();
  if (kind != "error" && kind != "refused") {
    if (kind != message) root().at("message").refuse("\"" + std::string(message) + "\"");
    if (kind == "done" || kind == "ready")
      root().no_misspelt_keys({"message", "bytes", "ms", "semantics", "impacts"});
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

// The contacts behind an answer: lists of records of fixed size, one list after the other.

namespace {

constexpr std::size_t kWord = sizeof(std::uint32_t), kNumber = sizeof(double);

struct List {
  const char* key;
  std::size_t record;  ///< bytes
};

constexpr List kLists[] = {{"bodies", 2 * kWord},
                           {"triangles", 4 * kWord},
                           {"cells", 4 * kWord},
                           {"vertices", 3 * kWord},
                           {"near", 4 * kWord},
                           {"piece_contacts", 4 * kWord + 4 * kNumber},
                           {"vertex_contacts", 4 * kWord + 4 * kNumber},
                           {"impacts", 2 * kWord + kNumber},
                           {"impact_triangles", 4 * kWord},
                           {"impact_vertices", 4 * kWord},
                           {"impact_edges", 6 * kWord}};

std::size_t count_of(const Reply& reply, const List& list) {
  if (!reply.root().has(list.key)) return 0;
  return reply.root().at(list.key).whole(0, kLargestAnswer / list.record);
}

/// Takes values off the front of what was read. @pre the sizes were checked
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t word() { return take<std::uint32_t>(); }
  double number() { return take<double>(); }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  ElementPair elements() {
    const std::uint32_t body_a = word(), body_b = word(), a = word(), b = word();
    return {body_a, body_b, a, b};
  }
  NearPair near() {
    const std::uint32_t body = word(), other = word(), vertex = word(), triangle = word();
    return {body, other, vertex, triangle};
  }
  VertexInBody vertex() {
    const std::uint32_t body = word(), in = word(), v = word();
    return {body, in, v};
  }

 private:
  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  std::string_view bytes_;
};

}  // namespace

void check_contact_counts(const Reply& reply) {
  static const std::vector<std::string> kKeys = [] {  // this is timed
    std::vector<std::string> keys = {"message", "bytes", "ms"};
    for (const List& list : kLists) keys.emplace_back(list.key);
    return keys;
  }();
  reply.root().no_misspelt_keys(kKeys);
  std::size_t sum = 0;
  for (const List& list : kLists) sum += count_of(reply, list) * list.record;
  if (sum != reply.bytes())
    reply.root().fail("announces lists of " + std::to_string(sum) + " bytes together and says " +
                      std::to_string(reply.bytes()) + " in `bytes`");
}

void read_contacts(const Reply& reply, std::string_view bytes, ContactSet& out, StepAnswer& steps) {
  check_contact_counts(reply);
  CONTACTCHECK_INVARIANT(bytes.size() == reply.bytes(), "as many bytes as were announced");
  Reader in(bytes);
  std::size_t list = 0;
  const auto read = [&](auto& items, auto&& one) {
    const std::size_t count = count_of(reply, kLists[list++]);
    for (std::size_t i = 0; i < count; ++i) items.push_back(one(in));
  };
  read(out.bodies, [](Reader& r) {
    const std::uint32_t a = r.word(), b = r.word();
    return BodyPair{a, b};
  });
  read(out.triangles, [](Reader& r) { return r.elements(); });
  read(out.cells, [](Reader& r) { return r.elements(); });
  read(out.vertices, [](Reader& r) { return r.vertex(); });
  read(out.near, [](Reader& r) { return r.near(); });
  read(out.piece_contacts, [](Reader& r) {
    PieceContact contact;
    contact.pieces = r.elements();
    contact.depth = r.number();
    contact.normal = r.vector();
    return contact;
  });
  read(out.vertex_contacts, [](Reader& r) {
    VertexContact contact;
    contact.where = r.vertex();
    r.word();  // keeps the numbers behind it at a multiple of eight
    contact.depth = r.number();
    contact.normal = r.vector();
    return contact;
  });
  read(steps.bodies, [](Reader& r) {
    const std::uint32_t a = r.word(), b = r.word();
    const double time = r.number();  // below 0: it reports none
    return BodyImpact{{a, b}, time < 0.0 ? std::nullopt : std::optional(time)};
  });
  read(steps.triangles, [](Reader& r) { return r.elements(); });
  read(steps.vertices, [](Reader& r) { return r.near(); });
  read(steps.edges, [](Reader& r) {
    NamedEdges edges;
    edges.body_a = r.word();
    edges.body_b = r.word();
    for (Edge* edge : {&edges.a, &edges.b})
      for (std::uint32_t& vertex : *edge) vertex = r.word();
    return edges;
  });
}

}  // namespace contactcheck::plugin
