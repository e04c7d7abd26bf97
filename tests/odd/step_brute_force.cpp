#include "tests/odd/step_brute_force.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "core/types/mesh_edges.h"
#include "reference/oracle/rational_clipping.h"

namespace contactcheck::test {
namespace {

using oracle::rational::TriangleCorners;
using oracle::rational::triangles_intersect_by_clipping;

const TriangleMesh& mesh_of(const StepScene& scene, std::uint32_t body) {
  return scene.bodies[body].shape->mesh;
}

template <typename Vertices>
Aabb swept_box(const StepScene& scene, std::uint32_t body, const Vertices& vertices) {
  Aabb box;
  for (const std::uint32_t v : vertices) {
    box.extend(scene.start.vertices[body][v]);
    box.extend(scene.end.vertices[body][v]);
  }
  return box;
}

std::vector<ExactTime> times_of_contact(const StepScene& scene, ImpactKind kind,
                                        const std::array<std::uint32_t, 4>& bodies,
                                        const std::array<std::uint32_t, 4>& vertices) {
  ImpactQuery query{kind, {}, {}};
  for (std::size_t i = 0; i < 4; ++i) {
    query.start[i] = scene.start.vertices[bodies[i]][vertices[i]];
    query.end[i] = scene.end.vertices[bodies[i]][vertices[i]];
  }
  return test::times_of_contact(query);
}

}  // namespace

/// The elements of a body with their boxes over the step, and what of them meets another body.
struct StepBruteForce::Elements {
  Elements(const StepScene& scene, std::uint32_t body)
      : mesh(mesh_of(scene, body)), edges(mesh_edges(mesh.triangles)) {
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
      vertex_boxes.push_back(swept_box(scene, body, std::array{v}));
    for (const Edge& e : edges.edges) edge_boxes.push_back(swept_box(scene, body, e));
    for (const Triangle& t : mesh.triangles) triangle_boxes.push_back(swept_box(scene, body, t));
  }

  const TriangleMesh& mesh;
  const MeshEdges edges;
  std::vector<Aabb> vertex_boxes, edge_boxes, triangle_boxes;
};

StepBruteForce::StepBruteForce(const StepScene& scene) : scene_(scene) {
  const auto count = static_cast<std::uint32_t>(scene.bodies.size());
  for (std::uint32_t a = 0; a < count; ++a) {
    judge_own(a);
    for (std::uint32_t b = a + 1; b < count; ++b) judge_pair(a, b);
  }
  backwards_.impact_vertices = forwards_.impact_vertices;
  backwards_.impact_edges = forwards_.impact_edges;
  backwards_.self_impact_vertices = forwards_.self_impact_vertices;
  backwards_.self_impact_edges = forwards_.self_impact_edges;
  forwards_.canonicalize();
  backwards_.canonicalize();
  std::sort(at_start_.begin(), at_start_.end());
  std::sort(at_end_.begin(), at_end_.end());
}

void StepBruteForce::judge_pair(std::uint32_t a, std::uint32_t b) {
  const Elements of_a(scene_, a), of_b(scene_, b);
  std::vector<ExactTime> found;
  const auto decide = [&](ImpactKind kind, const std::array<std::uint32_t, 4>& bodies,
                          const std::array<std::uint32_t, 4>& vertices) {
    ++decided_;
    const std::vector<ExactTime> times = times_of_contact(scene_, kind, bodies, vertices);
    found.insert(found.end(), times.begin(), times.end());
    return !times.empty();
  };
  using Table = std::vector<std::vector<char>>;
  const auto vertices_with_faces = [&](std::uint32_t p, const Elements& of_p, std::uint32_t q,
                                       const Elements& of_q) {
    Table table(of_p.mesh.vertices.size(), std::vector<char>(of_q.mesh.triangles.size()));
    for (std::uint32_t v = 0; v < table.size(); ++v)
      for (std::uint32_t t = 0; t < table[v].size(); ++t) {
        if (!of_p.vertex_boxes[v].overlaps(of_q.triangle_boxes[t])) continue;
        const Triangle& corners = of_q.mesh.triangles[t];
        if (!decide(ImpactKind::vertex_triangle, {p, q, q, q},
                    {v, corners[0], corners[1], corners[2]}))
          continue;
        table[v][t] = 1;
        forwards_.impact_vertices.push_back({p, q, v, t});
      }
    return table;
  };
  const Table ab = vertices_with_faces(a, of_a, b, of_b),
              ba = vertices_with_faces(b, of_b, a, of_a);
  Table edges(of_a.edges.edges.size(), std::vector<char>(of_b.edges.edges.size()));
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (std::uint32_t f = 0; f < edges[e].size(); ++f) {
      if (!of_a.edge_boxes[e].overlaps(of_b.edge_boxes[f])) continue;
      const Edge &p = of_a.edges.edges[e], &q = of_b.edges.edges[f];
      if (!decide(ImpactKind::edge_edge, {a, a, b, b}, {p[0], p[1], q[0], q[1]})) continue;
      edges[e][f] = 1;
      forwards_.impact_edges.push_back({a, b, e, f});
    }
  const auto corners = [&](const FrameData& at, std::uint32_t body, std::uint32_t t) {
    const Triangle& of = mesh_of(scene_, body).triangles[t];
    const std::vector<Vec3>& vertices = at.vertices[body];
    return TriangleCorners{vertices[of[0]], vertices[of[1]], vertices[of[2]]};
  };
  for (std::uint32_t s = 0; s < of_a.mesh.triangles.size(); ++s)
    for (std::uint32_t t = 0; t < of_b.mesh.triangles.size(); ++t) {
      if (!of_a.triangle_boxes[s].overlaps(of_b.triangle_boxes[t])) continue;
      const auto touch = [&](const FrameData& at) {
        return triangles_intersect_by_clipping(corners(at, a, s), corners(at, b, t));
      };
      const bool at_start = touch(scene_.start), at_end = touch(scene_.end);
      bool meet = false;
      for (std::size_t i = 0; i < 3; ++i) {
        meet |= ab[of_a.mesh.triangles[s][i]][t] != 0 || ba[of_b.mesh.triangles[t][i]][s] != 0;
        for (std::size_t j = 0; j < 3; ++j) {
          const std::uint32_t e = of_a.edges.of_triangle[s][i], f = of_b.edges.of_triangle[t][j];
          meet |= e != MeshEdges::kNone && f != MeshEdges::kNone && edges[e][f] != 0;
        }
      }
      const ElementPair pair{a, b, s, t};
      if (at_start) at_start_.push_back(pair), found.emplace_back(0);
      if (at_end) at_end_.push_back(pair), found.emplace_back(1);
      if (at_start || meet) forwards_.impact_triangles.push_back(pair);
      if (at_end || meet) backwards_.impact_triangles.push_back(pair);
    }
  if (!found.empty()) times_.emplace(BodyPair{a, b}, std::move(found));
}

void StepBruteForce::judge_own(std::uint32_t body) {
  const Elements of(scene_, body);
  const BodyShape& shape = *scene_.bodies[body].shape;
  const std::vector<Vec3>& rest = shape.mesh.vertices;
  const auto share = [&](const auto& some, const auto& others) {
    for (const std::uint32_t v : some)
      for (const std::uint32_t w : others)
        if (v == w || (!shape.welded.empty() && rest[v] == rest[w])) return true;
    return false;
  };
  const std::array<std::uint32_t, 4> bodies = {body, body, body, body};
  const auto meet = [&](ImpactKind kind, const std::array<std::uint32_t, 4>& vertices) {
    ++decided_;
    return !times_of_contact(scene_, kind, bodies, vertices).empty();
  };
  for (std::uint32_t v = 0; v < rest.size(); ++v)
    for (std::uint32_t t = 0; t < of.mesh.triangles.size(); ++t) {
      const Triangle& c = of.mesh.triangles[t];
      if (of.vertex_boxes[v].overlaps(of.triangle_boxes[t]) && !share(std::array{v}, c) &&
          meet(ImpactKind::vertex_triangle, {v, c[0], c[1], c[2]}))
        forwards_.self_impact_vertices.push_back({body, body, v, t});
    }
  const std::vector<Edge>& edges = of.edges.edges;
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (std::uint32_t f = e + 1; f < edges.size(); ++f)
      if (of.edge_boxes[e].overlaps(of.edge_boxes[f]) && !share(edges[e], edges[f]) &&
          meet(ImpactKind::edge_edge, {edges[e][0], edges[e][1], edges[f][0], edges[f][1]}))
        forwards_.self_impact_edges.push_back({body, e, f});
}

const std::vector<ExactTime>* StepBruteForce::times_of(const BodyPair& bodies) const {
  const auto found = times_.find(bodies);
  return found == times_.end() ? nullptr : &found->second;
}

bool StepBruteForce::starts_in_contact(const BodyPair& bodies, bool backwards) const {
  const std::vector<ElementPair>& touching = backwards ? at_end_ : at_start_;
  return std::any_of(touching.begin(), touching.end(), [&](const ElementPair& pair) {
    return pair.body_a == bodies.a && pair.body_b == bodies.b;
  });
}

// The first time forwards is the least; backwards it is 1 less the greatest.
bool StepBruteForce::first_within(const BodyPair& bodies, const mpq_class& low,
                                  const mpq_class& high, bool backwards) const {
  const mpq_class early = backwards ? mpq_class(1 - low) : low;
  const mpq_class late = backwards ? mpq_class(1 - high) : high;
  const int before = backwards ? 1 : -1;
  bool reached = false;
  for (const ExactTime& time : *times_of(bodies)) {
    if (time.compared(early) == before) return false;
    reached = reached || time.compared(late) != -before;
  }
  return reached;
}

std::string StepBruteForce::fault_of_first(const std::vector<oracle::FirstImpact>& first,
                                           bool backwards) const {
  if (first.size() != times_.size()) return "not one first time per pair of bodies";
  for (const oracle::FirstImpact& f : first) {
    if (times_of(f.bodies) == nullptr) return "other bodies";
    if (f.starts_in_contact != starts_in_contact(f.bodies, backwards)) return "not as it starts";
    if (f.starts_in_contact && (f.earliest != 0 || f.latest != 0)) return "a start that is not 0";
    if (!(0 <= f.earliest && f.earliest <= f.latest && f.latest <= 1)) return "no interval";
    if (f.latest - f.earliest > kImpactTimeWidth) return "too wide an interval";
    if (!first_within(f.bodies, f.earliest, f.latest, backwards)) return "another time";
  }
  return "";
}

std::string StepBruteForce::fault_of_times(const std::vector<BodyImpact>& impacts,
                                           bool backwards) const {
  const mpq_class width(kImpactTimeWidth);
  for (const BodyImpact& impact : impacts) {
    if (!impact.time) return "no time";
    const mpq_class time(*impact.time);
    if (times_of(impact.bodies) == nullptr) return "a time of other bodies";
    if (starts_in_contact(impact.bodies, backwards) != (time == 0)) return "not as it starts";
    if (!first_within(impact.bodies, time - width, time + width, backwards)) return "another time";
  }
  return "";
}

std::string different_list(const ContactSet& a, const ContactSet& b) {
  if (a.impact_vertices != b.impact_vertices) return "vertices";
  if (a.impact_edges != b.impact_edges) return "edges";
  if (a.impact_triangles != b.impact_triangles) return "triangles";
  if (a.self_impact_vertices != b.self_impact_vertices) return "own vertices";
  if (a.self_impact_edges != b.self_impact_edges) return "own edges";
  const auto same_bodies = [](const BodyImpact& x, const BodyImpact& y) {
    return x.bodies == y.bodies;
  };
  if (!std::equal(a.impacts.begin(), a.impacts.end(), b.impacts.begin(), b.impacts.end(),
                  same_bodies))
    return "bodies";
  return "";
}

std::string text(const StepScene& scene) {
  std::string out = scene.name;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    out += "\nbody " + std::to_string(b);
    for (const Triangle& t : scene.bodies[b].shape->mesh.triangles)
      out += " {" + std::to_string(t[0]) + "," + std::to_string(t[1]) + "," + std::to_string(t[2]) +
             "}";
    for (std::size_t v = 0; v < scene.start.vertices[b].size(); ++v) {
      out += "\n ";
      for (const FrameData* data : {&scene.start, &scene.end})
        for (int k = 0; k < 3; ++k) {
          char number[40];
          std::snprintf(number, sizeof number, " %a", data->vertices[b][v][k]);
          out += number;
        }
    }
  }
  return out;
}

}  // namespace contactcheck::test
