#include "tests/metamorphic/relation_faults.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/narrow/triangle_triangle.h"
#include "tests/faults/broken_detectors.h"

namespace contactcheck::test {
namespace {

// One triangle of a true pair, as a fault may see it.
struct SeenTriangle {
  const BodyShape& shape;
  std::uint32_t id;
  TrianglePoints points;

  const Triangle& corners() const { return shape.mesh.triangles[id]; }
  Vec3 normal() const { return (points[1] - points[0]).cross(points[2] - points[0]); }
  Vec3 center() const { return (points[0] + points[1] + points[2]) / 3.0; }
  Aabb box() const {
    Aabb box;
    for (const Vec3& p : points) box.extend(p);
    return box;
  }
  Aabb rest_box() const {
    Aabb box;
    for (std::uint32_t v : corners()) box.extend(shape.mesh.vertices[v]);
    return box;
  }
  double side() const { return box().extent().maxCoeff(); }
  double rest_side() const { return rest_box().extent().maxCoeff(); }
};

using Drops = bool (*)(const SeenTriangle& a, const SeenTriangle& b);

/// Loses true pairs by a look at their two triangles.
class DropsPairs : public TruthfulDetector {
 public:
  explicit DropsPairs(Drops drops) : drops_(drops) {}

  void prepare(const std::vector<Body>& bodies) override {
    shapes_.clear();
    for (const Body& body : bodies) shapes_.push_back(body.shape);
    TruthfulDetector::prepare(bodies);
  }
  void update(const Frame& frame) override {
    vertices_.clear();
    for (const BodyState& body : frame.bodies) vertices_.push_back(body.vertices);
    TruthfulDetector::update(frame);
  }

 private:
  SeenTriangle seen(std::uint32_t body, std::uint32_t id) const {
    const Triangle& t = shapes_[body]->mesh.triangles[id];
    const std::span<const Vec3> v = vertices_[body];
    return {*shapes_[body], id, {v[t[0]], v[t[1]], v[t[2]]}};
  }
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    std::erase_if(truth, [&](const ElementPair& p) {
      return drops_(seen(p.body_a, p.a), seen(p.body_b, p.b));
    });
    return truth;
  }

  Drops drops_;
  std::vector<std::shared_ptr<const BodyShape>> shapes_;
  std::vector<std::span<const Vec3>> vertices_;
};

bool by_number_in_order_of_bodies(const SeenTriangle& a, const SeenTriangle& b) {
  return a.id > b.id;
}
bool behind_the_first(const SeenTriangle& a, const SeenTriangle& b) {
  return a.normal().dot(b.center() - a.center()) < 0.0;
}
bool last_triangle(const SeenTriangle& a, const SeenTriangle&) {
  return a.id + 1 == a.shape.mesh.triangles.size();
}
bool names_last_vertex(const SeenTriangle& a, const SeenTriangle&) {
  const auto last = static_cast<std::uint32_t>(a.shape.mesh.vertices.size() - 1);
  return a.corners()[0] == last || a.corners()[1] == last || a.corners()[2] == last;
}
bool begins_with_the_lowest_corner(const SeenTriangle& a, const SeenTriangle&) {
  return a.points[0].x() < a.points[1].x() && a.points[0].x() < a.points[2].x();
}
bool stretched(const SeenTriangle& a, const SeenTriangle&) {
  return a.side() > 1.5 * a.rest_side();
}
bool large_at_rest(const SeenTriangle& a, const SeenTriangle&) { return a.rest_side() > 100.0; }
bool small_at_rest(const SeenTriangle& a, const SeenTriangle&) { return a.rest_side() < 1e-9; }
// A volume in single precision.
bool out_of_range_of_floats(const SeenTriangle& a, const SeenTriangle&) {
  const auto side = static_cast<float>(a.side());
  const float volume = side * side * side;
  return !(volume > 0.0f && std::isfinite(volume));
}
bool at_negative_coordinates(const SeenTriangle& a, const SeenTriangle&) {
  return a.box().lo.y() < 0.0;
}
bool side_lost_in_floats(const SeenTriangle& a, const SeenTriangle&) {
  const Aabb box = a.box();
  const Eigen::Vector3f extent = box.hi.cast<float>() - box.lo.cast<float>();
  return std::abs(static_cast<double>(extent.maxCoeff()) - a.side()) > 0.01 * a.side();
}
// As a sweep along x with open intervals does.
bool touching_along_x(const SeenTriangle& a, const SeenTriangle& b) {
  return a.box().hi.x() == b.box().lo.x() || b.box().hi.x() == a.box().lo.x();
}
bool right_handed(const SeenTriangle& a, const SeenTriangle& b) {
  return a.normal().cross(b.normal()).dot(b.center() - a.center()) > 0.0;
}
bool across_the_axes(const SeenTriangle& a, const SeenTriangle&) {
  return a.box().extent().minCoeff() > 0.0;
}

/// Has no answer before its second update.
class WakesUpLate : public TruthfulDetector {
 public:
  void update(const Frame& frame) override {
    TruthfulDetector::update(frame);
    if (updates_++ == 0) truth_.clear();
  }

 private:
  int updates_ = 0;
};

/// Every other update with the frame that it has already loses all.
class ForgetsWhatItHas : public TruthfulDetector {
 public:
  void update(const Frame& frame) override {
    const bool again = known_ == frame.index;
    known_ = again ? SIZE_MAX : frame.index;
    TruthfulDetector::update(frame);
    if (again) truth_.clear();
  }

 private:
  std::size_t known_ = SIZE_MAX;
};

class AnswersOnce : public TruthfulDetector {
 public:
  void query(Question question, ContactSet& out) override {
    TruthfulDetector::query(question, out);
    (question == Question::kBody ? truth_.bodies.clear() : truth_.triangles.clear());
  }
};

/// Bounds that only grow, and a table that is then too small for them.
class NeverShrinks : public TruthfulDetector {
 public:
  void update(const Frame& frame) override {
    TruthfulDetector::update(frame);
    double size = 0.0;
    for (const BodyState& body : frame.bodies)
      for (const Vec3& v : body.vertices) size = std::max(size, v.cwiseAbs().maxCoeff());
    largest_ = std::max(largest_, size);
    if (largest_ > 0x1p18 * size) truth_.clear();
  }

 private:
  double largest_ = 0.0;
};

/// Loses a pair where contacts are asked for, as where these are made in another way.
class OtherWithContacts : public TruthfulDetector {
 public:
  OtherWithContacts() {
    semantics_ = TruthfulDetector::semantics();
    semantics_.questions.push_back(Question::kContacts);
  }
  const Semantics& semantics() const override { return semantics_; }
  void query(Question question, ContactSet& out) override {
    TruthfulDetector::query(question, out);
    if (question == Question::kContacts && !out.triangles.empty()) out.triangles.pop_back();
  }

 private:
  Semantics semantics_;
};

RelationFault dropping(std::string relation, std::string what, Drops drops) {
  return {std::move(relation), std::move(what),
          [drops] { return std::make_unique<DropsPairs>(drops); }};
}

template <typename Faulty>
RelationFault faulty(std::string relation, std::string what) {
  return {std::move(relation), std::move(what), [] { return std::make_unique<Faulty>(); }};
}

}  // namespace

const std::vector<RelationFault>& relation_faults() {
  static const char* const kFloats = "a volume in single precision leaves its range";
  static const char* const kSide = "corners in single precision lose digits of the side";
  static const std::vector<RelationFault> faults = {
      dropping("SwappedBodies", "half of the pairs, by the order of the bodies",
               by_number_in_order_of_bodies),
      dropping("FlippedWinding", "what lies behind a triangle", behind_the_first),
      dropping("ShuffledTriangles", "a loop ends before the last triangle", last_triangle),
      dropping("ShuffledVertices", "a loop ends before the last vertex", names_last_vertex),
      dropping("TurnedCorners", "the first corner is taken for another one",
               begins_with_the_lowest_corner),
      dropping("AllIds", "a loop ends before the last triangle", last_triangle),
      dropping("ScaledByTwo", "more stretch than was planned for", stretched),
      dropping("ScaledByTwoToThe64", kFloats, out_of_range_of_floats),
      dropping("ScaledByTwoToTheMinus64", kFloats, out_of_range_of_floats),
      dropping("ScaledByTwoToThe480", kFloats, out_of_range_of_floats),
      dropping("ScaledByTwoToTheMinus480", kFloats, out_of_range_of_floats),
      dropping("ScaledWithRestBy1024", "a largest size in metres", large_at_rest),
      dropping("ScaledWithRestByTwoToTheMinus100", "a smallest size in metres", small_at_rest),
      dropping("ScaledToTheLargest", kFloats, out_of_range_of_floats),
      dropping("ScaledToTheSmallest", kFloats, out_of_range_of_floats),
      dropping("TranslatedByItsSize", "buckets of negative coordinates", at_negative_coordinates),
      dropping("TranslatedByAMillionSizes", kSide, side_lost_in_floats),
      dropping("TranslatedToTheLastDigits", kSide, side_lost_in_floats),
      dropping("TurnedToOtherAxes", "intervals along x are open", touching_along_x),
      dropping("Mirrored", "pairs of one handedness", right_handed),
      dropping("MovedWithRounding", "triangles across the axes", across_the_axes),
      faulty<WakesUpLate>("FreshDetector", "no answer to the first frame"),
      faulty<AnswersOnce>("RepeatedQuery", "an answer is gone once it was given"),
      faulty<ForgetsWhatItHas>("RepeatedUpdate", "the frame that is there already is lost"),
      faulty<AnswersLate>("AfterOtherFrame", "the answer to the frame before"),
      faulty<NeverShrinks>("AfterFarFrame", "bounds only grow"),
      faulty<OtherWithContacts>("WithContacts", "a pair fewer where contacts are asked for")};
  return faults;
}

}  // namespace contactcheck::test
