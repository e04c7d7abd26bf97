#include "reference/suite/case_file.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/deform/lattice.h"
#include "core/types/mesh_edges.h"
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

// What a disagreement is about; the vertex of a near pair stands first.
Json element(const judge::JudgedScene& judged, const judge::Disagreement& d, Element kind,
             std::uint32_t body, std::uint32_t id) {
  const BodyShape& shape = *judged.scene->bodies[body].shape;
  const scene::FramePosition& positions = judged.positions[d.frame];
  Json out = {{"body", judged.scene->bodies[body].name}};
  if (kind == Element::kVertex) {
    const Vec3& place = positions.vertices[body][id];
    out["vertex"] = shape.given.number_of(id);
    out["position"] = point(place);
    out["position_decimal"] = decimal(place);
  } else if (kind == Element::kTriangle) {
    out["triangle"] = id;
    std::vector<Vec3> corners;
    for (const std::uint32_t v : shape.mesh.triangles[id])
      corners.push_back(positions.vertices[body][v]);
    add_points(out, "vertices", corners);
  } else if (kind == Element::kEdge) {
    const std::vector<Edge> edges = mesh_edges(shape.mesh.triangles).edges;
    out["edge"] = Json::array();
    if (id >= edges.size()) return out;  // reported, and none
    std::vector<Vec3> ends;
    for (const std::uint32_t v : edges[id]) {
      out["edge"].push_back(shape.given.number_of(v));
      ends.push_back(positions.vertices[body][v]);
    }
    add_points(out, "vertices", ends);
  } else if (kind == Element::kCell) {
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
  const auto [first, second] = judge::elements_of(d.level, d.kind);
  Json out = {{"scene", d.scene},
              {"frame", d.frame},
              {"detector", d.detector},
              {"level", d.level},
              {"kind", d.kind}};
  if (!recording.empty()) out["recording"] = recording;
  out["first"] = element(judged, d, first, d.pair.body_a, d.pair.a);
  out["second"] = element(judged, d, second, d.pair.body_b, d.pair.b);
  write_file_atomically(file, out.dump(1) + "\n");
}

}  // namespace contactcheck::suite
