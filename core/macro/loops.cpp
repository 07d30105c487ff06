#include "core/macro/loops.hpp"
#include "core/macro/text.hpp"

#include <algorithm>
#include <string>

namespace ridgeline::macro {

namespace {

void make_faulty(Program& program, std::int32_t index, AlarmNumber number,
                 const std::string& detail) {
  Block& block = program.blocks[static_cast<std::size_t>(index)];
  Alarm alarm;
  alarm.number = static_cast<int>(number);
  alarm.message = std::string(text(number)) + ": " + detail;
  alarm.column = block.column;
  block.kind = BlockKind::Faulty;
  block.target = static_cast<std::int32_t>(program.alarms.size());
  program.alarms.push_back(std::move(alarm));
}

struct OpenLoop {
  std::int32_t block = 0;
  std::int32_t number = 0;
};

}  // namespace

void pair_loops(Program& program) {
  std::vector<OpenLoop> open;
  const auto count = static_cast<std::int32_t>(program.blocks.size());
  for (std::int32_t i = 0; i < count; ++i) {
    Block& block = program.blocks[static_cast<std::size_t>(i)];
    block.loop = open.empty() ? -1 : open.back().block;
    const std::int32_t number = block.target;
    const auto same = [number](const OpenLoop& loop) { return loop.number == number; };
    if (block.kind == BlockKind::While || block.kind == BlockKind::Do) {
      if (std::any_of(open.begin(), open.end(), same)) {
        make_faulty(program, i, AlarmNumber::EndMissing,
                    numbered("DO", number) + " inside DO" + std::to_string(number));
        continue;
      }
      open.push_back({i, number});
    } else if (block.kind == BlockKind::End) {
      const auto partner = std::find_if(open.begin(), open.end(), same);
      if (partner == open.end()) {
        make_faulty(program, i, AlarmNumber::LoopNumber, numbered("END", number) + " without DO");
        continue;
      }
      for (auto crossed = partner + 1; crossed != open.end(); ++crossed) {
        make_faulty(program, crossed->block, AlarmNumber::EndMissing,
                    numbered("DO", crossed->number) + " crosses END" + std::to_string(number));
      }
      program.blocks[static_cast<std::size_t>(partner->block)].target = i;
      block.target = partner->block;
      block.loop = partner->block;
      open.erase(partner, open.end());
    }
  }
  for (const OpenLoop& loop : open) {
    make_faulty(program, loop.block, AlarmNumber::EndMissing,
                numbered("DO", loop.number) + " has no END");
  }
}

bool may_jump(const Program& program, std::int32_t from, std::int32_t to) {
  const auto loop_of = [&](std::int32_t block) {
    return program.blocks[static_cast<std::size_t>(block)].loop;
  };
  const std::int32_t inner = loop_of(to);
  if (inner < 0) return true;
  std::int32_t loop = loop_of(from);
  while (loop >= 0 && loop != inner) loop = loop_of(loop);
  return loop == inner;
}

}  // namespace ridgeline::macro
