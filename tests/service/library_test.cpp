#include "service/library.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/support/named_tube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::service {
namespace {

using Json = nlohmann::json;

Json ball(const std::string& name, int number, double radius) {
  return {
      {"kind", "tool"}, {"name", name}, {"number", number}, {"shape", "ball"}, {"radius", radius}};
}

template <class F>
Error error_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {ErrorCode::Internal, ""};
}

TEST(Library, KeepsEveryRevisionAndAnswersTheLast) {
  Library library(":memory:");
  EXPECT_EQ(library.put(ball("b6", 12, 3)).revision, 1);
  EXPECT_EQ(library.put(ball("b6", 12, 2.9)).revision, 2);
  EXPECT_EQ(library.find("tool", "b6")->document.at("radius"), 2.9);
  EXPECT_EQ(library.find("tool", "b6")->revision, 2);
  EXPECT_EQ(Json::parse(library.get("tool", "b6", 1)->document).at("radius"), 3);
  EXPECT_FALSE(library.get("tool", "b6", 3));
  EXPECT_EQ(library.history("tool", "b6").size(), 2u);
}

TEST(Library, FindsAToolByNumberAndByName) {
  Library library(":memory:");
  library.put(ball("b6", 12, 3));
  Json nameless = ball("", 7, 2);
  nameless.erase("name");
  library.put(nameless);
  EXPECT_EQ(library.find("tool", "12")->document.at("name"), "b6");
  EXPECT_EQ(library.find("tool", "7")->document.at("radius"), 2);
  EXPECT_FALSE(library.find("tool", "b7"));
  EXPECT_FALSE(library.find("workpiece", "b6"));
  const std::vector<std::string> names = library.names("tool");
  EXPECT_EQ(std::ranges::count(names, "12"), 1);
}

TEST(Library, PuttingTheSameAgainIsNoRevision) {
  Library library(":memory:");
  library.put(named_tube("t"));
  const Receipt again = library.put(named_tube("t"));
  EXPECT_EQ(again.revision, 1);
  EXPECT_FALSE(again.is_new);
  EXPECT_EQ(library.history("workpiece", "t").size(), 1u);
}

TEST(Library, RemovalIsARevisionAndTheNameCanBeUsedAgain) {
  Library library(":memory:");
  library.put(ball("b6", 12, 3));
  EXPECT_EQ(library.remove("tool", "12").revision, 2);
  EXPECT_FALSE(library.find("tool", "b6"));
  EXPECT_FALSE(library.find("tool", "12"));
  EXPECT_TRUE(library.list().empty());
  EXPECT_EQ(error_of([&] { library.remove("tool", "b6"); }).code(), ErrorCode::UnknownDefinition);
  EXPECT_EQ(library.put(ball("b6", 13, 3)).revision, 3);
  EXPECT_EQ(library.find("tool", "13")->revision, 3);
}

TEST(Library, RefusesANumberThatAnotherToolHas) {
  Library library(":memory:");
  library.put(ball("b6", 12, 3));
  const Error error = error_of([&] { library.put(ball("b8", 12, 4)); });
  EXPECT_EQ(error.code(), ErrorCode::BadInput);
  EXPECT_EQ(error.details().field, "/number");
  EXPECT_FALSE(library.find("tool", "b8"));
}

TEST(Library, RefusesAnInvalidDefinitionAndStoresNothing) {
  Library library(":memory:");
  Json bad = named_tube("t");
  bad["outer_radius"] = -1;
  EXPECT_EQ(error_of([&] { library.put(bad); }).details().field, "/outer_radius");
  const std::vector<Json> three = {named_tube("a"), bad, named_tube("c")};
  EXPECT_EQ(error_of([&] { library.put_all(three); }).details().field,
            "/definitions/1/outer_radius");
  EXPECT_TRUE(library.list().empty());
}

TEST(Library, TheSameRequestTwiceChangesOnce) {
  Library library(":memory:");
  library.put(named_tube("t", 100), "request-1");
  library.put(named_tube("t", 110), "request-2");
  const Receipt again =
      library.put(named_tube("t", 100), "request-1");  // repeated by the middleware
  EXPECT_EQ(again.revision, 1);
  EXPECT_EQ(library.find("workpiece", "t")->document.at("length"), 110);
  EXPECT_EQ(library.remove("workpiece", "t", "request-3").revision, 3);
  EXPECT_EQ(library.remove("workpiece", "t", "request-3").revision, 3);
}

TEST(Library, IsKeptInTheFile) {
  const TemporaryFolder folder;
  {
    Library library(folder / "deep/er/library.db");
    library.put(named_tube("t"));
  }
  Library library(folder / "deep/er/library.db");
  EXPECT_EQ(library.find("workpiece", "t")->revision, 1);
  EXPECT_EQ(library.damage(), "");
}

TEST(Library, TwoWritersOfOneFileLoseNothing) {
  const TemporaryFolder folder;
  const auto write = [&](int writer) {
    Library library(folder / "library.db");
    for (int i = 1; i <= 30; ++i) {
      library.put(named_tube("shared", 100 + writer + i));
      library.put(named_tube("own-" + std::to_string(writer), 100 + i));
    }
  };
  Library(folder / "library.db").list();
  { std::jthread a(write, 1000), b(write, 2000); }
  Library library(folder / "library.db");
  EXPECT_EQ(library.find("workpiece", "shared")->revision, 60);
  EXPECT_EQ(library.history("workpiece", "shared").size(), 60u);
  EXPECT_EQ(library.find("workpiece", "own-1000")->revision, 30);
  EXPECT_EQ(library.find("workpiece", "own-2000")->revision, 30);
  EXPECT_EQ(library.conflicts(), 0);
}

// The child puts and tells each acknowledged revision; it is killed somewhere in a put.
TEST(Library, AnAcknowledgedPutSurvivesKill) {
  const TemporaryFolder folder;
  int total = 0;
  for (int round = 0; round < 10; ++round) {
    int pipe_ends[2];
    ASSERT_EQ(pipe(pipe_ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      Library library(folder / "library.db");
      for (int i = 0;; ++i) {
        const int revision = library.put(named_tube("t", 100 + round + i / 1000.0)).revision;
        if (write(pipe_ends[1], &revision, sizeof revision) != sizeof revision) _exit(1);
      }
    }
    close(pipe_ends[1]);
    int acknowledged = 0;
    for (int revision = 0, n = 0; n <= round; ++n) {
      ASSERT_EQ(read(pipe_ends[0], &revision, sizeof revision), ssize_t{sizeof revision});
      acknowledged = revision;
    }
    usleep(static_cast<useconds_t>(137 * round));
    kill(child, SIGKILL);
    for (int revision = 0; read(pipe_ends[0], &revision, sizeof revision) == sizeof revision;)
      acknowledged = revision;
    close(pipe_ends[0]);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);

    Library library(folder / "library.db");
    ASSERT_EQ(library.damage(), "");
    const auto held = library.find("workpiece", "t");
    ASSERT_TRUE(held);
    EXPECT_GE(held->revision, acknowledged);
    EXPECT_LE(held->revision, acknowledged + 1);  // one may be done and not yet told
    EXPECT_EQ(library.history("workpiece", "t").size(), static_cast<std::size_t>(held->revision));
    total = acknowledged;
  }
  EXPECT_GE(total, 55);  // 1 + 2 + ... + 10 at least
}

TEST(Library, AFullDiskIsNamedAndWhatWasThereStays) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "library.db";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{200'000, 200'000};  // every file, like a disk that has no more
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
    Library library(file);
    for (int i = 1; i < 10'000; ++i) {
      try {
        library.put(named_tube("t", 100 + i));
      } catch (const Error& error) {
        const bool is_readable = library.find("workpiece", "t")->revision == i - 1;
        _exit(error.code() == ErrorCode::Storage && is_readable && i > 10 ? 0 : 3);
      }
    }
    _exit(4);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 0);
  Library library(file);
  EXPECT_EQ(library.damage(), "");
  const int revision = library.find("workpiece", "t")->revision;
  EXPECT_GE(revision, 10);
  EXPECT_EQ(library.put(named_tube("t", 99)).revision, revision + 1);
}

TEST(Library, ReportsAnotherFileByName) {
  const TemporaryFolder folder;
  std::ofstream(folder / "text.db") << std::string(5000, 'x');
  EXPECT_EQ(error_of([&] { Library library(folder / "text.db"); }).code(), ErrorCode::Storage);
  EXPECT_EQ(error_of([&] { Library library(folder / "text.db/below.db"); }).code(),
            ErrorCode::Storage);
  {
    sqlite::Connection other((folder / "other.db").string(), sqlite::Connection::Access::ReadWrite);
    other.run("CREATE TABLE t(x); PRAGMA user_version = 1");
  }
  const Error error = error_of([&] { Library library(folder / "other.db"); });
  EXPECT_NE(std::string(error.what()).find("another program"), std::string::npos);
}

TEST(Library, ADamagedPageIsReportedAndTheRestIsRead) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "library.db";
  constexpr int count = 300;
  {
    Library library(file);
    std::vector<Json> all;
    for (int i = 0; i < count; ++i) all.push_back(named_tube("t" + std::to_string(i)));
    library.put_all(all);
  }
  const auto size = std::filesystem::file_size(file);
  {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(size / 4096 / 2 * 4096));
    bytes << std::string(4096, '\x5a');
  }
  Library library(file);
  EXPECT_NE(library.damage(), "");
  const std::size_t readable = library.list().size();
  EXPECT_GT(readable, static_cast<std::size_t>(count) / 2);
  EXPECT_LT(readable, static_cast<std::size_t>(count));
  EXPECT_EQ(error_of([&] { library.put(named_tube("new")); }).code(), ErrorCode::Storage);
  EXPECT_EQ(std::filesystem::file_size(file), size);
}

TEST(Library, AFlippedByteIsNotTakenForADefinition) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "library.db";
  {
    Library library(file);
    library.put(named_tube("good"));
    library.put(named_tube("flipped", 123456));
  }
  std::string bytes(std::filesystem::file_size(file), '\0');
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const std::size_t at = bytes.find("123456");
  ASSERT_NE(at, std::string::npos);
  stream.seekp(static_cast<std::streamoff>(at));
  stream << '9' << std::flush;

  Library library(file);
  const Error error = error_of([&] { library.find("workpiece", "flipped"); });
  EXPECT_EQ(error.code(), ErrorCode::Storage);
  EXPECT_NE(std::string(error.what()).find("flipped"), std::string::npos);
  EXPECT_TRUE(library.find("workpiece", "good"));
  EXPECT_TRUE(library.list().front().is_damaged);
}

std::vector<Change> all_changes(const Library& library) {
  std::int64_t after = 0;
  return library.changes(after, 1000);
}

TEST(LibraryMerge, BothOrdersGiveTheSameAndKeepTheLoser) {
  Library a(":memory:", "a"), b(":memory:", "b");
  a.put(named_tube("t", 100));
  b.merge(all_changes(a));
  a.put(named_tube("t", 110));  // both make revision 2
  b.put(named_tube("t", 120));
  b.remove("workpiece", "t");  // revision 3, at b alone
  const std::vector<Change> from_a = all_changes(a);
  const std::vector<Change> from_b = all_changes(b);
  EXPECT_EQ(a.merge(from_b), 2);
  EXPECT_EQ(b.merge(from_a), 1);
  EXPECT_EQ(a.merge(from_b), 0);
  for (const Library* library : {&a, &b}) {
    EXPECT_FALSE(library->find("workpiece", "t"));
    EXPECT_EQ(library->get("workpiece", "t")->revision, 3);
    EXPECT_EQ(library->history("workpiece", "t").size(), 4u);
    EXPECT_EQ(library->get("workpiece", "t", 2)->instance, "b");  // the later of the two
    EXPECT_EQ(library->conflicts(), 1);
  }
  const auto digest_of = [](const Library& library) {
    std::uint64_t sum = 0;
    for (const Change& change : all_changes(library)) sum ^= digest(change);
    return sum;
  };
  EXPECT_EQ(digest_of(a), digest_of(b));
  EXPECT_NE(digest_of(a), digest_of(Library(":memory:")));
}

TEST(LibraryMerge, ARepeatedRequestIsKnownWhereItsChangeArrived) {
  Library a(":memory:", "a"), b(":memory:", "b");
  a.put(named_tube("t"), "request-1");
  a.put(named_tube("t", 200), "request-2");
  b.merge(all_changes(a));
  EXPECT_EQ(b.put(named_tube("t"), "request-1").revision, 1);
  EXPECT_EQ(b.find("workpiece", "t")->document.at("length"), 200);
}

TEST(LibraryMerge, HealsADamagedRecord) {
  const TemporaryFolder folder;
  Library good(":memory:");
  good.put(named_tube("t"));
  Library library(folder / "library.db");
  library.merge(all_changes(good));
  {
    sqlite::Connection damage((folder / "library.db").string(),
                              sqlite::Connection::Access::ReadWrite);
    damage.run("UPDATE change SET document = replace(document, '20', '21')");
  }
  EXPECT_EQ(error_of([&] { library.find("workpiece", "t"); }).code(), ErrorCode::Storage);
  EXPECT_EQ(library.merge(all_changes(good)), 1);
  EXPECT_EQ(library.find("workpiece", "t")->document.at("inner_radius"), 20);
}

}  // namespace
}  // namespace ridgeline::service
