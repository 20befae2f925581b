#include "reference/light_clusters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <queue>

#include "base/pi.h"
#include "image/panorama.h"

namespace lobelight {
namespace {

// The size of a cell in texels after which it is time to ask whether to go on.
constexpr int kBetweenChecks = 256;

struct Cell {
  int column;  // Of its upper left texel.
  int row;
  int size;  // In texels, a power of two; the cell may reach beyond the map.
  std::size_t first;
  std::size_t last;
  double cost;  // What dividing it may gain.
};

bool cheaper(const Cell& a, const Cell& b) { return a.cost < b.cost; }

class Builder {
 public:
  Builder(int width, int height, const std::vector<double>& weights, const TexelSpace& space,
          const Progress* progress)
      : width_(width), height_(height), weights_(weights), space_(space), progress_(progress) {}

  LightClusters build(std::size_t count) {
    std::size_t weighty = 0;
    for (std::size_t texel = 0; texel < weights_.size(); ++texel) {
      throw_if_cancelled(progress_, texel);
      if (weights_[texel] > 0.0) ++weighty;
    }
    result_.order.reserve(weighty);
    int size = 1;
    while (size < std::max(width_, height_)) size *= 2;
    collect(0, 0, size);
    if (result_.order.empty()) return std::move(result_);
    sum_up();

    std::priority_queue<Cell, std::vector<Cell>, decltype(&cheaper)> cells(&cheaper);
    cells.push(make_cell(0, 0, size, 0, result_.order.size()));
    while (cells.size() < count && cells.top().cost > 0.0) {
      const Cell parent = cells.top();
      cells.pop();
      for (const Cell& child : children(parent)) cells.push(child);
    }
    result_.cluster_of.resize(weights_.size());
    for (; !cells.empty(); cells.pop()) add_cluster(cells.top());
    return std::move(result_);
  }

 private:
  double weight(std::uint32_t texel) const { return weights_[texel]; }
  int column_of(std::uint32_t texel) const {
    return static_cast<int>(texel % static_cast<std::uint32_t>(width_));
  }
  int row_of(std::uint32_t texel) const {
    return static_cast<int>(texel / static_cast<std::uint32_t>(width_));
  }

  void collect(int column, int row, int size) {
    if (column >= width_ || row >= height_) return;
    if (size > 1) {
      if (size == kBetweenChecks) throw_if_cancelled(progress_);
      const int half = size / 2;
      for (int quadrant = 0; quadrant < 4; ++quadrant) {
        collect(column + (quadrant & 1) * half, row + (quadrant >> 1) * half, half);
      }
      return;
    }
    const std::uint32_t texel =
        static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(width_) +
        static_cast<std::uint32_t>(column);
    if (weight(texel) > 0.0) result_.order.push_back(texel);
  }

  void sum_up() {
    std::vector<double>& cumulative = result_.cumulative;
    cumulative.reserve(result_.order.size() + 1);
    cumulative.push_back(0.0);
    for (const std::uint32_t texel : result_.order) {
      throw_if_cancelled(progress_, cumulative.size());
      cumulative.push_back(cumulative.back() + weight(texel));
    }
    const double total = cumulative.back();
    for (double& value : cumulative) value /= total;
  }

  Cell make_cell(int column, int row, int size, std::size_t first, std::size_t last) const {
    const double share = result_.cumulative[last] - result_.cumulative[first];
    const double middle = std::min(row + 0.5 * size, static_cast<double>(height_)) / height_;
    return {column, row, size, first, last, size == 1 ? 0.0 : share * space_.extent(size, middle)};
  }

  // The parent's texels lie quadrant after quadrant.
  std::vector<Cell> children(const Cell& parent) const {
    const int half = parent.size / 2;
    const auto quadrant_of = [&](std::uint32_t texel) {
      return (column_of(texel) >= parent.column + half ? 1 : 0) +
             (row_of(texel) >= parent.row + half ? 2 : 0);
    };
    std::vector<Cell> cells;
    const auto end = result_.order.begin() + static_cast<std::ptrdiff_t>(parent.last);
    std::size_t first = parent.first;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
      const auto begin = result_.order.begin() + static_cast<std::ptrdiff_t>(first);
      const auto next = std::partition_point(
          begin, end, [&](std::uint32_t texel) { return quadrant_of(texel) <= quadrant; });
      const std::size_t last = static_cast<std::size_t>(next - result_.order.begin());
      if (last > first) {
        cells.push_back(make_cell(parent.column + (quadrant & 1) * half,
                                  parent.row + (quadrant >> 1) * half, half, first, last));
      }
      first = last;
    }
    return cells;
  }

  void add_cluster(const Cell& cell) {
    throw_if_cancelled(progress_);
    glm::dvec3 sum(0.0);
    glm::dvec3 direction(0.0);
    double total = 0.0;
    for (std::size_t k = cell.first; k < cell.last; ++k) {
      const std::uint32_t texel = result_.order[k];
      result_.cluster_of[texel] = static_cast<std::uint16_t>(result_.clusters.size());
      direction = space_.place((column_of(texel) + 0.5) / width_, (row_of(texel) + 0.5) / height_);
      sum += weight(texel) * direction;
      total += weight(texel);
    }
    // Opposite directions may cancel in a cell as large as the map; then one of them serves.
    const double length = space_.is_sphere ? glm::length(sum) : total;
    result_.clusters.push_back({length > 0.0 ? sum / length : direction,
                                result_.cumulative[cell.last] - result_.cumulative[cell.first],
                                cell.first, cell.last});
  }

  int width_;
  int height_;
  const std::vector<double>& weights_;
  const TexelSpace& space_;
  const Progress* progress_;
  LightClusters result_;
};

}  // namespace

std::size_t LightClusters::choose(const LightCluster& cluster, double& u) const {
  const double low = cumulative[cluster.first];
  const double target = low + u * (cumulative[cluster.last] - low);
  const auto begin = cumulative.begin() + static_cast<std::ptrdiff_t>(cluster.first);
  const auto end = cumulative.begin() + static_cast<std::ptrdiff_t>(cluster.last);
  const auto above = std::upper_bound(begin + 1, end, target);
  u = std::clamp((target - above[-1]) / (*above - above[-1]), 0.0, std::nextafter(1.0, 0.0));
  return static_cast<std::size_t>(above - cumulative.begin()) - 1;
}

LightClusters make_light_clusters(int width, int height, const std::vector<double>& weights,
                                  std::size_t count, const TexelSpace& space,
                                  const Progress* progress) {
  return Builder(width, height, weights, space, progress).build(count);
}

LightClusters make_light_clusters(int width, int height, const std::vector<double>& weights,
                                  std::size_t count, const Progress* progress) {
  const TexelSpace sphere{
      [](double u, double v) {
        return panorama_direction({u, v});
      },
      [width, height](int size, double v) {
        const double tall = kPi * size / height;
        const double wide = 2.0 * kPi * size / width * std::sin(kPi * v);
        return std::max(tall, wide);
      },
      true,
  };
  return make_light_clusters(width, height, weights, count, sphere, progress);
}

}  // namespace lobelight
