#include "reference/report/pictures/svg.h"

#include <fmt/format.h>

namespace contactcheck::report {
namespace {

const char* anchor_name(Svg::Anchor anchor) {
  switch (anchor) {
    case Svg::Anchor::kStart:
      return "start";
    case Svg::Anchor::kMiddle:
      return "middle";
    case Svg::Anchor::kEnd:
      return "end";
  }
  return "";
}

std::string paper_css() {
  return "text{font:12px system-ui,sans-serif}.title{font-weight:600}\n" +
         themed_css({{"ink", "fill", "ink", "#1f2328", "#e6edf3"},
                     {"title", "fill", "ink", "#1f2328", "#e6edf3"},
                     {"paper", "fill", "surface", "#fff", "#0d1117"}});
}

// Twice: viewers that know no custom properties leave the second out.
std::string rule_of(const ThemedColour& c, const char* colour) {
  return fmt::format(".{0}{{{1}:{3};{1}:var(--{2},{3})}}", c.css_class, c.property, c.name, colour);
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& css_class,
                    double opacity) {
  const std::string faint = opacity < 1.0 ? fmt::format(" fill-opacity=\"{:.2f}\"", opacity) : "";
  body_ += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"{}\"{}/>\n", x, y,
      width, height, css_class, faint);
}

void Svg::text(double x, double y, const std::string& words, Anchor anchor,
               const std::string& css_class, double turned) {
  const std::string turn =
      turned != 0.0 ? fmt::format(" transform=\"rotate({:.0f} {:.1f} {:.1f})\"", turned, x, y) : "";
  body_ +=
      fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\"{}>{}</text>\n",
                  x, y, anchor_name(anchor), css_class, turn, xml_text(words));
}

void Svg::line(double x1, double y1, double x2, double y2, const std::string& css_class) {
  body_ +=
      fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n",
                  x1, y1, x2, y2, css_class);
}

void Svg::path(double x, double y, const std::string& outline, const std::string& css_class) {
  body_ += fmt::format("<path transform=\"translate({:.1f} {:.1f})\" d=\"{}\" class=\"{}\"/>\n", x,
                       y, outline, css_class);
}

void Svg::begin_group(const std::string& words,
                      const std::vector<std::pair<const char*, std::string>>& data) {
  body_ += "<g";
  for (const auto& [name, value] : data)
    body_ += fmt::format(" data-{}=\"{}\"", name, xml_text(value));
  body_ += "><title>" + xml_text(words) + "</title>\n";
}

void Svg::end_group() { body_ += "</g>\n"; }

std::string Svg::document(const std::string& title, const std::string& css) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\">\n<title>{2}</title>\n<style>\n{3}{4}</style>\n"
      "<rect width=\"100%\" height=\"100%\" class=\"paper\"/>\n{5}</svg>\n",
      width_, height_, xml_text(title), paper_css(), css, body_);
}

std::string series_css(const std::string& property) {
  struct Colour {
    const char* light;
    const char* dark;
  };
  constexpr Colour kColours[kSeriesColours] = {{"#0b62c4", "#58a6ff"}, {"#d9730d", "#f0a050"},
                                               {"#00695c", "#2fb39f"}, {"#b0568c", "#e39bc6"},
                                               {"#6e4a00", "#a88a3c"}, {"#5ab4d6", "#9fdcf2"},
                                               {"#a12622", "#e5716d"}, {"#7a828a", "#aab2ba"}};
  std::string light = ".grid{stroke:#d1d9e0}.faint{fill:#59636e}\n";
  std::string dark = ".grid{stroke:#3a424c}.faint{fill:#9aa5b1}\n";
  for (std::size_t s = 0; s < kSeriesColours; ++s) {
    light += fmt::format(".s{}{{{}:{}}}", s, property, kColours[s].light);
    dark += fmt::format(".s{}{{{}:{}}}", s, property, kColours[s].dark);
  }
  return light + "\n@media(prefers-color-scheme:dark){" + dark + "}\n";
}

std::string themed_css(const std::vector<ThemedColour>& colours) {
  std::string light, dark;
  for (const ThemedColour& colour : colours) {
    light += rule_of(colour, colour.light) + "\n";
    dark += "\n" + rule_of(colour, colour.dark);
  }
  return light + "@media(prefers-color-scheme:dark){" + dark + "}\n";
}

}  // namespace contactcheck::report
