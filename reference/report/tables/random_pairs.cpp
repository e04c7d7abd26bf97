#include "reference/report/tables/random_pairs.h"

#include <fmt/format.h>

#include "reference/report/tables/format.h"

namespace contactcheck::report {
namespace {

std::string oracle_text(std::uint64_t wrong) {
  const std::string text =
      fmt::format("oracle against rational arithmetic: {} wrong", grouped_digits(wrong));
  return wrong == 0 ? text : text + ", AN ERROR OF CONTACTCHECK ITSELF";
}

}  // namespace

std::string pairs_line(const results::Scene& scene) {
  if (!scene.pairs) return "";
  return fmt::format("{} pairs, seed {}, {} touch; {}", grouped_digits(scene.pairs->count),
                     scene.pairs->seed, grouped_digits(scene.pairs->touching),
                     oracle_text(scene.pairs->oracle_wrong));
}

TitledTable pairs_table(const results::Scene& scene) {
  TitledTable out{
      "Kinds of pairs",
      "",
      {{"kind", true, ""}, {"pairs", false, ""}, {"touching", false, ""}, {"share", false, ""}},
      {}};
  if (!scene.pairs) return out;
  out.text = pairs_line(scene) + ".";
  for (const auto& [kind, tally] : scene.pairs->per_kind) {
    std::optional<double> share;
    if (tally.pairs > 0)
      share = static_cast<double>(tally.touching) / static_cast<double>(tally.pairs);
    out.rows.push_back(
        {kind, format_count(tally.pairs), format_count(tally.touching), format_number(share)});
  }
  return out;
}

}  // namespace contactcheck::report
