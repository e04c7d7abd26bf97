// Fuzz target: tar archives, packed by gzip or not, out of which a member is read.

#include <filesystem>
#include <string>

#include "core/types/check.h"
#include "reference/mesh/datasets.h"
#include "tests/fuzz/fuzzed_file.h"

CONTACTCHECK_FUZZ_TARGET(archive) {
  using namespace contactcheck;
  static const test::FuzzedFile file("archive.tar");
  for (const char* member : {"a", "data/meshes/a.off"})
    test::try_file(file, data, size, [&](const std::filesystem::path& archive) {
      mesh::read_tar_member(archive, member);
    });
  return 0;
}
