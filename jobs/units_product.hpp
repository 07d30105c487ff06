#pragma once

#include <nlohmann/json.hpp>

#include "core/units/product.hpp"
#include "jobs/reader.hpp"

/// Products of turning programs between documents and values: what part/ finds in a STEP file, or
/// what another program knows of a part. Frame: turning axis on Z, low end at Z = 0.
namespace ridgeline::jobs {

nlohmann::json vector_document(const Eigen::Vector3d& v);

nlohmann::json hole_document(const units::Hole& hole);
units::Hole read_product_hole(const Value& value);

nlohmann::json face_document(const units::MilledFace& face);
units::MilledFace read_face(const Value& value);

nlohmann::json remainder_document(const units::Remainder& remainder);
units::Remainder read_remainder(const Value& value);

nlohmann::json product_document(const units::Product& product);
/// Absent "volume": that of the shape revolved, less the features. Throws Error{BadInput}.
units::Product read_product(const Value& value);

}  // namespace ridgeline::jobs
