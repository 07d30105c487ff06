#include "core/units/edit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/units/divide.hpp"
#include "core/units/figure.hpp"
#include "core/units/names.hpp"
#include "core/units/order.hpp"
#include "core/units/overlay.hpp"
#include "core/units/rework.hpp"
#include "core/units/tolerance.hpp"
#include "core/units/tools.hpp"
#include "core/units/volumes.hpp"

namespace ridgeline::units {
namespace {

enum class Role { Old, Changed, Inserted, Removed };

/// A unit of the program with what the edits do to it.
struct Entry {
  Unit unit;
  Role role = Role::Old;
  std::optional<Unit> before;  ///< of a changed unit
};

std::string label(const Unit& unit) {
  return "unit " + std::to_string(unit.number) + " " + std::string(name(unit.kind)) +
         " of process " + std::to_string(unit.process);
}

[[noreturn]] void refuse(const std::string& what, const std::string& field) {
  throw Error(ErrorCode::BadInput, what, {.field = field});
}

std::size_t place_of(const std::vector<Entry>& entries, int wanted, const std::string& field) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].role != Role::Inserted && entries[i].unit.number == wanted) return i;
  }
  refuse("the program has no unit " + std::to_string(wanted) + "; it has 1 to " +
             std::to_string(entries.size()),
         field);
}

std::vector<Entry> applied(const Program& program, std::span<const Edit> edits) {
  std::vector<Entry> entries;
  for (const Unit& unit : program.units) entries.push_back({unit, Role::Old, {}});
  for (std::size_t k = 0; k < edits.size(); ++k) {
    const std::string at = "/edits/" + std::to_string(k);
    if (const auto* change = std::get_if<ChangeUnit>(&edits[k])) {
      Entry& entry = entries[place_of(entries, change->number, at + "/unit")];
      if (entry.role == Role::Removed) {
        refuse("unit " + std::to_string(change->number) + " is removed by the same edit", at);
      }
      if (!entry.before) entry.before = entry.unit;
      entry.unit = change->unit;
      entry.unit.number = change->number;
      entry.role = Role::Changed;
    } else if (const auto* removal = std::get_if<RemoveUnit>(&edits[k])) {
      entries[place_of(entries, removal->number, at + "/remove")].role = Role::Removed;
    } else {
      const auto& insertion = std::get<InsertUnit>(edits[k]);
      std::size_t place = 0;
      if (insertion.after != 0) {
        place = place_of(entries, insertion.after, at + "/insert_after") + 1;
        while (place < entries.size() && entries[place].role == Role::Inserted) ++place;
      }
      entries.insert(entries.begin() + static_cast<std::ptrdiff_t>(place),
                     Entry{insertion.unit, Role::Inserted, {}});
    }
  }
  return entries;
}

void add(Region& sum, const Region& part) {
  if (is_empty(part)) return;
  const Region both[] = {sum, part};
  sum = union_of(both);
}

/// The declared extension of an edited bar: kept while its end over the split stays where it was.
Region kept_extension(const Program& program, const Entry& entry, const Region& raw) {
  const Unit& old = entry.before ? *entry.before : entry.unit;
  Region over = difference_of(old.region, old.core);
  if (is_empty(over)) return {};
  if (entry.role == Role::Old) return over;
  if (old.shape.empty() || entry.unit.shape.empty()) return {};
  if (std::abs(old.shape.back().end.z - entry.unit.shape.back().end.z) > equal_parameter) return {};
  const double z =
      entry.unit.kind == UnitKind::BarOuter ? program.split.outer : program.split.inner;
  const Box b = box(raw);
  const Region beyond = entry.unit.process == 1 ? rectangle(0, b.r1 + 1, z, b.z1 + 1)
                                                : rectangle(0, b.r1 + 1, b.z0 - 1, z);
  return intersection_of(raw, beyond);
}

/// What an edited turned unit removes: its FIG inside T, less what is gone already. Warns of what
/// runs into the product (design 1.8-o).
void measure_edited(const Program& program, Entry& entry, const Region& T, const Region& gone) {
  Unit& unit = entry.unit;
  Region raw = unit.region;
  if (entry.role != Role::Old) {
    const Region figure = figure_region(unit);
    raw = intersection_of(figure, T);
    const double gouge = volume(intersection_of(figure, program.product.shadow));
    unit.notes.clear();
    if (gouge > equal_volume) {
      unit.notes.push_back("its shape runs into the product by " + std::to_string(gouge) +
                           " mm3; that part is not cut");
    }
  }
  const Region over = kept_extension(program, entry, raw);
  const Region* operands[] = {&raw, &over, &gone};
  unit.core = select(overlay(operands), [](std::uint64_t covered) { return covered == 1; });
  const Region both[] = {unit.core, over};
  unit.region = is_empty(over) ? unit.core : union_of(both);
  unit.volume = volume(unit.region);
  if (unit.volume < equal_volume) unit.notes.push_back("it removes nothing");
}

/// An old unit gives way to what an edit made of its work.
struct Old {
  const Unit* unit = nullptr;
  bool is_used = false;
};

double common_volume(const Unit& p, const Unit& q) {
  return volume(intersection_of(p.region, q.region));
}

/// S1606 to S1609: a new unit equal to an old one is the old one; else it takes the tools of the
/// old unit of its kind with the largest common region.
void match(std::vector<Unit>& units, std::vector<Old>& old) {
  for (Unit& unit : units) {
    const auto is_equal = [&](const Old& one) {
      return !one.is_used && is_turned(*one.unit) && one.unit->kind == unit.kind &&
             one.unit->process == unit.process &&
             std::abs(one.unit->volume - unit.volume) < equal_volume &&
             symmetric_difference(one.unit->region, unit.region) < equal_volume &&
             symmetric_difference(one.unit->core, unit.core) < equal_volume;
    };
    const auto equal = std::find_if(old.begin(), old.end(), is_equal);
    if (equal != old.end()) {
      equal->is_used = true;
      unit = *equal->unit;
      unit.state = State::Kept;
      continue;
    }
    double most = 0;
    unit.tools = usual_tools(unit);
    for (const Old& one : old) {
      if (!is_turned(*one.unit) || one.unit->kind != unit.kind) continue;
      const double common = common_volume(*one.unit, unit);
      if (common <= most) continue;
      most = common;
      unit.tools = one.unit->tools;
    }
  }
}

/// Why an old unit is no longer there.
void explain(Program& program, const std::vector<Old>& old, const std::vector<Unit>& made) {
  for (const Old& one : old) {
    if (one.is_used || !is_turned(*one.unit)) continue;
    double rebuilt = 0;
    for (const Unit& unit : made) {
      if (unit.kind == one.unit->kind && unit.state == State::Auto) {
        rebuilt += common_volume(*one.unit, unit);
      }
    }
    if (rebuilt > equal_volume) {
      program.notes.push_back(label(*one.unit) + " was rebuilt: " + std::to_string(rebuilt) +
                              " of its " + std::to_string(one.unit->volume) +
                              " mm3 are left to it");
    } else {
      program.notes.push_back(label(*one.unit) +
                              " could not be rebuilt: edited units remove all of its region");
    }
  }
}

/// Everything that happens to a program once it is known what the edits touch.
class Regeneration {
public:
  Regeneration(const Program& program, std::vector<Entry> entries)
      : before_(program), entries_(std::move(entries)), result_(program) {
    result_.units.clear();
    result_.notes.clear();
  }

  Program run() {
    first_ = static_cast<std::size_t>(
        std::find_if(entries_.begin(), entries_.end(),
                     [](const Entry& entry) { return entry.role != Role::Old; }) -
        entries_.begin());
    T_ = difference_of(before_.stock, before_.product.shadow);
    freeze();
    take_edited();
    std::vector<Unit> made = divided();
    for (Unit& unit : features()) made.push_back(std::move(unit));
    for (Unit& unit : later_) made.push_back(std::move(unit));
    put_in_order(made);
    for (Unit& unit : made) result_.units.push_back(std::move(unit));
    number(result_.units);
    share_features(result_);
    result_.volumes = measured_volumes(result_);
    return std::move(result_);
  }

private:
  void freeze() {
    for (std::size_t i = 0; i < first_; ++i) {
      Unit unit = entries_[i].unit;
      add(gone_, unit.core);
      if (unit.state == State::Edited) {
        block(unit);
      } else {
        unit.state = State::Frozen;
      }
      result_.units.push_back(std::move(unit));
    }
  }

  /// No extension enters an edited unit, unless that still has its own extension over the split:
  /// then the overlap on both sides of the split is the declared one.
  void block(const Unit& unit) {
    if (symmetric_difference(unit.region, unit.core) < equal_volume) add(blocked_, unit.core);
  }

  void take_edited() {
    for (std::size_t i = first_; i < entries_.size(); ++i) {
      Entry& entry = entries_[i];
      if (entry.role == Role::Removed) {
        result_.removed.push_back(
            {entry.unit.kind, entry.unit.process, entry.unit.core, entry.unit.feature});
        continue;
      }
      if (entry.role == Role::Old && entry.unit.state != State::Edited) continue;
      if (is_turned(entry.unit)) {
        measure_edited(before_, entry, T_, gone_);
        add(gone_, entry.unit.core);
        block(entry.unit);
      } else if (entry.role != Role::Old) {
        warn_of_feature(before_.product, entry.unit);
      }
      entry.unit.state = State::Edited;
      if (i == first_) {
        result_.units.push_back(entry.unit);
      } else {
        later_.push_back(entry.unit);
      }
    }
  }

  std::vector<Unit> divided() {
    const std::vector<Zone> around =
        zones(before_.product, before_.stock, before_.split, before_.parameters);
    const Division division{.remaining = difference_of(T_, gone_),
                            .turned = T_,
                            .blocked = blocked_,
                            .zones = around,
                            .removed = result_.removed,
                            .process = entries_[first_].unit.process};
    Divided made = divide(division);
    std::vector<Old> old;
    for (std::size_t i = first_; i < entries_.size(); ++i) {
      const Entry& entry = entries_[i];
      if (entry.role == Role::Old && entry.unit.state != State::Edited) {
        old.push_back({&entry.unit});
      }
    }
    match(made.units, old);
    for (const std::string& note : made.notes) result_.notes.push_back(note);
    explain(result_, old, made.units);
    return std::move(made.units);
  }

  /// Holes, faces and what is unexplained do not depend on turning: they come back as they were.
  /// What an edited one leaves of its feature is another unit.
  std::vector<Unit> features() {
    std::vector<Unit> edited;
    for (const std::vector<Unit>& units : {result_.units, later_}) {
      for (const Unit& unit : units) {
        if (!is_turned(unit) && unit.state == State::Edited) edited.push_back(unit);
      }
    }
    const auto is_edited = [&](const Unit& unit) {
      return std::any_of(edited.begin(), edited.end(), [&](const Unit& other) {
        return unit.feature && unit.kind == other.kind && unit.feature == other.feature;
      });
    };
    std::vector<Unit> made;
    for (std::size_t i = first_; i < entries_.size(); ++i) {
      Unit& unit = entries_[i].unit;
      if (is_turned(unit) || unit.state == State::Edited || entries_[i].role == Role::Removed) {
        continue;
      }
      if (is_edited(unit)) continue;
      unit.state = State::Kept;
      made.push_back(unit);
    }
    std::vector<Unit> rests;
    for (const Unit& unit : edited) {
      const bool is_done = std::any_of(rests.begin(), rests.end(), [&](const Unit& rest) {
        return rest.kind == unit.kind && rest.feature == unit.feature;
      });
      if (is_done) continue;
      if (std::optional<Unit> rest = rest_of_feature(result_, unit)) {
        rests.push_back(std::move(*rest));
      }
    }
    for (Unit& rest : rests) made.push_back(std::move(rest));
    return made;
  }

  const Program& before_;
  std::vector<Entry> entries_;
  Program result_;
  std::size_t first_ = 0;
  Region T_;
  Region gone_;     ///< cores of frozen and edited units
  Region blocked_;  ///< cores that no extension enters
  std::vector<Unit> later_;
};

}  // namespace

Program edit(const Program& program, std::span<const Edit> edits) {
  if (edits.empty()) refuse("there is nothing to edit", "/edits");
  return Regeneration(program, applied(program, edits)).run();
}

}  // namespace ridgeline::units
