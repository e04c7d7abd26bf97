#include "core/detect/lazy_steps.h"

#include <algorithm>
#include <limits>

#include "core/broad/body_pairs.h"
#include "core/deform/mapping.h"
#include "core/types/check.h"
#include "core/types/mesh_topology.h"

namespace contactcheck {

LazySteps::LazySteps(const std::vector<Body>& bodies,
                     const std::vector<std::shared_ptr<const LatticeTree>>& trees,
                     const std::vector<bool>& refitted, const LazyKernels& kernels,
                     ThreadTeam& team)
    : kernels_(kernels), team_(team), tasks_(kernels, team), places_(bodies.size()) {
  for (std::vector<LazyState>* states : {&starts_, &ends_})
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      LazyState& state = states->emplace_back();
      state.shape = bodies[b].shape.get();
      state.tree = trees[b].get();
      state.from_vertices = refitted[b];
    }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    starts_[b].end = &ends_[b];
    const std::size_t count = bodies[b].shape->mesh.vertices.size();
    places_[b].start.resize(count);
    places_[b].end.resize(count);
    places_[b].mapped_in.assign(count, 0);
  }
  contacts_.prepare(bodies);
}

// A refitted body without given vertices has the box of its nodes until it may meet another.
void LazySteps::begin(std::size_t body, const Step& step) {
  Places& places = places_[body];
  LazyState &start = starts_[body], &end = ends_[body];
  const bool kept = step.follows && step_ > 1;
  if (kept) std::swap(places.start, places.end);
  places.start_mapped = kept && places.end_mapped;
  places.end_mapped = false;
  const auto begin_one = [&](LazyState& state, const BodyState& of, std::span<const Vec3> mapped,
                             std::span<const Vec3>& vertices) {
    CONTACTCHECK_INVARIANT(of.nodes.size() == state.shape->node_count(), "one position per node");
    // Without a lattice the nodes are the vertices; given ones are used.
    const std::span<const Vec3> given = !state.shape->lattice ? of.nodes : of.vertices;
    const bool by_vertices = state.from_vertices && !given.empty();
    vertices = by_vertices ? given : mapped;
    if (kept && &state == &start) {
      begin_same_frame(start, end, of.nodes, by_vertices ? given : std::span<const Vec3>());
    } else if (by_vertices) {
      begin_frame_by_vertices(state, given);
    } else {
      begin_frame_by_nodes(state, of.nodes);
    }
  };
  begin_one(start, step.start.bodies[body], places.start, places.at_start);
  begin_one(end, step.end.bodies[body], places.end, places.at_end);
}

// Maps the vertices of a refitted body that are not given, and takes their boxes, which are
// tighter.
void LazySteps::map_vertices_of(std::size_t body) {
  Places& places = places_[body];
  const auto map = [](LazyState& state, std::vector<Vec3>& mapped, bool& done) {
    if (!state.from_vertices || !state.vertices.empty()) return;
    if (!done) map_body(*state.shape, state.nodes, mapped);
    done = true;
    state.vertices = mapped;
    tighten_box(state);
  };
  map(starts_[body], places.start, places.start_mapped);
  map(ends_[body], places.end, places.end_mapped);
}

void LazySteps::update(const Step& step) {
  CONTACTCHECK_INVARIANT(
      step.start.bodies.size() == starts_.size() && step.end.bodies.size() == starts_.size(),
      "one state per prepared body at both ends");
  for (LazyScratch& scratch : team_.scratch()) {
    scratch.arena.clear();
    scratch.counters = {};
  }
  if (step_ == std::numeric_limits<std::uint32_t>::max()) {
    for (Places& places : places_) std::fill(places.mapped_in.begin(), places.mapped_in.end(), 0);
    step_ = 0;
  }
  ++step_;
  std::vector<std::span<const Vec3>> start, end;
  std::vector<Aabb> boxes;
  for (std::size_t b = 0; b < starts_.size(); ++b) {
    begin(b, step);
    start.push_back(places_[b].at_start);
    end.push_back(places_[b].at_end);
    boxes.push_back(starts_[b].box);
    boxes.back().extend(ends_[b].box);
  }
  place_step(starts_, ends_);
  contacts_.begin(std::move(start), std::move(end));
  pairs_.clear();
  find_candidate_bodies(boxes, pairs_);
  erase_pairs_apart();
  bounded_.assign(starts_.size(), 0);
}

void LazySteps::erase_pairs_apart() {
  std::erase_if(pairs_,
                [&](const BodyPair& pair) { return !may_meet(starts_[pair.a], starts_[pair.b]); });
}

// Prepares a body for tests: computes all its bounds if it is refitted, else its cells.
void LazySteps::bound(std::size_t body, LazyScratch& scratch) {
  if (starts_[body].from_vertices) return kernels_.bound_all(starts_[body], scratch.arena);
  find_cells(starts_[body]);
  find_cells(ends_[body]);
}

// All for contact of a body with itself, else those that may meet another.
std::vector<std::uint32_t> LazySteps::bodies_for(Question question) const {
  std::vector<std::uint32_t> out;
  if (question == Question::kSelfImpacts) {
    for (std::uint32_t b = 0; b < starts_.size(); ++b) out.push_back(b);
    return out;
  }
  for (const BodyPair& pair : pairs_)
    for (const std::uint32_t body : pair.ids()) out.push_back(body);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void LazySteps::find_candidates(Question question) {
  const bool own = question == Question::kSelfImpacts;
  std::vector<std::uint32_t> bodies = bodies_for(question);
  team_.for_each(bodies.size(), [&](std::size_t i, LazyScratch&) { map_vertices_of(bodies[i]); });
  if (!own) {
    erase_pairs_apart();
    bodies = bodies_for(question);
  }
  std::erase_if(bodies, [&](std::uint32_t body) { return bounded_[body] != 0; });
  for (const std::uint32_t body : bodies) bounded_[body] = 1;
  team_.for_each(bodies.size(),
                 [&](std::size_t i, LazyScratch& scratch) { bound(bodies[i], scratch); });
  candidates_.clear();
  if (!own) return tasks_.run(starts_, pairs_, false, candidates_);
  for (std::uint32_t b = 0; b < starts_.size(); ++b) {
    refuse_many_adjacent_pairs(starts_[b].shape->linked());
    kernels_.collide_self({{b, b}, starts_[b], starts_[b]}, false, team_.scratch()[0], candidates_);
  }
}

// One by one: of the leaves' vertices, which kernels map for their boxes, few are needed.
void LazySteps::map_triangle(std::uint32_t body, std::uint32_t triangle) {
  const LazyState &start = starts_[body], &end = ends_[body];
  if (start.from_vertices) return;
  const BodyShape& shape = *start.shape;
  Places& places = places_[body];
  for (const std::uint32_t v : shape.mesh.triangles[triangle]) {
    if (places.mapped_in[v] == step_) continue;
    places.mapped_in[v] = step_;
    const std::uint32_t cell = shape.embedding.home_cell[v];
    places.start[v] =
        map_point(corners_of(*shape.lattice, cell, start.nodes), shape.embedding.local[v]);
    places.end[v] =
        map_point(corners_of(*shape.lattice, cell, end.nodes), shape.embedding.local[v]);
  }
}

void LazySteps::query(Question question, ContactSet& out) {
  find_candidates(question);
  for (const ElementPair& pair : candidates_) {
    map_triangle(pair.body_a, pair.a);
    map_triangle(pair.body_b, pair.b);
    if (question == Question::kSelfImpacts) {
      contacts_.add_own({pair.body_a, pair.a, pair.b}, out);
    } else {
      contacts_.add(pair, out);
    }
  }
  contacts_.finish(out);
}

LazyCounters LazySteps::counters() const {
  LazyCounters sum;
  for (const LazyState& state : starts_) count_made(state, sum);
  return sum;
}

std::size_t LazySteps::bytes() const {
  std::size_t bytes = candidates_.capacity() * sizeof(ElementPair);
  for (const std::vector<LazyState>* states : {&starts_, &ends_})
    for (const LazyState& s : *states)
      bytes += s.near_nodes.size() * sizeof(Float4) + s.cells.size() * sizeof(CellTerms) +
               s.blocks.bytes() + s.leaves.bytes();
  for (const Places& p : places_)
    bytes += (p.start.size() + p.end.size()) * sizeof(Vec3) + p.mapped_in.size() * 4;
  return bytes;
}

}  // namespace contactcheck
