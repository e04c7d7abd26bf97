#include "core/detect/lazy_detector.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/broad/body_pairs.h"
#include "core/deform/mapping.h"
#include "core/detect/swept_detector.h"
#include "core/detect/triangle_pair_detector.h"
#include "core/detect/triangle_record.h"
#include "core/types/check.h"
#include "core/types/local_origin.h"
#include "core/types/mesh_topology.h"

namespace contactcheck {
namespace {

// By measurement over 260 drawn scenes: from 16 to 24 triangles per cell nodes take half of a
// refit's time, from 12 to 16 a tenth less or more, below 9 more. Coincident surfaces, where no
// bound ends anything, take 5 % more with nodes at 13.
constexpr std::size_t kFewTrianglesPerCell = 16;

bool refits(const BodyShape& shape, BoundSource bounds) {
  if (!shape.lattice || bounds == BoundSource::kVertices) return true;
  return bounds == BoundSource::kCheaper &&
         shape.mesh.triangles.size() < kFewTrianglesPerCell * shape.lattice->cells.size();
}

template <class Real>
std::string broken_promise(const LazyState& state, const std::vector<Vec3Of<Real>>& vertices) {
  std::string broken = validate(state, std::span<const Vec3Of<Real>>(vertices));
  if (!broken.empty()) return broken;
  for (const Vec3Of<Real>& v : vertices)
    if (!state.box.contains(v.template cast<double>())) return "a vertex leaves the body's box";
  return "";
}

Semantics semantics_in(Precision precision) {
  Semantics s = exact_triangle_semantics(precision, true);
  if (precision == Precision::kSingle) return s;
  const Semantics steps = exact_step_semantics(true);
  s.levels.insert(s.levels.end(), steps.levels.begin(), steps.levels.end());
  s.questions.insert(s.questions.end(), steps.questions.begin(), steps.questions.end());
  return s;
}

}  // namespace

LazyDetector::LazyDetector(const LazyConfig& config)
    : config_(config),
      kernels_(lazy_kernels(config.isa)),
      semantics_(semantics_in(config.precision)),
      team_(config.threads),
      tasks_(kernels_, team_) {}

void LazyDetector::expect(const std::vector<Question>& questions) {
  expects_self_ = std::find(questions.begin(), questions.end(), Question::kSelf) != questions.end();
  expects_steps_ = std::any_of(questions.begin(), questions.end(), is_of_steps);
}

void LazyDetector::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  states_.clear();
  patches_.clear();
  std::map<const BodyShape*, std::shared_ptr<const LatticeTree>> known;
  for (const Body& body : bodies) {
    std::shared_ptr<const LatticeTree>& tree = known[body.shape.get()];
    const bool refitted = refits(*body.shape, config_.bounds);
    if (!tree)
      tree = std::make_shared<const LatticeTree>(make_lattice_tree(
          *body.shape, refitted ? TreeUse::kVertices : TreeUse::kNodes, config_.precision));
    trees_.push_back(tree);
    LazyState& state = states_.emplace_back();
    state.shape = body.shape.get();
    state.tree = tree.get();
    state.precision = config_.precision;
    state.from_vertices = refitted;
  }
  for (std::size_t b = 0; expects_self_ && b < bodies.size(); ++b) {
    refuse_many_adjacent_pairs(bodies[b].shape->linked());
    know_patches(b);
  }
  mapped_.assign(bodies.size(), {});
  single_mapped_.assign(bodies.size(), {});
  bodies_ = bodies;
  steps_.reset();
  if (expects_steps_) know_steps();
}

void LazyDetector::know_steps() {
  if (steps_ != nullptr) return;
  std::vector<bool> refitted;
  for (const LazyState& state : states_) refitted.push_back(state.from_vertices);
  steps_ = std::make_unique<LazySteps>(bodies_, trees_, refitted, kernels_, team_);
}

void LazyDetector::update_step(const Step& step) {
  CONTACTCHECK_INVARIANT(!single(), "steps are answered in doubles alone");
  candidates_.clear();  // the arena of the last frame is used again
  know_steps();
  steps_->update(step);
  in_step_ = true;
}

// Prepares a body for pair tests: computes all its bounds if it is refitted, else its cells (bounds
// are then computed on demand).
void LazyDetector::bound(std::size_t index, LazyScratch& scratch) {
  LazyState& state = states_[index];
  if (!state.from_vertices) return find_cells(state);
  const BodyShape& shape = *state.shape;
  const bool known = !state.vertices.empty() || !state.single.vertices.empty();  // given or mapped
  if (!known && !single()) {
    mapped_[index].resize(shape.mesh.vertices.size());
    map_body(shape, state.nodes, mapped_[index]);
    state.vertices = mapped_[index];
  } else if (!known && !shape.lattice) {
    state.single.vertices = state.single.nodes;
  } else if (!known) {
    single_mapped_[index].resize(shape.mesh.vertices.size());
    map_vertices(*shape.lattice, shape.embedding, state.tree->single_sorted_local,
                 state.single.nodes, single_mapped_[index]);
    state.single.vertices = single_mapped_[index];
  }
  kernels_.bound_all(state, scratch.arena);
}

void LazyDetector::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == states_.size(), "one state per prepared body");
  for (LazyScratch& scratch : team_.scratch()) {
    scratch.arena.clear();
    scratch.counters = {};
  }
  candidates_.clear();  // a frame that is refused leaves no pair whose bounds are gone
  in_step_ = false;
  const Vec3 origin = single() ? local_origin(frame) : Vec3(Vec3::Zero());
  for (std::size_t b = 0; b < states_.size(); ++b) {
    const BodyState& body = frame.bodies[b];
    LazyState& state = states_[b];
    CONTACTCHECK_INVARIANT(body.nodes.size() == state.shape->node_count(), "one position per node");
    CONTACTCHECK_INVARIANT(
        !needs_vertices() || body.vertices.size() == state.shape->mesh.vertices.size(),
        "one position per vertex");
    if (single()) {
      begin_frame_in_single(state, body.nodes, origin);
    } else if (needs_vertices()) {
      begin_frame_by_vertices(state, body.vertices);
    } else if (state.shape->lattice) {
      begin_frame_by_nodes(state, body.nodes);
    } else {
      begin_frame_by_vertices(state, body.nodes);
    }
  }
  if (single()) {
    place_in_single(states_, origin);
  } else {
    place(states_);
  }
  std::vector<Aabb> boxes;
  for (const LazyState& state : states_) boxes.push_back(state.box);
  find_candidate_bodies(boxes, candidates_);
  // full-refit bounds every body; ffd-lazy leaves out bodies that meet no other.
  std::vector<bool> wanted(states_.size(), bounds_all() || expects_self_);
  for (const BodyPair& pair : candidates_) wanted[pair.a] = wanted[pair.b] = true;
  bounded_ = wanted;
  to_bound_.clear();
  for (std::size_t b = 0; b < wanted.size(); ++b)
    if (wanted[b]) to_bound_.push_back(b);
  team_.for_each(to_bound_.size(),
                 [this](std::size_t i, LazyScratch& scratch) { bound(to_bound_[i], scratch); });
}

void LazyDetector::query(Question question, ContactSet& out) {
  CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
  CONTACTCHECK_INVARIANT(is_of_steps(question) == in_step_,
                         "the question is about the last update");
  if (in_step_) return steps_->query(question, out);
  if (question == Question::kSelf) return find_self(out.self);
  if (question == Question::kTriangles)
    return tasks_.run(states_, candidates_, false, out.triangles);
  found_.clear();
  tasks_.run(states_, candidates_, true, found_);
  for (const ElementPair& pair : found_) out.bodies.push_back({pair.body_a, pair.body_b});
}

// Makes the patch tree of a body whose bounds come from nodes; a refitted body uses none.
void LazyDetector::know_patches(std::size_t index) {
  LazyState& state = states_[index];
  if (state.from_vertices || state.patches != nullptr) return;
  PatchTree& patches = patches_[state.shape];
  if (patches.children.empty()) patches = make_patch_tree(*state.shape, *trees_[index]);
  state.patches = &patches;
}

void LazyDetector::find_self(std::vector<SelfPair>& out) {
  for (std::uint32_t body = 0; body < states_.size(); ++body) {
    if (!expects_self_) refuse_many_adjacent_pairs(states_[body].shape->linked());
    know_patches(body);
    if (!bounded_[body]) bound(body, team_.scratch()[0]);
    bounded_[body] = true;
  }
  own_found_.resize(states_.size());
  team_.for_each(states_.size(), [this](std::size_t i, LazyScratch& scratch) {
    const auto body = static_cast<std::uint32_t>(i);
    own_found_[i].clear();
    kernels_.collide_self({{body, body}, states_[i], states_[i]}, false, scratch, own_found_[i]);
  });
  for (const std::vector<ElementPair>& found : own_found_)
    for (const ElementPair& pair : found) out.push_back({pair.body_a, pair.a, pair.b});
}

// Runs on one thread: the tests are the same.
StageTrace LazyDetector::trace() {
  std::vector<std::uint64_t> triangles;
  for (const LazyState& state : states_) triangles.push_back(state.shape->mesh.triangles.size());
  LazyScratch& scratch = team_.scratch()[0];
  const std::uint64_t before = scratch.counters.block_pairs;
  std::vector<ElementPair> tested, exact;
  scratch.candidates = &tested;
  for (const BodyPair& pair : candidates_)
    kernels_.collide({pair, states_[pair.a], states_[pair.b]}, false, scratch, exact);
  scratch.candidates = nullptr;

  StageTrace out;
  out.stages.push_back(triangle_record("boxes", brute_force_pairs(triangles), std::move(tested)));
  out.stages[0].visited = scratch.counters.block_pairs - before;
  out.stages[0].visited_unit = "pairs of blocks of eight";
  out.stages.push_back(triangle_record("triangles", out.stages[0].out, std::move(exact)));
  return out;
}

LazyCounters LazyDetector::counters() const {
  LazyCounters sum;
  if (in_step_) sum = steps_->counters();
  for (const LazyState& state : states_)
    if (!in_step_) count_made(state, sum);
  for (const LazyScratch& scratch : team_.scratch()) {
    sum.block_pairs += scratch.counters.block_pairs;
    sum.leaf_pairs += scratch.counters.leaf_pairs;
    sum.triangle_tests += scratch.counters.triangle_tests;
    sum.filter_failures += scratch.counters.filter_failures;
  }
  return sum;
}

std::vector<Count> LazyDetector::counts() {
  const LazyCounters c = counters();
  return {{"blocks_bounded", c.blocks_bounded},   {"leaves_mapped", c.leaves_mapped},
          {"vertices_mapped", c.vertices_mapped}, {"block_pairs", c.block_pairs},
          {"leaf_pairs", c.leaf_pairs},           {"triangle_tests", c.triangle_tests},
          {"exact_tests", c.filter_failures}};
}

std::string LazyDetector::validate(const std::vector<std::vector<Vec3>>& vertices) {
  for (std::size_t b = 0; b < states_.size(); ++b) {
    LazyScratch& scratch = team_.scratch()[0];
    bound(b, scratch);
    if (!states_[b].from_vertices) kernels_.bound_all(states_[b], scratch.arena);
    const std::string broken = single() ? broken_promise(states_[b], single_vertices(states_[b]))
                                        : broken_promise(states_[b], vertices[b]);
    if (!broken.empty()) return "body " + std::to_string(b) + ": " + broken;
  }
  return "";
}

std::size_t LazyDetector::shared_bytes() const {
  std::set<const LatticeTree*> distinct;
  std::size_t bytes = 0;
  for (const auto& tree : trees_)
    if (distinct.insert(tree.get()).second) bytes += tree->bytes();
  for (const auto& [shape, patches] : patches_) bytes += patches.bytes();
  return bytes;
}

std::size_t LazyDetector::instance_bytes() const {
  std::size_t bytes = 0;
  for (const LazyState& s : states_)
    bytes += s.near_nodes.size() * sizeof(Float4) + s.cells.size() * sizeof(CellTerms) +
             s.blocks.bytes() + s.leaves.bytes() + s.single.nodes.size() * sizeof(Vec3f) +
             s.single.leaves.bytes() + s.embedded_ones.size() + s.embedded_eights.size() +
             s.embedded_children.size();
  for (const LazyScratch& scratch : team_.scratch()) bytes += scratch.arena.bytes();
  if (steps_ != nullptr) bytes += steps_->bytes();
  for (const std::vector<Vec3>& m : mapped_) bytes += m.size() * sizeof(Vec3);
  for (const std::vector<Vec3f>& m : single_mapped_) bytes += m.size() * sizeof(Vec3f);
  return bytes;
}

}  // namespace contactcheck
