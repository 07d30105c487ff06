#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

/// Owners for the resources of the DDS C API. Nothing outside idl/, service/ and clients/ includes
/// this.
namespace ridgeline::dds {

/// A call to the middleware failed. Stops the program at its start, is logged or becomes an Error
/// later; never crosses into core/ or jobs/.
class Failure : public std::runtime_error {
public:
  Failure(const char* call, dds_return_t code)
      : std::runtime_error(std::string(call) + ": " + dds_strretcode(code)), code_(code) {}
  dds_return_t code() const noexcept { return code_; }

private:
  dds_return_t code_;
};

/// Passes a result on, or throws Failure when it is a DDS error (negative).
inline dds_return_t check(dds_return_t result, const char* call) {
  if (result < 0) throw Failure(call, result);
  return result;
}

/// Owns one entity. Declare owners parent first: members die in reverse order.
class Entity {
public:
  Entity() noexcept = default;
  Entity(dds_entity_t handle, const char* call) : handle_(check(handle, call)) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }

  dds_entity_t get() const noexcept { return handle_; }
  explicit operator bool() const noexcept { return handle_ > 0; }

private:
  dds_entity_t handle_ = 0;
};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

struct ListenerDeleter {
  void operator()(dds_listener_t* listener) const noexcept { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, ListenerDeleter>;

struct EndpointDeleter {
  void operator()(dds_builtintopic_endpoint_t* endpoint) const noexcept {
    dds_builtintopic_free_endpoint(endpoint);
  }
};
using Endpoint = std::unique_ptr<dds_builtintopic_endpoint_t, EndpointDeleter>;

/// The samples of one take, lent by the reader and given back on destruction.
template <class T, std::size_t N = 16>
class Taken {
public:
  explicit Taken(const Entity& reader) : Taken(reader.get()) {}
  explicit Taken(dds_entity_t reader) : reader_(reader) {
    count_ = check(dds_take(reader_, samples_, infos_, N, N), "dds_take");
  }
  Taken(const Taken&) = delete;
  Taken& operator=(const Taken&) = delete;
  ~Taken() {
    if (count_ > 0) dds_return_loan(reader_, samples_, count_);
  }

  bool empty() const noexcept { return count_ == 0; }

  /// Calls f(sample, info) for each sample; where info.valid_data is false only the key counts.
  template <class F>
  void for_each(F&& f) const {
    for (int i = 0; i < count_; ++i) f(*static_cast<const T*>(samples_[i]), infos_[i]);
  }

private:
  dds_entity_t reader_;
  void* samples_[N] = {};
  dds_sample_info_t infos_[N];
  int count_ = 0;
};

}  // namespace ridgeline::dds
