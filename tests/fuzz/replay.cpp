// Runs a harness where no fuzzer is linked:
//   fuzz_X FOLDER...                          over the files of a corpus: what was once found stays
//   mended fuzz_X --mutate SECONDS SEED FOLDER...    over files of it changed at random, blind to
//   what they reach
// The input under way is in the file "input" of the working directory with --mutate.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

using Bytes = std::vector<char>;

Bytes read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

void run(const Bytes& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// One change: a byte, a piece removed, repeated or taken from another input.
void mutate(Bytes& bytes, const Bytes& other, std::mt19937_64& random) {
  const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
  const std::size_t at = below(bytes.size()),
                    length = below(std::min<std::size_t>(32, bytes.size() - at));
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto end = begin + static_cast<std::ptrdiff_t>(length);
  switch (random() % 4) {
    case 0:
      if (!bytes.empty())
        bytes[at] = static_cast<char>(random() % 2 == 0 ? random() : '0' + random() % 10);
      break;
    case 1: bytes.erase(begin, end); break;
    case 2: {
      const Bytes piece(begin, end);
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())), piece.begin(),
                   piece.end());
      break;
    }
    default: {
      const std::size_t from = below(other.size()),
                        size = below(std::min<std::size_t>(64, other.size() - from));
      const auto first = other.begin() + static_cast<std::ptrdiff_t>(from);
      bytes.insert(begin, first, first + static_cast<std::ptrdiff_t>(size));
    }
  }
}

int mutate_for(double seconds, std::uint64_t seed, const std::vector<Bytes>& corpus) {
  std::mt19937_64 random(seed);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::uint64_t count = 0;
  double slowest = 0;
  for (auto now = std::chrono::steady_clock::now(); now < end; ++count) {
    Bytes bytes = corpus[random() % corpus.size()];
    for (auto changes = 1 + random() % 4; changes > 0; --changes)
      mutate(bytes, corpus[random() % corpus.size()], random);
    std::ofstream("input", std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    run(bytes);
    const auto after = std::chrono::steady_clock::now();
    slowest = std::max(slowest, std::chrono::duration<double>(after - now).count());
    now = after;
  }
  std::cout << count << " inputs, the slowest took " << slowest << " s\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool mutates = argc > 4 && std::string(argv[1]) == "--mutate";
  std::vector<Bytes> corpus;
  for (int i = mutates ? 4 : 1; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      corpus.push_back(read(entry.path()));
      if (mutates) continue;
      std::cout << entry.path().filename().string() << std::endl;  // the last one is the culprit
      run(corpus.back());
    }
  }
  if (corpus.empty()) return 1;
  if (mutates) return mutate_for(std::stod(argv[2]), std::stoull(argv[3]), corpus);
  std::cout << corpus.size() << " inputs\n";
  return 0;
}
