#include "reference/report/web/report_template.h"

namespace contactcheck {

const std::string_view kReportTemplate;

}  // namespace contactcheck
