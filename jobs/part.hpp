#pragma once

#include <nlohmann/json.hpp>

#include "core/base/progress.hpp"
#include "core/units/product.hpp"
#include "jobs/answer.hpp"
#include "jobs/reader.hpp"

/// Parts from STEP files as documents. A file is read in a process of its own, so that no file can
/// stop the service; files read lately are remembered.
namespace ridgeline::jobs {

/// A product, where it lies in its file, and how it was called for.
struct Part {
  units::Product product;
  nlohmann::json placement;  ///< {"origin", "x", "y", "z"}: its frame in file coordinates
};

/// "product_step" of a job: the text of the file. `axis`: "axis" of the job, if any. Throws
/// Error{BadFile, NotTurned, SeveralSolids, AbsurdSize}.
Part part_of_step(const Value& step, const std::optional<Value>& axis, const Progress& progress);

/// "stock_step": the half section of a stock.
units::Region stock_of_step(const Value& step, const Progress& progress);

/// The mouths of holes in round walls of the largest solid of a file, in file coordinates, angles
/// in degrees: {"mouths": [...], "low": [x, y, z], "high": [x, y, z]}.
nlohmann::json mouths_of_step(const Value& step, const Progress& progress);

/// "product": {...} of a job: part values; or the name of a part in the library.
Part part_of_document(const Value& product, const Definitions& definitions);

}  // namespace ridgeline::jobs
