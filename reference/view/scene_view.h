// One scene in the view: its entry in the header, and its arrays.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/deform/recording.h"

namespace contactcheck {

struct SceneView {
  nlohmann::ordered_json header;  ///< without "base"; see view_bytes.h
  std::string arrays;             ///< its size is a multiple of 4
};

/// `contacts`: of read_contacts(), or null where the results name none.
SceneView scene_view(const Recording& recording, const nlohmann::ordered_json& contacts);

}  // namespace contactcheck
