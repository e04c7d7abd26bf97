#include "reference/suite/case_file.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/deform/lattice.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {
namespace {
using Json = nlohmann::ordered_json;

Json point(const Vec3& p) { return {hex_float(p.x()), hex_float(p.y()), hex_float(p.z())}; }

Json triangle_points(const judge::JudgedScene& judged, std::size_t frame, std::uint32_t body,
                     std::uint32_t triangle) {
  Json out = Json::array();
  for (std::uint32_t v : judged.scene->bodies[body].shape->mesh.triangles[triangle])
    out.push_back(point(judged.positions[frame].vertices[body][v]));
  return out;
}

Json cell_nodes(const judge::JudgedScene& judged, std::size_t frame, std::uint32_t body,
                std::uint32_t cell) {
  Json out = Json::array();
  const Corners corners = corners_of(*judged.scene->bodies[body].shape->lattice, cell,
                                     judged.positions[frame].nodes[body]);
  for (const Vec3& p : corners) out.push_back(point(p));
  return out;
}

// A missed contact at level `cell` is a pair of triangles; a spurious one is a pair of cells.
bool names_triangles(const judge::Disagreement& d) {
  return d.level == name_of(Level::kTriangle) ||
         (d.level == name_of(Level::kCell) && d.kind == "missed");
}

bool names_cells(const judge::Disagreement& d) {
  return d.level == name_of(Level::kBox) ||
         (d.level == name_of(Level::kCell) && d.kind == "spurious");
}

// A vertex, of level `vertex` or `near`, is what stands first in its pair.
bool names_vertex(const judge::Disagreement& d) {
  return d.level == name_of(Level::kVertex) || d.level == name_of(Level::kNear);
}

Json first_of_vertex_pair(const judge::JudgedScene& judged, const judge::Disagreement& d) {
  return {{"body", judged.scene->bodies[d.pair.body_a].name},
          {"vertex", d.pair.a},
          {"position", point(judged.positions[d.frame].vertices[d.pair.body_a][d.pair.a])}};
}

Json element(const judge::JudgedScene& judged, const judge::Disagreement& d, std::uint32_t body,
             std::uint32_t id) {
  Json out = {{"body", judged.scene->bodies[body].name}};
  if (names_triangles(d) || d.level == name_of(Level::kNear)) {
    out["triangle"] = id;
    out["vertices"] = triangle_points(judged, d.frame, body, id);
  } else if (names_cells(d)) {
    out["cell"] = id;
    out["nodes"] = cell_nodes(judged, d.frame, body, id);
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
