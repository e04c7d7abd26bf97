#include "core/broad/bd_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/broad/sphere.h"
#include "core/deform/mapping.h"
#include "core/types/check.h"
#include "core/types/count.h"

namespace contactcheck {
namespace {

// Weights of centres are multiples of this: sums of them are exact.
constexpr double kWeightUnit = 0x1p-50;
// Errors of a spread: 6 * 2^-53 of a vertex weight, 2^-53 of the difference of two weights and
// 2^-53 of this sum. Together 8 * 2^-53.
constexpr double kSpreadError = 0x1p-50;
// Steps towards the smallest ball that holds a sphere's vertices at rest.
constexpr int kCenterSteps = 16;

struct SlotRange {
  std::uint32_t begin = 0, end = 0;
};

// Slots under every node of the tree; those of siblings are neighbours.
std::vector<SlotRange> slot_ranges(const TriangleTree& tree) {
  std::vector<SlotRange> ranges(tree.nodes.size());
  for (std::size_t n = ranges.size(); n-- > 0;) {
    const TriangleTree::Node node = tree.nodes[n];
    if (node.leaf()) {
      ranges[n] = {node.first, node.first + node.count};
      continue;
    }
    const SlotRange left = ranges[node.first], right = ranges[node.first + 1];
    CONTACTCHECK_INVARIANT(left.end == right.begin, "a node's slots stand side by side");
    ranges[n] = {left.begin, right.end};
  }
  return ranges;
}

class Builder {
 public:
  Builder(const BodyShape& shape, BdModel& model)
      : shape_(shape),
        lattice_(*shape.lattice),
        model_(model),
        rest_(shape.mesh.vertices.size()),
        seen_(rest_.size(), 0),
        center_weight_(lattice_.nodes.size(), 0.0),
        spread_(lattice_.nodes.size(), 0.0),
        touches_(lattice_.nodes.size(), 0),
        in_support_(lattice_.nodes.size(), 0) {
    map_vertices(lattice_, shape.embedding, model.reference.rest(), rest_);
    for (const Vec3& r : model.reference.rest())
      largest_ = std::max(largest_, r.cwiseAbs().maxCoeff());
  }

  void build() {
    for (const SlotRange& slots : slot_ranges(model_.tree)) add_sphere(slots);
  }

 private:
  const CornerIds& corners(std::uint32_t vertex) const {
    return lattice_.cell_nodes[shape_.embedding.home_cell[vertex]];
  }

  void add_sphere(const SlotRange& slots) {
    collect_vertices(slots);
    collect_support();
    find_center();
    BdSphere sphere;
    in_32_bits<RefusedInput>(model_.influences.size() + support_.size(),
                             "lattice nodes of all spheres of the BD-tree together");
    sphere.first = static_cast<std::uint32_t>(model_.influences.size());
    sphere.count = static_cast<std::uint32_t>(support_.size());
    find_spreads();
    for (std::uint32_t j : support_)
      model_.influences.push_back({j, center_weight_[j], spread_[j] + kSpreadError});
    measure_at_rest(sphere);
    model_.spheres.push_back(sphere);
  }

  void collect_vertices(const SlotRange& slots) {
    ++stamp_;
    vertices_.clear();
    for (std::uint32_t slot = slots.begin; slot < slots.end; ++slot)
      for (std::uint32_t v : model_.tree.corners[slot])
        if (seen_[v] != stamp_) {
          seen_[v] = stamp_;
          vertices_.push_back(v);
        }
  }

  void collect_support() {
    support_.clear();
    for (std::uint32_t v : vertices_)
      for (std::uint32_t j : corners(v))
        if (!in_support_[j]) {
          in_support_[j] = 1;
          support_.push_back(j);
        }
    std::sort(support_.begin(), support_.end());
    for (std::uint32_t j : support_) {
      in_support_[j] = 0;
      center_weight_[j] = spread_[j] = 0.0;
    }
  }

  // Badoiu and Clarkson, Smaller Core-Sets for Balls, SODA 2003: step i moves by 1 / (i + 1)
  // towards the farthest vertex, after which all steps so far have the same share. Any centre is
  // sound. One that is a mean of vertices has weights that are means of theirs.
  void find_center() {
    Vec3 center = rest_[vertices_.front()];
    chosen_.assign(1, vertices_.front());
    for (int i = 1; i <= kCenterSteps; ++i) {
      chosen_.push_back(farthest_from(center));
      center += (rest_[chosen_.back()] - center) / (i + 1.0);
    }
    for (std::uint32_t v : chosen_) {
      const std::array<double, 8> weights = corner_weights(shape_.embedding.local[v]);
      for (int c = 0; c < 8; ++c)
        center_weight_[corners(v)[c]] += weights[c] / static_cast<double>(chosen_.size());
    }
    round_weights();
  }

  std::uint32_t farthest_from(const Vec3& center) const {
    std::uint32_t farthest = vertices_.front();
    double largest = 0.0;
    for (std::uint32_t v : vertices_) {
      const double squared = (rest_[v] - center).squaredNorm();
      if (squared <= largest) continue;
      largest = squared;
      farthest = v;
    }
    return farthest;
  }

  void round_weights() {
    double rest = 1.0;
    std::uint32_t heaviest = support_.front();
    for (std::uint32_t j : support_) {
      double& weight = center_weight_[j];
      weight = std::floor(weight / kWeightUnit) * kWeightUnit;
      rest -= weight;
      if (weight > center_weight_[heaviest]) heaviest = j;
    }
    center_weight_[heaviest] += rest;
  }

  void find_spreads() {
    for (std::uint32_t j : support_) touches_[j] = 0;
    for (std::uint32_t v : vertices_) {
      const std::array<double, 8> weights = corner_weights(shape_.embedding.local[v]);
      for (int c = 0; c < 8; ++c) {
        const std::uint32_t j = corners(v)[c];
        spread_[j] = std::max(spread_[j], std::abs(weights[c] - center_weight_[j]));
        ++touches_[j];
      }
    }
    // A node has weight 0 for the vertices that it does not touch.
    for (std::uint32_t j : support_)
      if (touches_[j] < vertices_.size()) spread_[j] = std::max(spread_[j], center_weight_[j]);
  }

  void measure_at_rest(BdSphere& sphere) const {
    for (std::uint32_t j : support_)
      sphere.rest_center += center_weight_[j] * model_.reference.rest()[j];
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (std::uint32_t j : support_) {
      const Vec3 arm = model_.reference.rest()[j] - sphere.rest_center;
      moment += arm * arm.transpose();
    }
    sphere.inverse_moment = moment.inverse();
    double largest = 0.0;
    for (std::uint32_t v : vertices_)
      largest = std::max(largest, (rest_[v] - sphere.rest_center).squaredNorm());
    const double error =
        mapping_error_bound(largest_) + blend_error_bound(support_.size(), largest_);
    sphere.rest_radius = covering_radius(largest, 2.0 * error);
  }

  const BodyShape& shape_;
  const Lattice& lattice_;
  BdModel& model_;
  std::vector<Vec3> rest_;  // vertices as mapped by the nodes at rest
  double largest_ = 0.0;    // |coordinate| of the nodes at rest
  std::vector<std::uint32_t> seen_;
  std::uint32_t stamp_ = 0;
  // Scratch of the current sphere:
  std::vector<std::uint32_t> vertices_, support_, chosen_;
  // Per lattice node, valid for those in support_:
  std::vector<double> center_weight_, spread_;
  std::vector<std::uint32_t> touches_;  // number of the sphere's vertices that the node moves
  std::vector<char> in_support_;
};

}  // namespace

std::array<double, 8> corner_weights(const Vec3& local) {
  std::array<double, 8> weights;
  for (int c = 0; c < 8; ++c) {
    const double s = c & 1 ? local.x() : 1.0 - local.x();
    const double t = c & 2 ? local.y() : 1.0 - local.y();
    const double u = c & 4 ? local.z() : 1.0 - local.z();
    weights[c] = s * t * u;
  }
  return weights;
}

std::shared_ptr<const BdModel> make_bd_model(const BodyShape& shape, std::uint32_t leaf_size) {
  if (!shape.lattice) throw RefusedInput("the BD-tree needs a lattice for every body");
  auto model = std::make_shared<BdModel>();
  model->shape = &shape;
  model->tree = make_triangle_tree(shape.mesh, leaf_size);
  model->reference = ReferenceFit(shape.lattice->rest_nodes());
  Builder(shape, *model).build();
  return model;
}

std::vector<std::shared_ptr<const BdModel>> make_bd_models(const std::vector<Body>& bodies,
                                                           std::uint32_t leaf_size) {
  std::map<const BodyShape*, std::shared_ptr<const BdModel>> made;
  std::vector<std::shared_ptr<const BdModel>> models;
  for (const Body& body : bodies) {
    std::shared_ptr<const BdModel>& model = made[body.shape.get()];
    try {
      if (!model) model = make_bd_model(*body.shape, leaf_size);
    } catch (const RefusedInput& e) {
      throw RefusedInput("body \"" + body.name + "\": " + e.what());
    }
    models.push_back(model);
  }
  return models;
}

}  // namespace contactcheck
