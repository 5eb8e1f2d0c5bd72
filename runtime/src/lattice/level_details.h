// The details of one level as the stream has them, and what their integers are worth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/coefficient_layout.h"

namespace zerotree::surface {

/// The values of one channel by cell, in one of two widths; both null: all are zero.
struct ChannelValues {
  const std::int16_t* narrow = nullptr;
  const std::int32_t* wide = nullptr;

  std::int32_t operator[](std::size_t cell) const {
    return narrow ? narrow[cell] : wide ? wide[cell] : 0;
  }
};

/// All channels of a level. A value times the channel's unit is a length in the local frame where
/// the area weight is 1.
struct LevelDetails {
  std::array<ChannelValues, bitstream::kChannelCount> channels;
  std::array<float, bitstream::kChannelCount> units{};

  bool any() const {
    for (const ChannelValues& channel : channels)
      if (channel.narrow || channel.wide) return true;
    return false;
  }
};

}  // namespace zerotree::surface
