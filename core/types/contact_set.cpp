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

void add_implied_bodies(const std::vector<ElementPair>& pairs, std::vector<BodyPair>& bodies) {
  BodyPair last{~0u, ~0u};
  for (const ElementPair& p : pairs) {
    const BodyPair body{p.body_a, p.body_b};
    if (body != last) bodies.push_back(last = body);
  }
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
}

void ContactSet::canonicalize() {
  contactcheck::canonicalize(cells);
  contactcheck::canonicalize(triangles);
  for (BodyPair& p : bodies) orient(p);
  sort_unique(vertices);
  add_implied_bodies(cells, bodies);
  add_implied_bodies(triangles, bodies);
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
  return hash.digest();
}

}  // namespace contactcheck
