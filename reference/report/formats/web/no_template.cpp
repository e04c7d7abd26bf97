#include "reference/report/formats/web/report_template.h"

namespace contactcheck::report {

const std::string_view kReportTemplate;

}  // namespace contactcheck::report
