// What the results say about FCL's test of two triangles.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck {

/// Markdown: the scenes where FCL takes pairs for contacts that only less than rounding parts, and
/// why; nothing where no detector of FCL does. Families of hard cases have a table of their own.
std::string fcl_findings(const results::Results& results);

}  // namespace contactcheck
