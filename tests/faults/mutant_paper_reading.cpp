// The paper's reading, written down once more: which nodes lie in which boxes, by planes through
// face centroids, and which of them share a bucket of the grid.
#include <algorithm>
#include <cmath>

#include "core/detect/ffd_detector.h"
#include "tests/faults/mutant_checks.h"

namespace contactcheck::test {
namespace {

using Bucket = std::array<double, 3>;

Bucket bucket_of(const Vec3& p, double edge) {
  return {std::floor(p.x() / edge), std::floor(p.y() / edge), std::floor(p.z() / edge)};
}

// Each face with its corners in the order round it; the sign makes its normal look outward.
bool lies_inside(const Corners& box, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, at = side << axis;
      const Vec3 &a = box[at], &b = box[at | u], &c = box[at | u | v], &d = box[at | v];
      const Vec3 normal = (side == 1 ? 1.0 : -1.0) * (c - a).cross(d - b);
      const Vec3 middle = 0.25 * ((a + c) + (b + d));
      const double beyond = normal.dot(p - middle);
      // Within rounding of the plane either answer is right.
      if (beyond > 1e-9 * normal.norm() * (c - a).norm()) return false;
    }
  return true;
}

std::vector<std::vector<Bucket>> buckets_of(const FfdState& state, double edge) {
  std::vector<std::vector<Bucket>> buckets;
  for (const Corners& box : state.corners) {
    std::vector<Bucket>& of_box = buckets.emplace_back();
    for (const Vec3& corner : box) of_box.push_back(bucket_of(corner, edge));
  }
  return buckets;
}

// Every corner of a box of one body against every box of another that has a corner in its bucket.
class PlainReading {
 public:
  explicit PlainReading(const FfdDetector& detector) : states_(detector.states()) {
    double edge = 0.0;
    for (const FfdModel& model : detector.models()) edge += model.mean_edge;
    edge /= static_cast<double>(states_.size());
    for (const FfdState& state : states_) buckets_.push_back(buckets_of(state, edge));
  }

  std::vector<ElementPair> pairs() const {
    std::vector<ElementPair> out;
    for (std::uint32_t a = 0; a < states_.size(); ++a)
      for (std::uint32_t b = 0; b < states_.size(); ++b)
        if (a != b) add_pairs(a, b, out);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

 private:
  void add_pairs(std::uint32_t a, std::uint32_t b, std::vector<ElementPair>& out) const {
    for (std::uint32_t i = 0; i < states_[a].corners.size(); ++i)
      for (std::uint32_t j = 0; j < states_[b].corners.size(); ++j)
        if (hits(a, i, b, j))
          out.push_back(a < b ? ElementPair{a, b, i, j} : ElementPair{b, a, j, i});
  }

  bool hits(std::uint32_t a, std::uint32_t i, std::uint32_t b, std::uint32_t j) const {
    const std::vector<Bucket>& boxes = buckets_[b][j];
    for (std::size_t c = 0; c < 8; ++c)
      if (std::find(boxes.begin(), boxes.end(), buckets_[a][i][c]) != boxes.end() &&
          lies_inside(states_[b].corners[j], states_[a].corners[i][c]))
        return true;
    return false;
  }

  const std::vector<FfdState>& states_;
  std::vector<std::vector<std::vector<Bucket>>> buckets_;  // per body, box and corner
};

}  // namespace

void check_paper_reading(const MutantScene& scene, MutantFindings& out) {
  FfdDetector detector{FfdConfig{}};
  detector.prepare(scene.scene.bodies);
  for (std::size_t f = 0; f < scene.scene.frames.size(); ++f) {
    out.enter({scene.name, f, "ffd-aabb", "cell"});
    ContactSet answer;
    detector.update(scene.scene.frames[f].frame(f));
    detector.query(Question::kCells, answer);
    for (ElementPair& p : answer.cells)
      if (p.body_a > p.body_b) p = {p.body_b, p.body_a, p.b, p.a};
    std::sort(answer.cells.begin(), answer.cells.end());
    answer.cells.erase(std::unique(answer.cells.begin(), answer.cells.end()), answer.cells.end());
    out.expect_same(PlainReading(detector).pairs(), answer.cells);
  }
}

}  // namespace contactcheck::test
