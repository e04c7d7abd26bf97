#include "tests/metamorphic/subject.h"

#include <numeric>
#include <utility>

namespace contactcheck::test {
namespace {

std::vector<std::uint32_t> numbers_below(std::size_t count) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

}  // namespace

Names same_names(const std::vector<Body>& bodies) {
  Names names;
  names.body = numbers_below(bodies.size());
  for (const Body& body : bodies) {
    names.triangle.push_back(numbers_below(body.shape->mesh.triangles.size()));
    names.vertex.push_back(numbers_below(body.shape->mesh.vertices.size()));
  }
  return names;
}

ContactSet in_names_of_subject(ContactSet set, const Names& names) {
  const auto body = [&](std::uint32_t& b) { b = names.body[b]; };
  const auto triangles = [&](ElementPair& p) {
    p.a = names.triangle[p.body_a][p.a], p.b = names.triangle[p.body_b][p.b];
    body(p.body_a), body(p.body_b);
  };
  for (BodyPair& p : set.bodies) body(p.a), body(p.b);
  for (ElementPair& p : set.cells) body(p.body_a), body(p.body_b);
  for (ElementPair& p : set.triangles) triangles(p);
  for (VertexInBody& v : set.vertices) {
    v.vertex = names.vertex[v.body][v.vertex];
    body(v.body), body(v.in);
  }
  for (std::vector<NearPair>* pairs : {&set.near, &set.self_near})
    for (NearPair& p : *pairs) {
      p.vertex = names.vertex[p.body][p.vertex], p.triangle = names.triangle[p.other][p.triangle];
      body(p.body), body(p.other);
    }
  for (SelfPair& p : set.self) {
    p.a = names.triangle[p.body][p.a], p.b = names.triangle[p.body][p.b];
    body(p.body);
  }
  for (SelfPair& p : set.self_cells) body(p.body);
  for (std::uint32_t& b : set.self_bodies) body(b);
  // Depths and normals are no part of what is compared, and which pieces they have the sets say.
  set.piece_contacts.clear();
  set.vertex_contacts.clear();
  set.canonicalize();
  return set;
}

Variant unchanged(std::shared_ptr<const Subject> subject) {
  Variant out;
  out.bodies = subject->bodies;
  out.frames.assign(subject->frames.begin(), subject->frames.end());
  out.names = same_names(out.bodies);
  out.plain = std::move(subject);
  return out;
}

}  // namespace contactcheck::test
