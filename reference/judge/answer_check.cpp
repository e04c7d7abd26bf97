#include "reference/judge/answer_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reference/text/counted.h"

namespace contactcheck::judge {

void check_answer(const scene::Scene& scene, std::size_t frame, const ContactSet& contacts) {
  const auto fail = [frame](const std::string& what) {
    throw std::runtime_error("frame " + std::to_string(frame) + ": the answer " + what);
  };
  const auto shape = [&scene](std::uint32_t body) -> const BodyShape& {
    return *scene.bodies[body].shape;
  };
  const auto check_pair = [&](std::uint32_t a, std::uint32_t b) {
    const std::size_t count = scene.bodies.size();
    if (a >= count || b >= count)
      fail("names body " + std::to_string(std::max(a, b)) + " of " +
           text::counted(count, "body", "bodies"));
    if (a == b) fail("names body \"" + scene.bodies[a].name + "\" in contact with itself");
  };
  const auto check_element = [&](const char* kind, std::uint32_t body, std::uint32_t id,
                                 std::size_t count, const char* hint = "") {
    if (id < count) return;
    fail("names " + std::string(kind) + " " + std::to_string(id) + " of body \"" +
         scene.bodies[body].name + "\", which has " + std::to_string(count) + hint);
  };
  const auto check_elements = [&](const char* kind, const ElementPair& pair, auto&& count_of) {
    const std::size_t of_a = count_of(pair.body_a), of_b = count_of(pair.body_b);
    const char* const hint = pair.a < of_b && pair.b < of_a
                                 ? "; exchanged, both would exist: a belongs to the body with the "
                                   "lower index"
                                 : "";
    check_element(kind, pair.body_a, pair.a, of_a, hint);
    check_element(kind, pair.body_b, pair.b, of_b, hint);
  };
  const auto triangles_of = [&](std::uint32_t body) { return shape(body).mesh.triangles.size(); };
  const auto cells_of = [&](std::uint32_t body) {
    return shape(body).lattice ? shape(body).lattice->cells.size() : std::size_t{0};
  };
  const auto check_triangles = [&](const ElementPair& pair) {
    check_elements("triangle", pair, triangles_of);
  };
  const auto check_cells = [&](const ElementPair& pair) { check_elements("cell", pair, cells_of); };
  const auto check_vertex = [&](const VertexInBody& v) {
    check_pair(v.body, v.in);
    check_element("vertex", v.body, v.vertex, shape(v.body).mesh.vertices.size());
  };
  const auto check_depth = [&](double depth, const Vec3& normal) {
    if (!std::isfinite(depth) || depth < 0.0 || !normal.allFinite())
      fail("holds a depth or normal that is negative or no number");
  };

  const auto check_body = [&](std::uint32_t body) {
    if (body >= scene.bodies.size())
      fail("names body " + std::to_string(body) + " of " +
           text::counted(scene.bodies.size(), "body", "bodies"));
  };

  for (const std::uint32_t body : contacts.self_bodies) check_body(body);
  const auto check_own = [&](const char* kind, const SelfPair& p, const auto& count_of) {
    check_body(p.body);
    for (const std::uint32_t element : {p.a, p.b})
      check_element(kind, p.body, element, count_of(p.body));
    if (p.a == p.b)
      fail("names " + std::string(kind) + " " + std::to_string(p.a) + " of body \"" +
           scene.bodies[p.body].name + "\" in contact with itself");
  };
  for (const SelfPair& p : contacts.self) check_own("triangle", p, triangles_of);
  for (const SelfPair& p : contacts.self_cells) check_own("cell", p, cells_of);
  const auto check_own_vertex = [&](const NearPair& p) {
    check_body(p.body);
    check_element("vertex", p.body, p.vertex, shape(p.body).mesh.vertices.size());
    check_element("triangle", p.body, p.triangle, triangles_of(p.body));
  };
  for (const NearPair& p : contacts.self_near) check_own_vertex(p);
  // There are fewer edges than corners of triangles; a number that is none is spurious at worst.
  const auto edges_of = [&](std::uint32_t body) { return 3 * triangles_of(body); };
  for (const NearPair& p : contacts.self_impact_vertices) check_own_vertex(p);
  for (const SelfPair& p : contacts.self_impact_edges) check_own("edge", p, edges_of);
  for (const BodyImpact& impact : contacts.impacts) {
    check_pair(impact.bodies.a, impact.bodies.b);
    if (impact.time && !(*impact.time >= 0.0 && *impact.time <= 1.0))
      fail("holds a time of contact that is not within [0, 1]");
  }
  for (const ElementPair& p : contacts.impact_triangles)
    check_elements("triangle", p, triangles_of);
  for (const ElementPair& p : contacts.impact_edges) check_elements("edge", p, edges_of);
  for (const BodyPair& p : contacts.bodies) check_pair(p.a, p.b);
  for (const ElementPair& p : contacts.triangles) check_triangles(p);
  for (const ElementPair& p : contacts.cells) check_cells(p);
  for (const VertexInBody& v : contacts.vertices) check_vertex(v);
  const auto check_near = [&](const NearPair& p) {
    check_vertex({p.body, p.other, p.vertex});
    check_element("triangle", p.other, p.triangle, triangles_of(p.other));
  };
  for (const NearPair& p : contacts.near) check_near(p);
  for (const NearPair& p : contacts.impact_vertices) check_near(p);
  for (const PieceContact& c : contacts.piece_contacts) {
    check_pair(c.pieces.body_a, c.pieces.body_b);
    if (std::binary_search(contacts.cells.begin(), contacts.cells.end(), c.pieces)) {
      check_cells(c.pieces);
    } else {
      check_triangles(c.pieces);
    }
    check_depth(c.depth, c.normal);
  }
  for (const VertexContact& c : contacts.vertex_contacts) {
    check_vertex(c.where);
    check_depth(c.depth, c.normal);
  }
}

void ask(Detector& detector, Question question, const scene::Scene& scene, std::size_t frame,
         ContactSet& out) {
  out.clear();
  detector.query(question, out);
  out.canonicalize();
  check_answer(scene, frame, out);
}

}  // namespace contactcheck::judge
