#include "reference/adapters/bullet_soft_detector.h"

#include <utility>

#include "core/types/check.h"
#include "reference/adapters/bullet_scale.h"

namespace contactcheck {

BulletSoftDetector::BulletSoftDetector(Semantics semantics, int collisions, double margin,
                                       double scale)
    : collisions_(collisions),
      margin_(margin),
      scale_option_(scale),
      semantics_(std::move(semantics)) {
  set_scale(scale > 0.0 ? scale : 1.0);
}

void BulletSoftDetector::set_scale(double scale) {
  semantics_.scale = scale;
  semantics_.margin = sum_of_margins(margin_, scale);
}

void BulletSoftDetector::prepare(const std::vector<Body>& bodies) {
  set_scale(scale_option_ > 0.0 ? scale_option_ : automatic_bullet_scale(bodies));
  bodies_.clear();
  const SoftBodySettings settings{scale(), fed_value(margin_, scale()), collisions_};
  for (const Body& body : bodies) {
    bodies_.push_back(std::make_unique<SoftBody>(world_, body.shape->mesh, settings));
    prepare_body(*bodies_.back());
  }
}

void BulletSoftDetector::update(const Frame& frame) {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == bodies_.size(), "one state per body");
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    bodies_[b]->feed(frame.bodies[b].vertices);
    refit(*bodies_[b]);
  }
}

void BulletSoftDetector::query(Question question, ContactSet& out) {
  CONTACTCHECK_INVARIANT(semantics_.answers(question), "only claimed questions are asked");
  for (std::uint32_t a = 0; a < bodies_.size(); ++a)
    for (std::uint32_t b = a + 1; b < bodies_.size(); ++b)
      if (bodies_[a]->boxes_meet(*bodies_[b])) collide(a, b, question, out);
}

}  // namespace contactcheck
