#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ridgeline {

/// A workpiece for the library: bore radius 20, outer radius 30, a cross hole H1 of radius 5
/// through its middle [mm].
inline nlohmann::json named_tube(const std::string& name, double length = 100) {
  return {{"kind", "workpiece"},
          {"name", name},
          {"shape", "thick_walled_cylinder"},
          {"inner_radius", 20},
          {"outer_radius", 30},
          {"length", length},
          {"holes", {{{"name", "H1"}, {"shape", "circle"}, {"radius", 5}}}}};
}

}  // namespace ridgeline
