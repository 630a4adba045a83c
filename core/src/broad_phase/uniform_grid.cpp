// A uniform grid with cells as large as the boxes, in memory that does not grow with the empty space.
//
// Cells. With cells at least as large as the boxes, two boxes that overlap have their lower corners in the same cell or
// in neighbouring ones: 13 neighbours to look at, the other 13 look at us. Boxes of uneven size get one grid for each
// factor 2 of size (a hierarchical grid: Ericson, Real-Time Collision Detection, 7.2.1); a box also looks into the
// grids with larger cells.
//
// Slots. Cell (x, y, z) of a grid has the slot (x + P y + Q z) mod M, M a power of two >= 4 n: cells in a row along x
// have slots in a row. If all cells from wall to wall fit, P and Q are the row length and the layer size, and no two
// cells share a slot. If not, P and Q are M times two numbers as far from fractions as can be, which scatters the cells
// that are in use evenly; boxes from cells that share a slot are told apart only when they overlap, which is rare.
//
// A counting sort puts the boxes in order of their slots: two passes, and the boxes of a row of cells are neighbours in
// memory.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "plumbline/core/broad_phase/broad_phase.hpp"

namespace plumbline {
namespace {

constexpr double kMaxCells = 0x1p40;      // along an axis; a corner is then rounded by less than 2^-12 of a cell, and
constexpr double kMargin = 1 + 0x1p-10;   // cells this much larger than the boxes leave room for that
constexpr double kSmallestCell = 1e-200;  // [m]
constexpr int kLevels = 64;               // sizes down to 2^-63 of the largest; smaller boxes join the last level

// 1 / 1.3247..., the inverse of the plastic number: multiples of it and of its square fill a square evenly, as those of
// the golden ratio fill a line (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
constexpr double kPlastic = 0.7548776662466927;

std::uint64_t odd(double value) { return static_cast<std::uint64_t>(value) | 1; }

struct Cell {
  std::int64_t x, y, z;
};

// The cells x_low ... x_high of one row.
struct Row {
  std::int64_t x_low, x_high, y, z;
};

class UniformGrid final : public BroadPhase {
 public:
  std::string_view name() const override { return "uniform grid"; }

 private:
  struct Entry {
    Aabb box;
    std::uint32_t body;
  };

  // One grid; a box belongs to the one with the smallest cells that are as large as the box.
  struct Level {
    std::uint32_t boxes = 0;
    double per_cell = 0;                         // cells per metre
    std::uint64_t row = 0, layer = 0, mask = 0;  // P, Q and M - 1
    std::size_t first_slot = 0;
    bool shares_slots = false;
  };

  void find(std::span<const Aabb> boxes, std::vector<BodyPair>& pairs) override {
    if (boxes.empty()) return;
    measure(boxes);
    lay_out_levels(boxes);
    sort(boxes);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      const Level& level = levels_[l];
      if (level.boxes == 0) continue;
      const std::uint32_t end = starts_[level.first_slot + level.mask + 1];
      for (std::uint32_t k = starts_[level.first_slot]; k < end; ++k) {
        for (std::size_t larger = 0; larger < l; ++larger) {
          if (levels_[larger].boxes > 0) look_among_larger(levels_[larger], entries_[k], pairs);
        }
        look_among_equals(level, k, pairs);
      }
    }
  }

  void measure(std::span<const Aabb> boxes) {
    Aabb corners{boxes[0].min, boxes[0].min};
    double largest = 0;
    for (const Aabb& box : boxes) {
      corners = merged(corners, {box.min, box.min});
      largest = std::max(largest, (box.max - box.min).maxCoeff());
    }
    walls_ = corners;
    const double span = (corners.max - corners.min).maxCoeff();
    largest_cell_ = std::max({largest, span / kMaxCells, kSmallestCell});
    const double most = span > 0 ? largest_cell_ / span * kMaxCells : kMaxCells;  // how often it may be halved
    last_level_ = std::clamp(std::ilogb(most), 0, kLevels - 1);
  }

  std::size_t level_of(const Aabb& box) const {
    const double ratio = largest_cell_ / (box.max - box.min).maxCoeff();  // infinite for a point: the last level
    if (ratio < 2) return 0;
    return static_cast<std::size_t>(std::min(std::ilogb(ratio), last_level_));
  }

  void lay_out_levels(std::span<const Aabb> boxes) {
    levels_ = {};
    for (const Aabb& box : boxes) ++levels_[level_of(box)].boxes;
    std::size_t slots = 0;
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      Level& level = levels_[l];
      if (level.boxes == 0) continue;
      level.per_cell = 1 / (std::ldexp(largest_cell_, -static_cast<int>(l)) * kMargin);
      const std::uint64_t size = std::bit_ceil(std::uint64_t{4} * level.boxes);  // M; at least 4, a row of 3 fits
      const auto all = static_cast<double>(size);
      const Cell far = cell_at(level, walls_.max);
      const double nx = static_cast<double>(far.x + 1), ny = static_cast<double>(far.y + 1);
      level.shares_slots = nx * ny * static_cast<double>(far.z + 1) > all;
      level.row = level.shares_slots ? odd(kPlastic * all) : static_cast<std::uint64_t>(nx);
      level.layer = level.shares_slots ? odd(kPlastic * kPlastic * all) : static_cast<std::uint64_t>(nx * ny);
      level.mask = size - 1;
      level.first_slot = slots;
      slots += size;
    }
    starts_.assign(slots + 1, 0);
  }

  void sort(std::span<const Aabb> boxes) {
    slots_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Level& level = levels_[level_of(boxes[i])];
      slots_[i] = level.first_slot + slot(level, cell_at(level, boxes[i].min));
      ++starts_[slots_[i]];
    }
    // Each start first becomes the end of its slot and then, while the slot is filled from behind, its start.
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts_) start = sum += start;
    entries_.resize(boxes.size());
    for (auto i = static_cast<std::uint32_t>(boxes.size()); i-- > 0;) entries_[--starts_[slots_[i]]] = {boxes[i], i};
  }

  // Numbers within the walls are not negative, so that cutting off their fraction rounds them down.
  Cell cell_at(const Level& level, const Vec3& point) const {
    const Vec3 p = ((point - walls_.min) * level.per_cell).cwiseMax(0.0);
    return {static_cast<std::int64_t>(p.x()), static_cast<std::int64_t>(p.y()), static_cast<std::int64_t>(p.z())};
  }

  static std::size_t slot(const Level& level, const Cell& cell) {
    return (static_cast<std::uint64_t>(cell.x) + level.row * static_cast<std::uint64_t>(cell.y) +
            level.layer * static_cast<std::uint64_t>(cell.z)) &
           level.mask;
  }

  // The cell that a box ends in, or the last one before the wall.
  Cell end_cell(const Level& level, const Aabb& box) const { return cell_at(level, box.max.cwiseMin(walls_.max)); }

  // Its own cell from itself on, and those neighbours that come later in the order of z, y, x; the earlier ones look at
  // us.
  void look_among_equals(const Level& level, std::uint32_t k, std::vector<BodyPair>& pairs) const {
    const Entry& entry = entries_[k];
    const Cell own = cell_at(level, entry.box.min), end = end_cell(level, entry.box);
    const std::int64_t x_low = std::max<std::int64_t>(own.x - 1, 0), y_low = std::max<std::int64_t>(own.y - 1, 0);
    look_along(level, {own.x, end.x, own.y, own.z}, entry, k + 1, pairs);
    for (std::int64_t y = own.y + 1; y <= end.y; ++y) look_along(level, {x_low, end.x, y, own.z}, entry, 0, pairs);
    for (std::int64_t z = own.z + 1; z <= end.z; ++z) {
      for (std::int64_t y = y_low; y <= end.y; ++y) look_along(level, {x_low, end.x, y, z}, entry, 0, pairs);
    }
  }

  // All cells in which a larger box may begin: those the entry covers, and one before.
  void look_among_larger(const Level& level, const Entry& entry, std::vector<BodyPair>& pairs) const {
    const Cell begin = cell_at(level, entry.box.min.array() - 1 / level.per_cell), end = end_cell(level, entry.box);
    for (std::int64_t z = begin.z; z <= end.z; ++z) {
      for (std::int64_t y = begin.y; y <= end.y; ++y) look_along(level, {begin.x, end.x, y, z}, entry, 0, pairs);
    }
  }

  void look_along(const Level& level, const Row& row, const Entry& entry, std::uint32_t from,
                  std::vector<BodyPair>& pairs) const {
    const std::size_t first = slot(level, {row.x_low, row.y, row.z});
    const std::size_t last = first + static_cast<std::size_t>(row.x_high - row.x_low);
    const std::uint32_t* start = &starts_[level.first_slot];
    const auto look = [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) {
        const Entry& other = entries_[k];
        if (!overlap(entry.box, other.box)) continue;
        if (level.shares_slots && !begins_in(level, row, other.box)) continue;
        pairs.push_back(ordered(entry.body, other.body));
      }
    };
    if (last <= level.mask) {
      look(std::max(start[first], from), start[last + 1]);
    } else {  // the row goes on in the first slots
      look(std::max(start[first], from), start[level.mask + 1]);
      look(start[0], start[last - level.mask]);
    }
  }

  bool begins_in(const Level& level, const Row& row, const Aabb& box) const {
    const Cell cell = cell_at(level, box.min);
    return cell.x >= row.x_low && cell.x <= row.x_high && cell.y == row.y && cell.z == row.z;
  }

  Aabb walls_{};  // of the lower corners
  double largest_cell_ = 0;
  int last_level_ = 0;
  std::array<Level, kLevels> levels_;  // from large cells to small ones
  std::vector<std::size_t> slots_;     // of each box
  std::vector<std::uint32_t> starts_;  // of each slot, within the entries
  std::vector<Entry> entries_;         // in order of their slots
};

}  // namespace

std::unique_ptr<BroadPhase> make_uniform_grid() { return std::make_unique<UniformGrid>(); }

}  // namespace plumbline
