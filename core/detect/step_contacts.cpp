#include "core/detect/step_contacts.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/narrow/impact.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The places of `items` in the order of what they belong to, as offsets and a list.
void group(const std::vector<std::array<std::uint32_t, 3>>& items, std::size_t groups,
           std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& members) {
  begin.assign(groups + 1, 0);
  const auto each = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < items.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t of = items[t][i];
        // A triangle that names it twice belongs to it once.
        const bool again = (i > 0 && of == items[t][0]) || (i > 1 && of == items[t][1]);
        if (of != MeshEdges::kNone && !again) visit(of, t);
      }
  };
  each([&](std::uint32_t of, std::uint32_t) { ++begin[of + 1]; });
  for (std::size_t g = 0; g < groups; ++g) begin[g + 1] += begin[g];
  members.resize(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  each([&](std::uint32_t of, std::uint32_t t) { members[next[of]++] = t; });
}

/// Marks in `owned` the first triangle of each group, by the place of the element in it.
void own(const std::vector<std::array<std::uint32_t, 3>>& items,
         const std::vector<std::uint32_t>& begin, const std::vector<std::uint32_t>& members,
         int shift, std::vector<std::uint8_t>& owned) {
  for (std::uint32_t of = 0; of + 1 < begin.size(); ++of) {
    if (begin[of] == begin[of + 1]) continue;
    const std::uint32_t t = members[begin[of]];
    const auto at = std::find(items[t].begin(), items[t].end(), of) - items[t].begin();
    owned[t] |= static_cast<std::uint8_t>(1u << (at + shift));
  }
}

/// The box of a side, or of a corner named twice.
MovingBox path_of(const MovingTriangle& of, std::size_t i, std::size_t j) {
  MovingBox box;
  box.extend(*of.start[i], *of.end[i]);
  box.extend(*of.start[j], *of.end[j]);
  return box;
}

}  // namespace

StepContacts::Elements StepContacts::elements_of(const std::shared_ptr<const BodyShape>& shape) {
  Elements out;
  out.shape = shape;
  const std::vector<Triangle>& triangles = shape->mesh.triangles;
  out.edges = mesh_edges(triangles);
  group(triangles, shape->mesh.vertices.size(), out.vertex_begin, out.vertex_triangles);
  group(out.edges.of_triangle, out.edges.edges.size(), out.edge_begin, out.edge_triangles);
  out.owned.assign(triangles.size(), 0);
  own(triangles, out.vertex_begin, out.vertex_triangles, 0, out.owned);
  own(out.edges.of_triangle, out.edge_begin, out.edge_triangles, 3, out.owned);
  out.linked.resize(shape->mesh.vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) out.linked[triangles[t][i]] = shape->linked()[t][i];
  return out;
}

void StepContacts::prepare(const std::vector<Body>& bodies) {
  bodies_.clear();
  std::map<const BodyShape*, std::shared_ptr<const Elements>> made;
  for (const Body& body : bodies) {
    std::shared_ptr<const Elements>& elements = made[body.shape.get()];
    if (!elements) elements = std::make_shared<const Elements>(elements_of(body.shape));
    bodies_.push_back(elements);
  }
}

void StepContacts::begin(const Step& step) {
  const auto vertices_of = [](const Frame& frame) {
    std::vector<std::span<const Vec3>> out;
    for (const BodyState& body : frame.bodies) out.push_back(body.vertices);
    return out;
  };
  begin(vertices_of(step.start), vertices_of(step.end));
}

void StepContacts::begin(std::vector<std::span<const Vec3>> start,
                         std::vector<std::span<const Vec3>> end) {
  start_ = std::move(start);
  end_ = std::move(end);
  CONTACTCHECK_INVARIANT(start_.size() == bodies_.size() && end_.size() == bodies_.size(),
                         "one state per prepared body at both ends");
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t count = bodies_[b]->shape->mesh.vertices.size();
    CONTACTCHECK_INVARIANT(start_[b].size() == count && end_[b].size() == count,
                           "one position per vertex at both ends");
  }
  first_.clear();
  tested_ = 0;
  entered_ = false;
}

// Candidates come in runs of the same two bodies.
void StepContacts::enter(std::uint32_t body_a, std::uint32_t body_b, ContactSet& out) {
  if (entered_ && pair_[0] == body_a && pair_[1] == body_b) return;
  flush(out);
  entered_ = true;
  pair_ = {body_a, body_b};
  // The time of contact of a body with itself is never asked for.
  const auto before = first_.find({body_a, body_b});
  until_ = body_a == body_b ? -1.0 : before == first_.end() ? kNever : before->second;
  at_start_.begin(*bodies_[body_a]->shape, start_[body_a], *bodies_[body_b]->shape, start_[body_b]);
}

void StepContacts::flush(ContactSet& out) {
  if (!entered_) return;
  const auto [a, b] = pair_;
  at_start_.flush([&](std::uint32_t i, std::uint32_t j) {
    out.impact_triangles.push_back({a, b, i, j});
    until_ = 0.0;
  });
  if (a != b && until_ < kNever) first_[{a, b}] = until_;
}

MovingTriangle StepContacts::moving(std::uint32_t body, std::uint32_t triangle) const {
  const Triangle& t = bodies_[body]->shape->mesh.triangles[triangle];
  const std::span<const Vec3> start = start_[body], end = end_[body];
  return {{&start[t[0]], &start[t[1]], &start[t[2]]}, {&end[t[0]], &end[t[1]], &end[t[2]]}};
}

// Calls `meet(vertex, time)` for the corners that a triangle owns and a face of `other` meets.
template <typename Meet>
void StepContacts::test_vertices(std::uint32_t body, std::uint32_t triangle,
                                 const MovingTriangle& of, std::uint32_t other, std::uint32_t face,
                                 const MovingTriangle& with, Meet&& meet) {
  const Elements& elements = *bodies_[body];
  const Triangle& corners = elements.shape->mesh.triangles[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    if ((elements.owned[triangle] >> i & 1u) == 0 || separated(path_of(of, i, i), with.box))
      continue;
    if (body == other && elements.shape->uses(face, corners[i])) continue;
    ++tested_;
    const Impact impact =
        find_impact({ImpactKind::vertex_triangle,
                     {*of.start[i], *with.start[0], *with.start[1], *with.start[2]},
                     {*of.end[i], *with.end[0], *with.end[1], *with.end[2]}},
                    until_);
    if (impact.contact) meet(corners[i], impact.earliest);
  }
}

// Calls `meet(edge, edge, time)` for the sides that both triangles own and that meet.
template <typename Meet>
void StepContacts::test_edges(std::uint32_t body_a, std::uint32_t a, const MovingTriangle& p,
                              std::uint32_t body_b, std::uint32_t b, const MovingTriangle& q,
                              Meet&& meet) {
  const Elements &of_a = *bodies_[body_a], &of_b = *bodies_[body_b];
  const unsigned owned_a = of_a.owned[a] >> 3, owned_b = of_b.owned[b] >> 3;
  if (owned_a == 0 || owned_b == 0) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((owned_a >> i & 1u) == 0) continue;
    const std::size_t to = (i + 1) % 3;
    const MovingBox path = path_of(p, i, to);
    if (separated(path, q.box)) continue;
    const std::uint32_t edge_a = of_a.edges.of_triangle[a][i];
    for (std::size_t j = 0; j < 3; ++j) {
      if ((owned_b >> j & 1u) == 0) continue;
      const std::size_t end = (j + 1) % 3;
      if (separated(path, path_of(q, j, end))) continue;
      const std::uint32_t edge_b = of_b.edges.of_triangle[b][j];
      if (body_a == body_b) {
        const auto same = [&](std::uint32_t v, std::uint32_t w) {
          return of_a.linked[v] == of_a.linked[w];
        };
        const Edge &e = of_a.edges.edges[edge_a], &f = of_a.edges.edges[edge_b];
        if (same(e[0], f[0]) || same(e[0], f[1]) || same(e[1], f[0]) || same(e[1], f[1])) continue;
      }
      ++tested_;
      const Impact impact = find_impact({ImpactKind::edge_edge,
                                         {*p.start[i], *p.start[to], *q.start[j], *q.start[end]},
                                         {*p.end[i], *p.end[to], *q.end[j], *q.end[end]}},
                                        until_);
      if (impact.contact) meet(edge_a, edge_b, impact.earliest);
    }
  }
}

void StepContacts::add(const ElementPair& candidate, ContactSet& out) {
  const auto [body_a, body_b, a, b] = candidate;
  enter(body_a, body_b, out);
  const MovingTriangle p = moving(body_a, a), q = moving(body_b, b);
  if (separated(p, q)) return;
  at_start_.add({a, b, {}}, [&](std::uint32_t i, std::uint32_t j) {
    out.impact_triangles.push_back({pair_[0], pair_[1], i, j});
    until_ = 0.0;
  });
  const auto triangles_at = [](const std::vector<std::uint32_t>& begin,
                               const std::vector<std::uint32_t>& members, std::uint32_t of) {
    return std::span(members).subspan(begin[of], begin[of + 1] - begin[of]);
  };
  const Elements &of_a = *bodies_[body_a], &of_b = *bodies_[body_b];
  test_vertices(body_a, a, p, body_b, b, q, [&](std::uint32_t vertex, double time) {
    until_ = std::min(until_, time);
    out.impact_vertices.push_back({body_a, body_b, vertex, b});
    for (const std::uint32_t t : triangles_at(of_a.vertex_begin, of_a.vertex_triangles, vertex))
      out.impact_triangles.push_back({body_a, body_b, t, b});
  });
  test_vertices(body_b, b, q, body_a, a, p, [&](std::uint32_t vertex, double time) {
    until_ = std::min(until_, time);
    out.impact_vertices.push_back({body_b, body_a, vertex, a});
    for (const std::uint32_t t : triangles_at(of_b.vertex_begin, of_b.vertex_triangles, vertex))
      out.impact_triangles.push_back({body_a, body_b, a, t});
  });
  test_edges(body_a, a, p, body_b, b, q, [&](std::uint32_t e, std::uint32_t f, double time) {
    until_ = std::min(until_, time);
    out.impact_edges.push_back({body_a, body_b, e, f});
    for (const std::uint32_t s : triangles_at(of_a.edge_begin, of_a.edge_triangles, e))
      for (const std::uint32_t t : triangles_at(of_b.edge_begin, of_b.edge_triangles, f))
        out.impact_triangles.push_back({body_a, body_b, s, t});
  });
}

void StepContacts::add_own(const SelfPair& candidate, ContactSet& out) {
  const auto [body, a, b] = candidate;
  enter(body, body, out);
  const MovingTriangle p = moving(body, a), q = moving(body, b);
  if (separated(p, q)) return;
  test_vertices(body, a, p, body, b, q, [&](std::uint32_t vertex, double) {
    out.self_impact_vertices.push_back({body, body, vertex, b});
  });
  test_vertices(body, b, q, body, a, p, [&](std::uint32_t vertex, double) {
    out.self_impact_vertices.push_back({body, body, vertex, a});
  });
  test_edges(body, a, p, body, b, q, [&](std::uint32_t e, std::uint32_t f, double) {
    out.self_impact_edges.push_back({body, e, f});
  });
}

void StepContacts::finish(ContactSet& out) {
  flush(out);
  entered_ = false;
  for (const auto& [bodies, time] : first_) out.impacts.push_back({bodies, time});
  first_.clear();
}

}  // namespace contactcheck
