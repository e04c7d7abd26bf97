#include "reference/scene/sweep_spec.h"

namespace contactcheck {
namespace {

// Of the size: deeper, a body may have gone through the other one.
constexpr NumberRange kSeparation = {-0.5, false, 10.0, false};
constexpr std::size_t kMostOrientations = 10'000, kLargestSeed = 1'000'000'000;
constexpr std::size_t kMostFrames = 100'000;

}  // namespace

SweepSpec parse_sweep(const JsonField& field) {
  field.only_keys({"separations", "orientations", "seed"});
  SweepSpec spec;
  for (const JsonField& item : field.at("separations").items(1)) {
    const double separation = item.number(kSeparation);
    if (!spec.separations.empty() && !(separation > spec.separations.back()))
      item.refuse("above " + shown(spec.separations.back()) + ", the one before");
    spec.separations.push_back(separation);
  }
  if (field.has("orientations"))
    spec.orientations = field.at("orientations").whole(1, kMostOrientations);
  if (field.has("seed")) spec.seed = field.at("seed").whole(0, kLargestSeed);
  if (spec.separations.size() * spec.orientations > kMostFrames)
    field.fail("asks for more than " + std::to_string(kMostFrames) + " poses");
  return spec;
}

}  // namespace contactcheck
