#include <algorithm>
#include <cstdio>

#include "core/types/check.h"
#include "reference/cli/commands.h"
#include "reference/scene/catalogue.h"
#include "reference/suite/family_truth.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::vector<std::string>& families, const fs::path& fixtures) {
  std::vector<fs::path> files;
  for (const std::string& id : families) files.push_back(scene::find_scene(id, fixtures));
  if (families.empty())
    for (const scene::CatalogueEntry& entry : scene::list_families(fixtures))
      files.push_back(entry.file);
  return files;
}

// The first pairs by name; all of them would drown the table.
template <typename Pair>
std::string pairs_text(const std::vector<Pair>& pairs) {
  constexpr std::size_t kMost = 3;
  std::string out;
  for (std::size_t i = 0; i < pairs.size() && i < kMost; ++i)
    out += "  " + std::to_string(pairs[i].a) + "-" + std::to_string(pairs[i].b);
  return pairs.size() > kMost ? out + "  ..." : out;
}

void print_self_family(const scene::Scene& scene, const std::vector<suite::CaseTruth>& cases) {
  std::string levels;
  for (const Level level : kLevels)
    if (scene.judges(level)) levels += std::string(levels.empty() ? "" : ", ") + name_of(level);
  std::printf("  %-24s %9s  pairs of triangles of one body (%s)\n",
              scene.family()->parameter.c_str(), "pairs", levels.c_str());
  for (const suite::CaseTruth& c : cases)
    std::printf("  %-24s %9zu%s\n", c.value.c_str(), c.self.size(), pairs_text(c.self).c_str());
  std::printf("\n");
}

void print_family(const scene::Scene& scene, const std::vector<suite::CaseTruth>& cases) {
  std::printf("%s  %s\n", scene.id.c_str(), scene.title.c_str());
  if (std::all_of(scene.levels.begin(), scene.levels.end(), is_self))
    return print_self_family(scene, cases);
  std::printf("  %-24s %9s %11s %9s  pairs of triangles\n", scene.family()->parameter.c_str(),
              "bodies", "containment", "triangles");
  for (const suite::CaseTruth& c : cases)
    std::printf("  %-24s %9zu %11zu %9zu%s\n", c.value.c_str(), c.bodies, c.containment,
                c.triangles.size(), pairs_text(c.triangles).c_str());
  std::printf("\n");
}

}  // namespace

int truth_command(const std::vector<std::string>& families, bool write) {
  const fs::path fixtures = scene::fixtures_directory(), file = fixtures / "hard" / "expected.json";
  suite::ExpectedFamilies expected;
  if (write && !families.empty() && fs::exists(file)) expected = suite::read_expected(file);
  for (const fs::path& family : files_of(families, fixtures)) {
    const scene::Scene scene = scene::load_scene(family);
    if (!scene.family()) throw InputError("\"" + scene.id + "\" is no family of hard cases");
    const std::vector<suite::CaseTruth> cases = suite::family_truth(scene);
    print_family(scene, cases);
    expected[scene.id].clear();
    for (const suite::CaseTruth& c : cases) expected[scene.id].push_back(suite::summary_of(c));
  }
  if (!write) return 0;
  suite::write_expected(file, expected);
  std::printf("%s\n", file.c_str());
  return 0;
}

}  // namespace contactcheck::cli
