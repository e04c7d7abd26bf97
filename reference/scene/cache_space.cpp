#include "reference/scene/cache_space.h"

#include <algorithm>
#include <cmath>

#include "reference/text/json_value.h"

namespace contactcheck::scene {
namespace {

constexpr double kTolerance = 1e-6;  // of the mesh's largest side

// All 48, identity first, turns before reflections.
std::vector<SpaceChange> changes_of_axes() {
  std::vector<SpaceChange> turns, reflections;
  std::array<int, 3> axis = {0, 1, 2};
  do {
    // A permutation is even where it is cyclic.
    const bool even = (axis[1] - axis[0] + 3) % 3 == 1;
    for (int signs = 0; signs < 8; ++signs) {
      SpaceChange change{axis, {}, Vec3::Zero()};
      double determinant = even ? 1.0 : -1.0;
      for (std::size_t i = 0; i < 3; ++i) {
        change.sign[i] = (signs >> i & 1) != 0 ? -1.0 : 1.0;
        determinant *= change.sign[i];
      }
      (determinant > 0.0 ? turns : reflections).push_back(change);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  turns.insert(turns.end(), reflections.begin(), reflections.end());
  return turns;
}

Vec3 changed(const SpaceChange& change, const Vec3& p) {
  Vec3 out;
  for (std::size_t i = 0; i < 3; ++i)
    out[static_cast<Eigen::Index>(i)] = change.sign[i] * p[change.axis[i]];
  return out;
}

bool leads_to(const SpaceChange& change, const std::vector<Vec3>& points,
              const std::vector<Vec3>& mesh, double tolerance) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!((changed(change, points[i]) + change.offset - mesh[i]).cwiseAbs().maxCoeff() <=
          tolerance))
      return false;
  return true;
}

}  // namespace

void SpaceChange::apply(std::vector<Vec3>& points) const {
  if (is_identity()) return;
  for (Vec3& p : points) {
    p = changed(*this, p);
    if (moves()) p += offset;
  }
}

std::string SpaceChange::described() const {
  std::string out;
  if (turns()) {
    out = "axes";
    for (std::size_t i = 0; i < 3; ++i)
      out += std::string(" ") + (sign[i] < 0.0 ? "-" : "") + "xyz"[axis[i]];
  }
  if (moves())
    out += (out.empty() ? "an offset of (" : " and an offset of (") + text::shown(offset.x()) +
           ", " + text::shown(offset.y()) + ", " + text::shown(offset.z()) + ")";
  return out;
}

std::optional<SpaceChange> space_change(const std::vector<Vec3>& points,
                                        const std::vector<Vec3>& mesh) {
  Vec3 low = mesh[0], high = mesh[0];
  for (const Vec3& v : mesh) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double tolerance = kTolerance * (high - low).maxCoeff();
  for (const bool with_offset : {false, true}) {
    std::optional<SpaceChange> found;
    for (SpaceChange change : changes_of_axes()) {
      if (with_offset) change.offset = mesh[0] - changed(change, points[0]);
      if (!leads_to(change, points, mesh, tolerance)) continue;
      if (change.turns() == false) return change;
      const bool reflects = changed(change, Vec3::UnitX())
                                .cross(changed(change, Vec3::UnitY()))
                                .dot(changed(change, Vec3::UnitZ())) < 0.0;
      if (found && !reflects) return std::nullopt;  // points on a line: any of several turns
      if (!found) found = change;
    }
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace contactcheck::scene
