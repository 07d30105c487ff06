#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "core/base/error.hpp"

namespace ridgeline {

/// The Error that a call throws; a test failure when it throws none.
template <class F>
Error refusal_of(F&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was refused";
  return {ErrorCode::Internal, "nothing was refused"};
}

}  // namespace ridgeline
