#include "reference/suite/case_file.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/deform/lattice.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {
namespace {
using Json = nlohmann::ordered_json;

Json point(const Vec3& p) { return {hex_float(p.x()), hex_float(p.y()), hex_float(p.z())}; }
Json decimal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// Bit for bit, and for people.
void add_points(Json& element, const std::string& key, const std::vector<Vec3>& points) {
  Json hex = Json::array(), decimals = Json::array();
  for (const Vec3& p : points) {
    hex.push_back(point(p));
    decimals.push_back(decimal(p));
  }
  element[key] = std::move(hex);
  element[key + "_decimal"] = std::move(decimals);
}

// A missed contact of cells is a pair of triangles; a spurious one is a pair of cells.
bool names_triangles(const judge::Disagreement& d) {
  const std::optional<Level> level = level_from_name(d.level);
  return level == Level::kTriangle ||
         ((level == Level::kCell || level == Level::kSelfCell) && d.kind == "missed") ||
         level == Level::kSelf || level == Level::kSelfVertex || level == Level::kSelfEdge;
}

bool names_cells(const judge::Disagreement& d) {
  return d.level == name_of(Level::kBox) ||
         ((d.level == name_of(Level::kCell) || d.level == name_of(Level::kSelfCell)) &&
          d.kind == "spurious");
}

// A vertex, of level `vertex` or `near`, is what stands first in its pair.
bool names_vertex(const judge::Disagreement& d) {
  return d.level == name_of(Level::kVertex) || d.level == name_of(Level::kNear);
}

Json first_of_vertex_pair(const judge::JudgedScene& judged, const judge::Disagreement& d) {
  const Vec3& place = judged.positions[d.frame].vertices[d.pair.body_a][d.pair.a];
  return {{"body", judged.scene->bodies[d.pair.body_a].name},
          {"vertex", d.pair.a},
          {"position", point(place)},
          {"position_decimal", decimal(place)}};
}

Json element(const judge::JudgedScene& judged, const judge::Disagreement& d, std::uint32_t body,
             std::uint32_t id) {
  const BodyShape& shape = *judged.scene->bodies[body].shape;
  const scene::FramePosition& positions = judged.positions[d.frame];
  Json out = {{"body", judged.scene->bodies[body].name}};
  if (names_triangles(d) || d.level == name_of(Level::kNear)) {
    out["triangle"] = id;
    std::vector<Vec3> corners;
    for (const std::uint32_t v : shape.mesh.triangles[id])
      corners.push_back(positions.vertices[body][v]);
    add_points(out, "vertices", corners);
  } else if (names_cells(d)) {
    out["cell"] = id;
    const Corners corners = corners_of(*shape.lattice, id, positions.nodes[body]);
    add_points(out, "nodes", {corners.begin(), corners.end()});
  }
  return out;
}

}  // namespace

std::string hex_float(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

void write_case(const std::filesystem::path& file, const judge::JudgedScene& judged,
                const judge::Disagreement& d, const std::string& recording) {
  const Json first = names_vertex(d) ? first_of_vertex_pair(judged, d)
                                     : element(judged, d, d.pair.body_a, d.pair.a);
  Json out = {{"scene", d.scene},
              {"frame", d.frame},
              {"detector", d.detector},
              {"level", d.level},
              {"kind", d.kind}};
  if (!recording.empty()) out["recording"] = recording;
  out["first"] = first;
  out["second"] = element(judged, d, d.pair.body_b, d.pair.b);
  write_file_atomically(file, out.dump(1) + "\n");
}

}  // namespace contactcheck::suite
