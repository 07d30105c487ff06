#pragma once

#include <memory>

#include "idl/dds.hpp"

namespace ridgeline::dds {

/// Highest domain whose ports exist [DDSI-RTPS 9.6.1.1].
inline constexpr dds_domainid_t max_domain = 230;

/// Keeps a domain open. While CYCLONEDDS_URI is not set, the built-in configuration holds, which
/// uses the loopback alone: what leaves the machine is for the administrator to say.
class Domain {
public:
  /// The one of this process for `id`. Throws Failure when the configuration cannot be used.
  static std::shared_ptr<const Domain> open(dds_domainid_t id);

  dds_domainid_t id() const noexcept { return id_; }
  Entity participant() const;

private:
  explicit Domain(dds_domainid_t id);

  dds_domainid_t id_;
  Entity domain_;
};

/// Is the built-in configuration in use?
bool uses_loopback();

}  // namespace ridgeline::dds
