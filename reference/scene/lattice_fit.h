// A lattice fitted to recorded vertices: the nodes whose canonical mapping comes nearest to them.
//
// Per frame, with W the trilinear weights of the vertices (rows) at the nodes (columns) and P the
// recorded vertices, this minimises |W X - P|^2 over the nodes X. Many nodes have few or no
// vertices nearby and should follow their neighbours. So with Y the rest nodes in the rigid pose
// nearest to the frame (Kabsch 1976) and L the differences between nodes that share an edge of a
// kept cell, it minimises
//
//     |W X - P|^2 + s m |L (X - X0)|^2 + s m |X - X0|^2 / 100,    m the mean of diag(W^T W),
//
// first with X0 = Y, then kSweeps - 1 times with the last solution as X0 (iterated Tikhonov). What
// the vertices determine converges to the least squares; the rest stays near the pose. s is the
// smoothing, which does not depend on the scale.
//
// Sources: Kabsch, A solution for the best rotation to relate two sets of vectors, Acta Cryst. A32,
// 1976; Hanke & Groetsch, Nonstationary iterated Tikhonov regularization, JOTA 98, 1998.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "reference/scene/scene.h"

namespace contactcheck::scene {

class LatticeFit {
 public:
  static constexpr int kSweeps = 16;

  /// Factors the normal equations, once for all frames. `shape` must outlive it.
  /// @pre the shape has a lattice; smoothing above 0
  LatticeFit(const BodyShape& shape, double smoothing);
  ~LatticeFit();
  LatticeFit(const LatticeFit&) = delete;
  LatticeFit& operator=(const LatticeFit&) = delete;

  /// The nodes for these vertices; appends the distances of their canonical mapping to `error`.
  /// @pre one finite position per vertex. @throws InputError "overflows" (for coordinates above
  /// about 1e150, whose products are not finite)
  std::vector<Vec3> fitted(std::span<const Vec3> vertices, FitError& error) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactcheck::scene
