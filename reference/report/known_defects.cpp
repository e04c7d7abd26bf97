#include "reference/report/known_defects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/report/format.h"

namespace contactcheck::report {
namespace {

using Groups = std::vector<results::Sightings>;

std::size_t cases_in(const Groups& groups) {
  std::size_t out = 0;
  for (const results::Sightings& group : groups) out += group.values.size();
  return out;
}

std::string shown_text(const results::DefectCount& d) {
  return d.other_version ? "other version" : fmt::format("{} of {}", d.shown, d.listed);
}

TitledTable defects_table(const results::DefectCounts& known) {
  TitledTable out{"",
                  "",
                  {{"library", true, ""},
                   {"described in", true, ""},
                   {"seen as", true, ""},
                   {"why", true, ""},
                   {"detectors", true, ""},
                   {"families", false, ""},
                   {"cases that show it", false, ""}},
                  {}};
  for (const results::DefectCount& d : known.defects)
    out.rows.push_back({d.library + " " + d.version, d.issue, d.kind, d.sentence,
                        fmt::format("{}", fmt::join(d.detectors, ", ")),
                        format_count(d.scenes.size()), shown_text(d)});
  return out;
}

TitledTable groups_table(const std::string& text, const Groups& groups) {
  TitledTable out{
      "",
      text,
      {{"detector", true, ""}, {"family", true, ""}, {"kind", true, ""}, {"at", true, ""}},
      {}};
  for (const results::Sightings& g : groups)
    out.rows.push_back({g.detector, g.scene, g.kind, fmt::format("{}", fmt::join(g.values, ", "))});
  return out;
}

std::string group_lines(const char* title, const Groups& groups) {
  std::string out;
  for (const results::Sightings& g : groups)
    out +=
        fmt::format("  {}  {}  {}  {}\n", g.detector, g.scene, g.kind, fmt::join(g.values, ", "));
  return out.empty() ? "" : std::string(title) + "\n" + out;
}

}  // namespace

std::string known_defects_sentence(const results::DefectCounts& known) {
  std::size_t listed = 0, shown = 0;
  for (const results::DefectCount& d : known.defects) {
    listed += d.listed;
    shown += d.shown;
  }
  return fmt::format(
      "Of {} listed wrong answers that this run could show, {} show and {} do not; {} show that "
      "are not listed.",
      grouped_digits(listed), grouped_digits(shown), grouped_digits(cases_in(known.not_shown)),
      grouped_digits(cases_in(known.unlisted)));
}

std::vector<TitledTable> known_defects_tables(const results::DefectCounts& known) {
  std::vector<TitledTable> tables = {
      defects_table(known),
      groups_table("Listed, and not shown: mended in this build of the library, or the case has "
                   "changed.",
                   known.not_shown),
      groups_table("Shown, and not listed.", known.unlisted)};
  std::erase_if(tables, [](const TitledTable& table) { return table.rows.empty(); });
  return tables;
}

std::string known_defects_markdown(const results::Results& results) {
  if (!results.known_defects) return "";
  std::string out =
      "## Known defects of libraries\n\n" + known_defects_sentence(*results.known_defects) + "\n\n";
  for (const TitledTable& table : known_defects_tables(*results.known_defects))
    out += markdown_of(table);
  return out;
}

std::string defects_text(const results::DefectCounts& known) {
  std::string out;
  for (const results::DefectCount& d : known.defects)
    out += fmt::format("{} {}  {}  {}  {}: {}\n", d.library, d.version,
                       fmt::join(d.detectors, ", "), d.kind, shown_text(d), d.sentence);
  return out + defects_summary(known);
}

std::string defects_summary(const results::DefectCounts& known) {
  return group_lines("listed, not shown:", known.not_shown) +
         group_lines("shown, not listed:", known.unlisted) + "  " + known_defects_sentence(known) +
         "\n";
}

}  // namespace contactcheck::report
