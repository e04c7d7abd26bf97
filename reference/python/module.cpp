// contactcheck._binding: what contactcheck/__init__.py, the module for users, is made of.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/types/check.h"
#include "reference/process/process_tree.h"
#include "reference/python/judge.h"
#include "reference/suite/job.h"

PYBIND11_MODULE(_binding, module) {
  namespace py = pybind11;
  // Their order: pybind11 tries the last one first.
  py::register_exception<contactcheck::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<contactcheck::RefusedInput>(module, "RefusedInput", PyExc_ValueError);
  py::register_exception<contactcheck::Unavailable>(module, "Unavailable", PyExc_RuntimeError);
  module.attr("__version__") = CONTACTCHECK_VERSION;
  module.attr("MEMORY_LIMIT") = contactcheck::suite::RunSettings{}.memory_limit;
  module.def("process_tree", contactcheck::process::process_tree, py::arg("process"));
  contactcheck::python::add_judge(module);
  contactcheck::python::add_detector(module);
  contactcheck::python::add_results(module);
}
