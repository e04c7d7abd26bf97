#include "reference/report/random_pairs.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

// "12,345,678"
std::string with_commas(const Json& value) {
  std::string digits = std::to_string(whole_number(value));
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, ",");
  return digits;
}

std::string oracle_text(const Json& rational) {
  const Json& wrong = rational.at("oracle_wrong");
  const std::string text =
      fmt::format("oracle against rational arithmetic: {} wrong", with_commas(wrong));
  return whole_number(wrong) == 0 ? text : text + ", AN ERROR OF CONTACTCHECK ITSELF";
}

}  // namespace

std::string pairs_line(const Json& scene) {
  if (!scene.contains("pairs")) return "";
  const Json& pairs = scene.at("pairs");
  return fmt::format("{} pairs, seed {}, {} touch; {}", with_commas(pairs.at("count")),
                     whole_number(pairs.at("seed")), with_commas(pairs.at("touching")),
                     oracle_text(pairs.at("rational")));
}

std::string pairs_markdown(const Json& scene) {
  if (!scene.contains("pairs")) return "";
  std::string rows;
  for (const auto& [kind, tally] : scene.at("pairs").at("per_kind").items()) {
    const double pairs = tally.at("pairs").get<double>();
    const Json share = pairs > 0.0 ? Json(tally.at("touching").get<double>() / pairs) : Json();
    rows += table_line({kind, format_count(tally.at("pairs")), format_count(tally.at("touching")),
                        format_number(share)});
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
