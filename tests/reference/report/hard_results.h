// Results of a run with families of hard cases, made by hand (hard.json).
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace contactcheck::test {

/// Families "one" and "two" at the values 0, 1e-9 and 1e-3: "exact" is right, "skin" is wrong here
/// and there, "crash" fails in the last case of one and refuses two.
nlohmann::ordered_json hard_results();

}  // namespace contactcheck::test
