#pragma once

#include <string>
#include <vector>

namespace ridgeline::jobs {

struct ChamferJob;

/// What the head of an NC program says of its job, so that a printed program explains itself.
std::vector<std::string> comments_of(const ChamferJob& job);

}  // namespace ridgeline::jobs
