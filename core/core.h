// Everything of core that an installed program may use: detectors, the bodies and frames that they
// are given, recordings and simulations. Other headers of core are not installed.
#pragma once

#include "core/deform/body.h"
#include "core/deform/lattice.h"
#include "core/deform/mapping.h"
#include "core/deform/recording.h"
#include "core/detect/detector.h"
#include "core/detect/option_info.h"
#include "core/detect/registry.h"
#include "core/dynamics/simulation.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/check.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
