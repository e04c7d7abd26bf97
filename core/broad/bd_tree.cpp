#include "core/broad/bd_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

BdTree::BdTree(std::shared_ptr<const BdModel> model, const BdSettings& settings)
    : model_(std::move(model)),
      settings_(settings),
      sphere_frame_(model_->spheres.size(), 0),
      vertex_frame_(model_->shape->mesh.vertices.size(), 0),
      spheres_(sphere_frame_.size()),
      vertices_(vertex_frame_.size()) {}

void BdTree::begin_frame(std::span<const Vec3> nodes) {
  const std::vector<Vec3>& rest = model_->reference.rest();
  CONTACTCHECK_INVARIANT(nodes.size() == rest.size(), "one position per node");
  ++frame_;
  evaluated_spheres_ = mapped_vertices_ = 0;
  nodes_ = nodes;
  largest_ = largest_coordinate(nodes);
  const AffineMap map = model_->reference.fit(settings_.reference, nodes);
  stretch_ = spectral_norm_bound(map.linear);
  const double error =
      16.0 * 0x1p-53 * (model_->reference.largest_value(map) + largest_) + 0x1p-1000;
  residual_norms_.resize(nodes.size());
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const Vec3 residual = nodes[j] - (map.linear * (rest[j] - map.origin) + map.offset);
    residual_norms_[j] = covering_radius(residual.squaredNorm(), 2.0 * error);
  }
}

void BdTree::evaluate(std::uint32_t node) const {
  const BdSphere& rest = model_->spheres[node];
  const std::span<const BdInfluence> influences = model_->influences_of(node);
  Sphere& sphere = spheres_[node];
  sphere.center.setZero();
  for (const BdInfluence& i : influences) sphere.center += i.weight * nodes_[i.node];
  const double errors =
      2.0 * (blend_error_bound(influences.size(), largest_) + mapping_error_bound(largest_));
  sphere.radius = paper_radius(rest, influences, errors);
  // Where the reference map says nearly all there is nothing to gain.
  if (!settings_.paper_bound && sphere.radius > kGoodEnough * stretch_ * rest.rest_radius)
    sphere.radius = std::min({sphere.radius, hull_radius(influences, sphere.center, errors),
                              local_radius(rest, influences, sphere.center, errors)});
  sphere.radius *= settings_.fault_radius;
  sphere_frame_[node] = frame_;
  ++evaluated_spheres_;
}

double BdTree::paper_radius(const BdSphere& sphere, std::span<const BdInfluence> influences,
                            double errors) const {
  double sum = stretch_ * sphere.rest_radius + errors;
  for (const BdInfluence& i : influences) sum += i.spread * residual_norms_[i.node];
  return rounded_up(sum, influences.size());
}

double BdTree::hull_radius(std::span<const BdInfluence> influences, const Vec3& center,
                           double errors) const {
  double largest = 0.0;
  for (const BdInfluence& i : influences)
    largest = std::max(largest, (nodes_[i.node] - center).squaredNorm());
  return covering_radius(largest, errors);
}

double BdTree::local_radius(const BdSphere& sphere, std::span<const BdInfluence> influences,
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

void BdTree::map_vertex(std::uint32_t v) const {
  const Embedding& embedding = model_->shape->embedding;
  vertices_[v] = map_point(corners_of(*model_->shape->lattice, embedding.home_cell[v], nodes_),
                           embedding.local[v]);
  vertex_frame_[v] = frame_;
  ++mapped_vertices_;
}

std::string BdTree::validate() const {
  std::vector<std::vector<std::uint32_t>> slots(tree().nodes.size());
  for (std::size_t n = slots.size(); n-- > 0;) {
    const TriangleTree::Node node = tree().nodes[n];
    for (std::uint32_t i = 0; node.leaf() && i < node.count; ++i)
      slots[n].push_back(node.first + i);
    for (std::uint32_t child = 0; !node.leaf() && child < 2; ++child)
      slots[n].insert(slots[n].end(), slots[node.first + child].begin(),
                      slots[node.first + child].end());
    const Sphere& ball = sphere(static_cast<std::uint32_t>(n));
    for (std::uint32_t slot : slots[n])
      for (std::uint32_t v : tree().corners[slot])
        // stableNorm(): squares of distances must not overflow here.
        if ((vertex(v) - ball.center).stableNorm() > ball.radius)
          return "the sphere of node " + std::to_string(n) + " does not hold vertex " +
                 std::to_string(v);
  }
  return "";
}

}  // namespace contactcheck
