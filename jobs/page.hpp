#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/workpiece.hpp"
#include "core/path/motion.hpp"
#include "core/tool/tool.hpp"

/// The pages of `--format html`: data for the viewer (viewer/src), in the form that its data.js
/// reads, put into the page that holds the viewer.
namespace ridgeline::jobs {

/// The page with its data. Throws Error{Unsupported} when this program has no viewer.
std::string page(const nlohmann::json& data);

/// Points of a drawing: float32, which is finer than a screen shows.
nlohmann::json page_points(const std::vector<Eigen::Vector3d>& points);
/// Values of a chart: float64, the same numbers as in the result. NaN: a gap.
nlohmann::json page_values(const std::vector<double>& values);

/// A number of a document that the page's table shows.
struct PageRow {
  const char* key;  ///< "report/width": a member of a member
  const char* name;
  const char* unit;
  const char* missing = "not checked";  ///< what null means
};
/// The table's rows of those numbers that the document has; `null` stays null.
nlohmann::json page_rows(const nlohmann::json& document, std::initializer_list<PageRow> rows);

/// A curve of a chart: NaN is a gap.
struct PageSeries {
  const char* name;
  std::vector<double> values;
  enum class Style { Curve, Guide, Dots } style = Style::Curve;  ///< Guide: thin, dashed
};
/// A chart of values as they are in the result; the page shows them times `scale` in `unit`.
struct PageChart {
  const char* title;
  const char* unit;
  std::vector<PageSeries> series;
  double scale = 1;
};
nlohmann::json document_of(const std::vector<PageChart>& charts);
/// The coordinate that charts share. `at`: the length along the motion of the page at each value,
/// or empty; the charts' cursor and the tool are one then.
nlohmann::json page_axis(const char* title, const std::vector<double>& values,
                         const std::vector<double>& at = {});

/// A path as the page draws it: straight pieces, arcs within a tolerance that the screen does not
/// show.
struct PageMotion {
  std::vector<std::string> names;  ///< of the kinds
  std::vector<int> kinds;          ///< of each piece, an index of `names`
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> to;  ///< end of each piece
  std::vector<double> feeds;        ///< [mm/min]; 0: rapid
  std::vector<std::size_t> moves;   ///< which move of the result a piece belongs to
};
PageMotion page_motion(const path::Motion& motion, const Progress& progress = {});
nlohmann::json document_of(const PageMotion& motion);

/// The part as trimmed surfaces.
nlohmann::json page_part(const geometry::Workpiece& workpiece);
/// The tool along `axis` (tip to spindle); its ball's centre is `control_to_centre` above the
/// control point.
nlohmann::json page_tool(const tool::Tool& tool, const Eigen::Vector3d& axis,
                         double control_to_centre);

}  // namespace ridgeline::jobs
