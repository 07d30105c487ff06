#include "idl/domain.hpp"

#include <cstdlib>
#include <map>
#include <mutex>

#include "loopback.hpp"

namespace ridgeline::dds {

bool uses_loopback() {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return uri == nullptr || *uri == '\0';
}

Domain::Domain(dds_domainid_t id) : id_(id) {
  if (id > max_domain) throw Failure("dds_create_domain", DDS_RETCODE_OUT_OF_RANGE);
  if (uses_loopback()) {
    domain_ = Entity(dds_create_domain(id, loopback_configuration), "dds_create_domain");
  }
}

std::shared_ptr<const Domain> Domain::open(dds_domainid_t id) {
  static std::mutex mutex;
  static std::map<dds_domainid_t, std::weak_ptr<const Domain>> open;
  const std::scoped_lock lock(mutex);
  std::shared_ptr<const Domain> domain = open[id].lock();
  if (!domain) {
    domain = std::shared_ptr<const Domain>(new Domain(id));
    open[id] = domain;
  }
  return domain;
}

Entity Domain::participant() const {
  return {dds_create_participant(id_, nullptr, nullptr), "dds_create_participant"};
}

}  // namespace ridgeline::dds
