// What a run leaves in its folder.
#pragma once

#include <set>
#include <string>

#include "reference/report/html.h"

namespace contactcheck::test {

/// And `further` names, "plots" among them where a detector errs or is timed; report.html only
/// where this build can make it.
inline std::set<std::string> run_files(std::set<std::string> further = {}) {
  std::set<std::string> names = {"cases",      "contacts",  "recordings",
                                 "report.csv", "report.md", "results.json"};
  if (report::has_html_report()) names.insert("report.html");
  names.merge(further);
  return names;
}

}  // namespace contactcheck::test
