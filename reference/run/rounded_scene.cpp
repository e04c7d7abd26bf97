#include "reference/run/rounded_scene.h"

#include <algorithm>
#include <cmath>

namespace contactcheck {
namespace {

// What a detector in single precision sees. By way of memory: g++ 12 (-O2 and above) leaves out the
// conversion to float and back where it handles two numbers at once.
double seen_value(double x, double scale) {
  const volatile float fed = fed_value(x, scale);
  return static_cast<double>(fed);
}

bool fits(const std::vector<std::vector<Vec3>>& bodies, double scale) {
  return std::all_of(bodies.begin(), bodies.end(), [&](const std::vector<Vec3>& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), [&](const Vec3& v) {
      return std::isfinite(fed_value(v.x(), scale)) && std::isfinite(fed_value(v.y(), scale)) &&
             std::isfinite(fed_value(v.z(), scale));
    });
  });
}

}  // namespace

RoundedScene::RoundedScene(const JudgedScene& judged, double scale)
    : judged_(judged), scale_(scale), truths_(judged.truth.size()) {
  for (std::size_t f = 0; f < judged.scene->frames && representable_; ++f)
    representable_ = fits(judged.positions[f].vertices, scale);
}

const Frame& RoundedScene::frame(std::size_t index) {
  vertices_ = judged_.positions[index].vertices;
  for (std::vector<Vec3>& body : vertices_)
    for (Vec3& v : body)
      for (int k = 0; k < 3; ++k) v[k] = seen_value(v[k], scale_);
  frame_ =
      make_frame(index, judged_.scene->time_of(index), judged_.positions[index].nodes, vertices_);
  return frame_;
}

const Truth& RoundedScene::truth(std::size_t index, Oracle& oracle) {
  if (!truths_[index]) {
    WantedTruth wanted = wanted_truth(*judged_.scene);
    wanted.boxes = false;  // boxes are mapped nodes: no detector in single precision has them
    truths_[index] = oracle.judge(frame(index), wanted);
  }
  return *truths_[index];
}

JudgingTools::JudgingTools(const JudgedScene& scene)
    : judged(scene), oracle(scene.scene->bodies), geometry(scene.scene->bodies) {}

RoundedScene* JudgingTools::rounded(double scale) {
  RoundedScene& scene = rounded_.try_emplace(scale, judged, scale).first->second;
  return scene.representable() ? &scene : nullptr;
}

}  // namespace contactcheck
