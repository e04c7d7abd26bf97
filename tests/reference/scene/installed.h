// Whether the Debian packages with meshes are here: tests of what needs them are skipped elsewhere.
#pragma once

#include "reference/mesh/datasets.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

inline bool data_installed() {
  return sentence_of([] {
           mesh::find_package_file(mesh::data_roots(), "",
                                   "usr/share/doc/libcgal-demo/data.tar.gz");
           mesh::find_package_file(mesh::data_roots(), "",
                                   "usr/share/doc/povray/examples/advanced/teapot/teapot.inc");
         })
      .empty();
}

}  // namespace contactcheck::test
