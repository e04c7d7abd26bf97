// What judging queries found, for a terminal and as JSON.
#pragma once

#include <string>
#include <vector>

#include "reference/queries/query_families.h"
#include "reference/queries/query_judge.h"

namespace contactcheck::queries {

inline constexpr const char* kQueriesSchema = "contactcheck-queries/1";

/// What the file says, its own truth, and a table with a row a detector.
std::string text_of(const FileScore& score);

/// A table with a row a value: what each detector does wrong there. @pre as many scores as values
std::string text_of(const QueryFamily& family, const std::vector<FileScore>& scores);

/// A row a family, with the first of its values at which each detector errs, in the order of the
/// values. @pre `scores` has those of every family, one after the other
std::string summary_of(const std::vector<QueryFamily>& families,
                       const std::vector<FileScore>& scores);

/// The document of queries.json. `cap`: as it was judged.
std::string json_of(const std::vector<FileScore>& scores, const ImpactTolerance& cap = kNoCap);

}  // namespace contactcheck::queries
