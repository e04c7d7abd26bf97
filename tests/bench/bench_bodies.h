// The bodies that the benchmarks share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck::bench {

struct BenchBody {
  std::string name;  ///< says which mesh it really is
  std::shared_ptr<const BodyShape> shape;
};

/// The bunny with about 3,000 vertices in a 6^3 lattice (a sphere where libcgal-demo is missing).
const BenchBody& small_body();
/// The bunny with all its 37,706 vertices in a 6^3 lattice (a sphere where it is missing).
const BenchBody& large_body();

/// Rest nodes, every coordinate moved by up to `amount` times the body's largest side. Seeded: the
/// same nodes for the same call.
std::vector<Vec3> shaken_nodes(const BodyShape& shape, double amount, const Vec3& offset);

}  // namespace contactcheck::bench
