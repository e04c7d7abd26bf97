#pragma once

#include <cstdint>

namespace contactcheck {

/// The volume that stands for the surface in a cell.
enum class CellVolume {
  kLatticeCell,  ///< the cell itself (ffd-grid)
  kFfdAabb       ///< the box round the surface inside it (ffd-aabb and all spheres)
};

enum class ElementTest { kNodePlane, kTriangle };

/// Two readings of bounds that the paper leaves open. kPaper: as it is written; kSafe: bounds
/// contain what they bound.
enum class BoundsReading { kPaper, kSafe };

/// One member of the FFD-AABB family.
struct FfdConfig {
  CellVolume volume = CellVolume::kFfdAabb;
  int sphere_levels = 0;  ///< 0: none, 1: one sphere per body, 2: the paper's proposal, ...
  int spheres = 16;       ///< parts into which a sphere is split at the next level
  /// Factor on every radius. Below 1 the safe reading's spheres may not contain their triangles, so
  /// that contacts may be missed; above 1 they only let more through.
  double sphere_radius = 1.0;
  ElementTest element = ElementTest::kNodePlane;
  BoundsReading bounds = BoundsReading::kPaper;
  double hash_cell = 1.0;        ///< hash grid cell / mean edge of the boxes at rest
  std::uint32_t table_size = 0;  ///< buckets; 0: from the number of entries
};

}  // namespace contactcheck
