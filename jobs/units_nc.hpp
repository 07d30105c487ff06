#pragma once

#include <nlohmann/json.hpp>

#include "core/nc/turning.hpp"
#include "core/units/program.hpp"
#include "jobs/answer.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// Where the programs of a part stand: work zero on the finished end that each process works from,
/// Z out of the material, X a radius, C the angle that is turned under the tool.
struct LatheFrame {
  int process = 1;
  double length = 0;  ///< of the product [mm]

  double z(double section_z) const { return process == 1 ? -section_z : section_z - length; }
  /// Process 1 sees the product from its low end: turned half round about X.
  Eigen::Vector3d point(const Eigen::Vector3d& p) const {
    if (process == 1) return {p.x(), -p.y(), -p.z()};
    return {p.x(), p.y(), p.z() - length};
  }
  Eigen::Vector3d direction(const Eigen::Vector3d& d) const {
    if (process == 1) return {d.x(), -d.y(), -d.z()};
    return d;
  }
};

/// Holes beside the axis and milled faces, with driven tools; notes say what is not written.
/// `material` is what stands when the unit begins, turned about the axis.
void add_hole_steps(const units::Unit& unit, const LatheFrame& frame, const units::Region& material,
                    nc::LatheControl control, nc::LatheProgram& program,
                    std::vector<std::string>& notes);
void add_mill_steps(const units::Product& product, const units::Unit& unit, const LatheFrame& frame,
                    nc::LatheControl control, nc::LatheProgram& program,
                    std::vector<std::string>& notes);

/// "output": {"dialect", "program", "process", "top_speed"}.
Answer units_nc(const units::Program& program, const std::optional<Value>& output,
                std::string_view format);

}  // namespace ridgeline::jobs
