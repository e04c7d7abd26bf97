// What the detectors on Bullet's soft bodies share: the world, its scale and margins, one soft body
// per body, and the pairs of bodies whose boxes meet. Holds Bullet's types: for the .cpp files of
// the adapters of soft bodies alone.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/detect/detector.h"
#include "reference/adapters/bullet_soft_body.h"

namespace contactcheck {

class BulletSoftDetector : public Detector {
 public:
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }
  void prepare(const std::vector<Body>& bodies) override;
  void update(const Frame& frame) override;
  void query(Question question, ContactSet& out) override;

 protected:
  /// `semantics` without scale and margin. `collisions`: VF_SS or CL_SS. `margin`: of one body,
  /// metres. `scale`: world units per metre; 0: from the scene.
  BulletSoftDetector(Semantics semantics, int collisions, double margin, double scale);

  /// Once per body, at rest.
  virtual void prepare_body(SoftBody& body) = 0;
  /// The body has been fed new vertices.
  virtual void refit(SoftBody& body) = 0;
  /// Two bodies, a < b, whose boxes meet.
  virtual void collide(std::uint32_t a, std::uint32_t b, Question question, ContactSet& out) = 0;

  double scale() const { return semantics_.scale; }
  const std::vector<std::unique_ptr<SoftBody>>& bodies() const { return bodies_; }

 private:
  void set_scale(double scale);

  int collisions_;
  double margin_;        // of one body, metres
  double scale_option_;  // 0: from the scene
  Semantics semantics_;
  SoftBodyWorld world_;
  std::vector<std::unique_ptr<SoftBody>> bodies_;
};

}  // namespace contactcheck
