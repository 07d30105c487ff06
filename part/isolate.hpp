#pragma once

#include <functional>
#include <string>

#include "core/base/progress.hpp"

namespace ridgeline::part {

/// What a task may take before it is stopped.
struct Limits {
  double seconds = 120;
  double gigabytes = 4;
};

/// Runs `task` in a child process and returns the text that it makes: whatever a file makes a
/// translator do (fault, endless loop, all memory), this process goes on. The child is a copy of
/// this process with one thread; the task may use nothing that other threads of it might hold.
/// Throws Error{BadFile} when it died or took too much, Error{Cancelled} within 100 ms of a stop.
std::string isolated(const std::function<std::string()>& task, const Progress& progress,
                     const Limits& limits = {});

}  // namespace ridgeline::part
