// A picture as text: Scalable Vector Graphics, without a browser or a library.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace contactcheck::report {

/// Coordinates in pixels, y downwards. Colours come from classes, so that one picture reads well on
/// a light page and on a dark one: it lies on paper of its own, which is dark where the reader
/// wants that, whatever page is around it, and follows the page that it is part of, if any. The
/// classes `ink` (words), `title` and `paper` are there.
class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  /// `opacity` in [0, 1].
  void rectangle(double x, double y, double width, double height, const std::string& css_class,
                 double opacity = 1.0);
  enum class Anchor { kStart, kMiddle, kEnd };
  /// Letters stand on y. `turned`: degrees clockwise about (x, y).
  void text(double x, double y, const std::string& words, Anchor anchor = Anchor::kStart,
            const std::string& css_class = "ink", double turned = 0.0);
  void line(double x1, double y1, double x2, double y2, const std::string& css_class);
  /// `outline`: commands of SVG's attribute d, about (x, y).
  void path(double x, double y, const std::string& outline, const std::string& css_class);
  /// What is drawn between these two is one thing with words of its own, which a browser shows
  /// under the pointer and reads aloud. `data`: names without "data-" and values, for scripts.
  void begin_group(const std::string& words,
                   const std::vector<std::pair<const char*, std::string>>& data = {});
  void end_group();

  /// The whole document. `css`: rules for the further classes used. `title`: what the picture
  /// shows.
  std::string document(const std::string& title, const std::string& css) const;

 private:
  double width_, height_;
  std::string body_;
};

/// The colour that a class gives to `property` on light and on dark paper. `name`: the custom
/// property of the HTML report (style/colours.css) that goes before them where a picture is drawn
/// inside the page, whose reader may have chosen light or dark against the system.
struct ThemedColour {
  const char *css_class, *property, *name, *light, *dark;
};
std::string themed_css(const std::vector<ThemedColour>& colours);

/// Rules for the classes s0, s1, ... of series, which give their colours to `property`, and for
/// `grid` and `faint`. Neighbours in the order differ in lightness too, for eyes that tell no
/// colours apart.
inline constexpr std::size_t kSeriesColours = 8;
std::string series_css(const std::string& property);

/// With &, <, >, " and control characters made harmless.
std::string xml_text(const std::string& text);

}  // namespace contactcheck::report
