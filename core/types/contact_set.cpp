#include "core/types/contact_set.h"

#include <algorithm>
#include <cmath>
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

// Sorted, each pair of bodies once, with its earliest time: a time that is no number is the
// earliest of all, so that whoever checks the set meets it.
void sort_impacts(std::vector<BodyImpact>& impacts) {
  const auto rank = [](const BodyImpact& impact) {
    return !impact.time ? 2 : std::isnan(*impact.time) ? 0 : 1;
  };
  for (BodyImpact& impact : impacts) orient(impact.bodies);
  std::sort(impacts.begin(), impacts.end(), [&](const BodyImpact& x, const BodyImpact& y) {
    if (x.bodies != y.bodies) return x.bodies < y.bodies;
    if (rank(x) != rank(y)) return rank(x) < rank(y);
    return rank(x) == 1 && *x.time < *y.time;
  });
  const auto same = [](const BodyImpact& x, const BodyImpact& y) { return x.bodies == y.bodies; };
  impacts.erase(std::unique(impacts.begin(), impacts.end(), same), impacts.end());
}

template <typename Pair>
void add_implied_impacts(const std::vector<Pair>& pairs, std::vector<BodyImpact>& impacts) {
  std::vector<BodyPair> bodies;
  add_implied_bodies(pairs, bodies);
  for (const BodyPair& pair : bodies) impacts.push_back({pair, std::nullopt});
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
  for (std::vector<SelfPair>* pairs : {&self, &self_cells, &self_impact_edges}) {
    for (SelfPair& p : *pairs) orient(p);
    sort_unique(*pairs);
  }
  add_bodies(self, self_bodies);
  add_bodies(self_cells, self_bodies);
  sort_unique(self_near);
  add_bodies(self_near, self_bodies);
  sort_unique(self_bodies);
  for (BodyPair& p : bodies) orient(p);
  contactcheck::canonicalize(impact_triangles);
  contactcheck::canonicalize(impact_edges);
  sort_unique(impact_vertices);
  sort_unique(self_impact_vertices);
  add_implied_impacts(impact_triangles, impacts);
  add_implied_impacts(impact_edges, impacts);
  add_implied_impacts(impact_vertices, impacts);
  sort_impacts(impacts);
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
  // Lists that came later are told apart by their place.
  for_each_list(
      [&](ContactList list, const auto& records) {
        if constexpr (requires { records.front().ids(); }) {
          if (!is_of_step(list) || records.empty()) return;
          hash.value(static_cast<std::uint64_t>(list));
          hash_counted(hash, records);
        }
      },
      contacts);
  return hash.digest();
}

}  // namespace contactcheck
