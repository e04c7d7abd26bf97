// Fuzz target: bytes as a PC2 and as an MDD point cache. Whatever is accepted has the counts that
// its bytes ask for and finite positions alone, and every sample can be read.

#include <string>

#include "core/types/check.h"
#include "reference/scene/point_cache.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

void check_promises(const scene::PointCache& cache, std::size_t bytes) {
  require(cache.points() > 0 && cache.samples() > 0, "a cache has points and samples");
  require(cache.points() * cache.samples() <= bytes / 12, "no count is beyond the bytes");
  for (std::size_t s = 0; s < cache.samples(); ++s) {
    const auto sample = cache.sample(s);
    require(sample.size() == cache.points(), "a sample has all points");
    for (const Vec3& p : sample) require(p.allFinite(), "all positions are finite");
  }
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(cache) {
  using namespace contactcheck;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const scene::CacheFormat format : {scene::CacheFormat::kPc2, scene::CacheFormat::kMdd}) try {
      test::check_promises(scene::PointCache(format, bytes, "point cache"), size);
    } catch (const InputError& refusal) {
      test::require_sentence(refusal.what());
    }
  return 0;
}
