#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/nc/reader.hpp"

/// What the readers of all dialects share: exact numbers, where the tool is, the motion so far.
namespace ridgeline::nc {

/// 1e-9 of a mm, inch, degree, rev/min ...
using Nano = std::int64_t;
inline constexpr Nano nano = 1'000'000'000;
constexpr double real(Nano value) {
  return static_cast<double>(value) / static_cast<double>(nano);
}

/// Reads sign, digits, point, digits at the head of `text` and cuts them off; digits beyond the
/// ninth decimal are rounded. nullopt when there is no number or it is above 1e9.
std::optional<Nano> take_number(std::string_view& text);

/// Line and word of what is being read; makes the errors.
struct Spot {
  int line = 0;
  std::string word;
  [[noreturn]] void bad(const std::string& why) const;          ///< Error{BadFile}
  [[noreturn]] void unsupported(const std::string& why) const;  ///< Error{Unsupported}
};

/// Follows the tool. Coordinates are of the active plane and offset; an axis may be unknown.
class Tracer {
public:
  using Target = std::array<std::optional<Nano>, 3>;
  struct ArcTarget {
    path::ArcPlane plane;
    path::ArcSense sense;
    Eigen::Vector2d centre;  ///< first and second axis of the plane
  };

  explicit Tracer(const ReadOptions& options);

  /// Room for the moves of so many lines: none is copied as they grow in number.
  void reserve(std::size_t lines);

  bool is_known(std::size_t axis) const { return at_[axis].has_value(); }
  /// Where an axis is; an error of `spot` when that is not known.
  Nano at(std::size_t axis, const Spot& spot) const;

  void rapid(const Target& to, const Spot& spot);
  void feed(const Target& to, double mm_per_s, const std::optional<ArcTarget>& arc,
            const Spot& spot);

  /// The coordinate of the axis means something else from now on, or the axis went to a machine
  /// position.
  void lose(std::size_t axis);
  void lose_all();

  /// Something went out of sight after cutting: only rapids may follow.
  bool is_lost() const { return is_lost_; }

  void set_work_offset(const std::string& name);
  void set_tool(int number);
  /// Another length shifts the coordinate of `axis`, or of all when the control follows the tool.
  void set_length_offset(std::optional<int> number, std::optional<std::size_t> axis);
  /// nullopt: the plane of the machine.
  void set_plane(const std::optional<Eigen::Matrix3d>& axes, const Eigen::Vector3d& origin);

  Reading& reading() { return reading_; }
  Reading take(Dialect dialect);

private:
  Eigen::Vector3d work(const Eigen::Vector3d& point) const { return origin_ + axes_ * point; }
  bool all_known() const { return at_[0] && at_[1] && at_[2]; }
  Eigen::Vector3d position() const;
  void move_to(const Target& to, const Spot& spot);
  void record(const path::Move& move, const Spot& spot);
  void begin();
  void leave(const Target& to, const Spot& spot);

  Reading reading_;
  Target at_{};
  std::optional<int> length_;  ///< in force
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  bool has_start_ = false;
  bool has_cut_ = false;  ///< a move with a feed is recorded
  bool is_lost_ = false;  ///< an axis went out of sight after cutting
};

/// The radii at both ends of an arc that is read may differ by this [mm]: LinuxCNC refuses from
/// 0.03 mm on, other controls earlier.
inline constexpr double read_radius_tolerance = 0.02;

/// Centre of an arc of signed radius R (negative: more than half a turn) in the plane's axes.
/// Error of `spot` when the ends coincide or are further apart than the diameter.
Eigen::Vector2d centre_of(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double R,
                          path::ArcSense sense, const Spot& spot);

/// No coordinate may be beyond this.
inline constexpr Nano largest_read = 1'000'000 * nano;

/// M codes that neither move nor end.
bool is_harmless_m(int code);

Reading read_g_code(std::string_view text, Dialect dialect, const ReadOptions& options,
                    const Progress& progress);
Reading read_klartext(std::string_view text, const ReadOptions& options, const Progress& progress);

}  // namespace ridgeline::nc
