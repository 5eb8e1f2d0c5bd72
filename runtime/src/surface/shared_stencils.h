// A sparse operator whose rows share few sets of weights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace zerotree::surface {

/// Row r names vertices by `indices` and its weights by a mask: nearly all rows of a semi-regular
/// mesh have the regular one, so a row costs little more than its indices. A mask may hold several
/// weights per index (say of position and tangents), one plane after the other.
struct SharedStencils {
  std::vector<std::uint32_t> row_begin{0};   ///< into `indices`, one more than rows
  std::vector<std::uint32_t> mask_of_row;    ///< into `mask_begin`
  std::vector<std::uint32_t> indices;        ///< the rows one after the other
  std::vector<std::uint32_t> mask_begin{0};  ///< into `weights`, one more than masks
  std::vector<float> weights;                ///< the masks one after the other

  std::size_t row_count() const { return mask_of_row.size(); }
  std::span<const std::uint32_t> row_indices(std::size_t row) const {
    return std::span(indices).subspan(row_begin[row], row_begin[row + 1] - row_begin[row]);
  }
  /// The weights of the row's mask, `planes` times as many as indices.
  const float* row_weights(std::size_t row) const {
    return weights.data() + mask_begin[mask_of_row[row]];
  }
};

/// Appends rows to `SharedStencils` and finds their masks again.
class SharedStencilBuilder {
 public:
  void reserve(std::size_t rows, std::size_t indices_per_row);
  /// `weights` holds a whole number of planes of indices.size() weights.
  void add_row(std::span<const std::uint32_t> indices, std::span<const float> weights);
  SharedStencils take() { return std::move(stencils_); }

 private:
  std::uint32_t mask_for(std::span<const float> weights);

  SharedStencils stencils_;
  std::map<std::vector<float>, std::uint32_t> masks_;
  std::vector<float> last_;
  std::uint32_t last_mask_ = 0;
};

}  // namespace zerotree::surface
