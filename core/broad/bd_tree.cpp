#include "core/broad/bd_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/deform/mapping.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// A radius this near to what the reference map alone gives is not worth improving; any value is
// sound.
constexpr double kGoodEnough = 1.05;
// A bound that overflowed.
constexpr double kUnknown = std::numeric_limits<double>::infinity();

double rounded_up(double sum, std::size_t terms) {
  return sum * (1.0 + static_cast<double>(terms + 8) * 0x1p-52);
}

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& p : points)
    for (double x : p) largest = std::max(largest, std::abs(x));
  return largest;
}

// The sphere as it is kept: in floats with the radius rounded up, and the centre as
// coordinate_errors() has it.
template <typename T>
SphereOf<T> kept(const Sphere& sphere) {
  if constexpr (std::is_same_v<T, double>) {
    return sphere;
  } else {
    using Limits = std::numeric_limits<float>;
    // Beyond their range the conversion to floats is not defined.
    const float radius =
        sphere.radius < Limits::max() ? static_cast<float>(sphere.radius) : Limits::infinity();
    return {sphere.center.cast<float>(), std::nextafter(radius, Limits::infinity())};
  }
}

// Squares do not overflow.
template <typename T>
double distance(const Vec3Of<T>& a, const Vec3Of<T>& b) {
  return (a.template cast<double>() - b.template cast<double>()).stableNorm();
}

}  // namespace

template <typename T>
BdTreeOf<T>::BdTreeOf(std::shared_ptr<const BdModel> model, const BdSettings& settings)
    : model_(std::move(model)),
      settings_(settings),
      sphere_frame_(model_->spheres.size(), 0),
      vertex_frame_(model_->shape->mesh.vertices.size(), 0),
      spheres_(sphere_frame_.size()),
      vertices_(vertex_frame_.size()) {}

template <typename T>
void BdTreeOf<T>::begin_frame(std::span<const Vec3> nodes, const Vec3& origin) {
  const std::vector<Vec3>& rest = model_->reference.rest();
  CONTACTCHECK_INVARIANT(nodes.size() == rest.size(), "one position per node");
  ++frame_;
  evaluated_spheres_ = mapped_vertices_ = 0;
  nodes_ = nodes;
  largest_ = largest_coordinate(nodes);
  const AffineMap map = model_->reference.fit(settings_.reference, nodes, origin);
  stretch_ = spectral_norm_bound(map.linear);
  const double error =
      16.0 * 0x1p-53 * (model_->reference.largest_value(map) + largest_) + 0x1p-1000;
  residual_norms_.resize(nodes.size());
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const Vec3 residual = nodes[j] - (map.linear * (rest[j] - map.origin) + map.offset);
    residual_norms_[j] = covering_radius(residual.squaredNorm(), 2.0 * error);
  }
}

template <typename T>
void BdTreeOf<T>::evaluate(std::uint32_t node) const {
  const BdSphere& rest = model_->spheres[node];
  const std::span<const BdInfluence> influences = model_->influences_of(node);
  Sphere sphere;
  for (const BdInfluence& i : influences) sphere.center += i.weight * nodes_[i.node];
  const double errors = 2.0 * coordinate_errors(influences.size());
  sphere.radius = paper_radius(rest, influences, errors);
  // Where the reference map says nearly all there is nothing to gain.
  if (!settings_.paper_bound && sphere.radius > kGoodEnough * stretch_ * rest.rest_radius)
    sphere.radius = std::min({sphere.radius, hull_radius(influences, sphere.center, errors),
                              local_radius(rest, influences, sphere.center, errors)});
  sphere.radius *= settings_.fault_radius;
  spheres_[node] = kept<T>(sphere);
  sphere_frame_[node] = frame_;
  ++evaluated_spheres_;
}

template <typename T>
double BdTreeOf<T>::coordinate_errors(std::size_t influences) const {
  const double of_center = blend_error_bound(influences, largest_);
  if constexpr (std::is_same_v<T, double>) {
    return of_center + mapping_error_bound(largest_);
  } else {
    constexpr double kFloatUnit = 0x1p-24, kSmallest = std::numeric_limits<float>::denorm_min();
    const double of_locals = 3.0 * kFloatUnit * largest_;
    const double of_mapping =
        static_cast<double>(mapping_error_bound(static_cast<float>(largest_)));
    const double of_keeping = kFloatUnit * largest_ + kSmallest;
    return of_center + of_locals + of_mapping + of_keeping;
  }
}

template <typename T>
double BdTreeOf<T>::paper_radius(const BdSphere& sphere, std::span<const BdInfluence> influences,
                                 double errors) const {
  double sum = stretch_ * sphere.rest_radius + errors;
  for (const BdInfluence& i : influences) sum += i.spread * residual_norms_[i.node];
  return rounded_up(sum, influences.size());
}

template <typename T>
double BdTreeOf<T>::hull_radius(std::span<const BdInfluence> influences, const Vec3& center,
                                double errors) const {
  double largest = 0.0;
  for (const BdInfluence& i : influences)
    largest = std::max(largest, (nodes_[i.node] - center).squaredNorm());
  return covering_radius(largest, errors);
}

template <typename T>
double BdTreeOf<T>::local_radius(const BdSphere& sphere, std::span<const BdInfluence> influences,
                                 const Vec3& center, double errors) const {
  const std::vector<Vec3>& rest = model_->reference.rest();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  double off_center = 0.0, off_rest = 0.0;
  for (const BdInfluence& i : influences) {
    const Vec3 arm = nodes_[i.node] - center, rest_arm = rest[i.node] - sphere.rest_center;
    moment += arm * rest_arm.transpose();
    off_center = std::max(off_center, arm.squaredNorm());
    off_rest = std::max(off_rest, rest_arm.squaredNorm());
  }
  const Eigen::Matrix3d linear = moment * sphere.inverse_moment;
  if (!linear.allFinite()) return kUnknown;
  const double stretch = spectral_norm_bound(linear);
  const double largest_value = std::sqrt(off_center) + 2.0 * stretch * std::sqrt(off_rest);
  // With room for sums of such values: none below is infinite.
  if (!std::isfinite(8.0 * largest_value)) return kUnknown;
  const double slack = 2.0 * 16.0 * 0x1p-53 * largest_value + 0x1p-1000;
  double sum = 0.0, largest = 0.0;
  for (const BdInfluence& i : influences) {
    const Vec3 arm = nodes_[i.node] - center, rest_arm = rest[i.node] - sphere.rest_center;
    const double norm = covering_radius((arm - linear * rest_arm).squaredNorm(), slack);
    sum += i.spread * norm;
    largest = std::max(largest, norm);
  }
  const double local = stretch * sphere.rest_radius + std::min(sum, largest) + errors;
  return rounded_up(local, influences.size());
}

template <typename T>
void BdTreeOf<T>::map_vertex(std::uint32_t v) const {
  const Embedding& embedding = model_->shape->embedding;
  const Corners corners = corners_of(*model_->shape->lattice, embedding.home_cell[v], nodes_);
  CornersOf<T> own;
  for (std::size_t c = 0; c < own.size(); ++c) own[c] = corners[c].template cast<T>();
  vertices_[v] = map_point<T>(own, embedding.local[v].template cast<T>());
  vertex_frame_[v] = frame_;
  ++mapped_vertices_;
}

template <typename T>
std::string BdTreeOf<T>::validate() const {
  std::vector<std::vector<std::uint32_t>> slots(tree().nodes.size());
  for (std::size_t n = slots.size(); n-- > 0;) {
    const TriangleTree::Node node = tree().nodes[n];
    for (std::uint32_t i = 0; node.leaf() && i < node.count; ++i)
      slots[n].push_back(node.first + i);
    for (std::uint32_t child = 0; !node.leaf() && child < 2; ++child)
      slots[n].insert(slots[n].end(), slots[node.first + child].begin(),
                      slots[node.first + child].end());
    const SphereOf<T>& ball = sphere(static_cast<std::uint32_t>(n));
    for (std::uint32_t slot : slots[n])
      for (std::uint32_t v : tree().corners[slot])
        if (distance(vertex(v), ball.center) > static_cast<double>(ball.radius))
          return "the sphere of node " + std::to_string(n) + " does not hold vertex " +
                 std::to_string(v);
  }
  return "";
}

template class BdTreeOf<double>;
template class BdTreeOf<float>;

}  // namespace contactcheck
