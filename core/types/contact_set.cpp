#include "core/types/contact_set.h"

#include <algorithm>
#include <utility>

#include "core/types/hash.h"

namespace contactcheck {
namespace {

template <typename T>
void sort_unique(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

void orient(BodyPair& pair) {
  if (pair.a > pair.b) std::swap(pair.a, pair.b);
}

void orient(ElementPair& pair) {
  if (pair.body_a <= pair.body_b) return;
  std::swap(pair.body_a, pair.body_b);
  std::swap(pair.a, pair.b);
}

void orient(SelfPair& pair) {
  if (pair.a > pair.b) std::swap(pair.a, pair.b);
}

BodyPair bodies_of(const ElementPair& p) { return {p.body_a, p.body_b}; }
BodyPair bodies_of(const NearPair& p) {
  return {std::min(p.body, p.other), std::max(p.body, p.other)};
}

template <typename Pair>
void add_bodies(const std::vector<Pair>& pairs, std::vector<std::uint32_t>& bodies) {
  for (const Pair& p : pairs)
    if (bodies.empty() || bodies.back() != p.body) bodies.push_back(p.body);
}

template <typename Pair>
void add_implied_bodies(const std::vector<Pair>& pairs, std::vector<BodyPair>& bodies) {
  BodyPair last{~0u, ~0u};
  for (const Pair& p : pairs) {
    const BodyPair body = bodies_of(p);
    if (body != last) bodies.push_back(last = body);
  }
}

void sort_contacts(std::vector<PieceContact>& contacts) {
  for (PieceContact& c : contacts) {
    if (c.pieces.body_a > c.pieces.body_b) c.normal = -c.normal;
    orient(c.pieces);
  }
  std::stable_sort(
      contacts.begin(), contacts.end(),
      [](const PieceContact& x, const PieceContact& y) { return x.pieces < y.pieces; });
}

void sort_contacts(std::vector<VertexContact>& contacts) {
  std::stable_sort(
      contacts.begin(), contacts.end(),
      [](const VertexContact& x, const VertexContact& y) { return x.where < y.where; });
}

void hash_pairs(Fnv1a& hash, const std::vector<ElementPair>& pairs) {
  hash.value(static_cast<std::uint64_t>(pairs.size()));
  for (const ElementPair& p : pairs) {
    for (std::uint32_t id : {p.body_a, p.body_b, p.a, p.b}) hash.value(id);
  }
}

}  // namespace

void canonicalize(std::vector<ElementPair>& pairs) {
  for (ElementPair& p : pairs) orient(p);
  sort_unique(pairs);
}

void ContactSet::clear() {
  bodies.clear();
  cells.clear();
  triangles.clear();
  vertices.clear();
  near.clear();
  self.clear();
  self_cells.clear();
  self_near.clear();
  self_bodies.clear();
  piece_contacts.clear();
  vertex_contacts.clear();
}

void ContactSet::canonicalize() {
  contactcheck::canonicalize(cells);
  contactcheck::canonicalize(triangles);
  for (std::vector<SelfPair>* pairs : {&self, &self_cells}) {
    for (SelfPair& p : *pairs) orient(p);
    sort_unique(*pairs);
    add_bodies(*pairs, self_bodies);
  }
  sort_unique(self_near);
  add_bodies(self_near, self_bodies);
  sort_unique(self_bodies);
  for (BodyPair& p : bodies) orient(p);
  sort_unique(vertices);
  sort_unique(near);
  sort_contacts(piece_contacts);
  sort_contacts(vertex_contacts);
  add_implied_bodies(cells, bodies);
  add_implied_bodies(triangles, bodies);
  add_implied_bodies(near, bodies);
  sort_unique(bodies);
}

std::uint64_t chain_hash(std::uint64_t previous, std::uint64_t frame, const ContactSet& contacts) {
  Fnv1a hash;
  hash.value(previous);
  hash.value(frame);
  hash.value(static_cast<std::uint64_t>(contacts.bodies.size()));
  for (const BodyPair& p : contacts.bodies) {
    hash.value(p.a);
    hash.value(p.b);
  }
  hash_pairs(hash, contacts.cells);
  hash_pairs(hash, contacts.triangles);
  hash.value(static_cast<std::uint64_t>(contacts.vertices.size()));
  for (const VertexInBody& v : contacts.vertices) {
    for (std::uint32_t id : {v.body, v.in, v.vertex}) hash.value(id);
  }
  // Only where there are some: sets without keep the hash that they had before there were such.
  for (const std::vector<NearPair>* pairs : {&contacts.near, &contacts.self_near})
    for (const NearPair& p : *pairs)
      for (std::uint32_t id : {p.body, p.other, p.vertex, p.triangle}) hash.value(id);
  for (const std::vector<SelfPair>* pairs : {&contacts.self, &contacts.self_cells})
    for (const SelfPair& p : *pairs)
      for (std::uint32_t id : {p.body, p.a, p.b}) hash.value(id);
  for (const std::uint32_t body : contacts.self_bodies) hash.value(body);
  return hash.digest();
}

}  // namespace contactcheck
