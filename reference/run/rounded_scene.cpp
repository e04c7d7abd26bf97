#include "reference/run/rounded_scene.h"

#include <algorithm>
#include <limits>

#include "core/types/local_origin.h"
#include "core/types/semantics.h"

namespace contactcheck {
namespace {

// What a detector in single precision sees. By way of memory: g++ 12 (-O2 and above) leaves out the
// conversion to float and back where it handles two numbers at once.
double seen_value(double x, const Rounding& rounding, double origin) {
  const volatile float fed =
      rounding.local_origin ? local_value(x, origin) : fed_value(x, rounding.scale);
  return static_cast<double>(fed);
}

Vec3 seen_point(const Vec3& p, const Rounding& rounding, const Vec3& origin) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) out[k] = seen_value(p[k], rounding, origin[k]);
  return out;
}

}  // namespace

Rounding rounding_of(const Semantics& semantics) {
  return {semantics.scale, semantics.local_origin};
}

RoundedScene::RoundedScene(const JudgedScene& judged, const Rounding& rounding)
    : judged_(judged), rounding_(rounding), truths_(judged.truth.size()) {
  for (std::size_t f = 0; f < judged.scene->frames && representable_; ++f) representable_ = fits(f);
}

Vec3 RoundedScene::origin_of(std::size_t index) const {
  return rounding_.local_origin ? local_origin(judged_.frame(index)) : Vec3::Zero();
}

bool RoundedScene::fits(std::size_t index) const {
  const Vec3 origin = origin_of(index);
  // Asked before any conversion: beyond the range of floats it is not defined.
  const double limit = rounding_.local_origin ? kSingleLimit : std::numeric_limits<float>::max();
  const auto within = [&](const Vec3& p) {
    const Vec3 exact = rounding_.local_origin ? Vec3(p - origin) : Vec3(rounding_.scale * p);
    return exact.cwiseAbs().maxCoeff() <= limit;
  };
  const std::vector<std::vector<Vec3>>& bodies = judged_.positions[index].vertices;
  return std::all_of(bodies.begin(), bodies.end(), [&](const std::vector<Vec3>& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), within);
  });
}

const Frame& RoundedScene::frame(std::size_t index) {
  const Vec3 origin = origin_of(index);
  vertices_ = judged_.positions[index].vertices;
  for (std::vector<Vec3>& body : vertices_)
    for (Vec3& v : body) v = seen_point(v, rounding_, origin);
  frame_ =
      make_frame(index, judged_.scene->time_of(index), judged_.positions[index].nodes, vertices_);
  return frame_;
}

const Truth& RoundedScene::truth(std::size_t index, Oracle& oracle) {
  if (!truths_[index]) {
    WantedTruth wanted = wanted_truth(*judged_.scene);
    wanted.boxes = false;  // boxes are mapped nodes: no detector that is fed vertices has them
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

}  // namespace contactcheck
