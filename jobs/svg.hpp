#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline::jobs {

/// Part of a drawing with its own scale: maps a rectangle of model coordinates (y up) onto a
/// rectangle of the sheet (y down), keeping proportions unless `stretch`.
struct View {
  Eigen::Vector2d model_min, model_max;
  Eigen::Vector2d sheet_min, sheet_max;  ///< [px]
  enum class Scale { Proportional, Stretch } scale = Scale::Proportional;
};

/// Place of a model point on the sheet [px].
Eigen::Vector2d on_sheet(const View& view, const Eigen::Vector2d& model);

/// A small SVG writer. Shapes are styled by CSS classes, so that one sheet reads in light and dark.
class Svg {
public:
  Svg(double width, double height, std::string_view title);

  void polyline(const View& view, const std::vector<Eigen::Vector2d>& points,
                std::string_view style);
  void polygon(const View& view, const std::vector<Eigen::Vector2d>& points,
               std::string_view style);
  /// Closed loops as one area; what an even number of them encloses is a hole.
  void area(const View& view, const std::vector<std::vector<Eigen::Vector2d>>& loops,
            std::string_view style);
  void circle(const View& view, const Eigen::Vector2d& centre, double radius,
              std::string_view style);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::string_view style);
  enum class Anchor { Start, Middle, End };
  void text(const Eigen::Vector2d& at, std::string_view text, std::string_view style = "label",
            Anchor anchor = Anchor::Start);

  /// Rules for classes beside those of every drawing.
  void add_style(std::string_view css);

  /// The whole document; the writer is spent.
  std::string finish() &&;

private:
  void points(const View& view, const std::vector<Eigen::Vector2d>& points);
  std::string out_;
};

/// Axes with round tick values, unit and title, and one curve per series.
struct Series {
  std::string name;
  std::string style;
  std::vector<Eigen::Vector2d> points;
};
struct Chart {
  std::string title, x_title, y_title;
  Eigen::Vector2d sheet_min, sheet_max;
  std::vector<Series> series;
};
void draw(Svg& svg, const Chart& chart);

}  // namespace ridgeline::jobs
