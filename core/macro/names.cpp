#include "core/macro/names.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace ridgeline::macro {
namespace {

struct Entry {
  std::string_view name;
  SystemName variables;
};

constexpr int axes = 20;  ///< numbers kept for the axes in each kind of position

constexpr std::array<Entry, 57> entries = {{
    {"_UI", {1000, 32, 0}},   {"_UIL", {1032, 4, 0}},   {"_UO", {1100, 32, 0}},
    {"_UOL", {1132, 4, 0}},   {"_OFS", {10001, 999}},   {"_OFSW", {10001, 999}},
    {"_OFSG", {11001, 999}},  {"_OFSHW", {10001, 999}}, {"_OFSHG", {11001, 999}},
    {"_OFSDW", {12001, 999}}, {"_OFSDG", {13001, 999}}, {"_ALM", {3000}},
    {"_CLOCK1", {3001}},      {"_CLOCK2", {3002}},      {"_CNTL1", {3003}},
    {"_CNTL2", {3004}},       {"_SETDT", {3005}},       {"_MSGSTP", {3006}},
    {"_MRIMG", {3007}},       {"_PRSTR", {3008}},       {"_DATE", {3011}},
    {"_TIME", {3012}},        {"_EMPTY", {3100}},       {"_PI", {3101}},
    {"_E", {3102}},           {"_PRTSA", {3901}},       {"_PRTSN", {3902}},
    {"_MAINO", {4000}},       {"_BUFG", {4001, 30}},    {"_BUFB", {4102}},
    {"_BUFD", {4107}},        {"_BUFE", {4108}},        {"_BUFF", {4109}},
    {"_BUFH", {4111}},        {"_BUFM", {4113}},        {"_BUFN", {4114}},
    {"_BUFO", {4115}},        {"_BUFS", {4119}},        {"_BUFT", {4120}},
    {"_BUFWZP", {4130}},      {"_ACTG", {4201, 30}},    {"_ACTD", {4307}},
    {"_ACTF", {4309}},        {"_ACTH", {4311}},        {"_ACTM", {4313}},
    {"_ACTS", {4319}},        {"_ACTT", {4320}},        {"_ACTWZP", {4330}},
    {"_ABSIO", {5001, axes}}, {"_ABSMT", {5021, axes}}, {"_ABSOT", {5041, axes}},
    {"_ABSKP", {5061, axes}}, {"_TOFS", {5081, axes}},  {"_SVERR", {5101, axes}},
    {"_MIRTP", {5121, axes}}, {"_DIST", {5181, axes}},  {"_WZCMN", {5201, axes}},
}};

/// _WZG54 .. _WZG59 and _WZP1 .. _WZP300.
std::optional<SystemName> work_offset(std::string_view name) {
  const auto number_after = [name](std::string_view prefix) {
    int number = 0;
    if (!name.starts_with(prefix)) return 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, number);
    return error == std::errc() && rest == end ? number : 0;
  };
  const int g = number_after("_WZG"), p = number_after("_WZP");
  if (g >= 54 && g <= 59) return SystemName{5221 + 20 * (g - 54), axes};
  if (p >= 1 && p <= 300) return SystemName{14001 + 20 * (p - 1), axes};
  return std::nullopt;
}

}  // namespace

std::optional<SystemName> system_name(std::string_view name) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  if (found != entries.end()) return found->variables;
  return work_offset(name);
}

}  // namespace ridgeline::macro
