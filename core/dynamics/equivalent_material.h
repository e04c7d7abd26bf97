// Converts a material to another deformation model, as far as that model can express it.
//
// The body stores the same energy under small uniform strains: summed over an orthonormal basis of
// strains, which is the trace of the stiffness and the same for all axes. It is taken from the
// models themselves in the body's own lattice, whose outer springs belong to fewer cells.
//
// Poisson's ratio: springs between all nodes of a cell, averaged over directions, have that of
// every solid of central forces, 1/4 (Cauchy); shape matching draws every node by itself, without
// regard to its other coordinates: 0. Damping in proportion to stiffness is damping / stiffness of
// a spring, and 2 tau of what is damped critically at the frequency 1 / tau, as shape matching is
// with the relaxation time tau; it has no other.
#pragma once

#include "core/deform/body.h"
#include "core/dynamics/material.h"

namespace contactcheck {

/// Mass, restitution and friction stay. What the other model does not have (a spring's Poisson's
/// ratio, shape matching's damping) is lost; its region is 1. The same model: the same material.
/// @pre the shape has a lattice, and the material is valid for its own model
Material equivalent_material(const Material& material, DeformableModel model,
                             const BodyShape& shape);

}  // namespace contactcheck
