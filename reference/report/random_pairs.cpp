#include "reference/report/random_pairs.h"

#include <fmt/format.h>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {

// "12,345,678"
std::string with_commas(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, ",");
  return digits;
}

std::string oracle_text(std::uint64_t wrong) {
  const std::string text =
      fmt::format("oracle against rational arithmetic: {} wrong", with_commas(wrong));
  return wrong == 0 ? text : text + ", AN ERROR OF CONTACTCHECK ITSELF";
}

}  // namespace

std::string pairs_line(const results::Scene& scene) {
  if (!scene.pairs) return "";
  return fmt::format("{} pairs, seed {}, {} touch; {}", with_commas(scene.pairs->count),
                     scene.pairs->seed, with_commas(scene.pairs->touching),
                     oracle_text(scene.pairs->oracle_wrong));
}

std::string pairs_markdown(const results::Scene& scene) {
  if (!scene.pairs) return "";
  std::string rows;
  for (const auto& [kind, tally] : scene.pairs->per_kind) {
    std::optional<double> share;
    if (tally.pairs > 0)
      share = static_cast<double>(tally.touching) / static_cast<double>(tally.pairs);
    rows += table_line(
        {kind, format_count(tally.pairs), format_count(tally.touching), format_number(share)});
  }
  return pairs_line(scene) + ".\n\n" +
         titled_table("Kinds of pairs:",
                      {{"kind", true, ""},
                       {"pairs", false, ""},
                       {"touching", false, ""},
                       {"share", false, ""}},
                      rows);
}

}  // namespace contactcheck
