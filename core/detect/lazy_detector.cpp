#include "core/detect/lazy_detector.h"

#include <map>
#include <set>

#include "core/detect/triangle_pair_detector.h"
#include "core/detect/triangle_record.h"
#include "core/lazy/candidate_bodies.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// By measurement (lazy_register.cpp).
constexpr std::size_t kFewTrianglesPerCell = 100;

bool small_for_its_lattice(const BodyShape& shape) {
  return shape.mesh.triangles.size() < kFewTrianglesPerCell * shape.lattice->cells.size();
}

bool refits(const BodyShape& shape, BoundSource bounds) {
  if (!shape.lattice || bounds == BoundSource::kVertices) return true;
  return bounds == BoundSource::kCheaper && small_for_its_lattice(shape);
}

}  // namespace

LazyDetector::LazyDetector(const LazyConfig& config)
    : config_(config), kernels_(lazy_kernels(config.isa)), semantics_(exact_triangle_semantics()) {}

void LazyDetector::prepare(const std::vector<Body>& bodies) {
  trees_.clear();
  states_.clear();
  std::map<const BodyShape*, std::shared_ptr<const LatticeTree>> known;
  for (const Body& body : bodies) {
    std::shared_ptr<const LatticeTree>& tree = known[body.shape.get()];
    const bool refitted = refits(*body.shape, config_.bounds);
    if (!tree)
      tree = std::make_shared<const LatticeTree>(
          make_lattice_tree(*body.shape, refitted ? TreeUse::kVertices : TreeUse::kNodes));
    trees_.push_back(tree);
    LazyState& state = states_.emplace_back();
    state.shape = body.shape.get();
    state.tree = tree.get();
    state.from_vertices = refitted;
  }
  mapped_.assign(bodies.size(), {});
}

void LazyDetector::begin_body(const BodyState& body, LazyState& state) {
  const BodyShape& shape = *state.shape;
  CONTACTCHECK_INVARIANT(body.nodes.size() == shape.node_count(), "one position per node");
  if (needs_vertices()) {
    CONTACTCHECK_INVARIANT(body.vertices.size() == shape.mesh.vertices.size(),
                           "one position per vertex");
    begin_frame_by_vertices(state, body.vertices);
  } else if (shape.lattice) {
    begin_frame_by_nodes(state, body.nodes);
  } else {
    begin_frame_by_vertices(state, body.nodes);
  }
}

// Bounds of bodies that are refitted; those of others are made on demand.
void LazyDetector::refit(std::size_t index) {
  LazyState& state = states_[index];
  if (!state.from_vertices || state.block_frame[0] == state.frame) return;
  if (state.vertices.empty()) {
    mapped_[index].resize(state.shape->mesh.vertices.size());
    map_body(*state.shape, state.nodes, mapped_[index]);
    state.vertices = mapped_[index];
  }
  kernels_.bound_all(state, scratch_.counters);
}

void LazyDetector::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == states_.size(), "one state per prepared body");
  scratch_.counters = {};
  std::vector<Aabb> boxes;
  for (std::size_t b = 0; b < states_.size(); ++b) {
    begin_body(frame.bodies[b], states_[b]);
    boxes.push_back(states_[b].box);
  }
  place(states_);
  find_candidate_bodies(boxes, candidates_);
  // full-refit is what it says; ffd-lazy leaves out bodies that meet no other.
  for (std::size_t b = 0; needs_vertices() && b < states_.size(); ++b) refit(b);
  for (const BodyPair& pair : candidates_) {
    refit(pair.a);
    refit(pair.b);
  }
}

void LazyDetector::test_pair(const BodyPair& pair, bool first_only, std::vector<ElementPair>& out) {
  find_near_nodes(states_[pair.a]);
  find_near_nodes(states_[pair.b]);
  kernels_.collide({pair, states_[pair.a], states_[pair.b]}, first_only, scratch_, out);
}

void LazyDetector::query(Question question, ContactSet& out) {
  CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
  for (const BodyPair& pair : candidates_) {
    if (question == Question::kTriangles) {
      test_pair(pair, false, out.triangles);
      continue;
    }
    found_.clear();
    test_pair(pair, true, found_);
    if (!found_.empty()) out.bodies.push_back(pair);
  }
}

StageTrace LazyDetector::trace() {
  std::vector<std::uint64_t> triangles;
  for (const LazyState& state : states_) triangles.push_back(state.shape->mesh.triangles.size());
  const std::uint64_t before = scratch_.counters.block_pairs;
  std::vector<ElementPair> tested, exact;
  scratch_.candidates = &tested;
  for (const BodyPair& pair : candidates_) test_pair(pair, false, exact);
  scratch_.candidates = nullptr;

  StageTrace out;
  out.stages.push_back(triangle_record("boxes", brute_force_pairs(triangles), std::move(tested)));
  out.stages[0].visited = scratch_.counters.block_pairs - before;
  out.stages[0].visited_unit = "pairs of blocks of eight";
  out.stages.push_back(triangle_record("triangles", out.stages[0].out, std::move(exact)));
  return out;
}

std::string LazyDetector::validate(const std::vector<std::vector<Vec3>>& vertices) {
  for (std::size_t b = 0; b < states_.size(); ++b) {
    refit(b);
    find_near_nodes(states_[b]);
    if (!states_[b].from_vertices) kernels_.bound_all(states_[b], scratch_.counters);
    const std::string broken = contactcheck::validate(states_[b], vertices[b]);
    if (!broken.empty()) return "body " + std::to_string(b) + ": " + broken;
    for (const Vec3& v : vertices[b])
      if (!states_[b].box.contains(v))
        return "body " + std::to_string(b) + ": a vertex leaves the body's box";
  }
  return "";
}

std::size_t LazyDetector::shared_bytes() const {
  std::set<const LatticeTree*> distinct;
  std::size_t bytes = 0;
  for (const auto& tree : trees_)
    if (distinct.insert(tree.get()).second) bytes += tree->bytes();
  return bytes;
}

std::size_t LazyDetector::instance_bytes() const {
  std::size_t bytes = 0;
  for (const LazyState& s : states_)
    bytes += s.near_nodes.size() * sizeof(Float4) + s.arena.bytes() +
             s.block_bounds.size() * (sizeof(BlockBounds) + sizeof(std::uint32_t)) +
             s.leaves.size() * (sizeof(LeafCache*) + sizeof(std::uint32_t));
  for (const std::vector<Vec3>& m : mapped_) bytes += m.size() * sizeof(Vec3);
  return bytes;
}

}  // namespace contactcheck
