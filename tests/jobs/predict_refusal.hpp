#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {

/// What makes a good job of `predict` a bad one, and how it is refused.
struct PredictRefusal {
  const char* name;
  const char* patch;  ///< JSON merge patch on the job
  const char* code;
  const char* field;
};

inline void PrintTo(const PredictRefusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

inline void expect_refused(nlohmann::json job, const PredictRefusal& refusal) {
  job.merge_patch(nlohmann::json::parse(refusal.patch));
  const nlohmann::json result = assemble(answer(job.dump(), "json", NoDefinitions()));
  ASSERT_EQ(result["status"], "error") << result.dump().substr(0, 500);
  EXPECT_EQ(result["error"]["code"], refusal.code) << result.dump();
  EXPECT_EQ(result["error"].value("field", ""), refusal.field) << result.dump();
}

}  // namespace ridgeline::jobs
