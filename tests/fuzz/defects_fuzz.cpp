// Fuzz target: lists of known defects. Whatever is accepted is the same once it is written and read
// again.

#include <filesystem>
#include <string>

#include "core/types/check.h"
#include "reference/results/known_defects.h"
#include "reference/text/file_text.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

constexpr const char* kName = "known-defects.json";

std::string written(const results::KnownDefects& known, const std::filesystem::path& folder) {
  results::write_known_defects(folder, known);
  return text::read_file_bytes(folder / kName, "written defects");
}

void check_round_trip(const results::KnownDefects& known) {
  static const Scratch scratch;
  const std::string once = written(known, scratch.folder());
  require(once == written(results::read_known_defects(scratch.folder()), scratch.folder()),
          "defects that are written and read are the same");
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(defects) {
  using namespace contactcheck;
  static const test::FuzzedFile file(test::kName);
  results::KnownDefects known;
  try {
    file.write(data, size);
    known = results::read_known_defects(file.folder());
  } catch (const InputError& refusal) {
    test::require_sentence(refusal.what(), file.folder());
    file.require_alone();
    return 0;
  }
  file.require_alone();
  test::check_round_trip(known);
  return 0;
}
