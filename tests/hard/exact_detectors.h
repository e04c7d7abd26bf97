// The detectors that promise to be exact, with every variant of interest.
#pragma once

#include <string>
#include <vector>

namespace contactcheck::test {

/// Embree finds candidates; the exact test is ours.
inline const std::vector<std::string>& exact_detectors() {
  static const std::vector<std::string> names = {"embree",
                                                 "spatial-hash",
                                                 "spatial-hash:table=1",
                                                 "aabb-tree",
                                                 "sphere-tree",
                                                 "bd-tree",
                                                 "full-refit",
                                                 "ffd-lazy",
                                                 "ffd-lazy:bounds=nodes",
                                                 "ffd-lazy:bounds=nodes,threads=2",
                                                 "ffd-grid+tri",
                                                 "ffd-aabb+tri",
                                                 "ffd-aabb-sphere+tri",
                                                 "ffd-aabb-sphere2+tri",
                                                 "ffd-aabb-sphereN+tri"};
  return names;
}

}  // namespace contactcheck::test
