// Raw time samples on their way from a worker to its parent.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reference/compare/speedup.h"

namespace contactcheck {

nlohmann::ordered_json samples_to_json(const QuestionSamples& samples);
QuestionSamples samples_from_json(const nlohmann::ordered_json& json);

}  // namespace contactcheck
