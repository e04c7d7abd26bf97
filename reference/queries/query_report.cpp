#include "reference/queries/query_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/text/counted.h"
#include "reference/text/described_json.h"
#include "reference/text/lists.h"

namespace contactcheck {

constexpr std::array<ImpactKind, 2> values_of(ImpactKind) {
  return {ImpactKind::vertex_triangle, ImpactKind::edge_edge};
}

template <typename Io>
void fields(Io& io, ImpactTolerance& t) {
  CONTACTCHECK_FIELDS(io, t, absolute, of_start);
}

}  // namespace contactcheck

namespace contactcheck::queries {
namespace {

using Row = std::vector<std::string>;

/// A time that is not farther from the true interval is right in the tables of families.
constexpr double kRightTime = 1e-6;

std::string whole(std::uint64_t n) { return std::to_string(n); }

std::string fraction(double t) { return t == 0 ? "0" : fmt::format("{:.1e}", t); }

std::string micros(double us) { return fmt::format("{:.{}f}", us, us < 100 ? 2 : 0); }

/// Columns as wide as their widest cell; the first one to the left, the others to the right.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], row[i].size());
    }
  std::string out;
  for (const Row& row : rows) {
    std::string line = "  ";
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i])
                     : fmt::format("  {:>{}}", row[i], widths[i]);
    while (!line.empty() && line.back() == ' ') line.pop_back();
    out += line + "\n";
  }
  return out;
}

bool has_near(const ImpactScore& score) { return score.near + score.undecided > 0; }

/// "3 (1.2e-06 m)": how many, and the largest of their distances; "+ 1 ?" are undecided.
std::string near_text(const ImpactScore& score) {
  std::string text = whole(score.near);
  if (score.near > 0) text += fmt::format(" ({:.1e} m)", score.near_max);
  if (score.undecided > 0) text += " + " + whole(score.undecided) + " ?";
  return text;
}

Row row_of(const DetectorScore& d, bool near) {
  const bool timed = d.times.timed > 0;
  Row row = {d.detector, whole(d.score.missed), whole(d.score.spurious)};
  if (near) row.push_back(near_text(d.score));
  for (const std::string& cell :
       {timed ? fraction(d.times.early_max) : "-", timed ? fraction(d.times.late_max) : "-",
        micros(d.cost.median), micros(d.cost.mean), micros(d.cost.percentile_99),
        micros(d.cost.worst), whole(d.cost.worst_line)})
    row.push_back(cell);
  if (d.refused == d.queries) {
    row.assign(row.size(), "-");
    row[0] = d.detector + (d.refused > 0 ? " (all refused)" : "");
  } else if (d.refused > 0) {
    row[0] += " (" + whole(d.refused) + " refused)";
  }
  if (d.errors > 0) row[0] += " (" + text::counted(d.errors, "error") + ")";
  if (!d.failure.empty()) row[0] += " (failed after " + whole(d.queries) + ")";
  return row;
}

Row fed_row(const ImpactScore& score, bool near) {
  Row row = {fmt::format("  as given ({})", text::counted(score.truth, "contact")),
             whole(score.missed), whole(score.spurious)};
  if (near) row.push_back(near_text(score));
  return row;
}

/// "12 missed, 3 spurious, early 0.1"; "ok" without errors. Times count from a millionth of the
/// step.
std::string errors_of(const DetectorScore& d) {
  std::vector<std::string> words;
  if (d.score.missed > 0) words.push_back(whole(d.score.missed) + " missed");
  if (d.score.spurious > 0) words.push_back(whole(d.score.spurious) + " spurious");
  if (has_near(d.score)) words.push_back(near_text(d.score) + " near");
  if (d.times.near_at_start > 0)
    words.push_back(whole(d.times.near_at_start) + " near at the start");
  if (d.times.early_max > kRightTime) words.push_back("early " + fraction(d.times.early_max));
  if (d.times.late_max > kRightTime) words.push_back("late " + fraction(d.times.late_max));
  if (d.errors > 0) words.push_back(text::counted(d.errors, "error"));
  if (d.refused > 0) words.push_back(whole(d.refused) + " refused");
  if (!d.failure.empty()) words.push_back("failed");
  return words.empty() ? "ok" : text::joined(words);
}

/// It is wrong, whatever it tolerates; what it refuses it does not answer.
bool errs(const DetectorScore& d) {
  return d.score.missed + d.score.spurious + d.errors > 0 || !d.failure.empty() ||
         std::max(d.times.early_max, d.times.late_max) > kRightTime;
}

/// A line for each detector whose answers were errors, or that failed: where it first did, and why.
std::string failures_of(const QueryFamily& family, const std::vector<FileScore>& scores) {
  std::string out;
  std::vector<std::string> told;
  for (std::size_t i = 0; i < scores.size(); ++i)
    for (const DetectorScore& d : scores[i].detectors) {
      if ((d.failure.empty() && d.errors == 0) || std::ranges::count(told, d.detector) > 0)
        continue;
      told.push_back(d.detector);
      const std::size_t query =
          d.failure.empty() ? d.first_error.value_or(0) : d.failed_at.value_or(0);
      out += fmt::format("  {} at {:g}, query {}: {}\n", d.detector, family.values[i], query,
                         d.failure.empty() ? d.first_error_is : d.failure);
    }
  return out;
}

std::string decade_text(const std::optional<int>& decade) {
  return decade ? fmt::format("1e{} to 1e{}", *decade, *decade + 1) : "0 (points)";
}

/// Missed and spurious by edge length, of detectors that have any; empty when none has.
std::string by_length(const FileScore& file) {
  std::vector<const DetectorScore*> wrong;
  for (const DetectorScore& d : file.detectors)
    if (d.score.missed + d.score.spurious > 0) wrong.push_back(&d);
  if (wrong.empty()) return "";
  std::vector<Row> rows = {{"missed / spurious by longest edge, m", "contacts"}};
  for (const DetectorScore* d : wrong) rows[0].push_back(d->detector);
  for (const DecadeTruth& decade : file.decades) {
    Row row = {decade_text(decade.decade), whole(decade.contacts)};
    for (const DetectorScore* d : wrong) {
      const auto same = std::find_if(d->decades.begin(), d->decades.end(), [&](const auto& other) {
        return other.decade == decade.decade;
      });
      row.push_back(same == d->decades.end()
                        ? "-"
                        : fmt::format("{} / {}", same->score.missed, same->score.spurious));
    }
    rows.push_back(std::move(row));
  }
  return table(rows);
}

/// A line for each detector that errs: where it does first.
std::string first_wrong(const FileScore& file) {
  std::string out;
  for (const DetectorScore& d : file.detectors) {
    std::vector<std::string> words;
    if (d.score.first_missed) words.push_back("missed at line " + whole(*d.score.first_missed));
    if (d.score.first_spurious)
      words.push_back("spurious at line " + whole(*d.score.first_spurious));
    if (d.first_error)
      words.push_back(fmt::format("error at line {} ({})", *d.first_error, d.first_error_is));
    if (!words.empty()) out += "  first of " + d.detector + ": " + text::joined(words) + '\n';
    if (!d.failure.empty())
      out += fmt::format("  {} failed at line {} and was asked no more: {}\n", d.detector,
                         d.failed_at.value_or(0), d.failure);
    if (d.times.near_at_start > 0)
      out +=
          fmt::format("  {}: {} reported at t = 0, where the elements are within its tolerance\n",
                      d.detector, text::counted(d.times.near_at_start, "contact"));
  }
  return out;
}

}  // namespace

std::string text_of(const FileScore& score) {
  std::string out = fmt::format("{}: {}, {}, {}", score.name, name_of(score.kind),
                                text::counted(score.queries, "query", "queries"),
                                text::counted(score.contacts, "contact"));
  if (score.starts_in_contact > 0)
    out += fmt::format(" ({} at the start)", score.starts_in_contact);
  out += "\n";
  if (score.file_truths > 0) {
    out += score.file_wrong == 0
               ? fmt::format("  the file's own truth: all {} right\n", score.file_truths)
               : fmt::format(
                     "  the file's own truth: {} of {} wrong, at lines {}{}\n", score.file_wrong,
                     score.file_truths,
                     text::joined(score.wrong_lines, [](std::size_t line) { return whole(line); }),
                     score.wrong_lines.size() < score.file_wrong ? " ..." : "");
  }
  if (score.not_doubles > 0)
    out += fmt::format("  {} with coordinates that are no doubles: judged, and no detector asked\n",
                       text::counted(score.not_doubles, "query", "queries"));
  const bool near = std::ranges::any_of(score.detectors, [](const DetectorScore& d) {
    return has_near(d.score) || (d.score_fed && has_near(*d.score_fed));
  });
  std::vector<Row> rows = {{"detector", "missed", "spurious"}};
  if (near) rows[0].push_back("near");
  for (const char* title :
       {"early", "late", "median us", "mean us", "99 % us", "worst us", "at line"})
    rows[0].push_back(title);
  for (const DetectorScore& d : score.detectors) {
    rows.push_back(row_of(d, near));
    if (d.score_fed) rows.push_back(fed_row(*d.score_fed, near));
  }
  const QueryCost& oracle = score.oracle;
  Row last(rows[0].size() - 5);
  last[0] = "(oracle)";
  for (const std::string& cell :
       {micros(oracle.median), micros(oracle.mean), micros(oracle.percentile_99),
        micros(oracle.worst), whole(oracle.worst_line)})
    last.push_back(cell);
  rows.push_back(std::move(last));
  out += table(rows) + first_wrong(score);
  if (!score.of_another_kind.empty())
    out += fmt::format("  not asked, since they do not answer {}: {}\n", name_of(score.kind),
                       text::joined(score.of_another_kind));
  const std::string lengths = by_length(score);
  if (!lengths.empty()) out += '\n' + lengths;
  return out;
}

std::string text_of(const QueryFamily& family, const std::vector<FileScore>& scores) {
  std::vector<Row> rows = {{family.parameter, "queries", "contacts"}};
  for (const DetectorScore& d : scores.front().detectors) rows[0].push_back(d.detector);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const FileScore& score = scores[i];
    Row row = {fmt::format("{:g}", family.values[i]), whole(score.queries), whole(score.contacts)};
    for (const DetectorScore& d : score.detectors) row.push_back(errors_of(d));
    rows.push_back(std::move(row));
  }
  return fmt::format("{}: {}\n", family.id, family.title) + table(rows) +
         failures_of(family, scores);
}

std::string summary_of(const std::vector<QueryFamily>& families,
                       const std::vector<FileScore>& scores) {
  std::vector<std::string> names;
  for (const FileScore& score : scores)
    for (const DetectorScore& d : score.detectors)
      if (std::ranges::find(names, d.detector) == names.end()) names.push_back(d.detector);
  std::vector<Row> rows = {{"family", "parameter"}};
  rows[0].insert(rows[0].end(), names.begin(), names.end());
  std::size_t at = 0;
  for (const QueryFamily& family : families) {
    Row row = {family.id, family.parameter};
    for (const std::string& name : names) {
      std::string cell = "-";  // it does not answer this kind
      for (std::size_t i = 0; i < family.values.size(); ++i)
        for (const DetectorScore& d : scores.at(at + i).detectors) {
          if (d.detector != name || (cell != "-" && cell != "ok")) continue;
          cell = errs(d) ? fmt::format("{:g}", family.values[i]) : "ok";
        }
      row.push_back(cell);
    }
    at += family.values.size();
    rows.push_back(std::move(row));
  }
  return "First value of each family at which a detector errs (ok: at none; near is no error)\n" +
         table(rows);
}

template <typename Io>
void fields(Io& io, ImpactScore& s) {
  CONTACTCHECK_FIELDS(io, s, truth, reported, hit, missed, spurious, near, undecided, near_max);
  CONTACTCHECK_FIELDS(io.unless_empty, s, first_missed, first_spurious);
}
template <typename Io>
void fields(Io& io, TimeErrors& t) {
  CONTACTCHECK_FIELDS(io, t, timed, near_at_start, before, after, early_median, early_99, early_max,
                      late_median, late_99, late_max);
}
template <typename Io>
void fields(Io& io, QueryCost& c) {
  CONTACTCHECK_FIELDS(io, c, median, mean, percentile_99, worst, worst_line);
}
template <typename Io>
void fields(Io& io, DecadeTruth& d) {
  CONTACTCHECK_FIELDS(io, d, decade, queries, contacts);
}
template <typename Io>
void fields(Io& io, DecadeScore& d) {
  CONTACTCHECK_FIELDS(io, d, decade, score, timed, early_max, late_max, answered, micros);
}
template <typename Io>
void fields(Io& io, DetectorScore& d) {
  CONTACTCHECK_FIELDS(io, d, detector, precision, queries, refused, score);
  CONTACTCHECK_FIELDS(io.unless_empty, d, score_fed);
  io("time_of_contact", d.times);
  io("microseconds", d.cost);
  CONTACTCHECK_FIELDS(io, d, errors);
  CONTACTCHECK_FIELDS(io, d, tolerance);
  CONTACTCHECK_FIELDS(io.unless_empty, d, first_error, first_error_is, failure, failed_at, decades);
}
template <typename Io>
void fields(Io& io, FileScore& f) {
  CONTACTCHECK_FIELDS(io, f, name, kind, queries, contacts, starts_in_contact, not_doubles,
                      file_truths, file_wrong);
  CONTACTCHECK_FIELDS(io.unless_empty, f, wrong_lines, of_another_kind);
  CONTACTCHECK_FIELDS(io, f, decades);
  io("oracle_microseconds", f.oracle);
  CONTACTCHECK_FIELDS(io, f, detectors);
}

std::string json_of(const std::vector<FileScore>& scores, const ImpactTolerance& cap) {
  text::Json json = {{"schema", kQueriesSchema}, {"version", CONTACTCHECK_VERSION}};
  if (std::isfinite(cap.absolute)) json["cap"] = cap.absolute;
  if (std::isfinite(cap.of_start)) json["cap_of_start"] = cap.of_start;
  json["files"] = text::described(scores);
  return json.dump(1) + "\n";
}

}  // namespace contactcheck::queries
