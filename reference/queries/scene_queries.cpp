#include "reference/queries/scene_queries.h"

#include <fmt/format.h>
#include <gmpxx.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/impact.h"
#include "reference/oracle/certificate_text.h"
#include "reference/oracle/elementary_impact.h"
#include "reference/oracle/impact_certificate.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/split_mix.h"
#include "reference/text/file_text.h"

namespace contactcheck::queries {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kSchema = "contactcheck-query-export/1", *kIndex = "queries.json";

/// The elements of a body that can meet others, by vertex numbers.
struct Elements {
  std::vector<std::uint32_t> vertices;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> place;  ///< of each vertex: the first one welded to it, or itself
};

Elements elements_of(const BodyShape& shape) {
  Elements elements;
  std::set<std::uint32_t> used;
  std::set<std::array<std::uint32_t, 2>> edges;
  elements.place.resize(shape.mesh.vertices.size());
  for (std::size_t v = 0; v < elements.place.size(); ++v)
    elements.place[v] = static_cast<std::uint32_t>(v);
  for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
    const Triangle& triangle = shape.mesh.triangles[t];
    elements.triangles.push_back({triangle[0], triangle[1], triangle[2]});
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = triangle[corner], to = triangle[(corner + 1) % 3];
      used.insert(from);
      if (from != to) edges.insert({std::min(from, to), std::max(from, to)});
      elements.place[from] = shape.linked()[t][corner];
    }
  }
  elements.vertices.assign(used.begin(), used.end());
  elements.edges.assign(edges.begin(), edges.end());
  return elements;
}

using Places = std::vector<Vec3>;

/// Boxes of elements over a step, from the places at both ends.
template <typename Element>
std::vector<Aabb> swept_boxes(const std::vector<Element>& elements, const Places& start,
                              const Places& end) {
  std::vector<Aabb> boxes(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const std::uint32_t vertex : elements[i]) {
      boxes[i].extend(start[vertex]);
      boxes[i].extend(end[vertex]);
    }
  return boxes;
}

/// All pairs (i, j) with boxes a[i] and b[j] that meet, ascending: a sweep along x over those that
/// meet what all of the other side's boxes take up together.
std::vector<std::pair<std::size_t, std::size_t>> meeting(const std::vector<Aabb>& a,
                                                         const std::vector<Aabb>& b) {
  struct Entry {
    const Aabb* box;
    std::size_t index;
    bool first;
  };
  std::vector<Entry> entries;
  const auto add = [&](const std::vector<Aabb>& own, const std::vector<Aabb>& others, bool first) {
    Aabb all;
    for (const Aabb& box : others) all.extend(box);
    for (std::size_t i = 0; i < own.size(); ++i)
      if (own[i].overlaps(all)) entries.push_back({&own[i], i, first});
  };
  add(a, b, true);
  add(b, a, false);
  std::sort(entries.begin(), entries.end(), [](const Entry& left, const Entry& right) {
    return left.box->lo.x() < right.box->lo.x();
  });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::array<std::vector<Entry>, 2> open;  // boxes whose high end may still be ahead
  for (const Entry& entry : entries) {
    std::vector<Entry>& others = open[entry.first ? 1 : 0];
    std::erase_if(others, [&](const Entry& o) { return o.box->hi.x() < entry.box->lo.x(); });
    for (const Entry& other : others)
      if (entry.box->overlaps(*other.box))
        pairs.emplace_back(entry.first ? entry.index : other.index,
                           entry.first ? other.index : entry.index);
    open[entry.first ? 0 : 1].push_back(entry);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Chooses `most` of the queries that it is given, each with the same probability, in their order;
/// all without a limit. (Source: Vitter, "Random Sampling with a Reservoir", 1985, algorithm R.)
class Reservoir {
 public:
  Reservoir(const QuerySample& sample, std::uint64_t stream)
      : most_(sample.most),
        random_(scene::SplitMix64::mixed(scene::SplitMix64::mixed(sample.seed) + stream)) {}

  void add(const ImpactQuery& query) {
    const std::size_t number = seen_++;
    if (!most_ || chosen_.size() < *most_) {
      chosen_.emplace_back(number, query);
      return;
    }
    // A 64-bit number modulo fewer than 2^40 queries is biased by less than 2^-24.
    const std::uint64_t place = random_.bits() % seen_;
    if (place < *most_) chosen_[place] = {number, query};
  }

  std::size_t seen() const { return seen_; }

  /// What is chosen so far, which is then forgotten: for those without a limit, after each step.
  std::vector<std::pair<std::size_t, ImpactQuery>> take() {
    std::sort(chosen_.begin(), chosen_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return std::exchange(chosen_, {});
  }

 private:
  std::optional<std::size_t> most_;
  scene::SplitMix64 random_;
  std::size_t seen_ = 0;
  std::vector<std::pair<std::size_t, ImpactQuery>> chosen_;
};

/// A text file, written as it grows.
class GrowingFile {
 public:
  GrowingFile(const fs::path& folder, const std::string& name)
      : file_(folder / name), out_(file_, std::ios::binary) {}

  void add(const std::string& text) {
    crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(text.data()), text.size());
    out_ << text;
  }

  /// Puts the CRC-32 of the whole file into `checksums`. @throws InputError if it was not written
  void finish(Json& checksums) {
    out_.close();
    if (!out_) throw InputError("cannot write " + text::in_quotes(file_.string()));
    checksums[file_.filename().string()] = fmt::format("{:08x}", crc_);
  }

 private:
  fs::path file_;
  std::ofstream out_;
  uLong crc_ = crc32_z(0, nullptr, 0);
};

/// The CSV file of one kind, and its certificates.
class QueryWriter {
 public:
  QueryWriter(const fs::path& folder, ImpactKind kind, bool certificates)
      : queries_(folder, name_of(kind) + std::string(".csv")) {
    if (certificates)
      certificates_.emplace(folder, name_of(kind) + std::string(".certificates.jsonl"));
  }

  void add(const ImpactQuery& query, ExportedQueries& counts) {
    const Impact truth = oracle::elementary_impact(query);
    ++counts.written;
    counts.contacts += truth.contact ? 1 : 0;
    counts.starts_in_contact += truth.starts_in_contact ? 1 : 0;
    std::string text;
    for (const auto* places : {&query.start, &query.end})
      for (const Vec3& place : *places) {
        for (const double value : {place.x(), place.y(), place.z()}) {
          const mpq_class fraction(value);
          text += fraction.get_num().get_str() + ',' + fraction.get_den().get_str() + ',';
        }
        text += truth.contact ? "1\n" : "0\n";
      }
    queries_.add(text);
    if (!certificates_) return;
    const auto proof = oracle::certify::certify_impact(query, truth);
    counts.proved += proof ? 1 : 0;
    certificates_->add(proof ? oracle::certify::impact_text(*proof) + "\n" : "null\n");
  }

  /// @throws InputError if a file could not be written
  void finish(Json& checksums) {
    queries_.finish(checksums);
    if (certificates_) certificates_->finish(checksums);
  }

 private:
  GrowingFile queries_;
  std::optional<GrowingFile> certificates_;
};

/// The queries of one step, in a fixed order: by pair of bodies, then by element.
class StepQueries {
 public:
  StepQueries(const std::vector<Elements>& elements, const std::vector<Places>& start,
              const std::vector<Places>& end, Reservoir& vertex_face, Reservoir& edge_edge)
      : elements_(elements),
        start_(start),
        end_(end),
        vertex_face_(vertex_face),
        edge_edge_(edge_edge) {
    for (std::size_t b = 0; b < elements.size(); ++b) {
      std::vector<std::array<std::uint32_t, 1>> vertices;
      for (const std::uint32_t v : elements[b].vertices) vertices.push_back({v});
      boxes_.push_back({swept_boxes(vertices, start[b], end[b]),
                        swept_boxes(elements[b].edges, start[b], end[b]),
                        swept_boxes(elements[b].triangles, start[b], end[b])});
    }
  }

  void of_vertices(std::size_t a, std::size_t b) {
    for (const auto& [i, j] : meeting(boxes_[a].vertices, boxes_[b].triangles)) {
      const std::uint32_t vertex = elements_[a].vertices[i];
      const auto& triangle = elements_[b].triangles[j];
      if (a == b && share(a, std::array{vertex}, triangle)) continue;
      vertex_face_.add(query(ImpactKind::vertex_triangle, {a, b, b, b},
                             {vertex, triangle[0], triangle[1], triangle[2]}));
    }
  }

  void of_edges(std::size_t a, std::size_t b) {
    for (const auto& [i, j] : meeting(boxes_[a].edges, boxes_[b].edges)) {
      if (a == b && i >= j) continue;
      const auto& first = elements_[a].edges[i];
      const auto& second = elements_[b].edges[j];
      if (a == b && share(a, first, second)) continue;
      edge_edge_.add(
          query(ImpactKind::edge_edge, {a, a, b, b}, {first[0], first[1], second[0], second[1]}));
    }
  }

 private:
  struct Boxes {
    std::vector<Aabb> vertices, edges, triangles;
  };

  template <typename First, typename Second>
  bool share(std::size_t body, const First& first, const Second& second) const {
    const auto& place = elements_[body].place;
    for (const std::uint32_t v : first)
      for (const std::uint32_t w : second)
        if (place[v] == place[w]) return true;
    return false;
  }

  ImpactQuery query(ImpactKind kind, const std::array<std::size_t, 4>& bodies,
                    const std::array<std::uint32_t, 4>& vertices) const {
    ImpactQuery result{kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      result.start[i] = start_[bodies[i]][vertices[i]];
      result.end[i] = end_[bodies[i]][vertices[i]];
    }
    return result;
  }

  const std::vector<Elements>& elements_;
  const std::vector<Places>&start_, &end_;
  Reservoir &vertex_face_, &edge_edge_;
  std::vector<Boxes> boxes_;
};

Json to_json(const ExportedQueries& counts, bool certificates) {
  Json json = {{"found", counts.found},
               {"written", counts.written},
               {"contacts", counts.contacts},
               {"starts_in_contact", counts.starts_in_contact}};
  if (certificates) {
    json["proved"] = counts.proved;
    json["unproved"] = counts.written - counts.proved;
  }
  return json;
}

}  // namespace

QueryExport export_queries(const scene::Scene& scene, const QuerySample& sample,
                           const fs::path& folder, const std::function<void()>& before_step) {
  std::vector<Elements> elements;
  for (const Body& body : scene.bodies) elements.push_back(elements_of(*body.shape));
  const bool own = any_self(scene.levels);
  const scene::FramePositions positions(scene);
  Reservoir vertex_face(sample, 0), edge_edge(sample, 1);
  QueryWriter vertex_face_file(folder, ImpactKind::vertex_triangle, sample.certificates),
      edge_edge_file(folder, ImpactKind::edge_edge, sample.certificates);
  QueryExport result;
  Json steps = Json::array();
  const auto write = [&] {
    for (const auto& [number, query] : vertex_face.take())
      vertex_face_file.add(query, result.vertex_face);
    for (const auto& [number, query] : edge_edge.take())
      edge_edge_file.add(query, result.edge_edge);
  };

  const auto places = [&](std::size_t frame) {
    scene::require_judgeable(scene, frame, positions[frame]);
    return positions[frame].vertices;
  };

  std::vector<Places> start = places(0);
  for (std::size_t step = 0; step + 1 < scene.frames; ++step) {
    before_step();
    std::vector<Places> end = places(step + 1);
    const std::size_t vertices_before = vertex_face.seen(), edges_before = edge_edge.seen();
    StepQueries queries(elements, start, end, vertex_face, edge_edge);
    for (std::size_t a = 0; a < elements.size(); ++a)
      for (std::size_t b = a; b < elements.size(); ++b) {
        if (a == b && !own) continue;
        queries.of_vertices(a, b);
        if (a != b) queries.of_vertices(b, a);
        queries.of_edges(a, b);
      }
    if (!sample.most) write();
    steps.push_back({{"step", step},
                     {"vertex_face", vertex_face.seen() - vertices_before},
                     {"edge_edge", edge_edge.seen() - edges_before}});
    start = std::move(end);
    ++result.steps;
  }
  write();
  result.vertex_face.found = vertex_face.seen();
  result.edge_edge.found = edge_edge.seen();

  Json index = {{"schema", kSchema},
                {"version", CONTACTCHECK_VERSION},
                {"scene", scene.id},
                {"title", scene.title},
                {"self", own}};
  if (sample.most) index["sample"] = {{"most", *sample.most}, {"seed", sample.seed}};
  index["certificates"] = sample.certificates;
  index["vertex_face"] = to_json(result.vertex_face, sample.certificates);
  index["edge_edge"] = to_json(result.edge_edge, sample.certificates);
  Json& checksums = index["crc32"] = Json::object();
  vertex_face_file.finish(checksums);
  edge_edge_file.finish(checksums);
  index["steps"] = steps;
  write_file_atomically(folder / kIndex, index.dump(1) + "\n");
  return result;
}

bool is_query_export(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / kIndex, ignored)) return false;
  const Json index = Json::parse(text::read_file_bytes(folder / kIndex, "export"), nullptr, false);
  return index.is_object() && index.value("schema", Json()) == kSchema;
}

}  // namespace contactcheck::queries
