#include "sweep_detector.h"

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "core/core.h"

namespace example {
namespace {

using namespace contactcheck;

struct Box {
  Aabb bounds;
  std::uint32_t body = 0, triangle = 0;
};

class SweepDetector : public Detector {
 public:
  explicit SweepDetector(int axis) : axis_(axis) {
    semantics_.levels = {Level::kBody, Level::kTriangle};
    semantics_.questions = {Question::kTriangles, Question::kBody};
    semantics_.exact = true;  // boxes of doubles are exact, and so is the test of two triangles
  }

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }

  void prepare(const std::vector<Body>& bodies) override {
    bodies_ = bodies;
    boxes_.clear();
    for (std::uint32_t b = 0; b < bodies.size(); ++b)
      for (std::uint32_t t = 0; t < bodies[b].shape->mesh.triangles.size(); ++t)
        boxes_.push_back({{}, b, t});
  }

  void update(const Frame& frame) override {
    vertices_.clear();
    for (const BodyState& body : frame.bodies) vertices_.push_back(body.vertices);
    for (Box& box : boxes_) {
      box.bounds = {};
      for (const Vec3& corner : corners(box)) box.bounds.extend(corner);
    }
    std::sort(boxes_.begin(), boxes_.end(), [this](const Box& a, const Box& b) {
      return a.bounds.lo[axis_] < b.bounds.lo[axis_];
    });
  }

  void query(Question question, ContactSet& out) override {
    std::set<BodyPair> seen;  // the question `body` ends for two bodies with their first contact
    for (auto a = boxes_.begin(); a != boxes_.end(); ++a)
      for (auto b = a + 1; b != boxes_.end() && b->bounds.lo[axis_] <= a->bounds.hi[axis_]; ++b) {
        if (a->body == b->body || !a->bounds.overlaps(b->bounds)) continue;
        const BodyPair bodies = {std::min(a->body, b->body), std::max(a->body, b->body)};
        if (question == Question::kBody && seen.count(bodies) > 0) continue;
        if (!triangles_intersect(corners(*a), corners(*b))) continue;
        if (question == Question::kTriangles)
          out.triangles.push_back({a->body, b->body, a->triangle, b->triangle});
        else if (seen.insert(bodies).second)
          out.bodies.push_back(bodies);
      }
  }

 private:
  TrianglePoints corners(const Box& box) const {
    const Triangle& t = bodies_[box.body].shape->mesh.triangles[box.triangle];
    const std::span<const Vec3> v = vertices_[box.body];
    return {v[t[0]], v[t[1]], v[t[2]]};
  }

  int axis_;
  Semantics semantics_;
  std::vector<Body> bodies_;
  std::vector<Box> boxes_;
  std::vector<std::span<const Vec3>> vertices_;  // of the last frame; the caller keeps them
};

class BoxesDetector : public ImpactDetector {
 public:
  ReportedImpact query(const ImpactQuery& query) override {
    const std::size_t first = query.kind == ImpactKind::vertex_triangle ? 1 : 2;
    Aabb one, other;  // a point that moves straight stays in the box of its two places
    for (std::size_t i = 0; i < 4; ++i) {
      Aabb& box = i < first ? one : other;
      box.extend(query.start[i]);
      box.extend(query.end[i]);
    }
    if (!one.overlaps(other)) return {};
    const Impact impact = find_impact(query);
    if (!impact.contact) return {};
    return {true, impact.earliest};
  }
};

}  // namespace

void register_boxes(DetectorCatalog& catalog) {
  ImpactDetectorInfo info;
  info.id = "cpp-boxes";
  info.summary = "example: boxes over the step, core's exact test, in C++";
  info.make = [](const Options&) { return std::make_unique<BoxesDetector>(); };
  catalog.add(std::move(info));
}

void register_sweep(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "cpp-sweep";
  info.summary = "example: boxes swept along an axis, core's exact triangle test, in C++";
  info.options = {choice_option("axis", "x", {"x", "y", "z"}, "boxes are swept along it")};
  info.make = [](const Options& options) {
    return std::make_unique<SweepDetector>(options.at("axis").front() - 'x');
  };
  catalog.add(std::move(info));
}

}  // namespace example
