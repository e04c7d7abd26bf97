#include "reference/run/answer_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace contactcheck {

std::size_t AnswerCheck::cells_of(std::uint32_t body) const {
  return shape(body).lattice ? shape(body).lattice->cells.size() : 0;
}

void AnswerCheck::operator()(const ContactSet& contacts) const {
  for (const BodyPair& p : contacts.bodies) check_pair(p.a, p.b);
  for (const ElementPair& p : contacts.triangles) check_elements("triangle", p);
  for (const ElementPair& p : contacts.cells) check_elements("cell", p);
  for (const VertexInBody& v : contacts.vertices) check_vertex(v);
  for (const NearPair& p : contacts.near) {
    check_vertex({p.body, p.other, p.vertex});
    check_element("triangle", p.other, p.triangle, triangles_of(p.other));
  }
  check_contacts(contacts);
}

void AnswerCheck::check_contacts(const ContactSet& contacts) const {
  for (const PieceContact& c : contacts.piece_contacts) {
    check_pair(c.pieces.body_a, c.pieces.body_b);
    const bool of_cells =
        std::binary_search(contacts.cells.begin(), contacts.cells.end(), c.pieces);
    check_elements(of_cells ? "cell" : "triangle", c.pieces);
    check_way_out(c.depth, c.normal);
  }
  for (const VertexContact& c : contacts.vertex_contacts) {
    check_vertex(c.where);
    check_way_out(c.depth, c.normal);
  }
}

void AnswerCheck::check_pair(std::uint32_t a, std::uint32_t b) const {
  const std::size_t count = scene_.bodies.size();
  if (a >= count || b >= count)
    fail("body " + std::to_string(std::max(a, b)) + " of " + std::to_string(count) + " bodies");
  if (a == b) fail("body \"" + scene_.bodies[a].name + "\" in contact with itself");
}

void AnswerCheck::check_elements(const char* kind, const ElementPair& pair) const {
  const bool cells = std::string_view(kind) == "cell";
  for (const auto& [body, id] : {std::pair(pair.body_a, pair.a), std::pair(pair.body_b, pair.b)})
    check_element(kind, body, id, cells ? cells_of(body) : triangles_of(body));
}

void AnswerCheck::check_element(const char* kind, std::uint32_t body, std::uint32_t id,
                                std::size_t count) const {
  if (id < count) return;
  fail(std::string(kind) + " " + std::to_string(id) + " of body \"" + scene_.bodies[body].name +
       "\", which has " + std::to_string(count));
}

void AnswerCheck::check_vertex(const VertexInBody& v) const {
  check_pair(v.body, v.in);
  check_element("vertex", v.body, v.vertex, shape(v.body).mesh.vertices.size());
}

void AnswerCheck::check_way_out(double depth, const Vec3& normal) const {
  if (std::isfinite(depth) && depth >= 0.0 && normal.allFinite()) return;
  throw std::runtime_error("frame " + std::to_string(frame_) +
                           ": the answer holds a depth or normal that is negative or no number");
}

void AnswerCheck::fail(const std::string& what) const {
  throw std::runtime_error("frame " + std::to_string(frame_) + ": the answer names " + what);
}

void ask(Detector& detector, Question question, const AnswerCheck& check, ContactSet& out) {
  out.clear();
  detector.query(question, out);
  out.canonicalize();
  check(out);
}

}  // namespace contactcheck
