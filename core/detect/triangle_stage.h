// The element stage of the `+tri` variants: the triangles of candidate cells, exactly.
#pragma once

#include <span>
#include <vector>

#include "core/detect/ffd_model.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"

namespace contactcheck {

class TriangleStage {
 public:
  void begin_frame(const std::vector<FfdModel>& models, const Frame& frame);

  /// Appends every intersecting pair of triangles of each candidate pair of cells; a pair that
  /// stands in several cells may be appended several times.
  void run(const std::vector<FfdModel>& models, const std::vector<ElementPair>& candidates,
           bool first_only, std::vector<ElementPair>& out);

 private:
  // Boxes of a cell's triangles, made when a candidate first names the cell.
  struct CellBoxes {
    Aabb whole;
    std::vector<Aabb> triangles;
    bool known = false;
  };
  const CellBoxes& boxes(const std::vector<FfdModel>& models, std::uint32_t body,
                         std::uint32_t cell);
  void collect(const std::vector<FfdModel>& models, std::uint32_t body, std::uint32_t cell,
               const Aabb& region, std::vector<std::uint32_t>& out);
  bool test_pair(const std::vector<FfdModel>& models, const ElementPair& cells, bool first_only,
                 std::vector<ElementPair>& out);

  std::vector<std::span<const Vec3>> vertices_;
  std::vector<std::vector<CellBoxes>> boxes_;
  std::vector<std::uint32_t> near_a_, near_b_;  // row positions within the cells
};

}  // namespace contactcheck
