// contactcheck._binding: what contactcheck/__init__.py, the module for users, is made of.
#include <pybind11/pybind11.h>

#include "core/types/check.h"
#include "reference/python/judge.h"

PYBIND11_MODULE(_binding, module) {
  namespace py = pybind11;
  // Their order: pybind11 tries the last one first.
  py::register_exception<contactcheck::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<contactcheck::RefusedInput>(module, "RefusedInput", PyExc_ValueError);
  py::register_exception<contactcheck::Unavailable>(module, "Unavailable", PyExc_RuntimeError);
  module.attr("__version__") = CONTACTCHECK_VERSION;
  contactcheck::python::add_judge(module);
  contactcheck::python::add_detector(module);
  contactcheck::python::add_results(module);
}
