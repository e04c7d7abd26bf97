#include "core/detect/ffd_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/deform/mapping.h"
#include "core/types/check.h"
#include "core/types/local_origin.h"

namespace contactcheck {
namespace {

template <typename T>
Semantics semantics_of(const FfdConfig& config) {
  Semantics s;
  if (config.element == ElementTest::kTriangle) {
    s.levels = {Level::kBody,       Level::kTriangle, Level::kSelf,
                Level::kSelfVertex, Level::kSelfEdge, Level::kSelfBody};
    s.questions = {Question::kTriangles, Question::kBody, Question::kSelf};
    s.exact = config.bounds == BoundsReading::kSafe && config.sphere_radius >= 1.0 &&
              std::is_same_v<T, double>;
  } else {
    s.levels = {Level::kBody, Level::kCell, Level::kSelfCell};
    s.questions = {Question::kCells, Question::kBody};
    s.whole_cells = config.volume == CellVolume::kLatticeCell;
    // What node tests on FFD-AABBs literally claim; a lattice cell is no FFD-AABB, and an owner's
    // boxes under `safe` are not the box of the level. Depths are those of these boxes, too.
    if (config.volume == CellVolume::kFfdAabb && config.bounds == BoundsReading::kPaper) {
      s.levels.push_back(Level::kBox);
      s.questions.push_back(Question::kContacts);
      s.depth = DepthKind::kConvexPair;
    }
    s.questions.push_back(Question::kSelf);
  }
  if constexpr (std::is_same_v<T, float>) {
    s.precision = Precision::kSingle;
    s.local_origin = true;
  }
  return s;
}

template <typename T>
FfdModelOf<T> model_of(const BodyShape& shape, const FfdConfig& config) {
  if constexpr (std::is_same_v<T, float>) {
    return rounded_model(make_ffd_model(shape, config));
  } else {
    return make_ffd_model(shape, config);
  }
}

// Neither 0 nor infinite, whatever was rounded: coordinates are divided by it, and infinite ones
// over an infinite cell would be no number.
template <typename T>
T grid_cell(double size) {
  using Limits = std::numeric_limits<T>;
  if (size > static_cast<double>(Limits::max())) return Limits::max();
  return std::max(static_cast<T>(size), Limits::denorm_min());
}

// The offset from the grid about a local origin to the grid about the origin of the world, so that
// nodes share the buckets that they share in doubles, up to rounding.
template <typename T>
Vec3Of<T> grid_offset(const Vec3& origin, double cell) {
  Vec3Of<T> out = Vec3Of<T>::Zero();
  if (!(cell > 0.0) || !std::isfinite(cell)) return out;
  for (int k = 0; k < 3; ++k) out[k] = static_cast<T>(std::fmod(origin[k], cell));
  return out;
}

}  // namespace

void FrameNumbers<double>::update(const Frame& frame) {
  nodes_.clear();
  vertices_.clear();
  for (const BodyState& body : frame.bodies) {
    nodes_.push_back(body.nodes);
    vertices_.push_back(body.vertices);
  }
}

void FrameNumbers<float>::prepare(const std::vector<Body>& bodies, bool with_vertices) {
  with_vertices_ = with_vertices;
  sources_.clear();
  nodes_.assign(bodies.size(), {});
  vertices_.assign(bodies.size(), {});
  spans_.assign(bodies.size(), {});
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyShape& shape = *bodies[b].shape;
    sources_.push_back({&shape, with_vertices ? single_local(shape.embedding) : SingleLocal{}});
    nodes_[b].resize(shape.node_count());
    if (with_vertices) vertices_[b].resize(shape.mesh.vertices.size());
    spans_[b] = vertices_[b];
  }
}

void FrameNumbers<float>::update(const Frame& frame) {
  origin_ = local_origin(frame);
  for (std::size_t b = 0; b < sources_.size(); ++b) {
    round_to_local(frame.bodies[b].nodes, origin_, nodes_[b]);
    if (!with_vertices_) continue;
    const BodyShape& shape = *sources_[b].shape;
    map_vertices(*shape.lattice, shape.embedding, sources_[b].local, nodes_[b], vertices_[b]);
  }
}

template <typename T>
FfdDetectorOf<T>::FfdDetectorOf(const FfdConfig& config)
    : config_(config), semantics_(semantics_of<T>(config)) {}

template <typename T>
void FfdDetectorOf<T>::expect(const std::vector<Question>& questions) {
  expects_self_ = std::find(questions.begin(), questions.end(), Question::kSelf) != questions.end();
}

template <typename T>
void FfdDetectorOf<T>::prepare(const std::vector<Body>& bodies) {
  models_.clear();
  double edges = 0.0;
  for (const Body& body : bodies) {
    try {
      if (expects_self_ && config_.element == ElementTest::kTriangle)
        refuse_many_adjacent_pairs(body.shape->linked());
      models_.push_back(model_of<T>(*body.shape, config_));
    } catch (const RefusedInput& e) {
      throw RefusedInput("body \"" + body.name + "\": " + e.what());
    }
    edges += models_.back().mean_edge;
  }
  states_.assign(models_.size(), {});
  numbers_.prepare(bodies, config_.element == ElementTest::kTriangle);
  const double mean = models_.empty() ? 0.0 : edges / static_cast<double>(models_.size());
  // Boxes without extent (all surface in one point per cell) still need a grid.
  hash_cell_size_ = mean > 0.0 ? mean * config_.hash_cell : 1.0;
}

template <typename T>
void FfdDetectorOf<T>::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == models_.size(), "one state per prepared body");
  for (std::size_t body = 0; body < models_.size(); ++body) {
    const BodyShape& shape = *models_[body].shape;
    const BodyState& state = frame.bodies[body];
    CONTACTCHECK_INVARIANT(state.nodes.size() == shape.node_count(), "one position per node");
    CONTACTCHECK_INVARIANT(!needs_vertices() || state.vertices.size() == shape.mesh.vertices.size(),
                           "one position per vertex");
  }
  numbers_.update(frame);
  for (std::size_t body = 0; body < models_.size(); ++body) {
    try {
      update_state(models_[body], config_, numbers_.nodes(body), states_[body]);
    } catch (const RefusedInput& e) {
      throw RefusedInput("body " + std::to_string(body) + ": " + e.what());
    }
  }
  if (config_.element == ElementTest::kTriangle) {
    triangle_.begin_frame(models_, numbers_.vertices());
  } else {
    node_plane_.begin_frame(models_);
  }
}

template <typename T>
void FfdDetectorOf<T>::find_candidates(bool own) {
  run_spheres(models_, states_, config_.bounds, config_.sphere_levels, own, survivors_);
  const T cell = grid_cell<T>(hash_cell_size_);
  if (safe()) {
    box_hash_.run(models_, states_, config_, survivors_, cell, cells_);
  } else {
    probe_hash_.run(models_, states_, config_, survivors_, cell,
                    grid_offset<T>(numbers_.origin(), hash_cell_size_), hits_);
  }
}

template <typename T>
std::vector<ElementPair> FfdDetectorOf<T>::cells_of_hits() const {
  std::vector<ElementPair> cells;
  for (const ProbeHit& hit : hits_)
    for_cells_of_probe(models_[hit.body_a], config_.volume, hit.probe, [&](std::uint32_t cell) {
      cells.push_back({hit.body_a, hit.body_b, cell, hit.cell_b});
    });
  canonicalize(cells);
  return cells;
}

template <typename T>
void FfdDetectorOf<T>::test_elements(bool first_only, std::vector<ElementPair>& out) {
  if (config_.element == ElementTest::kTriangle) {
    if (!safe()) cells_ = cells_of_hits();
    triangle_.run(models_, cells_, first_only, out);
  } else if (safe()) {
    node_plane_.run_cells(models_, states_, cells_, first_only, out);
  } else {
    node_plane_.run_probes(models_, states_, config_.volume, hits_, first_only, out);
  }
}

template <typename T>
void FfdDetectorOf<T>::query(Question question, ContactSet& out) {
  CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
  if (question == Question::kSelf) return find_self(out);
  find_candidates();
  const bool boolean = question == Question::kBody;
  std::vector<ElementPair>& elements =
      config_.element == ElementTest::kTriangle ? out.triangles : out.cells;
  if (!boolean) {
    test_elements(false, elements);
    if (question == Question::kContacts)
      node_plane_.run_contacts(models_, states_, hits_, out.piece_contacts);
    return;
  }
  std::vector<ElementPair> found;
  test_elements(true, found);
  for (const ElementPair& p : found) out.bodies.push_back({p.body_a, p.body_b});
}

// A body against itself, as two bodies are tested.
template <typename T>
void FfdDetectorOf<T>::find_self(ContactSet& out) {
  const bool triangles = config_.element == ElementTest::kTriangle;
  for (std::size_t body = 0; triangles && !expects_self_ && body < models_.size(); ++body)
    refuse_many_adjacent_pairs(models_[body].shape->linked());
  find_candidates(true);
  // Cells that share a node always meet there.
  const auto skipped = [&](const ElementPair& p) {
    return !triangles && share_node(*models_[p.body_a].shape->lattice, p.a, p.b);
  };
  std::erase_if(cells_, skipped);
  std::vector<ElementPair> found;
  test_elements(false, found);
  for (std::uint32_t body = 0; triangles && body < models_.size(); ++body)
    triangle_.run_within_cells(models_, body, found);
  for (const ElementPair& p : found)
    if (!skipped(p)) (triangles ? out.self : out.self_cells).push_back({p.body_a, p.a, p.b});
}

// Which cells still take part after `levels` sphere levels.
template <typename T>
std::vector<std::vector<char>> FfdDetectorOf<T>::covered_cells(int levels,
                                                               const SphereSurvivors& s) const {
  FfdConfig config = config_;
  config.sphere_levels = levels;
  if (safe()) return BoxHashStageOf<T>::active_cells(models_, config, s);
  const auto probes = ProbeHashStageOf<T>::active_probes(models_, states_, config, s);
  std::vector<std::vector<char>> cells(models_.size());
  for (std::size_t body = 0; body < models_.size(); ++body) {
    cells[body].assign(models_[body].piece_begin.size() - 1, 0);
    for (std::uint32_t p = 0; p < probes[body].size(); ++p)
      if (probes[body][p])
        for_cells_of_probe(models_[body], config_.volume, p,
                           [&](std::uint32_t cell) { cells[body][cell] = 1; });
  }
  return cells;
}

template <typename T>
void FfdDetectorOf<T>::trace_spheres(StageTrace& out) {
  for (int level = 1; level <= config_.sphere_levels; ++level) {
    SphereSurvivors s;
    run_spheres(models_, states_, config_.bounds, level, false, s);
    StageRecord record;
    record.name = "sphere" + std::to_string(level);
    record.unit = level == 1 ? "body pairs" : "sphere pairs";
    record.in = s.tested;
    record.out = s.sphere_pairs.size();
    record.bodies = s.body_pairs;
    if (level > 1) {
      record.kind =
          safe() ? StageRecord::Kind::kActiveOwnerCells : StageRecord::Kind::kActiveLabelCells;
      record.active = covered_cells(level, s);
    }
    out.stages.push_back(std::move(record));
  }
}

template <typename T>
void FfdDetectorOf<T>::trace_hash_and_elements(StageTrace& out) {
  find_candidates();
  StageRecord hash;
  hash.name = "hash";
  hash.unit = "cell pairs";
  hash.kind = safe() ? StageRecord::Kind::kOwnerCells : StageRecord::Kind::kLabelCells;
  const auto cells = covered_cells(config_.sphere_levels, survivors_);
  const auto count = [&](std::uint32_t body) {
    return static_cast<std::uint64_t>(std::count(cells[body].begin(), cells[body].end(), 1));
  };
  for (const BodyPair& pair : survivors_.body_pairs) hash.in += count(pair.a) * count(pair.b);
  hash.elements = safe() ? cells_ : cells_of_hits();
  canonicalize(hash.elements);
  hash.out = hash.elements.size();

  StageRecord element;
  const bool triangles = config_.element == ElementTest::kTriangle;
  element.name = triangles ? "triangles" : "node-plane";
  element.unit = triangles ? "cell pairs to triangle pairs" : "cell pairs";
  // Reported cell pairs are judged through labels in both readings, as the level `cell` is.
  element.kind = triangles ? StageRecord::Kind::kTriangles : StageRecord::Kind::kLabelCells;
  element.in = hash.out;
  test_elements(false, element.elements);
  canonicalize(element.elements);
  element.out = element.elements.size();
  out.stages.push_back(std::move(hash));
  out.stages.push_back(std::move(element));
}

template <typename T>
StageTrace FfdDetectorOf<T>::trace() {
  StageTrace out;
  if (safe())
    for (const FfdModelOf<T>& model : models_) out.owner.push_back(model.owner);
  trace_spheres(out);
  trace_hash_and_elements(out);
  return out;
}

template class FfdDetectorOf<double>;
template class FfdDetectorOf<float>;

}  // namespace contactcheck
