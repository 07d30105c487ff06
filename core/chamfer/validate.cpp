#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/text.hpp"
#include "core/chamfer/job.hpp"

namespace ridgeline::chamfer {
namespace {

constexpr double least_length = 1e-4;      ///< [mm]; widths and radii below are a wrong unit
constexpr double largest_length = 1e5;     ///< [mm]
constexpr double largest_tolerance = 10;   ///< [mm]
constexpr double largest_feed = 1e6 / 60;  ///< [mm/s]
constexpr double full_turn = 2 * std::numbers::pi;
constexpr std::size_t most_passes = 100;

[[noreturn]] void refuse(const std::string& field, const std::string& value,
                         const std::string& limit) {
  throw Error(ErrorCode::BadInput, field.substr(1) + " is " + value + "; it must be " + limit,
              {.field = field, .value = value, .limit = limit});
}

/// From low to high; written so that NaN fails.
void require(const std::string& field, double value, double low, double high,
             const std::string& unit) {
  if (value >= low && value <= high) return;
  refuse(field, text(value, unit), text(low, unit) + " to " + text(high, unit));
}

void require_above(const std::string& field, double value, double low, double high,
                   const std::string& unit) {
  if (value > low && value <= high) return;
  refuse(field, text(value, unit),
         "greater than " + text(low, unit) + ", at most " + text(high, unit));
}

void require_point(const std::string& field, const Eigen::Vector3d& point) {
  for (const double coordinate : point) {
    require(field, coordinate, -largest_length, largest_length, "mm");
  }
}

void require_tool(const tool::Tool& tool) {
  require("/tool/radius", tool.radius, least_length, largest_length, "mm");
  require("/tool/wear", tool.wear, -tool.radius, tool.radius, "mm");
  require("/tool/radius", tool::cutting_radius(tool), least_length, largest_length, "mm");
  const auto part = [](const char* field, const std::optional<double>& value) {
    if (value) require_above(field, *value, 0, largest_length, "mm");
  };
  part("/tool/neck_radius", tool.neck_radius);
  part("/tool/neck_length", tool.neck_length);
  part("/tool/shank_radius", tool.shank_radius);
  part("/tool/stickout", tool.stickout);
  part("/tool/holder_radius", tool.holder_radius);
  const double D = tool::cutting_radius(tool);
  if (tool.neck_length) require("/tool/neck_length", *tool.neck_length, D, largest_length, "mm");
  if (tool.stickout) {
    const double below = std::max(D, tool.neck_length.value_or(D));
    require("/tool/stickout", *tool.stickout, below, largest_length, "mm");
  }
  if (tool.holder_radius && !tool.stickout) {
    refuse("/tool/stickout", "absent", "given when holder_radius is: it says where the holder is");
  }
}

void require_passes(const Job& job) {
  if (job.pass_widths.empty()) return;
  if (job.pass_widths.size() > most_passes) {
    refuse("/passes", std::to_string(job.pass_widths.size()),
           "at most " + std::to_string(most_passes));
  }
  double before = 0;
  for (const double width : job.pass_widths) {
    require_above("/passes", width, before, largest_length, "mm");
    before = width;
  }
  if (before != job.width) {
    refuse("/passes", text(before, "mm"), "a list that ends with the width " + text(job.width));
  }
}

void require_feeds(const Job& job) {
  require_above("/feed", job.feed, 0, largest_feed, "mm/s");
  if (job.lead_in_feed) require_above("/lead_in_feed", *job.lead_in_feed, 0, largest_feed, "mm/s");
}

void require_axis(const Job& job) {
  const auto* axis = std::get_if<Eigen::Vector3d>(&job.tool_axis);
  if (!axis) return;
  require_point("/tool_axis", *axis);
  if (!(axis->norm() > 1e-9)) refuse("/tool_axis", "no direction", "a vector that is not 0");
}

}  // namespace

void validate(const Job& job) {
  require("/width", job.width, least_length, largest_length, "mm");
  require_above("/tolerance", job.tolerance, 0, largest_tolerance, "mm");
  require_tool(job.tool);
  require_passes(job);
  require_feeds(job);
  require_axis(job);
  require("/start_angle", job.start_angle, -full_turn, full_turn, "rad");
  require("/overlap", job.overlap, 0, full_turn, "rad");
  require_above("/clearance", job.clearance, 0, largest_length, "mm");
  if (job.lead_radius) {
    require("/lead_radius", *job.lead_radius, least_length, largest_length, "mm");
  }
  if (job.end_position) require_point("/end_position", *job.end_position);
  require("/output/decimals", job.decimals, 1, 6, "");
}

}  // namespace ridgeline::chamfer
