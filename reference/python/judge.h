// The oracle for Python: queries about meshes, without a scene or a detector.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/deform/body.h"
#include "reference/scene/lattice_fit.h"

namespace contactcheck::python {

namespace py = pybind11;

/// A mesh that has been checked, in a lattice or not.
struct Shape {
  std::shared_ptr<const BodyShape> body;
  double smoothing = 0.0;  ///< of the fit
  /// The fit of a lattice, made on first use because it takes longer than the lattice.
  struct Fit {
    std::once_flag made;
    std::optional<scene::LatticeFit> value;
  };
  std::shared_ptr<Fit> fit = std::make_shared<Fit>();
};

/// Adds to the module: Shape, and the functions that judge shapes at rest.
void add_judge(py::module_& module);
/// Adds the class Detector.
void add_detector(py::module_& module);
/// Adds the class Results: a results file, checked, as a table and a picture.
void add_results(py::module_& module);

}  // namespace contactcheck::python
