// Everything of core that an installed program may use: detectors, their input bodies and frames,
// recordings and simulations. Of core's headers only these, and those they include, are installed.
#pragma once

#include "core/deform/body.h"
#include "core/deform/lattice.h"
#include "core/deform/mapping.h"
#include "core/deform/recording.h"
#include "core/detect/detector.h"
#include "core/detect/impact_detector.h"
#include "core/detect/option_info.h"
#include "core/detect/registry.h"
#include "core/dynamics/simulation.h"
#include "core/narrow/impact.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/check.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
