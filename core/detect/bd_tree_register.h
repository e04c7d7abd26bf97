#pragma once

#include "core/detect/registry.h"

namespace contactcheck {

/// Adds bd-tree.
void register_bd_tree(DetectorCatalog& catalog);

}  // namespace contactcheck
