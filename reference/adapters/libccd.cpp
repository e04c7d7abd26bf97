// libccd's two intersection algorithms as detectors; libccd_call.h calls them.
//
//   libccd-gjk  GJK, and EPA for depths
//   libccd-mpr  Minkowski portal refinement (XenoCollide), for both
//
// Option `pieces`:
//   triangles  each pair of triangles whose boxes overlap (core's refitted trees) as two hulls of
//              three points; answers which pairs of triangles and of bodies are in contact
//   boxes      the mapped FFD-AABBs of kept cells (core's spatial hash on their bounding boxes) as
//              hulls of eight corners; answers which pairs of cells and of bodies are in contact
//              and, by the question `contacts`, depth (metres) and direction of the shortest way
//              to part two boxes. Needs a lattice for every body.
// Option `iterations`: see libccd_call.h; a pair that takes more counts as no contact, and notes()
// says so. Option `scale`: libccd is fed points times this, and its tolerances, which are absolute,
// are in these units (see libccd_call.cpp). By default each pair has a power of two by the size of
// its pieces, which rounds nothing. Depths are in metres whatever the scale.
//
// In double, not exact. GJK means touching to be contact, and loses some of it; MPR means it to be
// none, and reports some (prior work, C8).
// Sources: van den Bergen, "Collision Detection in Interactive 3D Environments", 2003; Snethen,
// "XenoCollide", Game Programming Gems 7, 2008.
#include <ccd/ccd.h>

#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/broad/aabb_tree.h"
#include "core/broad/box_pairs.h"
#include "core/deform/ffd_aabb.h"
#include "core/deform/mapping.h"
#include "core/detect/option_info.h"
#include "core/detect/seen_pairs.h"
#include "core/detect/triangle_pair_detector.h"
#include "core/types/check.h"
#include "reference/adapters/adapters.h"
#include "reference/adapters/libccd_call.h"

namespace contactcheck::adapters {
namespace {

// --- Pieces: triangles ---

/// As the detector `aabb-tree` has by default, so that the two differ in the triangle test alone.
constexpr std::uint32_t kLeafSize = 4;

class CcdTriangles {
 public:
  explicit CcdTriangles(const CcdSettings& settings) : caller_(settings) {}

  bool operator()(const TrianglePoints& p, const TrianglePoints& q) {
    return caller_.intersect(p, q);
  }
  void begin_frame() { caller_.begin_frame(); }
  std::vector<std::string> notes() const { return caller_.notes(); }
  std::uint64_t support_calls() const { return caller_.support_calls(); }

 private:
  CcdCaller caller_;
};

Semantics triangle_semantics(CcdAlgorithm algorithm) {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kTriangle};
  semantics.questions = {Question::kTriangles, Question::kBody};
  semantics.closed = algorithm == CcdAlgorithm::kGjk;
  return semantics;
}

class CcdTriangleDetector final : public TrianglePairDetector<AabbTrees, CcdTriangles> {
 public:
  explicit CcdTriangleDetector(const CcdSettings& settings)
      : TrianglePairDetector(AabbTrees(kLeafSize), CcdTriangles(settings),
                             triangle_semantics(settings.algorithm)) {}

  StageTrace trace() override {
    const std::uint64_t before = narrow().support_calls();
    StageTrace out = TrianglePairDetector::trace();
    out.stages.back().visited = narrow().support_calls() - before;
    out.stages.back().visited_unit = "support calls";
    return out;
  }
};

// --- Pieces: mapped FFD-AABBs ---

Semantics box_semantics(CcdAlgorithm algorithm) {
  Semantics semantics;
  semantics.levels = {Level::kBody, Level::kCell, Level::kBox};
  semantics.questions = {Question::kCells, Question::kContacts, Question::kBody};
  semantics.closed = algorithm == CcdAlgorithm::kGjk;
  semantics.depth = DepthKind::kConvexPair;
  semantics.means = "the hulls of two cells' mapped FFD-AABBs share a point";
  return semantics;
}

Aabb bounds(const Corners& corners) {
  Aabb box;
  for (const Vec3& c : corners) box.extend(c);
  return box;
}

/// One body: a box per kept cell, mapped by the nodes of the last update.
class CcdBody {
 public:
  explicit CcdBody(const Body& body) : shape_(*body.shape) {
    if (!shape_.lattice)
      throw RefusedInput("body \"" + body.name + "\" has no lattice, and so no FFD-AABBs");
    const std::vector<Aabb> local = ffd_aabbs(shape_.mesh, *shape_.lattice, shape_.embedding);
    for (std::uint32_t cell = 0; cell < local.size(); ++cell) boxes_.push_back({cell, local[cell]});
    corners_.resize(boxes_.size());
  }

  void update(std::span<const Vec3> nodes) {
    CONTACTCHECK_INVARIANT(nodes.size() == shape_.node_count(), "one position per node");
    map_boxes(*shape_.lattice, boxes_, nodes, corners_);
  }
  /// Sum of the boxes' edges, along the axes, at rest.
  double rest_edges() {
    update(shape_.lattice->rest_nodes());
    return std::accumulate(corners_.begin(), corners_.end(), 0.0, [](double sum, const Corners& c) {
      return sum + bounds(c).extent().sum();
    });
  }
  const std::vector<Corners>& corners() const { return corners_; }

 private:
  const BodyShape& shape_;  // of the body, which outlives the detector
  std::vector<LocalBox> boxes_;
  std::vector<Corners> corners_;
};

class CcdBoxDetector final : public Detector {
 public:
  explicit CcdBoxDetector(const CcdSettings& settings)
      : caller_(settings), semantics_(box_semantics(settings.algorithm)) {}

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return false; }

  void prepare(const std::vector<Body>& bodies) override {
    bodies_.clear();
    double edges = 0.0;
    std::size_t boxes = 0;
    for (const Body& body : bodies) {
      bodies_.emplace_back(body);
      edges += bodies_.back().rest_edges();
      boxes += bodies_.back().corners().size();
    }
    // Boxes without extent (all surface in one point per cell) still need a grid.
    grid_.cell_size = edges > 0.0 ? edges / (3.0 * static_cast<double>(boxes)) : 1.0;
  }

  void update(const Frame& frame) override {
    CONTACTCHECK_INVARIANT(frame.bodies.size() == bodies_.size(), "one state per prepared body");
    boxes_.clear();
    for (std::uint32_t body = 0; body < bodies_.size(); ++body) {
      bodies_[body].update(frame.bodies[body].nodes);
      for (std::uint32_t cell = 0; cell < bodies_[body].corners().size(); ++cell)
        boxes_.push_back({bounds(bodies_[body].corners()[cell]), body, cell});
    }
    caller_.begin_frame();
  }

  void query(Question question, ContactSet& out) override {
    CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
    find_candidates();
    if (question == Question::kBody) {
      find_bodies(out.bodies);
    } else if (question == Question::kCells) {
      find_cells(out.cells);
    } else {
      find_contacts(out);
    }
  }

  StageTrace trace() override {
    find_candidates();
    StageTrace out;
    out.stages = {trace_boxes(), trace_hulls()};
    return out;
  }
  std::vector<std::string> notes() override { return caller_.notes(); }

 private:
  void find_candidates() {
    candidates_.clear();
    finder_.find(boxes_, grid_, candidates_);
  }

  /// Lower body first: boxes_ is in the order of the bodies.
  ElementPair cells_of(const BoxPairFinder::Pair& pair) const {
    const OwnedBox &a = boxes_[pair.first], &b = boxes_[pair.second];
    return {a.body, b.body, a.cell, b.cell};
  }
  CcdPiece piece(std::uint32_t body, std::uint32_t cell) const {
    return bodies_[body].corners()[cell];
  }
  bool intersect(const ElementPair& p) {
    return caller_.intersect(piece(p.body_a, p.a), piece(p.body_b, p.b));
  }

  void find_bodies(std::vector<BodyPair>& out) {
    SeenPairs found(bodies_.size());
    for (const BoxPairFinder::Pair& pair : candidates_) {
      const ElementPair cells = cells_of(pair);
      if (found.seen(cells.body_a, cells.body_b) || !intersect(cells)) continue;
      found.mark(cells.body_a, cells.body_b);
      out.push_back({cells.body_a, cells.body_b});
    }
  }

  void find_cells(std::vector<ElementPair>& out) {
    for (const BoxPairFinder::Pair& pair : candidates_)
      if (intersect(cells_of(pair))) out.push_back(cells_of(pair));
  }

  void find_contacts(ContactSet& out) {
    for (const BoxPairFinder::Pair& pair : candidates_) {
      const ElementPair p = cells_of(pair);
      const CcdPenetration found = caller_.penetrate(piece(p.body_a, p.a), piece(p.body_b, p.b));
      if (!found.contact) continue;
      out.cells.push_back(p);
      if (found.translation)
        out.piece_contacts.push_back({p, found.translation->depth, found.translation->normal});
    }
  }

  std::uint64_t brute_force_pairs() const {
    std::uint64_t pairs = 0, before = 0;
    for (const CcdBody& body : bodies_) {
      pairs += before * body.corners().size();
      before += body.corners().size();
    }
    return pairs;
  }

  StageRecord trace_boxes() const {
    StageRecord record;
    record.name = "boxes";
    record.unit = "box pairs";
    record.kind = StageRecord::Kind::kLabelCells;
    record.in = brute_force_pairs();
    record.out = candidates_.size();
    record.visited = finder_.visited();
    record.visited_unit = "bucket pairs";
    for (const BoxPairFinder::Pair& pair : candidates_) record.elements.push_back(cells_of(pair));
    canonicalize(record.elements);
    return record;
  }

  StageRecord trace_hulls() {
    StageRecord record;
    record.name = "hulls";
    record.unit = "box pairs";
    record.kind = StageRecord::Kind::kLabelCells;
    record.in = candidates_.size();
    const std::uint64_t before = caller_.support_calls();
    find_cells(record.elements);
    record.visited = caller_.support_calls() - before;
    record.visited_unit = "support calls";
    canonicalize(record.elements);
    record.out = record.elements.size();
    return record;
  }

  CcdCaller caller_;
  Semantics semantics_;
  std::vector<CcdBody> bodies_;
  BoxPairSettings grid_;
  std::vector<OwnedBox> boxes_;
  BoxPairFinder finder_;
  std::vector<BoxPairFinder::Pair> candidates_;
};

// --- Registration ---

CcdSettings settings_from(const Options& options, CcdAlgorithm algorithm) {
  CcdSettings settings;
  settings.algorithm = algorithm;
  settings.scale = number_option(options, "scale");
  settings.iterations = static_cast<std::uint32_t>(number_option(options, "iterations"));
  if (algorithm == CcdAlgorithm::kGjk) {
    settings.epa_tolerance = number_option(options, "epa_tolerance");
  } else {
    settings.mpr_tolerance = number_option(options, "tolerance");
  }
  return settings;
}

DetectorInfo info(std::string id, std::string summary, CcdAlgorithm algorithm,
                  OptionInfo tolerance) {
  DetectorInfo out;
  out.id = std::move(id);
  out.summary = std::move(summary);
  out.given =
      "a spatial hash of all boxes; each pair is scaled to its size; body ends at the first "
      "contact of two bodies";
  out.options = {
      choice_option("pieces", "triangles", {"triangles", "boxes"},
                    "what is convex: triangles, or the cells' mapped FFD-AABBs"),
      numeric_option("iterations", "100", 1, 100000, true,
                     "rounds of an algorithm on one pair before it is given up"),
      numeric_option("scale", "0", 0.0, 1e6, false,
                     "units of libccd in a metre; 0: for each pair the power of two at "
                     "which its larger piece is " +
                         std::string(algorithm == CcdAlgorithm::kGjk ? "a quarter to half a unit"
                                                                     : "half to one unit") +
                         " wide"),
      std::move(tolerance)};
  out.make = [algorithm](const Options& options) -> std::unique_ptr<Detector> {
    const CcdSettings settings = settings_from(options, algorithm);
    if (options.at("pieces") == "boxes") return std::make_unique<CcdBoxDetector>(settings);
    return std::make_unique<CcdTriangleDetector>(settings);
  };
  return out;
}

std::string libccd_version() {
  std::string said = CONTACTCHECK_CCD_VERSION;
  // 2.1, the one release after 2.0, kept 2.0 as its number in its CMake, pkg-config and library
  // names; this macro is new in its headers.
#ifdef CCD_EXPORT
  if (said == "2.0") return "2.1 (its own files say 2.0)";
#endif
  return said;
}

}  // namespace

Adapter libccd_adapter() {
  return {
      "libccd",
      libccd_version(),
      {info("libccd-gjk", "libccd's GJK on triangles, or GJK and EPA on the cells' boxes",
            CcdAlgorithm::kGjk,
            numeric_option("epa_tolerance", "1e-12", 1e-15, 1, false,
                           "square units: EPA stops growing its polytope; depths only")),
       info("libccd-mpr", "libccd's portal refinement (MPR) on triangles, or on the cells' boxes",
            CcdAlgorithm::kMpr,
            numeric_option("tolerance", "1e-9", 1e-15, 1, false,
                           "units: MPR stops refining its portal"))}};
}

}  // namespace contactcheck::adapters
