#include "reference/report/known_defects.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

std::string comma_list(const Json& texts) {
  std::string out;
  for (const Json& text : texts) out += (out.empty() ? "" : ", ") + text.get<std::string>();
  return out;
}

std::string text_of(const Json& object, const char* key) {
  return object.at(key).get<std::string>();
}

struct Sums {
  std::int64_t listed = 0, shown = 0;
};

Sums sums_of(const Json& known) {
  Sums out;
  for (const Json& d : known.at("defects")) {
    out.listed += whole_number(d.at("listed"));
    out.shown += whole_number(d.at("shown"));
  }
  return out;
}

std::int64_t cases_in(const Json& groups) {
  std::int64_t out = 0;
  for (const Json& group : groups) out += static_cast<std::int64_t>(group.at("values").size());
  return out;
}

std::string headline(const Json& known) {
  const Sums sums = sums_of(known);
  return fmt::format(
      "Of {} listed wrong answers that this run could show, {} show and {} do not; {} show that "
      "are not listed.",
      sums.listed, sums.shown, cases_in(known.at("not_shown")), cases_in(known.at("unlisted")));
}

std::string shown_text(const Json& defect) {
  if (defect.at("other_version").get<bool>()) return "other version";
  return fmt::format("{} of {}", whole_number(defect.at("shown")),
                     whole_number(defect.at("listed")));
}

std::string defects_table(const Json& known) {
  std::string rows;
  for (const Json& d : known.at("defects"))
    rows += table_line({text_of(d, "library") + " " + text_of(d, "version"), text_of(d, "issue"),
                        text_of(d, "kind"), text_of(d, "sentence"), comma_list(d.at("detectors")),
                        fmt::format("{}", d.at("scenes").size()), shown_text(d)});
  if (rows.empty()) return "";
  return table_head({{"library", true, ""},
                     {"described in", true, ""},
                     {"seen as", true, ""},
                     {"why", true, ""},
                     {"detectors", true, ""},
                     {"families", false, ""},
                     {"cases that show it", false, ""}}) +
         rows + "\n";
}

std::string groups_table(const std::string& paragraph, const Json& groups) {
  std::string rows;
  for (const Json& g : groups)
    rows += table_line({text_of(g, "detector"), text_of(g, "scene"), text_of(g, "kind"),
                        comma_list(g.at("values"))});
  return titled_table(
      paragraph,
      {{"detector", true, ""}, {"family", true, ""}, {"kind", true, ""}, {"at", true, ""}}, rows);
}

std::string group_lines(const char* title, const Json& groups) {
  std::string out;
  for (const Json& g : groups)
    out += fmt::format("  {}  {}  {}  {}\n", text_of(g, "detector"), text_of(g, "scene"),
                       text_of(g, "kind"), comma_list(g.at("values")));
  return out.empty() ? "" : std::string(title) + "\n" + out;
}

}  // namespace

std::string known_defects_markdown(const Json& results) {
  if (!results.contains("known_defects")) return "";
  const Json& known = results.at("known_defects");
  return "## Known defects of libraries\n\n" + headline(known) + "\n\n" + defects_table(known) +
         groups_table(
             "Listed, and not shown: mended in this build of the library, or the case has "
             "changed.",
             known.at("not_shown")) +
         groups_table("Shown, and not listed.", known.at("unlisted"));
}

std::string defects_text(const Json& known) {
  std::string out;
  for (const Json& d : known.at("defects"))
    out += fmt::format("{} {}  {}  {}  {}: {}\n", text_of(d, "library"), text_of(d, "version"),
                       comma_list(d.at("detectors")), text_of(d, "kind"), shown_text(d),
                       text_of(d, "sentence"));
  return out + defects_summary(known);
}

std::string defects_summary(const Json& known) {
  return group_lines("listed, not shown:", known.at("not_shown")) +
         group_lines("shown, not listed:", known.at("unlisted")) + "  " + headline(known) + "\n";
}

}  // namespace contactcheck
