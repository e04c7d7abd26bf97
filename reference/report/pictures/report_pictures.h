// All pictures of the report.
#pragma once

#include <map>
#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// SVG text by file, as the Picture blocks of sections name them; of results that have nothing for
/// a picture it is left out.
std::map<std::string, std::string> report_pictures(const results::Index& index);

}  // namespace contactcheck::report
