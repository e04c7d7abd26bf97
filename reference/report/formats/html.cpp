#include "reference/report/formats/html.h"

#include <zlib.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/report/formats/page_data.h"
#include "reference/report/formats/web/report_template.h"

namespace contactcheck::report {
namespace {

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_DEFAULT_COMPRESSION);
  if (result != Z_OK) throw InputError("the HTML report is too large for the memory.");
  out.resize(size);
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
  }
  return out;
}

// Without a character that means something to HTML.
std::string packed(std::string_view bytes) { return bytes.empty() ? "" : base64(deflated(bytes)); }

void fill_in(std::string& page, std::string_view placeholder, const std::string& text) {
  const std::size_t at = page.find(placeholder);
  CONTACTCHECK_INVARIANT(at != std::string::npos, "the page has its placeholders");
  page.replace(at, placeholder.size(), text);
}

}  // namespace

bool has_html_report() { return !kReportTemplate.empty(); }

std::string html_page(const std::string& data, std::string_view view) {
  std::string page(kReportTemplate);
  fill_in(page, "@page@", packed(data));
  fill_in(page, "@view@", packed(view));
  return page;
}

std::string html_report(const results::Results& results, const std::optional<PaperPart>& paper,
                        std::string_view view) {
  return html_page(page_data(results, paper).dump(), view);
}

}  // namespace contactcheck::report
