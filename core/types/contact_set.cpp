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

template <typename Record>
void hash_ids(Fnv1a& hash, const std::vector<Record>& records) {
  for (const Record& record : records)
    for (const std::uint32_t id : record.ids()) hash.value(id);
}

template <typename Record>
void hash_counted(Fnv1a& hash, const std::vector<Record>& records) {
  hash.value(static_cast<std::uint64_t>(records.size()));
  hash_ids(hash, records);
}

}  // namespace

void canonicalize(std::vector<ElementPair>& pairs) {
  for (ElementPair& p : pairs) orient(p);
  sort_unique(pairs);
}

void ContactSet::clear() {
  for_each_list([](ContactList, auto& list) { list.clear(); }, *this);
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
  hash_counted(hash, contacts.bodies);
  hash_counted(hash, contacts.cells);
  hash_counted(hash, contacts.triangles);
  hash_counted(hash, contacts.vertices);
  // Only where there are some: sets without keep the hash that they had before there were such.
  hash_ids(hash, contacts.near);
  hash_ids(hash, contacts.self_near);
  hash_ids(hash, contacts.self);
  hash_ids(hash, contacts.self_cells);
  for (const std::uint32_t body : contacts.self_bodies) hash.value(body);
  return hash.digest();
}

}  // namespace contactcheck
