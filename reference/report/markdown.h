#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// The Markdown report: where and how it was measured, what it says about the claims, one section
/// per scene (bodies, result table, losses per stage, disagreements), and how to read the columns.
std::string markdown_report(const results::Results& results);

}  // namespace contactcheck::report
