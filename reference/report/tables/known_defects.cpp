#include "reference/report/tables/known_defects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reference/report/tables/format.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {

using Groups = std::vector<results::Sightings>;

std::size_t cases_in(const Groups& groups) {
  std::size_t out = 0;
  for (const results::Sightings& group : groups) out += group.values.size();
  return out;
}

std::string shown_text(const results::DefectCount& d) {
  if (d.other_version) return "other version";
  return fmt::format("{} of {}", d.shown, d.listed) +
         (d.changed > 0 ? fmt::format(", {} with another count", d.changed) : "");
}

// Readings are of no library, version or issue.
TitledTable defects_table(const std::string& text, const std::vector<results::DefectCount>& defects,
                          bool readings) {
  TitledTable out{"",
                  text,
                  {{"described in", true, ""},
                   {"seen as", true, ""},
                   {"why", true, ""},
                   {"detectors", true, ""},
                   {"families", false, ""},
                   {"cases that show it", false, ""}},
                  {}};
  if (!readings) {
    out.columns.insert(out.columns.begin(), {"library", true, ""});
    out.columns.insert(out.columns.begin() + 2, {"upstream issue", true, ""});
  }
  for (const results::DefectCount& d : defects) {
    std::vector<std::string>& row = out.rows.emplace_back();
    if (readings) {
      row = {d.where};
    } else {
      row = {d.library + " " + d.version, d.where, d.upstream.empty() ? "-" : d.upstream};
    }
    for (const std::string& cell :
         {std::string(d.kind), d.sentence, fmt::format("{}", fmt::join(d.detectors, ", ")),
          format_count(d.scenes.size()), shown_text(d)})
      row.push_back(cell);
  }
  return out;
}

// "0: 3 -> 4" of a count that changed, "0: 3" of one that is listed or shown alone. The schema does
// not say how long the lists are. A refusal and an error have nothing to count.
std::string case_text(const results::Sightings& g, std::size_t i) {
  if (g.kind == "error" || g.kind == "refused") return g.values[i];
  std::string out = g.values[i];
  const bool was = i < g.was.size(), is = i < g.is.size();
  if (was || is) out += ": ";
  if (was) out += grouped_digits(g.was[i]);
  if (was && is) out += " -> ";
  if (is) out += grouped_digits(g.is[i]);
  return out;
}

std::string cases_text(const results::Sightings& g) {
  std::vector<std::string> cases;
  for (std::size_t i = 0; i < g.values.size(); ++i) cases.push_back(case_text(g, i));
  return fmt::format("{}", fmt::join(cases, "; "));
}

TitledTable groups_table(const std::string& text, const Groups& groups) {
  TitledTable out{
      "",
      text,
      {{"detector", true, ""}, {"family", true, ""}, {"kind", true, ""}, {"at: pairs", true, ""}},
      {}};
  for (const results::Sightings& g : groups)
    out.rows.push_back({g.detector, g.scene, g.kind, cases_text(g)});
  return out;
}

std::string group_lines(const char* title, const Groups& groups) {
  std::string out;
  for (const results::Sightings& g : groups)
    out += fmt::format("  {}  {}  {}  {}\n", g.detector, g.scene, g.kind, cases_text(g));
  return out.empty() ? "" : std::string(title) + "\n" + out;
}

std::string list_sentence(const char* what, const std::vector<results::DefectCount>& defects) {
  std::size_t listed = 0, shown = 0, changed = 0;
  for (const results::DefectCount& d : defects) {
    listed += d.listed;
    shown += d.shown;
    changed += d.changed;
  }
  if (listed == 0) return fmt::format("No {} are of these detectors and families. ", what);
  return fmt::format(
      "Of {} {} that this run could show, {} show as listed, {} with another count and {} do not. ",
      grouped_digits(listed), what, grouped_digits(shown - std::min(shown, changed)),
      grouped_digits(changed), grouped_digits(listed - std::min(listed, shown)));
}

}  // namespace

std::string known_defects_sentence(const results::DefectCounts& known) {
  std::string out = list_sentence("listed wrong answers of libraries", known.defects);
  if (!known.readings.empty())
    out += list_sentence("wrong answers expected of our readings of the paper", known.readings);
  return out + grouped_digits(cases_in(known.unlisted)) + " show that are not listed.";
}

std::string defects_text(const results::DefectCounts& known) {
  std::string out;
  for (const auto* list : {&known.defects, &known.readings})
    for (const results::DefectCount& d : *list)
      out += fmt::format("{} {}  {}  {}  {}: {}\n", d.library, d.version,
                         fmt::join(d.detectors, ", "), d.kind, shown_text(d), d.sentence);
  return out + defects_summary(known);
}

std::string defects_summary(const results::DefectCounts& known) {
  return group_lines("count changed (listed -> shown):", known.changed) +
         group_lines("listed, not shown:", known.not_shown) +
         group_lines("shown, not listed:", known.unlisted) + "  " + known_defects_sentence(known) +
         "\n";
}

namespace {

Blocks known_defects_blocks(const results::Index& index) {
  const std::optional<results::DefectCounts>& known = index.results().known_defects;
  if (!known) return {};
  return {Paragraph{known_defects_sentence(*known)},
          defects_table("", known->defects, false),
          defects_table("Expected of our readings of the paper, which are as it is written.",
                        known->readings, true),
          groups_table("Shown with another count than the listed one.", known->changed),
          groups_table("Listed, and not shown: mended in this build of the library, or the case "
                       "has changed.",
                       known->not_shown),
          groups_table("Shown, and not listed.", known->unlisted)};
}

std::vector<TerminalPart> known_defects_in_terminal(const results::Index& index) {
  if (!index.results().known_defects) return {};
  return {{"known defects", "", defects_summary(*index.results().known_defects)}};
}

}  // namespace

/// Known wrong answers of libraries, compared with those that a run shows: what is listed of
/// libraries and of readings of the paper; what shows with another count, what is listed and does
/// not show, what shows and is not listed.
extern const Section kKnownDefects = {"defects", "Known wrong answers", "Known defects",
                                      known_defects_blocks, known_defects_in_terminal};

}  // namespace contactcheck::report
