// contactcheck with one detector more: `judge run SCENE --detector sphere-per-body` judges it.
#include <algorithm>
#include <memory>
#include <vector>

#include "reference/reference.h"

using contactcheck::Vec3;

namespace {

// Bodies touch when spheres round them do: quick, and it reports too much by design.
class SpherePerBody : public contactcheck::Detector {
 public:
  SpherePerBody() {
    semantics_.levels = {contactcheck::Level::kBody};
    semantics_.questions = {contactcheck::Question::kBody};
    semantics_.means = "the spheres round two bodies meet";
  }
  const contactcheck::Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }
  void prepare(const std::vector<contactcheck::Body>&) override {}

  void update(const contactcheck::Frame& frame) override {
    spheres_.clear();
    for (const contactcheck::BodyState& body : frame.bodies) {
      Vec3 centre = Vec3::Zero();
      for (const Vec3& vertex : body.vertices) centre += vertex;
      centre /= static_cast<double>(body.vertices.size());
      double radius = 0.0;
      for (const Vec3& vertex : body.vertices) radius = std::max(radius, (vertex - centre).norm());
      spheres_.push_back({centre, radius});
    }
  }

  void query(contactcheck::Question, contactcheck::ContactSet& out) override {
    for (std::uint32_t b = 1; b < spheres_.size(); ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        if ((spheres_[a].centre - spheres_[b].centre).norm() <=
            spheres_[a].radius + spheres_[b].radius)
          out.bodies.push_back({a, b});
  }

 private:
  struct Sphere {
    Vec3 centre;
    double radius;
  };
  contactcheck::Semantics semantics_;
  std::vector<Sphere> spheres_;
};

}  // namespace

int main(int argc, char** argv) {
  contactcheck::DetectorCatalog catalog = contactcheck::standard_catalog();
  contactcheck::DetectorInfo mine;
  mine.id = "sphere-per-body";
  mine.summary = "a sphere round each body";
  mine.make = [](const contactcheck::Options&) { return std::make_unique<SpherePerBody>(); };
  catalog.add(std::move(mine));
  return contactcheck::contactcheck_main(argc, argv, catalog);
}
