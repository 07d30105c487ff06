#include "service/chunks.hpp"

#include <algorithm>
#include <numeric>

namespace ridgeline::wire {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorCode::Internal, "the samples of an answer do not fit together: " + what);
}

}  // namespace

Chunks::Chunks(jobs::Answer answer, std::uint64_t answer_number)
    : answer_(std::move(answer)),
      number_(answer_number),
      document_(answer_.document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
  if (jobs::is_error(answer_)) {
    const nlohmann::json& error = answer_.document.at("error");
    const auto text = [&](const char* key) { return error.value(key, std::string()); };
    code_ = error.value("code", "internal");
    error_ = {static_cast<std::int32_t>(error_code(code_).value_or(ErrorCode::Internal)),
              text("code"),
              text("message"),
              text("field"),
              text("value"),
              text("limit")};
  }
  answer_.document = nullptr;
  for (const jobs::Array& array : answer_.arrays) numbers_ += array.values.size();
  bytes_ = document_.size() + answer_.text.size() + numbers_ * sizeof(double);
  plan();
}

void Chunks::plan() {
  Chunk chunk;
  std::size_t space = chunk_bytes;
  const auto next = [&] {
    plan_.push_back(std::move(chunk));
    chunk = {};
    space = chunk_bytes;
  };
  const auto put_text = [&](std::size_t size, Range Chunk::*range) {
    for (std::size_t at = 0; at < size;) {
      if (space == 0) next();
      (chunk.*range) = {at, std::min(size - at, space)};
      at += (chunk.*range).size;
      space -= (chunk.*range).size;
    }
  };
  put_text(document_.size(), &Chunk::document);
  put_text(answer_.text.size(), &Chunk::text);
  constexpr std::size_t head = 256;  // a piece without numbers costs this much at most
  for (std::size_t i = 0; i < answer_.arrays.size(); ++i) {
    const std::size_t size = answer_.arrays[i].values.size();
    std::size_t at = 0;
    do {  // an empty array is a piece too
      if (space < head + sizeof(double)) next();
      const std::size_t count = std::min(size - at, (space - head) / sizeof(double));
      chunk.runs.push_back({i, {at, count}});
      space -= head + count * sizeof(double);
      at += count;
    } while (at < size);
  }
  plan_.push_back(std::move(chunk));
}

void Chunks::with_sample(std::uint32_t index, const RequestId& id, const std::string& instance,
                         const std::function<void(const ridgeline_wire_Reply&)>& write) const {
  const Chunk& chunk = plan_.at(index);
  ridgeline_wire_Reply sample{};
  sample.header.relatedRequestId = identity(id);
  sample.header.remoteEx = dds_rpc_REMOTE_EX_OK;
  copy(instance, sample.instance);
  sample.answer = number_;
  sample.chunk_index = index;
  sample.chunk_count = count();
  sample.document_bytes = document_.size();
  sample.text_bytes = answer_.text.size();
  sample.numbers = numbers_;

  static const ErrorTexts none;
  const ErrorTexts& error = error_ ? *error_ : none;
  sample.status = error_ ? ridgeline_wire_STATUS_ERROR : ridgeline_wire_STATUS_OK;
  sample.error.number = error.number;
  sample.error.code = borrowed(error.code);
  sample.error.message = borrowed(error.message);
  sample.error.field = borrowed(error.field);
  sample.error.value = borrowed(error.value);
  sample.error.limit = borrowed(error.limit);

  const std::string document = document_.substr(chunk.document.begin, chunk.document.size);
  const std::string text = answer_.text.substr(chunk.text.begin, chunk.text.size);
  sample.document = borrowed(document);
  sample.text = borrowed(text);

  std::vector<ridgeline_wire_Piece> pieces(chunk.runs.size());
  std::vector<std::vector<std::uint32_t>> shapes(chunk.runs.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Run& run = chunk.runs[i];
    const jobs::Array& array = answer_.arrays[run.array];
    for (const std::size_t size : array.shape) {
      shapes[i].push_back(static_cast<std::uint32_t>(size));
    }
    pieces[i].pointer = borrowed(array.pointer);
    pieces[i].shape._buffer = shapes[i].data();
    pieces[i].shape._length = pieces[i].shape._maximum =
        static_cast<std::uint32_t>(shapes[i].size());
    pieces[i].offset = run.values.begin;
    pieces[i].values._buffer = const_cast<double*>(array.values.data() + run.values.begin);
    pieces[i].values._length = pieces[i].values._maximum =
        static_cast<std::uint32_t>(run.values.size);
  }
  sample.arrays._buffer = pieces.data();
  sample.arrays._length = sample.arrays._maximum = static_cast<std::uint32_t>(pieces.size());
  write(sample);
}

bool Assembler::add(const ridgeline_wire_Reply& sample) {
  if (got_.empty()) {
    constexpr std::uint32_t max_chunks = 1U << 20;
    if (sample.chunk_count == 0 || sample.chunk_count > max_chunks) {
      fail("chunk_count is " + std::to_string(sample.chunk_count));
    }
    if (sample.numbers > max_numbers) fail("numbers is " + std::to_string(sample.numbers));
    got_.resize(sample.chunk_count);
    documents_.resize(sample.chunk_count);
    texts_.resize(sample.chunk_count);
    missing_ = sample.chunk_count;
    expected_numbers_ = sample.numbers;
    expected_document_ = sample.document_bytes;
    expected_text_ = sample.text_bytes;
  }
  if (sample.chunk_count != got_.size() || sample.chunk_index >= got_.size()) {
    fail("chunk " + std::to_string(sample.chunk_index) + " of " +
         std::to_string(sample.chunk_count));
  }
  if (got_[sample.chunk_index]) return false;
  got_[sample.chunk_index] = true;
  documents_[sample.chunk_index] = sample.document;
  texts_[sample.chunk_index] = sample.text;
  for (std::uint32_t i = 0; i < sample.arrays._length; ++i) add_piece(sample.arrays._buffer[i]);
  return --missing_ == 0;
}

void Assembler::add_piece(const ridgeline_wire_Piece& piece) {
  const auto found = std::ranges::find(arrays_, piece.pointer, &jobs::Array::pointer);
  jobs::Array& array =
      found != arrays_.end() ? *found : arrays_.emplace_back(jobs::Array{piece.pointer, {}, {}});
  if (array.shape.empty()) {
    std::uint64_t size = 1;
    for (std::uint32_t i = 0; i < piece.shape._length; ++i) {
      array.shape.push_back(piece.shape._buffer[i]);
      size *= piece.shape._buffer[i];
      if (size > expected_numbers_) fail(array.pointer + " is larger than the answer");
    }
    if (array.shape.empty()) fail(array.pointer + " has no shape");
    array.values.resize(size);
  }
  const std::uint64_t length = piece.values._length;
  if (piece.offset > array.values.size() || length > array.values.size() - piece.offset) {
    fail(array.pointer + " ends before its piece");
  }
  std::copy_n(piece.values._buffer, length,
              array.values.begin() + static_cast<std::ptrdiff_t>(piece.offset));
  numbers_ += length;
}

jobs::Answer Assembler::finish() {
  jobs::Answer answer;
  const std::string document = std::accumulate(documents_.begin(), documents_.end(), std::string(),
                                               [](std::string all, const std::string& piece) {
                                                 all += piece;
                                                 return all;
                                               });
  for (const std::string& piece : texts_) answer.text += piece;
  answer.arrays = std::move(arrays_);
  std::uint64_t size = 0;
  for (const jobs::Array& array : answer.arrays) size += array.values.size();
  if (document.size() != expected_document_) fail("the document has another length");
  if (answer.text.size() != expected_text_) fail("the text has another length");
  if (numbers_ != expected_numbers_ || size != expected_numbers_) fail("numbers are missing");
  answer.document = nlohmann::json::parse(document, nullptr, false);
  if (answer.document.is_discarded()) fail("the document is not JSON");
  return answer;
}

}  // namespace ridgeline::wire
