#pragma once

#include <optional>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// Warnings of an edited hole or face against the feature of the product that it came from.
void warn_of_feature(const Product& product, Unit& unit);

/// The unit that finishes a feature which an edited unit no longer removes wholly; nullopt when it
/// does, when a unit of `program` already finishes it, or when its finishing was removed.
std::optional<Unit> rest_of_feature(const Program& program, const Unit& edited);

/// Volumes of holes and faces in machining order: each the part of its feature that those before it
/// leave and it removes.
void share_features(Program& program);

}  // namespace ridgeline::units
