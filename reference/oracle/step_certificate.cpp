// Corners move straight, so what is linear in them and holds at both ends of a part of the step
// holds throughout: that of two boxes, interpolated from those at both ends of the step, one lies
// before the other along an axis, and that a direction separates two sets of corners. Neither
// depends on a motion that all have in common, unlike boxes that hold both ends of the step.
//
// Doubles look for directions; a letter is written once exact numbers have shown what it says.
#include "reference/oracle/step_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "core/types/check.h"
#include "core/types/mesh_edges.h"
#include "core/types/shared_corners.h"
#include "reference/oracle/elementary_impact.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/likely_direction.h"

namespace contactcheck::oracle::certify {

using WholePoint = std::array<mpz_class, 3>;

/// One body in one step: its boxes at both ends, and its vertices times one power of two.
struct MovingBody {
  explicit MovingBody(const TriangleMesh& rest) : start(rest), end(rest) {}

  RangeTree start, end;
  std::vector<std::array<WholePoint, 2>> vertices;
};

namespace {

// --- Loose elements

/// Two vertices, the lower first; equal for two vertices that are welded.
using VertexPair = std::array<std::uint32_t, 2>;

class LooseElements {
 public:
  explicit LooseElements(const BodyShape& shape)
      : shape_(shape), linked_(shape.linked()), around_(shape.mesh.vertices.size()) {
    for (std::uint32_t t = 0; t < linked_.size(); ++t)
      for (const std::uint32_t v : linked_[t])
        if (around_[v].empty() || around_[v].back() != t) around_[v].push_back(t);
    for (std::uint32_t t = 0; t < linked_.size(); ++t) edges_.push_back(edges_of(t));
    // Elements without a common vertex are loose only if their triangles have one.
    for (std::uint32_t t = 0; t < linked_.size(); ++t)
      for (const std::uint32_t shared : linked_[t])
        for (const std::uint32_t other : around_[shared])
          if (other != t) look_at(t, other);
  }

  std::vector<OwnElements> list() const {
    std::vector<OwnElements> out;
    for (const auto& [v, t] : vertices_) {
      const auto& [a, b, c] = linked_[t];
      out.push_back({ImpactKind::vertex_triangle, {v, a, b, c}, t});
    }
    for (const auto& [e, f] : edge_pairs_)
      out.push_back({ImpactKind::edge_edge, {e[0], e[1], f[0], f[1]}, 0});
    return out;
  }

 private:
  std::vector<VertexPair> edges_of(std::uint32_t t) const {
    std::vector<VertexPair> out;
    const Triangle& named = shape_.mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (named[i] == named[j]) continue;
      const auto [low, high] = std::minmax(linked_[t][i], linked_[t][j]);
      out.push_back({low, high});
    }
    return out;
  }

  bool has(std::uint32_t t, std::uint32_t v) const {
    return std::find(linked_[t].begin(), linked_[t].end(), v) != linked_[t].end();
  }
  bool share(std::uint32_t s, std::uint32_t t) const {
    return has(t, linked_[s][0]) || has(t, linked_[s][1]) || has(t, linked_[s][2]);
  }
  std::vector<std::uint32_t> around(const VertexPair& edge) const {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t t : around_[edge[0]])
      if (has(t, edge[1])) out.push_back(t);
    return out;
  }

  void look_at(std::uint32_t s, std::uint32_t t) {
    for (const std::uint32_t v : linked_[s])
      if (!has(t, v) &&
          std::ranges::all_of(around_[v], [&](auto other) { return share(other, t); }))
        vertices_.insert({v, t});
    for (const VertexPair& e : edges_[s])
      for (const VertexPair& f : edges_[t]) {
        if (f < e || e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) continue;
        const std::vector<std::uint32_t> of_e = around(e), of_f = around(f);
        if (std::ranges::all_of(of_e, [&](std::uint32_t one) {
              return std::ranges::all_of(of_f, [&](auto other) { return share(one, other); });
            }))
          edge_pairs_.insert({e, f});
      }
  }

  const BodyShape& shape_;
  const std::vector<Triangle>& linked_;
  std::vector<std::vector<std::uint32_t>> around_;  // triangles, per vertex
  std::vector<std::vector<VertexPair>> edges_;      // per triangle
  std::set<VertexPair> vertices_;                   // vertex and triangle
  std::set<std::array<VertexPair, 2>> edge_pairs_;
};

// --- A step in numbers

/// From number / 2^depth to (number + 1) / 2^depth of the step.
struct StepPart {
  int depth = 0;
  std::uint32_t number = 0;

  double start() const { return std::ldexp(number, -depth); }
  double end() const { return std::ldexp(number + 1.0, -depth); }
  StepPart earlier_half() const { return {depth + 1, 2 * number}; }
  StepPart later_half() const { return {depth + 1, 2 * number + 1}; }
};

// Parts of less than a millionth of the step are not looked at.
constexpr int kMostHalvings = 20;

/// The lowest bit of any of the numbers, as a power of two.
int lowest_bit(std::span<const Vec3> points, int lowest) {
  for (const Vec3& p : points)
    for (const double x : {p.x(), p.y(), p.z()}) {
      if (x == 0) continue;
      int exponent = 0;
      const double mantissa = std::frexp(x, &exponent);
      const auto bits = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
      lowest = std::min(lowest, exponent - 53 + __builtin_ctzll(static_cast<std::uint64_t>(bits)));
    }
  return lowest;
}

WholePoint whole(const Vec3& p, int lowest) {
  WholePoint out;
  for (int axis = 0; axis < 3; ++axis) {
    int exponent = 0;
    const double mantissa = std::frexp(p[axis], &exponent);
    mpz_class& x = out[static_cast<std::size_t>(axis)];
    x = std::ldexp(mantissa, 53);
    const int shift = exponent - 53 - lowest;
    if (shift > 0)
      mpz_mul_2exp(x.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(shift));
    else
      mpz_fdiv_q_2exp(x.get_mpz_t(), x.get_mpz_t(), static_cast<mp_bitcnt_t>(-shift));
  }
  return out;
}

/// A value at t = start and t = end of a part, of one at both ends of the step.
std::array<double, 2> at_ends(double start, double end, const StepPart& part) {
  const auto at = [&](double t) {
    return t == 0 ? start : t == 1 ? end : (1 - t) * start + t * end;
  };
  return {at(part.start()), at(part.end())};
}

/// How far the one box lies before the other at both ends of a part of the step: more than 0 only
/// if it surely does.
std::array<double, 2> gaps_along(int axis, const std::array<const Aabb*, 2>& before,
                                 const std::array<const Aabb*, 2>& after, const StepPart& part) {
  const double high_start = before[0]->hi[axis], high_end = before[1]->hi[axis],
               low_start = after[0]->lo[axis], low_end = after[1]->lo[axis];
  const auto high = at_ends(high_start, high_end, part), low = at_ends(low_start, low_end, part);
  // Both are interpolated by at most three roundings, subnormal ones among them. At the ends of the
  // step nothing is rounded, and a difference is of the right sign.
  const double rounding = part.depth == 0
                              ? 0.0
                              : 0x1p-50 * std::max({std::abs(high_start), std::abs(high_end),
                                                    std::abs(low_start), std::abs(low_end)}) +
                                    0x1p-1070;
  return {low[0] - high[0] - rounding, low[1] - high[1] - rounding};
}

/// What the boxes of two ranges say in a part of the step.
struct BoxVerdict {
  int axis = -1;  ///< along which they are apart throughout
  /// At every time they are apart along some axis, with room to spare.
  bool in_turns = false;
};

BoxVerdict verdict_of(const std::array<const Aabb*, 2>& a, const std::array<const Aabb*, 2>& b,
                      const StepPart& part) {
  BoxVerdict verdict;
  double until = 0, from = 1;  // shares of the part: apart along one axis, then along another
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& [start, end] : {gaps_along(axis, a, b, part), gaps_along(axis, b, a, part)}) {
      if (start > 0 && end > 0) {
        verdict.axis = axis;
        return verdict;
      }
      if (start > 0) until = std::max(until, start / (start - end));
      if (end > 0) from = std::min(from, start / (start - end));
    }
  constexpr double kRoom = 0x1p-6;
  verdict.in_turns = until > from + kRoom;
  return verdict;
}

/// @pre both ascending
bool have_common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) return true;
    ++(a[i] < b[j] ? i : j);
  }
  return false;
}

// --- One pair of bodies

class PairProver {
 public:
  PairProver(const Step& step, const std::vector<Body>& bodies,
             const std::vector<MovingBody>& moving, BodyPair pair)
      : step_(step), bodies_(bodies), moving_(moving), pair_(pair) {}

  bool prove() {
    if (pair_.a != pair_.b) return cover(tree_a().all(), tree_b().all(), {});
    return cover_own(tree_a().all()) && prove_loose();
  }

  ApartCertificate out;

 private:
  const RangeTree& tree_a() const { return moving_[pair_.a].start; }
  const RangeTree& tree_b() const { return moving_[pair_.b].start; }

  bool cover_own(const Range& range) {
    if (range.size() == 1) return true;
    return cover_own(range.lower_half()) && cover_own(range.upper_half()) &&
           cover(range.lower_half(), range.upper_half(), {});
  }

  // False if some pair of them is not proven apart; then nothing of theirs is written.
  bool cover(const Range& a, const Range& b, const StepPart& part) {
    const BoxVerdict boxes = verdict_of(boxes_of(pair_.a, a), boxes_of(pair_.b, b), part);
    if (boxes.axis >= 0) {
      out.decisions += "xyz"[boxes.axis];
      return true;
    }
    if (a.size() == 1 && b.size() == 1) return cover_pair(a, b, part);
    if (a.size() <= kMostWithDirection && b.size() <= kMostWithDirection && separate(a, b, part))
      return true;
    if (boxes.in_turns && in_halves(a, b, part)) return true;
    const double size_a = tree_a().box(a).extent().maxCoeff(),
                 size_b = tree_b().box(b).extent().maxCoeff();
    if (b.size() == 1 || (a.size() > 1 && size_a >= size_b))
      return all_of(
          'a', [&] { return cover(a.lower_half(), b, part) && cover(a.upper_half(), b, part); });
    return all_of('b',
                  [&] { return cover(a, b.lower_half(), part) && cover(a, b.upper_half(), part); });
  }

  bool cover_pair(const Range& a, const Range& b, const StepPart& part) {
    const std::uint32_t s = tree_a().order()[a.first], t = tree_b().order()[b.first];
    if (pair_.a == pair_.b) {
      const std::vector<Triangle>& linked = bodies_[pair_.a].shape->linked();
      if (shared_corners(linked[s], linked[t]).count > 0) {
        out.decisions += 'n';
        return true;
      }
    }
    if (separate(a, b, part) || in_halves(a, b, part)) return true;
    return part.depth == 0 && prove_by_elements(s, t);
  }

  bool in_halves(const Range& a, const Range& b, const StepPart& part) {
    return part.depth < kMostHalvings && all_of('h', [&] {
             return cover(a, b, part.earlier_half()) && cover(a, b, part.later_half());
           });
  }

  // A letter and all below it, or nothing.
  template <typename Below>
  bool all_of(char letter, const Below& below) {
    const std::size_t decisions = out.decisions.size(), directions = out.directions.size(),
                      triangles = out.triangles.size();
    out.decisions += letter;
    if (below()) return true;
    out.decisions.resize(decisions);
    out.directions.resize(directions);
    out.triangles.resize(triangles);
    return false;
  }

  std::array<const Aabb*, 2> boxes_of(std::uint32_t body, const Range& range) const {
    return {&moving_[body].start.box(range), &moving_[body].end.box(range)};
  }

  std::span<const Vec3> start(std::uint32_t body) const {
    return step_.start.bodies[body].vertices;
  }
  std::span<const Vec3> end(std::uint32_t body) const { return step_.end.bodies[body].vertices; }
  const Triangle& triangle(std::uint32_t body, std::uint32_t t) const {
    return bodies_[body].shape->mesh.triangles[t];
  }

  std::vector<std::uint32_t> vertices_of(std::uint32_t body, const Range& range) const {
    std::vector<std::uint32_t> used;
    for (std::size_t place = range.first; place < range.last; ++place)
      for (const std::uint32_t v : triangle(body, moving_[body].start.order()[place]))
        used.push_back(v);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }

  // --- Directions

  bool separate(const Range& a, const Range& b, const StepPart& part) {
    const std::vector<std::uint32_t> of_a = vertices_of(pair_.a, a), of_b = vertices_of(pair_.b, b);
    // A vertex is on neither side of itself: so it is of most ranges of one body that are near.
    if (pair_.a == pair_.b && have_common(of_a, of_b)) return false;
    const std::optional<Vec3> guess = likely_direction(clouds(of_a, of_b, part));
    if (!guess) return false;
    // The shortest numbers that serve.
    for (const int bits : {3, 6, 10, 16, 24, 36, 52}) {
      StepDirection direction{};
      const double unit = std::ldexp(1 / guess->cwiseAbs().maxCoeff(), bits);
      for (int axis = 0; axis < 3; ++axis)
        direction[static_cast<std::size_t>(axis)] = std::llround((*guess)[axis] * unit);
      if (!separates(direction, of_a, of_b, part)) continue;
      out.decisions += 's';
      out.directions.push_back(direction);
      return true;
    }
    return false;
  }

  // From a corner, and in the size of all.
  std::array<Clouds, 2> clouds(const std::vector<std::uint32_t>& of_a,
                               const std::vector<std::uint32_t>& of_b, const StepPart& part) const {
    std::array<Clouds, 2> both;
    const Vec3 origin = place(pair_.a, of_a.front(), part.start());
    double size = 0;
    for (const std::size_t k : {0, 1}) {
      const double t = k == 0 ? part.start() : part.end();
      const auto add = [&](std::uint32_t body, std::uint32_t v, std::vector<Vec3>& to) {
        to.push_back(place(body, v, t) - origin);
        size = std::max(size, to.back().cwiseAbs().maxCoeff());
      };
      for (const std::uint32_t v : of_a) add(pair_.a, v, both[k].p);
      for (const std::uint32_t v : of_b) add(pair_.b, v, both[k].q);
    }
    const int exponent = exponent_above(size);
    for (Clouds& at : both)
      for (std::vector<Vec3>* points : {&at.p, &at.q})
        for (Vec3& p : *points) p = scaled_by_two_to(-exponent, p);
    return both;
  }

  Vec3 place(std::uint32_t body, std::uint32_t v, double t) const {
    return (1 - t) * start(body)[v] + t * end(body)[v];
  }

  /// Exact.
  bool separates(const StepDirection& direction, const std::vector<std::uint32_t>& of_a,
                 const std::vector<std::uint32_t>& of_b, const StepPart& part) const {
    WholePoint n;
    for (std::size_t axis = 0; axis < 3; ++axis) n[axis] = static_cast<long>(direction[axis]);
    std::array<mpz_class, 2> least_of_a, most_of_b;
    heights(n, pair_.a, of_a, part, least_of_a, 1);
    heights(n, pair_.b, of_b, part, most_of_b, -1);
    return least_of_a[0] > most_of_b[0] && least_of_a[1] > most_of_b[1];
  }

  /// The extreme heights along n at both ends of a part, times one power of two: the least, or with
  /// sign -1 the most.
  void heights(const WholePoint& n, std::uint32_t body, const std::vector<std::uint32_t>& vertices,
               const StepPart& part, std::array<mpz_class, 2>& extreme, int sign) const {
    const mpz_class steps = mpz_class(1) << part.depth;
    std::array<mpz_class, 2> along;
    mpz_class height;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (const std::size_t k : {0, 1}) {
        const WholePoint& p = moving_[body].vertices[vertices[i]][k];
        along[k] = n[0] * p[0];
        for (const std::size_t axis : {1, 2})
          mpz_addmul(along[k].get_mpz_t(), n[axis].get_mpz_t(), p[axis].get_mpz_t());
      }
      for (const std::size_t k : {0, 1}) {
        const mpz_class done = part.number + static_cast<unsigned long>(k);
        height = along[0] * (steps - done) + along[1] * done;
        if (i == 0 || sign * cmp(height, extreme[k]) < 0) extreme[k] = height;
      }
    }
  }

  // --- Elements

  bool prove_by_elements(std::uint32_t s, std::uint32_t t) {
    const Triangle &p = triangle(pair_.a, s), &q = triangle(pair_.b, t);
    const auto corners = [](std::span<const Vec3> vertices, const Triangle& of) {
      return TriangleCorners{vertices[of[0]], vertices[of[1]], vertices[of[2]]};
    };
    auto plane = separating_plane(corners(start(pair_.a), p), corners(start(pair_.b), q));
    if (!plane) return false;
    ApartByElements proofs{std::move(*plane), {}};
    const auto [a, b] = pair_;
    const auto prove = [&](ImpactKind kind, const std::array<std::uint32_t, 4>& bodies,
                           const std::array<std::uint32_t, 4>& vertices) {
      return prove_elements(kind, bodies, vertices, proofs.elements);
    };
    for (std::size_t i = 0; i < 3; ++i)
      if (!prove(ImpactKind::vertex_triangle, {a, b, b, b}, {p[i], q[0], q[1], q[2]})) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (!prove(ImpactKind::vertex_triangle, {b, a, a, a}, {q[j], p[0], p[1], p[2]})) return false;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (!prove(ImpactKind::edge_edge, {a, a, b, b},
                   {p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]}))
          return false;
    out.decisions += 'f';
    out.triangles.push_back(std::move(proofs));
    return true;
  }

  bool prove_loose() {
    const std::uint32_t body = pair_.a;
    for (const OwnElements& e : loose_elements(*bodies_[body].shape))
      if (!prove_elements(e.kind, {body, body, body, body}, e.vertices, out.elements)) return false;
    return true;
  }

  bool prove_elements(ImpactKind kind, const std::array<std::uint32_t, 4>& bodies,
                      const std::array<std::uint32_t, 4>& vertices,
                      std::vector<ImpactCertificate>& proofs) const {
    ImpactQuery query{kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      query.start[i] = start(bodies[i])[vertices[i]];
      query.end[i] = end(bodies[i])[vertices[i]];
    }
    auto proof = certify_impact(query, Impact{});
    if (proof) proofs.push_back(std::move(*proof));
    return proof.has_value();
  }

  // Larger ranges seldom have one, and the checker looks at every corner.
  static constexpr std::size_t kMostWithDirection = 32;

  const Step& step_;
  const std::vector<Body>& bodies_;
  const std::vector<MovingBody>& moving_;
  const BodyPair pair_;
};

}  // namespace

std::vector<OwnElements> loose_elements(const BodyShape& shape) {
  return LooseElements(shape).list();
}

struct StepCertifier::Impl {
  ImpactQuery query(const ElementsMeet& elements) const {
    ImpactQuery query{elements.kind, {}, {}};
    const std::size_t first = elements.kind == ImpactKind::vertex_triangle ? 1 : 2;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t body = elements.bodies[i < first ? 0 : 1], v = elements.vertices[i];
      query.start[i] = step->start.bodies[body].vertices[v];
      query.end[i] = step->end.bodies[body].vertices[v];
    }
    return query;
  }

  /// The listed ones of two bodies, or of one, with their times.
  std::vector<ElementsMeet> elements_of(BodyPair pair, const ContactSet& in_step) const {
    std::vector<ElementsMeet> out;
    const auto add = [&](ElementsMeet elements) {
      const auto [low, high] = std::minmax(elements.bodies[0], elements.bodies[1]);
      if (BodyPair{low, high} != pair) return;
      elements.time = elementary_impact(query(elements));
      if (elements.time.contact) out.push_back(std::move(elements));
    };
    for (const auto* list : {&in_step.impact_vertices, &in_step.self_impact_vertices})
      for (const NearPair& near : *list) {
        const auto& [p, q, r] = bodies[near.other].shape->mesh.triangles[near.triangle];
        add({ImpactKind::vertex_triangle,
             {near.body, near.other},
             {near.vertex, p, q, r},
             near.triangle,
             {},
             {}});
      }
    const auto edges = [&](std::uint32_t body) {
      return mesh_edges(bodies[body].shape->mesh.triangles).edges;
    };
    const std::vector<Edge> of_a = edges(pair.a), of_b = edges(pair.b);
    const auto add_edges = [&](BodyPair of, std::uint32_t first, std::uint32_t second) {
      if (of != pair) return;
      const Edge &e = of_a[first], &f = of_b[second];
      add({ImpactKind::edge_edge, {of.a, of.b}, {e[0], e[1], f[0], f[1]}, 0, {}, {}});
    };
    for (const ElementPair& x : in_step.impact_edges) add_edges({x.body_a, x.body_b}, x.a, x.b);
    for (const SelfPair& x : in_step.self_impact_edges) add_edges({x.body, x.body}, x.a, x.b);
    return out;
  }

  std::vector<Body> bodies;
  std::vector<MovingBody> moving;
  const Step* step = nullptr;
};

StepCertifier::StepCertifier(const std::vector<Body>& bodies) : impl_(std::make_unique<Impl>()) {
  impl_->bodies = bodies;
  for (const Body& body : bodies) impl_->moving.emplace_back(body.shape->mesh);
}
StepCertifier::~StepCertifier() = default;

void StepCertifier::begin(const Step& step) {
  impl_->step = &step;
  int lowest = 0;
  for (std::size_t b = 0; b < impl_->bodies.size(); ++b)
    for (const Frame* frame : {&step.start, &step.end})
      lowest = lowest_bit(frame->bodies[b].vertices, lowest);
  for (std::size_t b = 0; b < impl_->bodies.size(); ++b) {
    const std::span<const Vec3> start = step.start.bodies[b].vertices,
                                end = step.end.bodies[b].vertices;
    MovingBody& moving = impl_->moving[b];
    CONTACTCHECK_INVARIANT(
        start.size() == impl_->bodies[b].shape->mesh.vertices.size() && end.size() == start.size(),
        "every deformed vertex at both ends");
    moving.start.refit(start);
    moving.end.refit(end);
    moving.vertices.clear();
    for (std::size_t v = 0; v < start.size(); ++v)
      moving.vertices.push_back({whole(start[v], lowest), whole(end[v], lowest)});
  }
}

std::optional<ApartCertificate> StepCertifier::prove_apart(BodyPair bodies) const {
  const FloatingPointGuard guard;
  PairProver prover(*impl_->step, impl_->bodies, impl_->moving, bodies);
  if (!prover.prove()) return std::nullopt;
  return std::move(prover.out);
}

std::optional<ContactProof> StepCertifier::prove_contact(BodyPair bodies,
                                                         const std::vector<ElementPair>& at_start,
                                                         const ContactSet& in_step) const {
  const FloatingPointGuard guard;
  const auto found = std::ranges::find_if(at_start, [&](const ElementPair& pair) {
    return BodyPair{pair.body_a, pair.body_b} == bodies;
  });
  if (found != at_start.end()) {
    const auto corners = [&](std::uint32_t body, std::uint32_t triangle) {
      const Triangle& t = impl_->bodies[body].shape->mesh.triangles[triangle];
      const std::span<const Vec3> vertices = impl_->step->start.bodies[body].vertices;
      return TriangleCorners{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    };
    auto witness = common_point(corners(bodies.a, found->a), corners(bodies.b, found->b));
    if (!witness) return std::nullopt;
    return TouchAtStart{*found, std::move(*witness)};
  }
  std::vector<ElementsMeet> meeting = impl_->elements_of(bodies, in_step);
  const auto earlier = [](const ElementsMeet& x, const ElementsMeet& y) {
    return x.time.earliest < y.time.earliest;
  };
  std::ranges::stable_sort(meeting, earlier);
  for (ElementsMeet& elements : meeting) {
    if (elements.time.earliest > meeting.front().time.latest) break;
    auto proof = certify_impact(impl_->query(elements), elements.time);
    if (!proof) continue;
    elements.proof = std::move(*proof);
    return std::move(elements);
  }
  return std::nullopt;
}

const std::vector<std::uint32_t>& StepCertifier::order(std::size_t body) const {
  return impl_->moving[body].start.order();
}

}  // namespace contactcheck::oracle::certify
