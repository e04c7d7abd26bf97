// The oracle in a detector's place, with all that it knows: what the relations say of detectors
// must hold for their judge.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/detect/detector.h"
#include "reference/oracle/oracle.h"

namespace contactcheck::test {

class OracleDetector : public Detector {
 public:
  /// `near`: whether it is asked about near pairs, too.
  explicit OracleDetector(bool near) : asked_near_(near) {
    semantics_.levels = {Level::kBody, Level::kContainment, Level::kTriangle, Level::kVertex,
                         Level::kNear};
    semantics_.questions = {Question::kTriangles, Question::kBody};
    semantics_.exact = true;
    semantics_.solid = true;
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }
  void prepare(const std::vector<Body>& bodies) override { oracle_.emplace(bodies); }
  void update(const Frame& frame) override {
    truth_ = oracle_->judge(frame, {.containment = true, .vertices = true});
    if (asked_near_) near_ = oracle_->near(frame, margin_of(frame));
  }
  /// To `triangles` also vertices inside and near pairs, to `body` also containment.
  void query(Question question, ContactSet& out) override {
    if (question == Question::kBody) {
      out.bodies = truth_.surface.bodies;
      out.bodies.insert(out.bodies.end(), truth_.containment.begin(), truth_.containment.end());
    } else {
      out.triangles = truth_.surface.triangles;
      out.vertices = truth_.surface.vertices;
      out.near = near_;
    }
  }

 private:
  // A power of two by the largest side of any body, so that it scales with the scene and stays when
  // that is moved. Half coordinates, because a side may overflow.
  static double margin_of(const Frame& frame) {
    double side = 0.0;
    for (const BodyState& body : frame.bodies) {
      Aabb box;
      for (const Vec3& v : body.vertices) box.extend(v);
      if (!box.empty()) side = std::max(side, (box.hi / 2 - box.lo / 2).maxCoeff());
    }
    return side > 0.0 ? std::ldexp(1.0, std::ilogb(side) - 8) : 0.0;
  }

  bool asked_near_;
  Semantics semantics_;
  std::optional<oracle::Oracle> oracle_;
  oracle::Truth truth_;
  std::vector<NearPair> near_;
};

}  // namespace contactcheck::test
