#include "reference/scene/lattice_fit.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/types/check.h"

namespace contactcheck::scene {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using Entries = std::vector<Eigen::Triplet<double>>;

// The weight of |X - X0|^2 in the smoothing. It keeps the mean of X - X0, which L does not see.
constexpr double kAnchor = 0.01;

Rows rows_of(std::span<const Vec3> points) {
  Rows out(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return out;
}

// Trilinear, as map_point blends.
Sparse weights_of(const BodyShape& shape) {
  const Lattice& lattice = *shape.lattice;
  const Embedding& embedding = shape.embedding;
  Entries entries;
  for (std::size_t v = 0; v < embedding.local.size(); ++v)
    for (int c = 0; c < 8; ++c) {
      double weight = 1.0;
      for (int k = 0; k < 3; ++k) {
        const double w = embedding.local[v][k];
        weight *= (c >> k & 1) != 0 ? w : 1.0 - w;
      }
      if (weight != 0.0)
        entries.emplace_back(v, lattice.cell_nodes[embedding.home_cell[v]][c], weight);
    }
  Sparse out(static_cast<Eigen::Index>(embedding.local.size()),
             static_cast<Eigen::Index>(lattice.nodes.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// L^T L + kAnchor I
Sparse smoother_of(const Lattice& lattice) {
  const auto nodes = static_cast<Eigen::Index>(lattice.nodes.size());
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;  // of kept cells, each once
  for (const CornerIds& ids : lattice.cell_nodes)
    for (int c = 0; c < 8; ++c)
      for (int k = 0; k < 3; ++k)
        if ((c >> k & 1) == 0) edges.emplace(ids[c], ids[c | 1 << k]);
  Entries entries;
  for (Eigen::Index n = 0; n < nodes; ++n) entries.emplace_back(n, n, kAnchor);
  for (const auto& [a, b] : edges) {
    entries.emplace_back(a, a, 1.0);
    entries.emplace_back(b, b, 1.0);
    entries.emplace_back(a, b, -1.0);
    entries.emplace_back(b, a, -1.0);
  }
  Sparse out(nodes, nodes);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// The rest nodes in the rigid pose that brings the rest vertices nearest to the frame's. Flat and
// straight meshes have a proper rotation too.
Rows posed(const Rows& nodes, const Rows& rest, const Rows& frame) {
  const Eigen::RowVector3d from = rest.colwise().mean(), to = frame.colwise().mean();
  const Eigen::Matrix3d covariance = (rest.rowwise() - from).transpose() * (frame.rowwise() - to);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0.0) {
    const Eigen::Vector3d signs(1.0, 1.0, -1.0);
    turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }
  return ((nodes.rowwise() - from) * turn).rowwise() + to;
}

}  // namespace

struct LatticeFit::Impl {
  const BodyShape& shape;
  Sparse weights;
  Rows rest_vertices, rest_nodes;
  Eigen::SimplicialLDLT<Sparse> solver;
};

LatticeFit::LatticeFit(const BodyShape& shape, double smoothing)
    : impl_(new Impl{shape,
                     weights_of(shape),
                     rows_of(shape.mesh.vertices),
                     rows_of(shape.lattice->rest_nodes()),
                     {}}) {
  CONTACTCHECK_INVARIANT(smoothing > 0.0, "without smoothing nothing holds nodes without vertices");
  const Sparse normal = Sparse(impl_->weights.transpose()) * impl_->weights;
  const double mean = normal.diagonal().mean();
  impl_->solver.compute(normal + smoothing * mean * smoother_of(*shape.lattice));
  CONTACTCHECK_INVARIANT(impl_->solver.info() == Eigen::Success,
                         "the anchor makes the normal equations positive definite");
}

LatticeFit::~LatticeFit() = default;

std::vector<Vec3> LatticeFit::fitted(std::span<const Vec3> vertices, FitError& error) const {
  CONTACTCHECK_INVARIANT(vertices.size() == impl_->shape.mesh.vertices.size(),
                         "one position per vertex");
  const Rows frame = rows_of(vertices);
  Rows rows = posed(impl_->rest_nodes, impl_->rest_vertices, frame);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const Rows off = impl_->weights.transpose() * (frame - impl_->weights * rows);
    rows += Rows(impl_->solver.solve(off));
  }
  if (!rows.allFinite()) throw InputError("overflows");
  std::vector<Vec3> nodes;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) nodes.emplace_back(rows.row(i).transpose());

  std::vector<Vec3> mapped(vertices.size());
  map_body(impl_->shape, nodes, mapped);
  double largest = 0.0, sum = 0.0;
  for (std::size_t v = 0; v < mapped.size(); ++v)
    largest = std::max(largest, (mapped[v] - vertices[v]).stableNorm());
  if (!std::isfinite(largest)) throw InputError("overflows");
  // Relative to the largest, so that tiny distances do not underflow.
  for (std::size_t v = 0; v < mapped.size() && largest > 0.0; ++v)
    sum += ((mapped[v] - vertices[v]) / largest).squaredNorm();
  error.max.push_back(largest);
  error.rms.push_back(largest * std::sqrt(sum / static_cast<double>(mapped.size())));
  return nodes;
}

}  // namespace contactcheck::scene
