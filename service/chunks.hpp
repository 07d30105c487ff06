#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jobs/answer.hpp"
#include "service/wire.hpp"

namespace ridgeline::wire {

/// Most payload of one sample [bytes]: small enough for memory that is never mapped anew, large
/// enough for the throughput of the middleware (docs/dds.md).
inline constexpr std::size_t chunk_bytes = 192UL * 1024;
/// Most numbers that one answer may hold.
inline constexpr std::uint64_t max_numbers = 1ULL << 31;

/// An answer cut into samples. Keeps the answer, its document as text alone: many are kept for
/// duplicates, and the tree is several times as large. Each sample is made when it is sent.
class Chunks {
public:
  /// `answer_number` differs for each computation of this instance.
  Chunks(jobs::Answer answer, std::uint64_t answer_number);

  std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(plan_.size()); }
  std::size_t bytes() const noexcept { return bytes_; }       ///< payload of all samples
  const std::string& code() const noexcept { return code_; }  ///< "ok" or the error's

  /// Calls write with sample `index`, which borrows from this.
  void with_sample(std::uint32_t index, const RequestId& id, const std::string& instance,
                   const std::function<void(const ridgeline_wire_Reply&)>& write) const;

private:
  struct Range {
    std::size_t begin = 0, size = 0;
  };
  struct Run {
    std::size_t array = 0;
    Range values;
  };
  struct Chunk {
    Range document, text;
    std::vector<Run> runs;
  };
  void plan();

  /// Of an error object, for readers without JSON.
  struct ErrorTexts {
    std::int32_t number = 0;
    std::string code, message, field, value, limit;
  };

  jobs::Answer answer_;  ///< without its document
  std::uint64_t number_;
  std::string document_;
  std::optional<ErrorTexts> error_;
  std::string code_ = "ok";
  std::size_t bytes_ = 0;
  std::uint64_t numbers_ = 0;
  std::vector<Chunk> plan_;
};

/// Puts the samples of one answer together again.
class Assembler {
public:
  /// Was this sample the last one missing? One that is there already counts once. Throws
  /// Error{Internal} when the samples do not fit together.
  bool add(const ridgeline_wire_Reply& sample);
  /// The answer, once all samples are there.
  jobs::Answer finish();

private:
  void add_piece(const ridgeline_wire_Piece& piece);

  std::vector<bool> got_;
  std::size_t missing_ = 0;
  std::vector<std::string> documents_, texts_;  ///< by chunk
  std::vector<jobs::Array> arrays_;
  std::uint64_t numbers_ = 0;
  std::uint64_t expected_numbers_ = 0, expected_document_ = 0, expected_text_ = 0;
};

}  // namespace ridgeline::wire
