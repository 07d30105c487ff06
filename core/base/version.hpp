#pragma once

#include <string_view>

namespace ridgeline {

/// Version of this build, e.g. "0.1.0": project(VERSION) of the top CMakeLists.txt, nowhere else.
std::string_view version() noexcept;

}  // namespace ridgeline
