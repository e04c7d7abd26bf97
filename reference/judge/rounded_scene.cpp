#include "reference/judge/rounded_scene.h"

#include <limits>

#include "core/types/local_origin.h"
#include "core/types/semantics.h"

namespace contactcheck::judge {
namespace {

// The value that a detector in single precision sees. It goes through memory, because g++ 12 (-O2
// and above) leaves out the conversion to float and back where it handles two numbers at once.
double seen_value(double x, const Rounding& rounding, double origin) {
  const volatile float fed =
      rounding.local_origin ? local_value(x, origin) : fed_value(x, rounding.scale);
  return static_cast<double>(fed);
}

}  // namespace

RoundedScene::RoundedScene(const JudgedScene& judged, const Rounding& rounding)
    : judged_(judged), rounding_(rounding), truths_(judged.truth.size()) {
  // Asked before any conversion: beyond the range of floats it is not defined.
  const double limit = rounding.local_origin ? kSingleLimit : std::numeric_limits<float>::max();
  for (std::size_t f = 0; f < judged.scene->frames && representable_; ++f) {
    const Vec3 origin = origin_of(f);
    for (const std::vector<Vec3>& vertices : judged.positions[f].vertices)
      for (const Vec3& p : vertices) {
        const Vec3 exact = rounding.local_origin ? Vec3(p - origin) : Vec3(rounding.scale * p);
        if (!(exact.cwiseAbs().maxCoeff() <= limit)) representable_ = false;
      }
  }
}

Vec3 RoundedScene::origin_of(std::size_t index) const {
  return rounding_.local_origin ? local_origin(judged_.frame(index)) : Vec3::Zero();
}

const Frame& RoundedScene::frame(std::size_t index) {
  const Vec3 origin = origin_of(index);
  vertices_ = judged_.positions[index].vertices;
  for (std::vector<Vec3>& body : vertices_)
    for (Vec3& v : body)
      for (int k = 0; k < 3; ++k) v[k] = seen_value(v[k], rounding_, origin[k]);
  frame_ =
      make_frame(index, judged_.scene->time_of(index), judged_.positions[index].nodes, vertices_);
  return frame_;
}

const oracle::Truth& RoundedScene::truth(std::size_t index, oracle::Oracle& oracle) {
  if (!truths_[index]) {
    oracle::WantedTruth wanted = wanted_truth(*judged_.scene);
    wanted.boxes = false;  // boxes are mapped nodes, which no detector that is fed vertices has
    truths_[index] = oracle.judge(frame(index), wanted);
  }
  return *truths_[index];
}

JudgingTools::JudgingTools(const JudgedScene& scene)
    : judged(scene), oracle(scene.scene->bodies), geometry(scene.scene->bodies) {}

RoundedScene* JudgingTools::rounded(const Rounding& rounding) {
  RoundedScene& scene = rounded_.try_emplace(rounding, judged, rounding).first->second;
  return scene.representable() ? &scene : nullptr;
}

}  // namespace contactcheck::judge
