#pragma once

#include <optional>
#include <string>

#include "core/cutting/along.hpp"
#include "core/tool/coefficients.hpp"
#include "jobs/answer.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// A cutting-coefficient set: force per chip area (K_c) and per length of edge (K_e), tangential,
/// radial and axial, with where it comes from.
struct Material {
  std::string name;
  tool::Coefficients coefficients;
  std::optional<cutting::Uncertainty> uncertainty;  ///< of K_c and K_e
  std::string source;
  bool is_estimate = false;
};

/// Reads {"name", "Ktc", "Krc", "Kac", "Kte", "Kre", "Kae", "uncertainty": {"Kc", "Ke"}, "source",
/// "estimate"}; all from "uncertainty" on may be left out.
Material read_material(const Value& value);

/// A name of the library or an inline object. Throws Error{UnknownMaterial}.
Material resolve_material(const Value& value, const Definitions& definitions);
/// The same for a name that stands at `pointer`.
Material find_material(const std::string& name, const std::string& pointer,
                       const Definitions& definitions);

/// {"Kc", "Ke", "stiffness"}: relative standard uncertainties.
cutting::Uncertainty read_uncertainty(const Value& value);

/// The set as a result reports it.
nlohmann::json document_of(const Material& material);

}  // namespace ridgeline::jobs
