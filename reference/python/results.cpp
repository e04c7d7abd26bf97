#include "reference/results/results.h"

#include "reference/python/judge.h"
#include "reference/report/formats/csv.h"
#include "reference/report/pictures/speed_error_plot.h"
#include "reference/results/results_file.h"

namespace contactcheck::python {

void add_results(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<results::Results>(module, "Results")
      .def(py::init([](const std::string& file) { return results::results_in(file); }), Released())
      .def("csv", &report::csv_report, Released())
      .def(
          "plot",
          [](const results::Results& run) {
            return report::speed_error_picture(results::Index(run));
          },
          Released());
}

}  // namespace contactcheck::python
