// Fuzz target: tar archives, packed by gzip or not, out of which a member is read.

#include <filesystem>
#include <string>

#include "core/types/check.h"
#include "reference/mesh/datasets.h"
#include "tests/fuzz/fuzzed_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contactcheck;
  static const test::FuzzedFile file("archive.tar");
  const std::filesystem::path archive = file.write(data, size);
  for (const char* member : {"a", "data/meshes/a.off"}) try {
      mesh::read_tar_member(archive, member);
    } catch (const InputError& refusal) {
      test::require_sentence(refusal.what(), file.folder());
    }
  file.require_alone();
  return 0;
}
