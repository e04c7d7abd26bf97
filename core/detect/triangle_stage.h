// The element stage of the `+tri` variants: the triangles of candidate cells, exactly (in single
// precision those of floats).
#pragma once

#include <span>
#include <vector>

#include "core/detect/ffd_state.h"
#include "core/types/contact_set.h"

namespace contactcheck {

template <typename T>
class TriangleStageOf {
 public:
  /// `vertices`: per body; they must live until the next frame begins.
  void begin_frame(const FfdModels<T>& models,
                   const std::vector<std::span<const Vec3Of<T>>>& vertices);

  /// Appends every intersecting pair of triangles of each candidate pair of cells; a pair that
  /// stands in several cells may be appended several times.
  void run(const FfdModels<T>& models, const std::vector<ElementPair>& candidates, bool first_only,
           std::vector<ElementPair>& out);

 private:
  // Boxes of a cell's triangles, made when a candidate first names the cell.
  struct CellBoxes {
    AabbOf<T> whole;
    std::vector<AabbOf<T>> triangles;
    bool known = false;
  };
  const CellBoxes& boxes(const FfdModels<T>& models, std::uint32_t body, std::uint32_t cell);
  void collect(const FfdModels<T>& models, std::uint32_t body, std::uint32_t cell,
               const AabbOf<T>& region, std::vector<std::uint32_t>& out);
  bool test_pair(const FfdModels<T>& models, const ElementPair& cells, bool first_only,
                 std::vector<ElementPair>& out);

  std::vector<std::span<const Vec3Of<T>>> vertices_;
  std::vector<std::vector<CellBoxes>> boxes_;
  std::vector<std::uint32_t> near_a_, near_b_;  // row positions within the cells
};

}  // namespace contactcheck
